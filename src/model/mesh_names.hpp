#pragma once
// What a user's `on = "..."` means on a mesh.

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace gneiss {

// Each function throws InputError with empty `where` if the mesh has no such thing of this name. The message says
// whether the name belongs to something else, lists the names there are, and suggests the one that was probably meant.

const std::vector<BoundaryEdge>& boundary_named(const Mesh& mesh, const std::string& name);
/// A line of sides inside the solid.
const std::vector<ElementSide>& inner_line_named(const Mesh& mesh, const std::string& name);
/// Nodes of a set or of a boundary, ascending.
const std::vector<std::int32_t>& nodes_named(const Mesh& mesh, const std::string& name);
/// Numbers of the elements of a region, ascending.
std::vector<std::int32_t> elements_named(const Mesh& mesh, const std::string& region);
/// Nodes of a region or of a set, ascending. A name that means both is refused, unless
/// the nodes are among those of the region.
std::vector<std::int32_t> region_or_nodes_named(const Mesh& mesh, const std::string& name);

}  // namespace gneiss
