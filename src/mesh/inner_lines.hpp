#pragma once
// Straight lines of sides inside the solid that get a name by where they are.

#include "mesh/mesh.hpp"
#include "mesh/mesh_options.hpp"

namespace gneiss {

/// Adds every line to the inner lines of the mesh, and its nodes to the node sets: the sides between two elements whose
/// nodes all stand on it, to a millionth of the side's length.
/// @throws InputError with everything that is wrong: a name that is taken, a line that these sides do not cover from
/// end
///     to end (how long it is, how much of it they cover, where they stop)
void name_lines(Mesh& mesh, const std::vector<InnerLine>& lines);

}  // namespace gneiss
