#pragma once
// Where a boundary feels for other bodies: contactor points on its edges.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace gneiss {

/// Contactor points as parallel arrays. Point i stands at (1 - weight_b[i]) x(a[i]) + weight_b[i] x(b[i]).
struct ContactorPoints {
    std::vector<std::int32_t> a, b;  ///< ends of the edge; equal for a point that is a node
    std::vector<double> weight_b;    ///< in [0, 1)
    std::vector<double> length;      ///< tributary length in the reference shape, m
    /// The points at the two ends and in the middle of every edge.
    std::vector<std::array<std::int32_t, 3>> of_edge;

    std::size_t size() const { return a.size(); }
};

/// The points of Simpson's rule on every edge: its middle with 2/3 of its length, and each of its nodes with 1/6; a
/// node gathers the shares of all its edges in one point, so that there are about two points per edge. Linear openings
/// along an edge give the exact energy (a quadratic), and corners, which meet other bodies first, are points
/// themselves.
/// @param edges  edges of the boundary, crack faces included
/// @param nodes  reference positions, m
/// @returns points in the order of the edges, a node before the first edge that leaves from or arrives at it
ContactorPoints contactor_points(std::span<const BoundaryEdge> edges, std::span<const std::array<double, 2>> nodes);

/// Where a point comes from as a mesh comes apart.
struct FormerPoint {
    std::int32_t point =
        -1;            ///< that had its place on the same edges: itself, or of the node that was copied; -1: none
    double share = 0;  ///< part of the point's length now that these edges make
};
/// @param old  of the first ones among the edges of `now`
std::vector<FormerPoint> former_points(const ContactorPoints& old, const ContactorPoints& now);

}  // namespace gneiss
