#pragma once
// The joint of Y-code, for comparison with published results  [Munjiza, The Combined Finite-Discrete Element Method,
// Wiley 2004, ch. 7; FORMULATION 7]. Opening and slip are separate but for the damage, the rise to the peak is a
// parabola, and the ends of softening are at 3 G/f behind the peaks:
//
//   o_p = 2 f_t/k, o_t = 3 G_I/f_t;   s_p = 2 c_0/k, s_t = 3 G_II/c_0
//   D   = largest sqrt( (<o - o_p>/o_t)^2 + (<|s| - s_p>/s_t)^2 ), at most 1
//   t_n = z(D) f_t g(o/o_m) - k <-o>,  t_s = z(D) c_0 g(s/s_m) + friction,   g(x) = 2 x - x^2, and 1 beyond x = 1
//
// 3 Z = 1.159, so the softening branch dissipates 1.159 G, and a complete failure the rise on top, 2/3 f_t o_p. That
// is the law, and known.
//
// Settled here: damage has a memory (in older codes a joint heals when it closes), and so has the end of the rise, o_m
// = max(o_p, largest o), s_m likewise: unloading goes back to the origin on the parabola, stretched. On a path that
// never turns back this is the published law. Friction stands in parallel from the start, as in `MixedModeLaw`, in
// place of a shear strength that grows with pressure.
//
// With the stored energy w = z(D) W, W = f_t o_m (x^2 - x^3/3) + c_0 s_m (y^2 - y^3/3), x = <o>/o_m, y = |s|/s_m, a
// step dissipates the integral of z (f_t do_m + c_0 ds_m)/3 - W dz, term by term in opening and in sliding. It is exact
// in pure modes for steps of any size.

#include <algorithm>
#include <array>
#include <cmath>

#include "fracture/cohesion_history.hpp"
#include "fracture/cohesion_properties.hpp"
#include "fracture/friction.hpp"
#include "fracture/softening.hpp"

namespace gneiss {

/// As `CohesionHistory`: all zeros is the intact joint.
template <class T>
struct YCodeHistory {
    T damage = T(0.0);       ///< D, -, 0 to 1
    T opening_max = T(0.0);  ///< largest o so far, m, >= 0
    T slip_max = T(0.0);     ///< largest |s| so far, m
    T opening = T(0.0);      ///< o at the accepted state, m
    T slip = T(0.0);         ///< s at the accepted state, m
    T slider = T(0.0);       ///< where the spring of friction is without load, m
    T fracture_i = T(0.0);   ///< dissipated by fracture so far, J/m2, in opening
    T fracture_ii = T(0.0);  ///< the same in sliding
    T friction = T(0.0);     ///< dissipated by friction so far, J/m2

    static constexpr std::array<T YCodeHistory::*, 9> members{
        &YCodeHistory::damage,     &YCodeHistory::opening_max, &YCodeHistory::slip_max,
        &YCodeHistory::opening,    &YCodeHistory::slip,        &YCodeHistory::slider,
        &YCodeHistory::fracture_i, &YCodeHistory::fracture_ii, &YCodeHistory::friction};

    /// Dissipated by fracture so far, J/m2.
    T fracture() const { return fracture_i + fracture_ii; }
};

struct YCodeLaw {
    template <class T>
    using History = YCodeHistory<T>;

    /// As `MixedModeLaw::start`. Shear is friction as far as that reaches, the rest cohesive; beyond the peaks of the
    /// cohesive parts there is no such point.
    static LoadedStart<History<double>> start(const CohesionProperties<double>& p, double normal, double shear) {
        const auto rise_to = [](double part) { return 1 - std::sqrt(1 - std::min(part, 1.0)); };  // g(x) = part
        LoadedStart<History<double>> point;
        point.opening = normal > 0 ? rise_to(normal / p.tensile_strength) * opening_at_peak(p) : normal / p.penalty;
        const double friction = std::min(std::abs(shear), p.tan_phi_initial * positive_part(-normal));
        const double way = rise_to((std::abs(shear) - friction) / p.cohesion) * slip_at_peak(p);
        point.slip = with_sign_of(shear, way);
        point.history.opening = point.opening;
        point.history.slip = point.slip;
        point.history.slider = with_sign_of(shear, way - friction / p.penalty);
        return point;
    }

