#pragma once
// Hyper-elastic Munjiza material, m = M e on the total logarithmic strains  [FORMULATION 3; Lei et al. 2016, (2)-(14)].

#include "materials/munjiza_stress.hpp"
#include "materials/out_of_plane.hpp"
#include "materials/work_meter.hpp"

namespace gneiss {

/// e_v comes from the composite's volume, everything else from F of the sub-triangle.
/// @tparam direct  false: `conjugate`, stresses are the gradient of a stored energy. true: the paper's pragmatic map,
/// equal
///                 to first order in strain and not conservative beyond it; its energy is the accumulated stress power.
template <bool direct>
struct MunjizaHyperelastic {
    static constexpr std::size_t n_internal = direct ? WorkMeter::n_internal : 0;
    static constexpr std::size_t n_history = direct ? WorkMeter::n_history : 0;
    static constexpr bool has_stored_energy = !direct;
    static constexpr bool offers_centre = direct;  ///< `centre` is not the gradient of an energy either
    static constexpr bool uniform_q = true;        ///< q follows from s_v alone, P alpha and P beta from F alone

    template <class T>
    using Memory = PointMemory<T, n_internal, n_history>;

    MunjizaConstants constants;
    double M_z = 0;  ///< Pa, transversely_isotropic_across(); for the stress across the plane alone

    /// df/du of an element that takes the mean volume is symmetric: its forces are a gradient by u.
    static constexpr bool symmetric_tangent() { return !direct; }

    template <class T>
    using Volume = MunjizaVolume<T>;
    template <class T>
    Volume<T> volume(const T& volume_strain_minus_1) const {
        return munjiza_volume(volume_strain_minus_1);
    }

    template <class T, class V>
    PointStress<T> stress(const PointKinematics<T>& point, const Volume<T>& s_v, const Memory<V>& accepted) const {
        const MunjizaStretches<T> stretches = munjiza_stretches(point);
        if constexpr (direct) {
            return direct_map(point, stretches, munjiza_stress(point, s_v, accepted));
        } else {
            const MunjizaComponents<T> m{constants.M_v * s_v.strain,
                                         (0.5 * constants.M_alpha) * ln1p(stretches.alpha_squared_minus_1),
                                         (0.5 * constants.M_beta) * ln1p(stretches.beta_squared_minus_1),
                                         constants.M_psi * angular_response(stretches.cotangent)};
            return conjugate_map(point, stretches, m, s_v.inverse);
        }
    }

    /// Stored energy per initial volume, J/m3.
    template <class T>
    T energy_density(const PointKinematics<T>& point, const Volume<T>& s_v) const requires(!direct) {
        const MunjizaComponents<T> e = munjiza_strains(munjiza_stretches(point), s_v.strain).e;
        return 0.5 * (constants.M_v * (e.v * e.v) + constants.M_alpha * (e.alpha * e.alpha) +
                      constants.M_beta * (e.beta * e.beta) + (shear_energy_weight * constants.M_psi) * (e.psi * e.psi));
    }

    /// Munjiza stress (14), Pa.
    template <class T, class V>
    MunjizaComponents<T> munjiza_stress(const PointKinematics<T>& point, const Volume<T>& s_v, const Memory<V>&) const {
        const MunjizaComponents<T> e = munjiza_strains(munjiza_stretches(point), s_v.strain).e;
        return {constants.M_v * e.v, constants.M_alpha * e.alpha, constants.M_beta * e.beta, constants.M_psi * e.psi};
    }

    /// Cauchy stress across the plane in plane strain, Pa  [FORMULATION 3]. Only for output.
    /// @param q  average of the composite
    template <class T, class V>
    T stress_across(const PointKinematics<T>& point, const Volume<T>& s_v, const Memory<V>&, const T& q) const {
        const T m_z = M_z * munjiza_strains(munjiza_stretches(point), s_v.strain).e.alpha;
        return q + across_map<direct>(point, m_z);
    }

    /// @param q  average of the composite
    template <class T, class V>
    Memory<T> update(const PointKinematics<T>& point, const Volume<T>&, const PointStress<T>& stress, const T& q,
                     const Memory<V>& accepted) const {
        Memory<T> updated{};
        if constexpr (direct) WorkMeter::update(point, stress, q, accepted, updated);
        return updated;
    }

    template <class T>
    std::array<T, n_internal> rate(const PointKinematics<T>& point, const Volume<T>&, const PointRates<T>& rates,
                                   const PointStress<T>& stress, const T& q, const Memory<T>&) const {
        if constexpr (direct)
            return {WorkMeter::power(point, rates, stress, q)};
        else
            return {};
    }

    /// Small-strain stiffness at rest, for wave speeds and impedances.
    MunjizaConstants tangent_constants(const Memory<double>&) const { return constants; }
};

}  // namespace gneiss
