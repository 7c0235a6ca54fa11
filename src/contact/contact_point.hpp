#pragma once
// One contactor point inside one target triangle: penetration, normal force, friction   [FORMULATION 6].
//
// The point stands at P = sum lambda_i x_i in the current triangle. Whatever is interpolated linearly in it,
// phi = sum lambda_i c_i, moves with its nodes: keeping P fixed, sum dlambda_i x_i = -lambda_j dx_j, so that
//
//     d phi/dP = g = sum c_i grad lambda_i,        d phi/dx_j = -lambda_j g                                  (1)
//
// An energy w(phi) therefore pushes the point with F = -w' g and the nodes of the target with -lambda_j F: forces add
// up to nothing because lambda adds up to one, moments because sum lambda_j x_j = P. That holds for every F, and
// friction uses it too.
//
// Normal. phi is the penetration potential (penetration_potential.hpp); in 3 r min(lambda) the smallest lambda only
// counts, with c = 3 r at its node. The normal is that of g, turned outwards: n = -g/|g|. Force on the point
// p_n h l phi g, the exact gradient of 1/2 p_n h l phi^2. |g| = |F^-T grad phi| is 1 in an undeformed body.
//
// Restitution e < 1. The point loads along p_n and unloads along p_n/e^2, down to a depth (1 - e^2) of the deepest one;
// Walton and Braun (1986), Journal of Rheology 30, 949-980. What comes back is e^2 of the energy, whatever the masses,
// the speed and the mesh; no velocity is involved. The unloading branch is stiffer by 1/e^2: so is the bound on the
// step.
//
// Tangent. The spring measures in the reference shape of the target, as phi does. With X(P) = sum lambda_i X_i, the
// place in the target that the point touches, and t the unit tangent, grad phi in the reference shape turned by +90
// degrees,
//
//     s = t . (X(P) - A),      force on the point -k_t s q,      q = ds/dP = sum (t . X_i) grad lambda_i         (2)
//
// A, the anchor, being where in the target the spring is fixed. (2) is linear like phi: (1) holds, the spring is
// conservative, momentum is conserved, and a rigid motion changes nothing. In the undeformed body q is the unit
// tangent; in a sheared one it leans from the current tangent by the angle of shear, a strain. Coulomb: k_t |s| |q| <=
// mu t_n with t_n = |normal force|; beyond, the anchor follows the point.
//
// Into the next triangle, or past the edge where the smallest lambda changes, t turns while X(P) goes on continuously.
// An accepted state leaves the anchor at A = X(P) - s t, the spring at S = s t: (2) with the new t then takes the
// spring's projection on the new tangent, and adds the motion along it since. What projection takes from the energy of
// the spring counts as dissipated. So a history belongs to a point and to the body that it is in, not to a triangle: it
// survives where the target has not come apart between the old triangle and the new one.
//
// Rest depth. What overlaps already when contact takes over, because it was bonded until then, would be pushed apart
// with an energy from nowhere. Such a pair has a rest depth phi_0, from which its penetration is counted: <phi - phi_0>
// stands for phi above. phi_0 goes down with phi as the overlap comes apart, without a force, and never up.
//
// The history is that of the last accepted state; a trial reads it and returns what accepting would leave.

#include <array>
#include <cstddef>

#include "base/dual.hpp"
#include "base/functions.hpp"
#include "base/vec2.hpp"

