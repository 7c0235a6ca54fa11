#pragma once
// From options to a mesh that is fit for computation.

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/draft.hpp"
#include "mesh/mesh.hpp"
#include "mesh/mesh_options.hpp"

namespace gneiss {

/// What is worth knowing about a mesh, but no error.
struct MeshReport {
    std::vector<std::string> warnings;
};

/// The mesh that the options describe: made or read, checked (check.hpp), renumbered for locality (renumber() of
/// draft.hpp). Besides the boundaries that have names, "boundary" is the whole contour, unless the file uses this name;
/// where nothing else on the contour has one and it is a rectangle, its sides have theirs (name_sides_of_rectangle()).
/// A boundary consists of contour edges only; the sides of a named line inside the solid are in inner_lines. A line
/// that is both is warned of.
/// @param compt     false: CST by split_composites(), on the same nodes
/// @param base_dir  where a relative file name starts
/// @param report    filled if given
/// @throws InputError with everything that is wrong with the options, or else with the mesh
Mesh make_mesh(const MeshOptions& options, bool compt, const std::filesystem::path& base_dir,
               MeshReport* report = nullptr);

/// Checks a draft whose mid-side nodes are all there and turns it into a mesh, the last step of make_mesh().
Mesh finish(MeshDraft draft, bool compt, MeshReport& report);

/// The same mesh with every composite cut into its four sub-triangles: composite e becomes CST 4e to 4e+3, in the order
/// of composite.hpp, counter-clockwise, each with the region, the data and the label of its composite. Nodes,
/// boundaries and node sets stay; the elements of boundary edges and of inner lines become the CST that they belong to.
/// @param composites  of kind compt
Mesh split_composites(const Mesh& composites);

}  // namespace gneiss
