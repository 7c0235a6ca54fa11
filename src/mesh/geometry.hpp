#pragma once
// Points and triangles in the plane.

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

}  // namespace gneiss