namespace gneiss {

// Throughout, V is double or Pack, and T is V or a dual of V. Nodes of a target run counter-clockwise.

/// a b - c d with one rounding of a b: antisymmetric under a change of sign of a and c, bit by bit.
inline double difference_of_products(double a, double b, double c, double d) { return std::fma(a, b, -(c * d)); }
inline Pack difference_of_products(const Pack& a, const Pack& b, const Pack& c, const Pack& d) {
    return xsimd::fms(a, b, c * d);
}

/// Which lanes lie in the triangle. A point on an edge between two triangles lies in exactly one of them, whatever the
/// rounding: both measure it from the same end of the edge.
/// @param x       current nodes, m, shape (3)
/// @param rising  shape (3): 1 where the edge opposite to node i, from node i + 1 to node i + 2, runs from the lower
/// node number to the higher one, else 0
template <class V>
decltype(V(0.0) > V(0.0)) contains(const Vec2<V>& point, const std::array<Vec2<V>, 3>& x,
                                   const std::array<V, 3>& rising) {
    const auto inner_side = [&](std::size_t i) {
        const Vec2<V>&from = x[(i + 1) % 3], &to = x[(i + 2) % 3];
        const Vec2<V> edge = to - from;
        const auto ascending = rising[i] > V(0.5);
        const Vec2<V> arm{point.x - choose(ascending, from.x, to.x), point.y - choose(ascending, from.y, to.y)};
        const V twice_area = difference_of_products(edge.x, arm.y, edge.y, arm.x);
        return (twice_area > V(0.0)) | ((twice_area == V(0.0)) & ascending);
    };
    return inner_side(0) & inner_side(1) & inner_side(2);
}

/// The target triangle as contact sees it.
template <class V>
struct ContactTarget {
    std::array<Vec2<V>, 3> reference;  ///< reference positions of the nodes, m
    std::array<V, 3> nodal;            ///< of TrianglePotential, m
    V bubble, reach;                   ///< of TrianglePotential, m
};

/// Constants of a pair.
template <class V>
struct ContactLaw {
    V normal_stiffness;      ///< p_n h l, N/m, > 0
    V tangential_stiffness;  ///< p_t h l, N/m, > 0
    V friction;              ///< mu, >= 0
    V returned;              ///< e^2, in (0, 1]: what comes back of the energy of an impact
};

/// What a pair remembers. All zero: not in touch.
template <class V>
struct ContactHistory {
    V in_touch = V(0.0);             ///< 1 or 0
    Vec2<V> anchor{V(0.0), V(0.0)};  ///< A, m, in the reference shape of the target
    Vec2<V> slip{V(0.0), V(0.0)};    ///< S = s t, elastic slip, m
    V slip_limit = V(0.0);           ///< largest |s| that friction held, m
    V deepest = V(0.0);              ///< largest depth since contact began, m
    V rest = V(0.0);                 ///< phi_0, m, >= 0
};

template <class T, class V>
struct ContactResponse {
    Vec2<T> force;                       ///< on the contactor point, N; on node j of the target -lambda[j] force
    std::array<T, 3> lambda;             ///< barycentric coordinates of the point
    T depth;                             ///< <phi - phi_0>, m
    V stored_normal;                     ///< J
    V stored_tangential;                 ///< J
    V dissipated_normal;                 ///< by restitution since the accepted state, J, >= 0
    V dissipated_friction;               ///< since the accepted state, J, >= 0
    decltype(V(0.0) > V(0.0)) too_deep;  ///< deeper than the potential reaches: to be reported, the force means nothing
    ContactHistory<V> next;              ///< what accepting this state would leave
};

/// Friction work, J, on the way from the accepted state to a trial, where the stretch of the spring would go from s_0
/// to s and the limit goes from l_0 to l, both in proportion: sliding begins where they meet, and from there the anchor
/// moves by what is too much. Exact however the way is cut into steps. 0 where the limit is not met.
template <class V>
V sliding_work(const V& stiffness, const V& s_0, const V& s, const V& l_0, const V& l) {
    const V direction = choose(s > V(0.0), V(1.0), V(-1.0));
    const V excess = direction * s - l, excess_0 = direction * s_0 - l_0;
    const auto slides = excess > V(0.0);
    // the way from 0 to 1 on which the limit is met; where nothing slides any number will do
    const V approach = choose(slides & (excess_0 < V(0.0)), excess - excess_0, V(1.0));
    const V begin = choose(excess_0 < V(0.0), -excess_0 / approach, V(0.0));
    const V l_begin = l_0 + begin * (l - l_0);
    return choose(slides, 0.5 * stiffness * (l_begin + l) * excess, V(0.0));
}

/// Whether there is a tangential spring. Without one nothing is remembered either: friction 0 and all of the energy
/// returned; it saves half of the work.
enum class Tangential { held, none };

/// Force and energies of a point that lies in the triangle (`contains`).
/// @param point  current position, m
/// @param x      current nodes of the target, m, shape (3), not inverted
/// @param old    of the last accepted state; zero if the point did not touch this body
template <Tangential tangential = Tangential::held, class T, class V>
ContactResponse<T, V> contact_response(const Vec2<T>& point, const std::array<Vec2<T>, 3>& x,
                                       const ContactTarget<V>& target, const ContactLaw<V>& law,
                                       const ContactHistory<V>& old) {
    ContactResponse<T, V> result;

    // barycentric coordinates and their gradients, current and reference
    const Vec2<T> e_1 = x[1] - x[0], e_2 = x[2] - x[0], arm = point - x[0];
    const T per_area = T(V(1.0)) / cross(e_1, e_2);
    const Vec2<T> grad_1{e_2.y * per_area, -(e_2.x * per_area)}, grad_2{-(e_1.y * per_area), e_1.x * per_area};
    const T lambda_1 = dot(grad_1, arm), lambda_2 = dot(grad_2, arm), lambda_0 = T(V(1.0)) - lambda_1 - lambda_2;
    result.lambda = {lambda_0, lambda_1, lambda_2};
    const Vec2<V> edge_1 = target.reference[1] - target.reference[0],
                  edge_2 = target.reference[2] - target.reference[0];
    const V per_reference_area = V(1.0) / cross(edge_1, edge_2);

    // phi = c_0 + lambda_1 rise_1 + lambda_2 rise_2, and its gradients
    const V l_0 = plain(lambda_0), l_1 = plain(lambda_1), l_2 = plain(lambda_2);
    const auto least_0 = (l_0 <= l_1) & (l_0 <= l_2);
    const auto least_1 = (!least_0) & (l_1 <= l_2);
    const V c_0 = target.nodal[0] + choose(least_0, target.bubble, V(0.0));
    const V c_1 = target.nodal[1] + choose(least_1, target.bubble, V(0.0));
    const V c_2 = target.nodal[2] + choose(least_0 | least_1, V(0.0), target.bubble);
    const V rise_1 = c_1 - c_0, rise_2 = c_2 - c_0;
    const T phi = rise_1 * lambda_1 + rise_2 * lambda_2 + T(c_0);
    const T beyond = phi - T(old.rest);
    result.depth = choose(plain(beyond) > V(0.0), beyond, T(V(0.0)));
    const Vec2<T> g = rise_1 * grad_1 + rise_2 * grad_2;
    const Vec2<V> reference_g{(rise_1 * edge_2.y - rise_2 * edge_1.y) * per_reference_area,
                              (rise_2 * edge_1.x - rise_1 * edge_2.x) * per_reference_area};
    const V depth = plain(result.depth);
    const auto pressed = depth > V(0.0);
    result.too_deep = (plain(phi) >= target.reach) & pressed;

    // normal force: along p_n while the depth is the deepest so far, along p_n/e^2 below
    if constexpr (tangential == Tangential::none) {
        const T normal_force = law.normal_stiffness * result.depth;
        result.force = -(normal_force * g);
        result.stored_normal = 0.5 * law.normal_stiffness * depth * depth;
        result.stored_tangential = result.dissipated_normal = result.dissipated_friction = V(0.0);
        return result;
    }
    const V lost = V(1.0) - law.returned;
    const V unloading = law.normal_stiffness / law.returned;
    const T deepest = choose(depth > old.deepest, result.depth, T(old.deepest));
    const T above = result.depth - lost * deepest;
    const T held = choose(plain(above) > V(0.0), above, T(V(0.0)));
    const T normal_force = unloading * held;  // times |g|
    result.stored_normal = 0.5 * unloading * plain(held) * plain(held);
    result.dissipated_normal =
        0.5 * law.normal_stiffness * lost * (plain(deepest) * plain(deepest) - old.deepest * old.deepest);

    // the tangent in the reference shape; a plateau of phi has none, and no force that would need one
    const V tiny(1e-200);  // the square root has no derivative at zero
    const V steepness = dot(reference_g, reference_g);
    const Vec2<V> tangent = (V(1.0) / square_root(choose(steepness > tiny, steepness, V(1.0)))) * turned(reference_g);
    const Vec2<T> place{edge_1.x * lambda_1 + edge_2.x * lambda_2 + T(target.reference[0].x),
                        edge_1.y * lambda_1 + edge_2.y * lambda_2 + T(target.reference[0].y)};
    const Vec2<T> q = dot(tangent, edge_1) * grad_1 + dot(tangent, edge_2) * grad_2;

    // the spring, held by friction
    const auto in_touch = old.in_touch > V(0.5);
    const T stretch = tangent.x * (place.x - T(old.anchor.x)) + tangent.y * (place.y - T(old.anchor.y));
    const T s_trial = choose(in_touch, stretch, T(V(0.0)));
    const T g_g = dot(g, g), q_q = dot(q, q);
    const auto sloped = (plain(g_g) > tiny) & (plain(q_q) > tiny);
    const T ratio = choose(sloped, g_g, T(V(1.0))) / choose(sloped, q_q, T(V(1.0)));
    const T limit =
        choose(sloped, (law.friction / law.tangential_stiffness) * (normal_force * square_root(ratio)), T(V(0.0)));
    const V s_plain = plain(s_trial), l = plain(limit);
    const T s = choose(s_plain > l, limit, choose(s_plain < -l, -limit, s_trial));
    const V s_held = plain(s), s_0 = dot(tangent, old.slip);
    result.stored_tangential = 0.5 * law.tangential_stiffness * s_held * s_held;
    result.dissipated_friction =
        0.5 * law.tangential_stiffness * (dot(old.slip, old.slip) - s_0 * s_0) +
        choose(in_touch, sliding_work(law.tangential_stiffness, s_0, s_plain, old.slip_limit, l), V(0.0));

    const T spring_force = law.tangential_stiffness * s;
    result.force = -(normal_force * g) - spring_force * q;

    result.next.in_touch = V(1.0);
    result.next.slip = s_held * tangent;
    result.next.anchor = Vec2<V>{plain(place.x), plain(place.y)} - result.next.slip;
    result.next.slip_limit = l;
    result.next.deepest = choose(pressed, plain(deepest), V(0.0));  // it has come loose: the next impact begins anew
    const V still = choose(plain(phi) > V(0.0), plain(phi), V(0.0));
    result.next.rest = choose(still < old.rest, still, old.rest);
    return result;
}

/// Energy of a friction spring whose point has left the body, J: dissipated.
template <class V>
V released_energy(const ContactLaw<V>& law, const ContactHistory<V>& old) {
    return 0.5 * law.tangential_stiffness * dot(old.slip, old.slip);
}

/// Forces on the five nodes of a pair, N: the ends a, b of the contactor's edge, then the target's nodes 0, 1, 2.
/// @param weight_b  of the point between a and b
template <class T, class V>
std::array<Vec2<T>, 5> nodal_forces(const ContactResponse<T, V>& response, const V& weight_b) {
    const Vec2<T>& f = response.force;
    const Vec2<T> reaction = -f;
    return {(V(1.0) - weight_b) * f, weight_b * f, response.lambda[0] * reaction, response.lambda[1] * reaction,
            response.lambda[2] * reaction};
}

}  // namespace gneiss