    /// As `MixedModeLaw::traction`.
    template <class T, class V>
    static Traction<T> traction(const CohesionProperties<V>& p, const YCodeHistory<V>& accepted, const T& opening,
                                const T& slip) {
        const Step<T> step = take_step(p, accepted, opening, slip);
        T z(1.0);
        if (any_lane(plain(step.damage) > 0.0)) z = softening_value(step.damage);
        return {
            z * T(p.tensile_strength) * rise(T(positive_part(opening) / step.opening_end)) -
                p.penalty * positive_part(T(-opening)),
            z * T(p.cohesion) * with_sign_of(slip, rise(T(magnitude(slip) / step.slip_end))) + step.friction.traction};
    }

    /// As `MixedModeLaw::advance`.
    template <class T, class V>
    static YCodeHistory<T> advance(const CohesionProperties<V>& p, const YCodeHistory<V>& accepted, const T& opening,
                                   const T& slip) {
        const Step<T> step = take_step(p, accepted, opening, slip);
        YCodeHistory<T> after;
        after.damage = step.damage;
        const T apart = positive_part(opening), along = magnitude(slip);
        after.opening_max = larger(apart, T(accepted.opening_max));
        after.slip_max = larger(along, T(accepted.slip_max));
        after.opening = opening;
        after.slip = slip;
        after.slider = step.friction.slider;
        after.friction = T(accepted.friction) + step.friction.dissipated;
        const Dissipation<T> lost = fracture_dissipation(p, accepted, apart, along, step);
        after.fracture_i = T(accepted.fracture_i) + lost.opening;
        after.fracture_ii = T(accepted.fracture_ii) + lost.sliding;
        return after;
    }

    /// As `MixedModeLaw::stored_energy`.
    template <class T>
    static T stored_energy(const CohesionProperties<T>& p, const YCodeHistory<T>& history, const T& opening,
                           const T& slip) {
        const T apart = positive_part(opening), closed = positive_part(T(-opening)), e = slip - history.slider;
        const T cohesive =
            unit_energy(T(p.tensile_strength), apart, T(larger(opening_at_peak(p), history.opening_max))) +
            unit_energy(T(p.cohesion), T(magnitude(slip)), T(larger(slip_at_peak(p), history.slip_max)));
        return softening_value(history.damage) * cohesive + 0.5 * p.penalty * (closed * closed + e * e);
    }

private:
    template <class T>
    struct Step {
        T opening_end, slip_end;  // o_m, s_m at the end
        T damage;                 // at the end
        T part;                   // of the step, until D = 1
        SliderStep<T> friction;
    };

    template <class T>
    static T larger(const T& a, const T& b) {
        return choose(plain(a) > plain(b), a, b);
    }
    template <class V>
    static V opening_at_peak(const CohesionProperties<V>& p) {
        return 2.0 * p.tensile_strength / p.penalty;
    }
    template <class V>
    static V slip_at_peak(const CohesionProperties<V>& p) {
        return 2.0 * p.cohesion / p.penalty;
    }
    /// g(x) for x <= 1
    template <class T>
    static T rise(const T& x) {
        return x * (T(2.0) - x);
    }
    /// A term of W: of opening with f_t, o and o_m, of sliding with c_0, |s| and s_m.
    template <class T, class V>
    static T unit_energy(const V& strength, const T& way, const T& end) {
        const T x = way / end;
        return strength * (end * (x * x * (T(1.0) - x * (1.0 / 3))));
    }

