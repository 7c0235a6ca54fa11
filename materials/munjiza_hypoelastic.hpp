#pragma once
// Hypo-elastic Munjiza material: the same stresses from increments, with moduli that may depend on the state and with
// stress at the start  [FORMULATION 4; Lei et al. 2016, (3), (4)].

#include "base/functions.hpp"
#include "materials/munjiza_stress.hpp"
#include "materials/out_of_plane.hpp"
#include "materials/work_meter.hpp"

namespace gneiss {

/// M = M0 g(p), g = (1 + k <p>/p_ref)^n, with p = -(m_v + (m_alpha + m_beta)/2): stiffening under confinement.
struct Stiffening {
    double k = 0;      ///< -, >= 0; 0: constant moduli
    double p_ref = 1;  ///< Pa, > 0
    double n = 0;      ///< -, [0, 1]

    bool active() const { return k > 0 && n > 0; }

    /// Out of line, as mean_factor(): a call costs little beside its exponentials, and the kernels of constant moduli
    /// stay short, to compile and to run.
    template <class T>
    [[gnu::noinline]] T factor(const T& p) const {
        const double kappa = k / p_ref;
        return choose(plain(p) > 0.0, T(exponential(n * ln1p(T(kappa * positive(p))))), T(1.0));
    }

    /// Mean of g along a step on which the strains run straight: all four stresses grow by M0 de g, so that p obeys
    /// dp/ds = g(p) pi with pi the step of p at g = 1; separated and integrated exactly.
    /// @param p0  pressure at the start, Pa
    /// @param pi  step of the pressure at g = 1, Pa
    template <class T>
    [[gnu::noinline]] T mean_factor(const T& p0, const T& pi) const;

private:
    template <class T>
    static T positive(const T& x) {
        return choose(plain(x) > 0.0, x, T(0.0));
    }
    template <class T>
    static T negative(const T& x) {
        return choose(plain(x) > 0.0, T(0.0), x);
    }

    /// Phi(p) = integral from 0 to p of dp/g, for p >= 0.
    template <class T>
    T stretched(const T& p) const {
        const double kappa = k / p_ref;
        const T logarithm = ln1p(T(kappa * p));
        return n == 1 ? logarithm * (1 / kappa) : exponential_minus_1(T((1 - n) * logarithm)) * (1 / (kappa * (1 - n)));
    }
};

template <class T>
T Stiffening::mean_factor(const T& p0, const T& pi) const {
    const double kappa = k / p_ref;
    // The part of the step spent above p = 0, in the stretched coordinate in which the path is straight.
    const T start = stretched(positive(p0)) + negative(p0);
    const T end = start + pi;
    const T from = positive(start), to = positive(end);
    const T base = T(1.0) + kappa * positive(p0);  // 1 + kappa p at `from`
    // A small step far above p = 0 is pi itself: the difference of its ends has lost its digits.
    const T step_above = choose((plain(start) > 0.0) && (plain(end) > 0.0), pi, T(to - from));
    // p(to) - p(from) = base/kappa expm1(E), from y = kappa (to - from)/base^(1-n): no difference of large numbers
    const T y = step_above * kappa * T(exponential((n - 1) * ln1p(T(base - T(1.0)))));
    const T grown = n == 1 ? y : T(ln1p(T((1 - n) * y)) * (1 / (1 - n)));
    const T above = base * T(exponential_minus_1(grown)) * (1 / kappa);
    const T below = pi - step_above;
    // Towards a vanishing step the quotient becomes 0/0, and its derivative loses digits as eps/(kappa pi). The
    // midpoint rule is then exact to round-off, (kappa pi)^2; across p = 0 to n kappa pi/4.
    const double vanishing = 1e-8;
    const auto tiny = plain(T(pi * pi)) * (kappa * kappa) <= vanishing * vanishing;
    const T quotient = (above + below) / choose(tiny, T(1.0), pi);
    return choose(tiny, factor(T(p0 + 0.5 * factor(p0) * pi)), quotient);
}

/// Internal variables: Munjiza stresses (Pa) and the accumulated stress power (J/m3). History: the total logarithmic
/// strains at the last accepted state. Increments are differences of total strains, so that with constant moduli hypo
/// equals hyper to round-off.
/// @tparam direct  as in MunjizaHyperelastic; `conjugate` measures its power as m . de, which is P : dF along a step
template <bool direct>
struct MunjizaHypoelastic {
    static constexpr std::size_t n_internal = 5;
    static constexpr std::size_t n_history = direct ? 4 + WorkMeter::n_history : 4;
    static constexpr bool has_stored_energy = false;
    static constexpr bool offers_centre = direct;
    static constexpr bool uniform_q = false;  ///< moduli that depend on the state differ between the sub-triangles

