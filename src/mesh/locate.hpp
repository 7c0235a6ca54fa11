#pragma once
// Which triangle a point lies in: probes, initial fields.

#include <array>

#include "mesh/mesh.hpp"

namespace gneiss {

/// A point of the solid as the mean of three nodes. A linear field has the value sum of weights[i] * field(nodes[i]).
struct MeshPoint {
    int element;
    int sub_triangle;               ///< 0 to 3 as in composite.hpp; 0 for CST
    std::array<int, 3> nodes;       ///< a, b, c of the sub-triangle; of a CST its nodes
    std::array<double, 3> weights;  ///< in [0, 1], sum 1 to round-off
};

/// The triangle that contains a point of the reference shape; of several that meet there, the first. A point outside,
/// but no further than a tenth of the edge of the nearest triangle, is moved to the nearest point of the solid: a probe
/// on a curved boundary stands beside the straight edges that approximate it.
/// @param point  m
/// @throws InputError if the point is further outside; the message gives the distance to the solid
MeshPoint locate(const Mesh& mesh, const std::array<double, 2>& point);

}  // namespace gneiss
