#pragma once
// Points and triangles in the plane.

#include <algorithm>
#include <array>
#include <cmath>

namespace gneiss {

using Point2 = std::array<double, 2>;  ///< m

inline Point2 midpoint(const Point2& p, const Point2& q) { return {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])}; }

inline double distance(const Point2& p, const Point2& q) { return std::hypot(q[0] - p[0], q[1] - p[1]); }

/// Signed area, m2, positive where p, q, r run counter-clockwise.
inline double triangle_area(const Point2& p, const Point2& q, const Point2& r) {
    return 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]));
}

/// From a point to the edge from a to b, m.
inline double distance_to_edge(const Point2& p, const Point2& a, const Point2& b) {
    const double ex = b[0] - a[0], ey = b[1] - a[1];
    const double along = ((p[0] - a[0]) * ex + (p[1] - a[1]) * ey) / (ex * ex + ey * ey);
    const double t = std::clamp(along, 0.0, 1.0);
    return distance(p, {a[0] + t * ex, a[1] + t * ey});
}

/// From a point outside a triangle to it, m.
inline double distance_to_triangle(const Point2& p, const Point2& a, const Point2& b, const Point2& c) {
    return std::min({distance_to_edge(p, a, b), distance_to_edge(p, b, c), distance_to_edge(p, c, a)});
}

}  // namespace gneiss