    template <class T, class V>
    static Step<T> take_step(const CohesionProperties<V>& p, const YCodeHistory<V>& accepted, const T& opening,
                             const T& slip) {
        const V k = p.penalty, o_p = opening_at_peak(p), s_p = slip_at_peak(p);
        const V per_o_t = p.tensile_strength / (3.0 * p.fracture_energy_i);
        const V per_s_t = p.cohesion / (3.0 * p.fracture_energy_ii);
        const T apart = positive_part(opening), along = magnitude(slip);
        Step<T> step;
        step.opening_end = larger(apart, T(larger(o_p, accepted.opening_max)));
        step.slip_end = larger(along, T(larger(s_p, accepted.slip_max)));
        const T x = per_o_t * positive_part(T(apart - T(o_p))), y = per_s_t * positive_part(T(along - T(s_p)));
        const T square = x * x + y * y;
        const auto grows = plain(square) > accepted.damage * accepted.damage;
        const T reached = square_root(choose(grows, square, T(1.0)));
        const auto fails = plain(reached) > 1.0;
        step.damage = choose(grows, choose(fails, T(1.0), reached), T(accepted.damage));
        const T part = (T(1.0) - T(accepted.damage)) / choose(fails, T(reached - T(accepted.damage)), T(1.0));
        step.part = choose(grows && fails, part, T(1.0));

        const V fall = p.tan_phi_residual - p.tan_phi_initial;
        const V limit = k * positive_part(V(-accepted.opening)) * (p.tan_phi_initial + fall * accepted.damage);
        const T coefficient = T(p.tan_phi_initial) + fall * step.damage;
        step.friction = slide(k, T(limit), T(coefficient * (k * positive_part(T(-opening)))), T(accepted.slip),
                              T(accepted.slider), slip);
        return step;
    }

    template <class T>
    struct Dissipation {
        T opening, sliding;  // J/m2
    };

    /// From where damage, o_m or s_m begin to grow in this step: with W0 there, dW to the end, and the mean zm of z
    /// over the growth of D,  zm [(f_t do_m + c_0 ds_m)/3 + dW] + z0 W0 - z1 W1, up to D = 1.
    template <class T, class V>
    static Dissipation<T> fracture_dissipation(const CohesionProperties<V>& p, const YCodeHistory<V>& accepted,
                                               const T& apart, const T& along, const Step<T>& step) {
        const V o_m = larger(opening_at_peak(p), accepted.opening_max);
        const V s_m = larger(slip_at_peak(p), accepted.slip_max);
        const T o_0 = choose(plain(apart) > o_m, T(o_m), T(positive_part(accepted.opening)));
        const T s_0 = choose(plain(along) > s_m, T(s_m), T(magnitude(accepted.slip)));
        const auto grows = plain(step.damage) > accepted.damage;
        const auto stretches = plain(step.opening_end) > o_m || plain(step.slip_end) > s_m;
        if (!any_lane(grows || stretches)) return {T(0.0), T(0.0)};
        const Softening<T> z0 = softening_and_integral(T(accepted.damage)), z1 = softening_and_integral(step.damage);
        const T growth = choose(grows, T(step.damage - T(accepted.damage)), T(1.0));
        const T mean = choose(grows, T((z1.integral - z0.integral) / growth), z0.value);
        const auto lost = [&](const V& strength, const T& from, const T& to, const V& end0, const T& end1) {
            const T energy0 = unit_energy(strength, from, T(end0)), energy1 = unit_energy(strength, to, end1);
            const T stretched = strength * (end1 - T(end0));
            return T(mean * step.part * ((1.0 / 3) * stretched + energy1 - energy0) + z0.value * energy0 -
                     z1.value * energy1);
        };
        return {lost(p.tensile_strength, o_0, apart, o_m, step.opening_end),
                lost(p.cohesion, s_0, along, s_m, step.slip_end)};
    }
};

}  // namespace gneiss
