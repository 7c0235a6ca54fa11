#pragma once
// The contour of a mesh and of its parts.

#include <vector>

#include "mesh/mesh.hpp"

namespace gneiss {

/// All edges that belong to one element only, with the solid on the left, in walking order.
std::vector<BoundaryEdge> contour(const Mesh& mesh);

/// The same edges ordered so that each starts where the one before it ends, as far as they chain: open chains from
/// their first edge, then closed ones from their lowest node.
std::vector<BoundaryEdge> in_walking_order(const std::vector<BoundaryEdge>& edges);

/// Nodes of the edges, ascending, each once.
std::vector<std::int32_t> nodes_of(const std::vector<BoundaryEdge>& edges);

}  // namespace gneiss
