#include "mesh/locate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "mesh/geometry.hpp"
#include "mesh/sub_triangles.hpp"

namespace gneiss {
namespace {

/// How far outside a point may lie, in longest edges of the nearest triangle: eight edges around a full circle, far
/// coarser than any hole should be, leave a gap of 0.099 edges.
constexpr double reach = 0.1;

/// Weights are exact to about this; a point is inside when none is below its negative.
constexpr double round_off = 1e-12;

using Triangle = std::array<Point2, 3>;

Triangle corners(const Mesh& mesh, const std::array<int, 3>& nodes) {
    return {mesh.nodes[nodes[0]], mesh.nodes[nodes[1]], mesh.nodes[nodes[2]]};
}

std::array<double, 3> barycentric(const Triangle& t, const Point2& x) {
    const double whole = triangle_area(t[0], t[1], t[2]);
    const double first = triangle_area(x, t[1], t[2]) / whole, second = triangle_area(t[0], x, t[2]) / whole;
    return {first, second, 1 - first - second};
}

/// Weights of the nearest point of the triangle to a point outside: it lies on one of the edges.
std::array<double, 3> nearest_weights(const Triangle& t, const Point2& x) {
    double nearest = std::numeric_limits<double>::max();
    std::array<double, 3> weights{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 &p = t[i], &q = t[(i + 1) % 3];
        const Point2 edge{q[0] - p[0], q[1] - p[1]};
        const double length = std::hypot(edge[0], edge[1]);
        const double along = ((x[0] - p[0]) * edge[0] + (x[1] - p[1]) * edge[1]) / (length * length);
        const double s = std::clamp(along, 0.0, 1.0);
        const double d = distance(x, {std::lerp(p[0], q[0], s), std::lerp(p[1], q[1], s)});
        if (d < nearest) {
            nearest = d;
            weights = {};
            weights[i] = 1 - s;
            weights[(i + 1) % 3] = s;
        }
    }
    return weights;
}

double distance_to(const Triangle& t, const std::array<double, 3>& weights, const Point2& x) {
    Point2 y{0, 0};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 2; ++k) y[k] += weights[i] * t[i][k];
    return distance(x, y);
}

double longest_edge(const Triangle& t) {
    return std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])});
}

}  // namespace

MeshPoint locate(const Mesh& mesh, const std::array<double, 2>& point) {
    const int n_sub = static_cast<int>(sub_triangles(mesh.kind).size());
    MeshPoint best{};
    double least = std::numeric_limits<double>::infinity(), allowed = 0;
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (int sub = 0; sub < n_sub; ++sub) {
            const std::array<int, 3> nodes = triangle_nodes(mesh, e, sub);
            const Triangle t = corners(mesh, nodes);
            std::array<double, 3> weights = barycentric(t, point);
            if (*std::min_element(weights.begin(), weights.end()) >= -round_off) {
                for (double& weight : weights) weight = std::max(weight, 0.0);
                return {static_cast<int>(e), sub, nodes, weights};
            }
            weights = nearest_weights(t, point);
            if (const double d = distance_to(t, weights, point); d < least) {
                least = d;
                allowed = reach * longest_edge(t);
                best = {static_cast<int>(e), sub, nodes, weights};
            }
        }
    if (!(least <= allowed))
        throw InputError(
            "", fmt::format("the point ({}, {}) m lies {:.3g} m outside the solid", point[0], point[1], least));
    return best;
}

}  // namespace gneiss
