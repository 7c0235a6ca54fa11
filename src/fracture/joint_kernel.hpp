#pragma once
// The motion of a joint between two straight sub-edges that once were one, and the forces that its tractions exert
// [FORMULATION 7]. Nodes a0, a1 belong to the element on the left of the walk from a0 to a1, b0, b1 to the one on its
// right, b0 opposite a0. The joint is looked at at its two ends, each with half of its length.
//
// Directions are those half-way between the two faces, t_a and t_b along them from their starts to their ends: t along
// (t_a + t_b), n = (t_y, -t_x) from a to b. With D_i = u_bi - u_ai opening and slip are o_i = D_i.n, s_i = D_i.t;
// turning the faces by d theta_a and d theta_b turns t by d theta = (d theta_a + d theta_b)/2 and adds do = s d theta,
// ds = -o d theta. The forces are those whose virtual work is that of the tractions,
//
//   sum_i w (t_n do_i + t_s ds_i),   w = thickness times half the length in the reference shape,
//
// so that work, momentum and angular momentum are kept whatever the law.
//
// Faces that open like a book turn against each other by 180 degrees and more, past which t_a + t_b vanishes and comes
// back with the other sign. From 90 degrees on n is therefore taken along t_b - t_a, the same line, and of its two
// directions the one along which the end that is farther apart stands open: D_1 - D_0 is as long as t_b - t_a, so that
// this end is at least 0.7 lengths away, which no end is that presses (elements would have been inverted long before).
// As the faces come round, nearly a full turn, t_a + t_b serves again and the same rule tells its sign: an end that
// lies more than half a length on the wrong side has come there from behind. Opening, slip and their energy are
// continuous all the way, from the faces closed to 331 degrees open.

#include <array>

#include "base/functions.hpp"
#include "base/vec2.hpp"
#include "fracture/cohesion_properties.hpp"
#include "fracture/parts.hpp"

namespace gneiss {

inline constexpr std::size_t joint_points = 2, joint_nodes = 4;  ///< nodes: a0, a1, b0, b1

template <class T>
struct JointMotion {
    std::array<T, joint_points> opening, slip;  ///< m
    Vec2<T> along, normal;                      ///< t, n
    /// Of faces a and b: d theta = -turning.(du_end - du_start), 1/m.
    std::array<Vec2<T>, 2> turning;
    T length;  ///< mean of the two faces, m
};

/// @param edge  from a0 to a1 in the reference shape, m
/// @param u     displacements, m
template <class V, class T>
JointMotion<T> joint_motion(const Vec2<V>& edge, const std::array<Vec2<T>, joint_nodes>& u) {
    JointMotion<T> motion;
    std::array<Vec2<T>, 2> face;  // t_a, t_b
    std::array<T, 2> lengths;
    for (const std::size_t f : {std::size_t{0}, std::size_t{1}}) {
        const Vec2<T> from_start = u[2 * f + 1] - u[2 * f];
        const Vec2<T> line{T(edge.x) + from_start.x, T(edge.y) + from_start.y};
        lengths[f] = square_root(dot(line, line));
        const T inverse = T(1.0) / lengths[f];
        face[f] = inverse * line;
        motion.turning[f] = inverse * Vec2<T>{face[f].y, -face[f].x};
    }
    motion.length = 0.5 * (lengths[0] + lengths[1]);

    const auto facing = plain(dot(face[0], face[1])) >= 0.0;
    const Vec2<T> sum = face[0] + face[1], across = turned(face[1] - face[0]);
    const Vec2<T> middle{choose(facing, sum.x, across.x), choose(facing, sum.y, across.y)};
    motion.along = (T(1.0) / square_root(dot(middle, middle))) * middle;
    motion.normal = {motion.along.y, -motion.along.x};
    for (std::size_t i = 0; i < joint_points; ++i) {
        const Vec2<T> apart = u[i + 2] - u[i];
        motion.opening[i] = dot(apart, motion.normal);
        motion.slip[i] = dot(apart, motion.along);
    }

    const auto way = [&](std::size_t i) {
        return plain(motion.opening[i]) * plain(motion.opening[i]) + plain(motion.slip[i]) * plain(motion.slip[i]);
    };
    const auto end_is_farther = way(1) > way(0);
    const auto open = choose(end_is_farther, plain(motion.opening[1]), plain(motion.opening[0]));
    const auto behind = open < choose(facing, decltype(open)(-0.5 * plain(motion.length)), decltype(open)(0.0));
    if (!any_lane(behind)) return motion;
    const auto about = [&](T& x) { x = choose(behind, T(-x), x); };
    for (Vec2<T>* direction : {&motion.along, &motion.normal}) {
        about(direction->x);
        about(direction->y);
    }
    for (std::size_t i = 0; i < joint_points; ++i) {
        about(motion.opening[i]);
        about(motion.slip[i]);
    }
    return motion;
}

/// Forces on the nodes, N.
/// @param weight  w, m2
template <class V, class T>
std::array<Vec2<T>, joint_nodes> joint_forces(const JointMotion<T>& motion, const V& weight,
                                              const std::array<Traction<T>, joint_points>& tractions) {
    std::array<Vec2<T>, joint_nodes> f;
    T moment(0.0);  // the work per turn of t
    for (std::size_t i = 0; i < joint_points; ++i) {
        const T normal = weight * tractions[i].normal, shear = weight * tractions[i].shear;
        f[i] = normal * motion.normal + shear * motion.along;
        f[i + 2] = -f[i];
        moment += normal * motion.slip[i] - shear * motion.opening[i];
    }
    for (std::size_t side = 0; side < 2; ++side) {
        const Vec2<T> turning = (0.5 * moment) * motion.turning[side];
        f[2 * side] += -turning;
        f[2 * side + 1] += turning;
    }
    return f;
}

/// The same where both tractions are k times opening and slip: then an end pulls along D, w k D, and the moment is
/// none, whichever way t points.
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