    template <class T>
    using Memory = PointMemory<T, n_internal, n_history>;

    MunjizaConstants constants;
    Stiffening stiffening;
    double M_z = 0;  ///< Pa, transversely_isotropic_across(); for the stress across the plane alone

    /// With constant moduli a step ends at m = m0 + M (e - e0), whatever m0 and e0 are. `conjugate` makes of it forces
    ///
    ///     -f = sum_s V_s sum_k w_k m_k de_k/du = d/du sum_s V_s sum_k w_k (m0_k e_k + M_k/2 (e_k - e0_k)^2)
    ///
    /// with w = 1, 1, 1, psi-bar^2/2, and of given m the gradient of sum w_k m_k e_k: symmetric both. Moduli that
    /// depend on the state add M_k (e_k - e0_k) dg/dp dp/de_l, which is not.
    bool symmetric_tangent() const { return !direct && !stiffening.active(); }

    template <class T>
    using Volume = MunjizaVolume<T>;
    template <class T>
    Volume<T> volume(const T& s_v_minus_1) const {
        return munjiza_volume(s_v_minus_1);
    }

    template <class T, class V>
    PointStress<T> stress(const PointKinematics<T>& point, const Volume<T>& s_v, const Memory<V>& accepted) const {
        const MunjizaStretches<T> stretches = munjiza_stretches(point);
        const MunjizaStrains<T> strains = munjiza_strains(stretches, s_v.strain);
        return map(point, stretches, strains, s_v, grown(strains.e, accepted));
    }

    /// The stress when z is not advanced from the accepted state but given, as ODE solvers carry it.
    template <class T, class V>
    PointStress<T> stress_at(const PointKinematics<T>& point, const Volume<T>& s_v, const Memory<V>& given) const {
        const MunjizaStretches<T> stretches = munjiza_stretches(point);
        const MunjizaStrains<T> strains = munjiza_strains(stretches, s_v.strain);
        return map(point, stretches, strains, s_v, {T(given.z[0]), T(given.z[1]), T(given.z[2]), T(given.z[3])});
    }

    template <class T, class V>
    MunjizaComponents<T> munjiza_stress(const PointKinematics<T>& point, const Volume<T>& s_v,
                                        const Memory<V>& accepted) const {
        return grown(munjiza_strains(munjiza_stretches(point), s_v.strain).e, accepted);
    }

    /// Cauchy stress across the plane in plane strain, Pa  [FORMULATION 4]. Only for output.
    /// @param q  average of the composite
    template <class T, class V>
    T stress_across(const PointKinematics<T>& point, const Volume<T>& s_v, const Memory<V>& accepted,
                    const T& q) const {
        if (M_z == 0) return q;
        return q + across_map<direct>(point, T(M_z / constants.M_alpha * munjiza_stress(point, s_v, accepted).alpha));
    }

    template <class T, class V>
    Memory<T> update(const PointKinematics<T>& point, const Volume<T>& s_v, const PointStress<T>& stress, const T& q,
                     const Memory<V>& accepted) const {
        const MunjizaComponents<T> e = munjiza_strains(munjiza_stretches(point), s_v.strain).e;
        const MunjizaComponents<T> m = grown(e, accepted);
        Memory<T> updated{};
        updated.z = {m.v, m.alpha, m.beta, m.psi, T(0.0)};
        const std::array<T, 4> strain{e.v, e.alpha, e.beta, e.psi};
        for (std::size_t k = 0; k < 4; ++k) updated.history[k] = strain[k];
        if constexpr (direct) {
            WorkMeter::update(point, stress, q, accepted, updated);
        } else {
            const std::array<double, 4> weight{1, 1, 1, shear_energy_weight};
            T work = T(accepted.z[4]);
            for (std::size_t k = 0; k < 4; ++k)
                work += (0.5 * weight[k]) * ((T(accepted.z[k]) + updated.z[k]) * (strain[k] - T(accepted.history[k])));
            updated.z[4] = work;
        }
        return updated;
    }

