#pragma once
// Munjiza strains (5)-(13) and the two maps from Munjiza stress to nodal forces  [FORMULATION 3].

#include <numbers>

#include "base/functions.hpp"
#include "base/series.hpp"
#include "materials/elastic_constants.hpp"
#include "materials/point.hpp"

namespace gneiss {

/// The four components that belong together: of strain (-), of stress (Pa), of moduli (Pa).
template <class T>
struct MunjizaComponents {
    T v, alpha, beta, psi;
};

/// Factor between the work-conjugate shear pair: the tensor shear strain is -(psi-bar/2) e_psi, psi-bar = pi/2.
inline constexpr double half_psi_bar = std::numbers::pi / 4;
/// Weight of M_psi e_psi^2 in the stored energy, psi-bar^2 / 2.
inline constexpr double shear_energy_weight = 2 * half_psi_bar * half_psi_bar;

/// What the Munjiza laws take from the volumetric stretch s_v of the composite.
template <class T>
struct MunjizaVolume {
    T strain, inverse;  ///< e_v = ln s_v, 1/s_v
};
template <class T>
MunjizaVolume<T> munjiza_volume(const T& s_v_minus_1) {
    return {ln1p(s_v_minus_1), T(1.0) / (T(1.0) + s_v_minus_1)};
}

/// Squares of the stretches and the angle, each measured as its distance from 1 or from the right angle.
template <class T>
struct MunjizaStretches {
    T alpha_squared_minus_1, beta_squared_minus_1;  ///< s_alpha^2 - 1, s_beta^2 - 1
    T cotangent;                                    ///< of the current angle psi
    T inverse_alpha_squared, inverse_beta_squared;  ///< 1/s_alpha^2, 1/s_beta^2
};

template <class T>
MunjizaStretches<T> munjiza_stretches(const PointKinematics<T>& point) {
    // with a = axis + h: a.a - 1 = (axis + a).h, and the same for beta; alpha.beta = a.h_beta + axis_beta.h_alpha
    const Vec2<T> beta_bar = turned(point.axis), alpha = point.alpha();
    const T alpha_m1 = dot(point.axis + alpha, point.h_alpha);
    const T beta_m1 = dot(beta_bar + point.beta(), point.h_beta);
    const T alpha_dot_beta = dot(alpha, point.h_beta) + dot(beta_bar, point.h_alpha);
    // three reciprocals from one division
    const T alpha_squared = T(1.0) + alpha_m1, beta_squared = T(1.0) + beta_m1, area = point.jacobian();
    const T both = alpha_squared * beta_squared;
    const T inverse = T(1.0) / (both * area);
    const T inverse_both = inverse * area;
    return {alpha_m1, beta_m1, alpha_dot_beta * (inverse * both), inverse_both * beta_squared,
            inverse_both * alpha_squared};
}

/// Logarithmic strains (13) and psi-bar/psi.
template <class T>
struct MunjizaStrains {
    MunjizaComponents<T> e;
    T angle_ratio;
};

/// @param volume_strain  e_v = ln s_v of the composite
template <class T>
MunjizaStrains<T> munjiza_strains(const MunjizaStretches<T>& stretches, const T& volume_strain) {
    const AngularStrain<T> angle = angular_strain(stretches.cotangent);
    return {{volume_strain, 0.5 * ln1p(stretches.alpha_squared_minus_1), 0.5 * ln1p(stretches.beta_squared_minus_1),
             angle.strain},
            angle.ratio};
}

/// `conjugate`: the exact gradient of w = 1/2 (M_v e_v^2 + M_alpha e_alpha^2 + M_beta e_beta^2 + psi-bar^2/2 M_psi
/// e_psi^2).
/// @param m                Munjiza stress, Pa; of psi: m_psi psi-bar/psi
/// @param inverse_volume   1/s_v of the composite
template <class T>
PointStress<T> conjugate_map(const PointKinematics<T>& point, const MunjizaStretches<T>& stretches,
                             const MunjizaComponents<T>& m, const T& inverse_volume) {
    const Vec2<T> alpha = point.alpha(), beta = point.beta();
    const T shear = half_psi_bar * m.psi;  // (psi-bar^2/2) m_psi/psi
    const Vec2<T> p_alpha = m.alpha * alpha - shear * turned(alpha);
    const Vec2<T> p_beta = m.beta * beta + shear * turned(beta);
    return {stretches.inverse_alpha_squared * p_alpha, stretches.inverse_beta_squared * p_beta, m.v * inverse_volume};
}

/// `direct`: Cauchy stress from traction components along the edges of the current material element. Its transform
/// P = det F sigma F^-T reads, on the edge of length |beta|: P alpha = |beta| (m_alpha alpha^ + tau beta^), and
/// likewise P beta = |alpha| (m_beta beta^ + tau alpha^), with unit vectors ^ and tau = -(psi-bar/2) m_psi.
/// @param m  Munjiza stress, Pa
template <class T>
PointStress<T> direct_map(const PointKinematics<T>& point, const MunjizaStretches<T>& stretches,
                          const MunjizaComponents<T>& m) {
    const Vec2<T> alpha = point.alpha(), beta = point.beta();
    const T tau = -half_psi_bar * m.psi;
    const T lengths =
        square_root(T((T(1.0) + stretches.alpha_squared_minus_1) * (T(1.0) + stretches.beta_squared_minus_1)));
    return {(m.alpha * lengths * stretches.inverse_alpha_squared) * alpha + tau * beta,
            (m.beta * lengths * stretches.inverse_beta_squared) * beta + tau * alpha, m.v};
}

}  // namespace gneiss
