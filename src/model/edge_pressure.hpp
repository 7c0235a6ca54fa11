#pragma once
// The pressure on one current edge, for any scalar: with dual numbers the same source gives its tangent.

#include <array>

#include "base/vec2.hpp"

namespace gneiss {

/// Nodal forces, N, of a pressure on the current edge from node a to node b; the solid lies on the left, so that
/// (dy, -dx) points out of it. The pressure varies linearly from a to b; integrated exactly with linear shape
/// functions.
/// @param edge      current x_b - x_a, m
/// @param p_a, p_b  pressure at the nodes, Pa, > 0 pushes onto the solid
/// @param thickness h, m
/// @return forces on a and on b; for constant p each is -p h (dy, -dx)/2
template <class T>
std::array<Vec2<T>, 2> edge_pressure_forces(const Vec2<T>& edge, double p_a, double p_b, double thickness) {
    const Vec2<T> inward{-edge.y, edge.x};
    return {T(thickness * (2 * p_a + p_b) / 6) * inward, T(thickness * (p_a + 2 * p_b) / 6) * inward};
}

}  // namespace gneiss
