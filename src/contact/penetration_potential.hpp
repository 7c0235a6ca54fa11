#pragma once
// How deep a point is inside a body: the penetration potential of FORMULATION 6, a length that vanishes on the
// boundary.
//
// Inside, it is the distance to the boundary in the reference shape, linear in every triangle between nodal values. A
// triangle with three nodes on the boundary, a fragment for example, would have none; it takes the potential of
// Munjiza and Andrews (2000), "Penalty function method for combined finite-discrete element systems comprising large
// number of separate bodies", International Journal for Numerical Methods in Engineering 49, 1377-1396, scaled to its
// inradius r: 3 r min(lambda_1, lambda_2, lambda_3). Both are zero along an edge between two boundary nodes, so the
// potential is continuous across the triangles of a body.
//
// A crack only shortens distances, and the nearest point of a boundary can be seen from any point of the body. So
// everything is told in the numbers of the mesh before any node has split: all copies of a split node lie on the
// boundary, at potential 0.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "mesh/geometry.hpp"

namespace gneiss {

/// Part of the way to a crest of the potential, where its force turns round, up to which a penetration is sound.
inline constexpr double trusted_depth = 0.75;

/// The potential of one triangle: sum of lambda_i nodal[i] + bubble min(lambda_1, lambda_2, lambda_3), m.
struct TrianglePotential {
    std::array<double, 3> nodal{};  ///< m, >= 0
    double bubble = 0;              ///< 3 r, m; 0 unless all three nodes are on the boundary
    /// Deepest penetration that the potential answers for, m: `trusted_depth` of the crest in this triangle, infinite
    /// where the potential goes on rising into the next one. Where it has been capped the force is gone: a crest too.
    double reach = std::numeric_limits<double>::infinity();
};

class PenetrationPotential {
public:
    /// Without any boundary yet: every node stands at its cap.
    /// @param nodes      reference positions, m
    /// @param triangles  node numbers, shape (n_triangles, 3), of positive area in either sense
    /// @param cap        in local sizes, > 0: no distance counts for more. The local size of a node is the mean over
    /// its triangles of the side of an equilateral triangle of the same area; it may grow at most half as fast as one
    /// moves along edges, and is less where triangles nearby are smaller
    PenetrationPotential(std::vector<Point2> nodes, std::vector<std::array<std::int32_t, 3>> triangles, double cap);

    /// Adds edges to the boundary: the contour first, then edges as they break. The cost is proportional to the number
    /// of edges, not to the size of the mesh.
    /// @param edges  node numbers, shape (n, 2); each an edge of a triangle
    void add_boundary(std::span<const std::array<std::int32_t, 2>> edges);

    /// Nodal potential, m.
    double at_node(std::int32_t node) const { return values_[static_cast<std::size_t>(node)]; }
    const TrianglePotential& of_triangle(std::size_t t) const { return potentials_[t]; }

    /// Triangles whose potential the last add_boundary has changed, ascending: where the energy of pairs in touch has
    /// jumped.
    std::span<const std::int32_t> changed() const { return changed_; }

private:
    std::span<const std::int32_t> triangles_around(std::int32_t node) const;
    void cap_by_local_size(double cap);
    void lower_near(const std::array<std::int32_t, 2>& edge);
    void lower(std::int32_t node, double value);
    bool is_crest(std::int32_t node) const;
    TrianglePotential potential(std::size_t t) const;
    bool visit(std::int32_t triangle);

    std::vector<Point2> nodes_;
    std::vector<std::array<std::int32_t, 3>> triangles_;
    std::vector<std::int32_t> around_, first_around_;  // triangles around nodes, compressed rows
    std::vector<double> caps_, values_;                // m
    std::vector<TrianglePotential> potentials_;

    std::vector<std::int32_t> lowered_, changed_, queue_;
    std::vector<std::uint32_t> visited_;  // per triangle, the walk that saw it last
    std::uint32_t walk_ = 0;
};

}  // namespace gneiss
