#pragma once
// The motion of a joint between two straight sub-edges that once were one, and the forces that its tractions exert
// [FORMULATION 7]. Nodes a0, a1 belong to the element on the left of the walk from a0 to a1, b0, b1 to the one on its
// right, b0 opposite a0. The joint is looked at at its two ends, each with half of its length.
//
// Directions are those of the middle line: t along it, n = (t_y, -t_x) from a to b. With D_i = u_bi - u_ai opening and
// slip are o_i = D_i.n, s_i = D_i.t; turning the line by d theta adds do = s d theta, ds = -o d theta. The forces are
// those whose virtual work is that of the tractions,
//
//   sum_i w (t_n do_i + t_s ds_i),   w = thickness times half the length in the reference shape,
//
// so that work, momentum and angular momentum are kept whatever the law.

#include <array>

#include "base/vec2.hpp"
#include "fracture/cohesion_properties.hpp"
#include "fracture/parts.hpp"

namespace gneiss {

inline constexpr std::size_t joint_points = 2, joint_nodes = 4;  ///< nodes: a0, a1, b0, b1

template <class T>
struct JointMotion {
    std::array<T, joint_points> opening, slip;  ///< m
    Vec2<T> along, normal;                      ///< t, n
    T length;                                   ///< of the middle line, m
};

/// @param edge  from a0 to a1 in the reference shape, m
/// @param u     displacements, m
template <class V, class T>
JointMotion<T> joint_motion(const Vec2<V>& edge, const std::array<Vec2<T>, joint_nodes>& u) {
    const Vec2<T> start = 0.5 * (u[0] + u[2]), end = 0.5 * (u[1] + u[3]);
    const Vec2<T> line{T(edge.x) + (end.x - start.x), T(edge.y) + (end.y - start.y)};
    JointMotion<T> motion;
    motion.length = square_root(dot(line, line));
    const T inverse = T(1.0) / motion.length;
    motion.along = inverse * line;
    motion.normal = {motion.along.y, -motion.along.x};
    for (std::size_t i = 0; i < joint_points; ++i) {
        const Vec2<T> apart = u[i + 2] - u[i];
        motion.opening[i] = dot(apart, motion.normal);
        motion.slip[i] = dot(apart, motion.along);
    }
    return motion;
}

/// Forces on the nodes, N.
/// @param weight  w, m2
template <class V, class T>
std::array<Vec2<T>, joint_nodes> joint_forces(const JointMotion<T>& motion, const V& weight,
                                              const std::array<Traction<T>, joint_points>& tractions) {
    std::array<Vec2<T>, joint_nodes> f;
    T moment(0.0);  // the work per turn of the middle line
    for (std::size_t i = 0; i < joint_points; ++i) {
        const T normal = weight * tractions[i].normal, shear = weight * tractions[i].shear;
        f[i] = normal * motion.normal + shear * motion.along;
        f[i + 2] = -f[i];
        moment += normal * motion.slip[i] - shear * motion.opening[i];
    }
    // d theta = -n.(du_end - du_start)/length, ends and starts being means of two nodes
    const Vec2<T> turning = (0.5 * moment / motion.length) * motion.normal;
    for (const std::size_t side : {std::size_t{0}, std::size_t{2}}) {
        f[side] += -turning;
        f[side + 1] += turning;
    }
    return f;
}

/// The same where both tractions are k times opening and slip: then an end pulls along D, w k D, and the moment is
/// none, whichever way the middle line points.
/// @param stiffness  w k, N/m
template <class V, class T>
std::array<Vec2<T>, joint_nodes> elastic_forces(const V& stiffness, const std::array<Vec2<T>, joint_nodes>& u) {
    std::array<Vec2<T>, joint_nodes> f;
    for (std::size_t i = 0; i < joint_points; ++i) {
        f[i] = stiffness * (u[i + 2] - u[i]);
        f[i + 2] = -f[i];
    }
    return f;
}

}  // namespace gneiss
