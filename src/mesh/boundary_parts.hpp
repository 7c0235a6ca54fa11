#pragma once
// Parts of a boundary that get a name by where they are.

#include "mesh/mesh.hpp"
#include "mesh/mesh_options.hpp"

namespace gneiss {

/// Adds every part as a boundary of its own, with its nodes: the edges that lie in the box, its rim included.
/// @throws InputError with everything that is wrong: an unknown boundary, a name that is taken, no edge in the box, an
///     edge that is cut by it (a traction on the part would not be the one that was asked for)
void name_parts(Mesh& mesh, const std::vector<BoundaryPart>& parts);

/// Where the contour is one rectangle along x and y, its sides become the boundaries "bottom", "right", "top", "left",
/// those of these names that are free.
void name_sides_of_rectangle(Mesh& mesh, const std::vector<BoundaryEdge>& contour);

}  // namespace gneiss
