#pragma once
// What passes between an element and a material law at one sub-triangle.
//
// Everything is written in the material base: instead of F and P, the images of the axes, F alpha and F beta, and the
// force-like vectors P alpha and P beta. alpha is a unit vector in the reference shape, beta is alpha turned by +90
// degrees (psi-bar = pi/2), so P : dF = (P alpha) . d(F alpha) + (P beta) . d(F beta).

#include <array>
#include <cstddef>

#include "base/vec2.hpp"

namespace gneiss {

/// Deformation of one sub-triangle, measured from the displacement gradient H = F - I  [FORMULATION 3, Precision].
template <class T>
struct PointKinematics {
    Vec2<T> axis;             ///< alpha in the reference shape, unit vector
    Vec2<T> h_alpha, h_beta;  ///< H alpha, H beta
    T area_strain;            ///< det F - 1 of this sub-triangle

    Vec2<T> alpha() const { return axis + h_alpha; }  ///< current axis, (4)
    Vec2<T> beta() const { return turned(axis) + h_beta; }
    T jacobian() const { return T(1.0) + area_strain; }  ///< det F
};

/// det F - 1 = tr H + det H, without the loss of digits of det F - 1: (H alpha) x (F beta) + alpha x (H beta).
template <class T>
T area_strain(const Vec2<T>& axis, const Vec2<T>& h_alpha, const Vec2<T>& h_beta) {
    return cross(h_alpha, turned(axis) + h_beta) + cross(axis, h_beta);
}

/// Rates of the same quantities.
template <class T>
struct PointRates {
    Vec2<T> alpha, beta;  ///< F' alpha, F' beta, 1/s
    T volume;             ///< s_v' / s_v of the composite, 1/s
};

/// The part of the first Piola-Kirchhoff stress that follows from F at fixed s_v, and the response to s_v:
/// an element adds q cof F, with q the average over the composite by reference volume.
template <class T>
struct PointStress {
    Vec2<T> p_alpha, p_beta;  ///< (dw/dF) alpha, (dw/dF) beta, Pa
    T q;                      ///< dw/ds_v, Pa
};

/// (cof F) alpha and (cof F) beta.
template <class T>
Vec2<T> cofactor_alpha(const PointKinematics<T>& point) {
    return -turned(point.beta());
}
template <class T>
Vec2<T> cofactor_beta(const PointKinematics<T>& point) {
    return turned(point.alpha());
}

/// What a law remembers at one sub-triangle: z has a rate, history has none.
template <class T, std::size_t n_internal, std::size_t n_history>
struct PointMemory {
    std::array<T, n_internal> z;
    std::array<T, n_history> history;
};

/// A symmetric tensor of the plane.
template <class T>
struct Symmetric2 {
    T xx, yy, xy;
};

/// Cauchy stress, Pa, from a law's answer and the composite's average q: sigma = P F^T / det F.
template <class T>
Symmetric2<T> cauchy_stress(const PointKinematics<T>& point, const PointStress<T>& stress, const T& q) {
    const Vec2<T> a = point.alpha(), b = point.beta();
    const T inverse = T(1.0) / point.jacobian();
    return {(stress.p_alpha.x * a.x + stress.p_beta.x * b.x) * inverse + q,
            (stress.p_alpha.y * a.y + stress.p_beta.y * b.y) * inverse + q,
            // symmetric by balance of moment of momentum; the mean of both entries halves the round-off
            0.5 * (stress.p_alpha.x * a.y + stress.p_beta.x * b.y + stress.p_alpha.y * a.x + stress.p_beta.y * b.x) *
                inverse};
}

}  // namespace gneiss
