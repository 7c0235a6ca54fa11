#pragma once
// Compressible neo-Hookean solid with three-dimensional constants: a second law that knows no axes and makes no split.
//
//   w = mu/2 (|F|^2 + s_z^2 - 3 - 2 ln J) + lambda/2 (ln J)^2,   J = s_v s_z
//
// s_z = 1 in plane strain; in plane stress it follows from mu (s_z^2 - 1) + lambda ln J = 0.

#include "base/functions.hpp"
#include "base/series.hpp"
#include "materials/elastic_constants.hpp"
#include "materials/point.hpp"

namespace gneiss {

/// Of F only the part without change of area counts: F is scaled by (s_v/det F)^(1/2)  [FORMULATION 3].
/// @tparam plane_stress  out-of-plane stretch free
template <bool plane_stress>
struct NeoHookean {
    static constexpr std::size_t n_internal = 0, n_history = 0;
    static constexpr bool has_stored_energy = true;
    static constexpr bool offers_centre = false;
    static constexpr bool uniform_q = false;

    template <class T>
    using Memory = PointMemory<T, 0, 0>;

    double mu = 0;      ///< shear modulus, Pa, > 0
    double lambda = 0;  ///< Lame's constant, Pa, > -2/3 mu

    static constexpr bool symmetric_tangent() { return true; }

    template <class T>
    struct Volume {
        T change;         ///< s_v - 1; not from s_v, which has lost its digits
        T s_v, inverse;   ///< s_v, 1/s_v
        T log_area;       ///< ln s_v
        T log_thickness;  ///< ln s_z
    };
    template <class T>
    Volume<T> volume(const T& s_v_minus_1) const {
        const T s_v = T(1.0) + s_v_minus_1, log_area = ln1p(s_v_minus_1);
        T log_thickness = T(0.0);
        if constexpr (plane_stress) {
            // Newton on mu (e^(2 y) - 1) + lambda (ln s_v + y), convex and increasing in y. From the small-strain
            // answer eight steps reach round-off for any |ln s_v| < 2; the derivative comes out with the value.
            log_thickness = (-lambda / (2 * mu + lambda)) * log_area;
            for (int step = 0; step < 8; ++step) {
                const T grown = exponential_minus_1(T(2.0 * log_thickness));
                log_thickness -=
                    (mu * grown + lambda * (log_area + log_thickness)) / (2 * mu * (grown + T(1.0)) + T(lambda));
            }
        }
        return {s_v_minus_1, s_v, T(1.0) / s_v, log_area, log_thickness};
    }

    template <class T, class V>
    PointStress<T> stress(const PointKinematics<T>& point, const Volume<T>& volume, const Memory<V>&) const {
        const T inverse_area = T(1.0) / point.jacobian();
        const T half_distortion = 0.5 * distortion(point) * inverse_area;
        const T scale = mu * volume.s_v * inverse_area;
        const Vec2<T> cof_alpha = cofactor_alpha(point), cof_beta = cofactor_beta(point);
        // F - |F|^2/2 F^-T = (H - cof H) - distortion/(2 det F) cof F
        return {scale * (point.h_alpha + turned(point.h_beta) - half_distortion * cof_alpha),
                scale * (point.h_beta - turned(point.h_alpha) - half_distortion * cof_beta),
                mu * half_distortion +
                    (mu * volume.change + lambda * (volume.log_area + volume.log_thickness)) * volume.inverse};
    }

    template <class T>
    T energy_density(const PointKinematics<T>& point, const Volume<T>& volume) const {
        const T y = volume.log_thickness, log_volume = volume.log_area + y;
        return (0.5 * mu) *
                   (2.0 * (volume.change - volume.log_area) + volume.s_v * distortion(point) / point.jacobian() +
                    exponential_minus_1(T(2.0 * y)) - 2.0 * y) +
               (0.5 * lambda) * (log_volume * log_volume);
    }

    /// Cauchy stress across the plane, Pa: (mu (s_z^2 - 1) + lambda ln J)/J, which is lambda ln s_v/s_v in plane strain
    /// and, by the choice of s_z, nothing in plane stress.
    template <class T, class V>
    T stress_across(const PointKinematics<T>&, const Volume<T>& volume, const Memory<V>&, const T&) const {
        const T y = volume.log_thickness;
        return (mu * exponential_minus_1(T(2.0 * y)) + lambda * (volume.log_area + y)) * volume.inverse *
               exponential(T(-y));
    }

    template <class T, class V>
    Memory<T> update(const PointKinematics<T>&, const Volume<T>&, const PointStress<T>&, const T&,
                     const Memory<V>&) const {
        return {};
    }
    template <class T>
    std::array<T, 0> rate(const PointKinematics<T>&, const Volume<T>&, const PointRates<T>&, const PointStress<T>&,
                          const T&, const Memory<T>&) const {
        return {};
    }

    /// The isotropic Munjiza constants with the same small-strain stiffness.
    MunjizaConstants tangent_constants(const Memory<double>&) const {
        const double lambda_plane = plane_stress ? 2 * mu * lambda / (lambda + 2 * mu) : lambda;
        return {lambda_plane, 2 * mu, 2 * mu, 2 * mu};
    }

private:
    /// |F|^2 - 2 det F = (H11 - H22)^2 + (H12 + H21)^2, the square of what F distorts; here with the axes as base.
    template <class T>
    static T distortion(const PointKinematics<T>& point) {
        const Vec2<T> d = point.h_alpha + turned(point.h_beta);
        return dot(d, d);
    }
};

}  // namespace gneiss
