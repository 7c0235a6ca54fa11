#pragma once
// What makes a mesh unfit, found all at once and named by the labels of the user's file.

#include <cstdint>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "mesh/draft.hpp"

namespace gneiss {

/// What is wrong with a draft whose mid-side nodes are all there and whose elements run counter-clockwise. Errors:
/// - a coordinate that is not a number; an element of zero area or with a repeated node; one with a sub-triangle turned
///   inside out by its mid-side nodes;
/// - elements on the same three corners; more than two elements at one side; two elements on the same side of it;
///   neighbours that share corners but not the node between them; a corner that is a mid-side of another element;
/// - pieces that hang together in a node alone (a hinge: separate bodies need nodes of their own);
/// - named lines and points that belong to no element.
/// Warnings, because they are legitimate in a mesh of several bodies or cracks: separate pieces, coincident nodes,
/// nodes that belong to no element (these are dropped).
/// @param[out] warnings  appended to
std::vector<Problem> check(const MeshDraft& draft, std::vector<std::string>& warnings);

/// "node 7", "nodes 3, 5 and 8", "nodes 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 and 37 more": ascending, each number once.
/// @param labels  at least one
std::string numbered(const char* noun, std::vector<std::int64_t> labels);

}  // namespace gneiss
