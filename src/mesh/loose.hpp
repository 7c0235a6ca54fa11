#pragma once
// What stands in a mesh file beside its triangles: nodes, points and curves of something else.

#include <cstdint>
#include <vector>

#include "mesh/draft.hpp"

namespace gneiss {

/// Labels of nodes of elements that are not as high as the others.
/// @param heights  z of each node of the draft, m
std::vector<std::int64_t> off_plane(const MeshDraft& draft, const std::vector<double>& heights);

/// Takes points that belong to no element, and sides with an end that belongs to none, out of the names: rods that
/// stick out, axes, points that a drawing was made with. A name with nothing left is no name. The draft warns of them.
void drop_loose_names(MeshDraft& draft);

}  // namespace gneiss
