#include "mesh/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/geometry.hpp"
#include "mesh/sub_triangles.hpp"

namespace gneiss {
namespace {

/// Calls visit(e, p, q, r) with the corners of every triangle of every element.
template <class Visit>
void for_each_triangle(const Mesh& mesh, Visit&& visit) {
    const int n_sub = static_cast<int>(sub_triangles(mesh.kind).size());
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (int sub = 0; sub < n_sub; ++sub) {
            const auto [i, j, k] = triangle_nodes(mesh, e, sub);
            visit(e, mesh.nodes[i], mesh.nodes[j], mesh.nodes[k]);
        }
}

}  // namespace

std::vector<std::array<double, 2>> element_centroids(const Mesh& mesh) {
    std::vector<std::array<double, 2>> centroids(mesh.n_elements(), {0, 0});
    const std::vector<double> areas = element_areas(mesh);
    for_each_triangle(mesh, [&](std::size_t e, const Point2& p, const Point2& q, const Point2& r) {
        const double share = std::abs(triangle_area(p, q, r)) / areas[e];
        for (int i : {0, 1}) centroids[e][i] += share * (p[i] + q[i] + r[i]) / 3;
    });
    return centroids;
}

std::vector<double> element_areas(const Mesh& mesh) {
    std::vector<double> areas(mesh.n_elements(), 0);
    for_each_triangle(mesh, [&](std::size_t e, const Point2& p, const Point2& q, const Point2& r) {
        areas[e] += std::abs(triangle_area(p, q, r));
    });
    return areas;
}

bool has_straight_sides(const Mesh& mesh, std::size_t element) {
    // of a coordinate; what a mid-point computed in one way or another may differ by
    constexpr double round_off = 1e-15;
    const std::int32_t* nodes = mesh.element(element);
    const auto at = [&](int local) { return mesh.nodes[static_cast<std::size_t>(nodes[local])]; };
    for (const auto& [a, middle, b] : composite_sides) {
        const Point2 from = at(a), between = at(middle), to = at(b);
        const double size = std::max({std::abs(from[0]), std::abs(from[1]), std::abs(to[0]), std::abs(to[1])});
        if (!(distance(between, midpoint(from, to)) <= round_off * size)) return false;
    }
    return true;
}

MeshSize mesh_size(const Mesh& mesh) {
    MeshSize size{mesh.n_nodes(), mesh.n_elements(), std::numeric_limits<double>::max(), 0, 0};
    for_each_triangle(mesh, [&](std::size_t, const Point2& p, const Point2& q, const Point2& r) {
        for (double edge : {distance(p, q), distance(q, r), distance(r, p)}) {
            size.smallest_edge = std::min(size.smallest_edge, edge);
            size.largest_edge = std::max(size.largest_edge, edge);
        }
        size.area += std::abs(triangle_area(p, q, r));
    });
    return size;
}

double largest_coordinate(const Mesh& mesh) {
    double largest = 0;
    for (const auto& [x, y] : mesh.nodes) largest = std::max({largest, std::abs(x), std::abs(y)});
    return largest;
}

}  // namespace gneiss