    /// z' of FORMULATION 4 at given z.
    template <class T>
    std::array<T, n_internal> rate(const PointKinematics<T>& point, const Volume<T>&, const PointRates<T>& rates,
                                   const PointStress<T>& stress, const T& q, const Memory<T>& given) const {
        const MunjizaStretches<T> stretches = munjiza_stretches(point);
        const Vec2<T> alpha = point.alpha(), beta = point.beta();
        const T area = point.jacobian(), c = stretches.cotangent;
        // psi = acot c with c = (alpha . beta)/(alpha x beta); psi' = -c'/(1 + c^2)
        const T area_rate = cross(rates.alpha, beta) + cross(alpha, rates.beta);
        const T c_rate = (dot(rates.alpha, beta) + dot(alpha, rates.beta) - c * area_rate) / area;
        const T psi_rate = -c_rate / (T(1.0) + c * c) * (angular_strain(c).ratio * (1 / (2 * half_psi_bar)));
        const MunjizaComponents<T> e_rate{rates.volume, dot(alpha, rates.alpha) * stretches.inverse_alpha_squared,
                                          dot(beta, rates.beta) * stretches.inverse_beta_squared, psi_rate};
        // as update() measures it: in a composite the two are equal in sum, not at every point
        T power(0.0);
        if constexpr (direct)
            power = WorkMeter::power(point, rates, stress, q);
        else
            power = given.z[0] * e_rate.v + given.z[1] * e_rate.alpha + given.z[2] * e_rate.beta +
                    shear_energy_weight * given.z[3] * e_rate.psi;
        const T g = stiffening.active() ? stiffening.factor(pressure(given)) : T(1.0);
        return {g * (constants.M_v * e_rate.v), g * (constants.M_alpha * e_rate.alpha),
                g * (constants.M_beta * e_rate.beta), g * (constants.M_psi * e_rate.psi), power};
    }

    /// Memory at rest under a Cauchy stress given in the axes, Pa: small strain on the axes, then m = M e.
    Memory<double> initial_memory(const Symmetric2<double>& sigma) const {
        const double c_aa = constants.M_v + constants.M_alpha, c_bb = constants.M_v + constants.M_beta,
                     c_ab = constants.M_v, determinant = c_aa * c_bb - c_ab * c_ab;
        const double e_alpha = (c_bb * sigma.xx - c_ab * sigma.yy) / determinant;
        const double e_beta = (c_aa * sigma.yy - c_ab * sigma.xx) / determinant;
        Memory<double> memory{};
        memory.z = {constants.M_v * (e_alpha + e_beta), constants.M_alpha * e_alpha, constants.M_beta * e_beta,
                    -sigma.xy / half_psi_bar, 0};
        return memory;
    }

    MunjizaConstants tangent_constants(const Memory<double>& memory) const {
        const double g = stiffening.active() ? stiffening.factor(pressure(memory)) : 1.0;
        return {g * constants.M_v, g * constants.M_alpha, g * constants.M_beta, g * constants.M_psi};
    }

private:
    template <class T>
    static T pressure(const Memory<T>& memory) {
        return -(memory.z[0] + 0.5 * (memory.z[1] + memory.z[2]));
    }

    /// The exact update of the stresses from the accepted state to total strains e.
    template <class T, class V>
    MunjizaComponents<T> grown(const MunjizaComponents<T>& e, const Memory<V>& accepted) const {
        const auto& before = accepted.history;
        MunjizaComponents<T> dm{constants.M_v * (e.v - T(before[0])), constants.M_alpha * (e.alpha - T(before[1])),
                                constants.M_beta * (e.beta - T(before[2])), constants.M_psi * (e.psi - T(before[3]))};
        if (stiffening.active()) {
            const T g = stiffening.mean_factor(T(pressure(accepted)), T(-(dm.v + 0.5 * (dm.alpha + dm.beta))));
            dm = {g * dm.v, g * dm.alpha, g * dm.beta, g * dm.psi};
        }
        return {T(accepted.z[0]) + dm.v, T(accepted.z[1]) + dm.alpha, T(accepted.z[2]) + dm.beta,
                T(accepted.z[3]) + dm.psi};
    }

    template <class T>
    PointStress<T> map(const PointKinematics<T>& point, const MunjizaStretches<T>& stretches,
                       const MunjizaStrains<T>& strains, const Volume<T>& s_v, MunjizaComponents<T> m) const {
        if constexpr (direct) return direct_map(point, stretches, m);
        m.psi = m.psi * strains.angle_ratio;
        return conjugate_map(point, stretches, m, s_v.inverse);
    }
};

}  // namespace gneiss
