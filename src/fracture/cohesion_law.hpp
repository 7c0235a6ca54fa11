#pragma once
// Cohesion law of an edge that has reached its strength: damage in mixed mode with secant unloading, friction in
// parallel, stiff contact in compression  [FORMULATION 7]. With o* = o + o_offset, s* = s + s_offset, x = <o*> k/f_t,
// y = s* k/c_0:
//
//   lambda = sqrt(x^2 + y^2),  omega = (x/lambda)^2,  dD = q(omega) d lambda while lambda > lambda_max
//   t_n = z(D)/lambda_max k <o*> - k <-o*>,   t_s = z(D)/lambda_max k s* + friction
//   B = omega f_t^2/(k G_I) + (1 - omega) c_0^2/(k G_II),   q = Z B (extrinsic),  Z B/(1 - B/2) (intrinsic)
//
// A finite step. (x, y) runs straight from the accepted to the trial point, crosses the circle lambda = lambda_max at
// one point, and from there D grows: by the mean of q(omega) at the crossing and at the end, times the growth of
// lambda. Where omega is constant (pure modes, constant mixes) that is exact for steps of any size, elsewhere of
// order 2. Dissipation follows on the same path from d(dissipated) = (z d lambda - lambda dz) A/2 with the mean of
// A = omega f_t^2/k + (1 - omega) c_0^2/k; the integral of z is known in closed form:
//
//   dissipated = A/2 [2 (I(D1) - I(D0))/q - (lambda_1 z_1 - lambda_0 z_0)]
//
// The first term of A is what opening loses, work of t_n less what its spring stores, the second what sliding loses.
//
// Intrinsic joints are elastic with k, in shear too, until |t_s| = c_0 + tan phi_i <-t_n> (or the ellipse, in
// tension). There shear is parted into friction at its limit, tau_f, and the cohesive rest. Two springs that carry
// tau_f and c_0 hold less energy than one that carries both, by tau_f c_0/k: friction at its limit over the slip
// c_0/k. It is booked as friction. Extrinsic points start parted, by `insert_point`
// (envelope.hpp); the energy of their offsets is lost with them, so that a complete failure dissipates G and that.

#include "fracture/cohesion_history.hpp"
#include "fracture/cohesion_properties.hpp"
#include "fracture/friction.hpp"
#include "fracture/softening.hpp"

namespace gneiss {

enum class Insertion {
    extrinsic,  ///< the point comes into being at the envelope, with traction
    intrinsic,  ///< the joint is there from the start, elastic up to the envelope
};

template <Insertion insertion>
struct MixedModeLaw {
    template <class T>
    using History = CohesionHistory<T>;

    /// Lanes that are intact and stay so at this trial: for them nothing but t = k (o, s) has to be computed.
    /// Always false for extrinsic points.
    /// @param lambda_max  of the accepted history
    template <class T, class V>
    static auto stays_intact(const CohesionProperties<V>& p, const V& lambda_max, const T& opening, const T& slip) {
        if constexpr (insertion == Insertion::extrinsic) {
            return lambda_max < V(0.0);
        } else {
            const V normal = p.penalty * plain(opening), shear = p.penalty * plain(slip);
            const V rest = positive_part(V(magnitude(shear) - p.tan_phi_initial * positive_part(V(-normal))));
            const V a = positive_part(normal) * p.cohesion, b = rest * p.tensile_strength;
            const V limit = p.tensile_strength * p.cohesion;
            return lambda_max < V(1.0) && a * a + b * b <= limit * limit;
        }
    }

    /// Length of (o, s), m, up to which an intact point stays so whichever way they point: k |(o, s)| <= min(f_t, c_0).
    static double elastic_reach(const CohesionProperties<double>& p) {
        return (p.tensile_strength < p.cohesion ? p.tensile_strength : p.cohesion) / p.penalty;
    }

    /// @param normal, shear  traction where nothing has moved, Pa
    static LoadedStart<History<double>> start(const CohesionProperties<double>& p, double normal,
                                              double shear) requires(insertion == Insertion::intrinsic) {
        return {normal / p.penalty, shear / p.penalty, {}};
    }

    /// Traction at a trial, from the accepted history.
    /// @param opening  o, m, > 0 apart
    /// @param slip     s, m
    template <class T, class V>
    static Traction<T> traction(const CohesionProperties<V>& p, const CohesionHistory<V>& accepted, const T& opening,
                                const T& slip) {
        const auto intact = stays_intact(p, accepted.lambda_max, opening, slip);
        const Traction<T> elastic{p.penalty * opening, p.penalty * slip};
        if (every_lane(intact)) return elastic;
        const Step<T> step = take_step(p, accepted, opening, slip);
        const T stiffness = p.penalty * secant(step);
        return {choose(intact, elastic.normal,
                       T(stiffness * positive_part(step.opening) - p.penalty * positive_part(T(-step.opening)))),
                choose(intact, elastic.shear, T(stiffness * step.slip + step.friction.traction))};
    }

    /// The history that accepting the trial would leave, with what the step has dissipated.
    template <class T, class V>
    static CohesionHistory<T> advance(const CohesionProperties<V>& p, const CohesionHistory<V>& accepted,
                                      const T& opening, const T& slip) {
        CohesionHistory<T> before;
        for (std::size_t i = 0; i < before.members.size(); ++i)
            before.*before.members[i] = T(accepted.*accepted.members[i]);
        const auto intact = stays_intact(p, accepted.lambda_max, opening, slip);
        if (every_lane(intact)) return before;
        const Step<T> step = take_step(p, accepted, opening, slip);
        CohesionHistory<T> after = before;
        after.damage = step.damage;
        after.lambda_max = step.lambda_max;
        after.opening = opening;
        after.slip = slip;
        after.slider = step.friction.slider;
        after.slip_offset = step.slip_offset;
        const T lost = fracture_dissipation(T(accepted.damage), step);
        after.fracture_i += step.elastic_i * lost;
        after.fracture_ii += step.elastic_ii * lost;
        after.friction += step.parting_loss + step.friction.dissipated;
        return choose_history(intact, before, after);
    }

    /// Stored at (o, s), J/m2: cohesive spring, compression, spring of friction. With work since the point came into
    /// being: work = stored - stored at the start + history.fracture() + history.friction.
    /// @param history  of that state: what `advance` returned for it
    template <class T>
    static T stored_energy(const CohesionProperties<T>& p, const CohesionHistory<T>& history, const T& opening,
                           const T& slip) {
        const auto intact = stays_intact(p, history.lambda_max, opening, slip);
        const T elastic = opening * opening + slip * slip;
        const T o = opening + history.opening_offset, s = slip + history.slip_offset, e = slip - history.slider;
        const T apart = positive_part(o), closed = positive_part(T(-o));
        T cohesive(0.0);
        if (!every_lane(intact)) {
            const T lambda_max = choose(history.lambda_max < 1.0, T(1.0), history.lambda_max);
            cohesive = softening_value(history.damage) / lambda_max * (apart * apart + s * s);
        }
        return 0.5 * p.penalty * choose(intact, elastic, T(cohesive + closed * closed + e * e));
    }

private:
    /// A step of points that are parted, or part in it.
    template <class T>
    struct Step {
        T opening, slip;              // o*, s* at the trial
        T slip_offset;                // s* - s
        T lambda_before, lambda_max;  // largest lambda, at the start and at the end
        T damage;                     // at the end
        T q;                          // mean of dD/d lambda over the growth of D
        T elastic_i, elastic_ii;      // means of the two terms of A, J/m2
        T parting_loss;               // J/m2
        SliderStep<T> friction;
    };

    template <class T>
    static T secant(const Step<T>& step) {
        if (every_lane(plain(step.damage) >= 1.0)) return T(0.0);
        return softening_value(step.damage) / step.lambda_max;
    }

    /// omega = (x/lambda)^2 where the straight way from (x0, y0), inside the circle of radius lambda, to (x, y),
    /// outside, crosses it: |(x0, y0) + t (dx, dy)| = lambda, a t^2 + 2 b t = c.
    template <class T, class Condition>
    static T mix_at_crossing(const Condition& grows, const T& x0, const T& y0, const T& x, const T& y,
                             const T& lambda) {
        const T dx = x - x0, dy = y - y0;
        const T a = dx * dx + dy * dy, b = x0 * dx + y0 * dy;
        const T c = positive_part(T(lambda * lambda - (x0 * x0 + y0 * y0)));
        const T square = b * b + a * c;
        // leaving along the tangent: t = 0; and no derivative of a root of zero
        const auto crosses = grows && plain(square) > 0.0;
        const T root = square_root(choose(crosses, square, T(1.0)));
        // the form of the root that does not cancel
        const auto outward = plain(b) > 0.0;
        const T t = choose(outward, c, T(root - b)) / choose(crosses, choose(outward, T(b + root), a), T(1.0));
        const T ratio = (x0 + choose(crosses, t, T(0.0)) * dx) / lambda;
        return ratio * ratio;
    }

    template <class T, class V>
    static Step<T> take_step(const CohesionProperties<V>& p, const CohesionHistory<V>& accepted, const T& opening,
                             const T& slip) {
        const V k = p.penalty, per_opening = k / p.tensile_strength, per_slip = k / p.cohesion;
        const auto parted = accepted.lambda_max >= 1.0;
        Step<T> step;
        step.opening = opening + T(accepted.opening_offset);
        const T closed = positive_part(T(-step.opening));
        // friction's part of the elastic slip where an intact joint reaches the envelope
        const T limit = p.tan_phi_initial * closed, all = magnitude(slip);
        const T share = with_sign_of(slip, choose(plain(limit) < plain(all), limit, all));
        step.slip_offset = choose(parted, T(accepted.slip_offset), T(-share));
        step.slip = slip + step.slip_offset;

        const T x = per_opening * positive_part(step.opening), y = per_slip * step.slip;
        const V before = choose(parted, accepted.lambda_max, V(1.0));
        step.lambda_before = T(before);
        const T square = x * x + y * y;
        const auto grows = plain(square) > before * before;
        const T lambda = square_root(choose(grows, square, T(before * before)));
        step.lambda_max = choose(grows, lambda, T(before));

        // Where the step starts. A joint that parts: from the envelope, on the ray to the trial point, the normal
        // traction being there already.
        const V accepted_opening = accepted.opening + accepted.opening_offset;
        const V accepted_slip = accepted.slip + accepted.slip_offset;
        const T inverse = T(1.0) / lambda;
        const T x0 = choose(parted, T(per_opening * positive_part(accepted_opening)), T(x * inverse));
        const T y0 = choose(parted, T(per_slip * accepted_slip), T(y * inverse));
        const T slider0 = choose(parted, T(accepted.slider), T(step.slip * inverse));
        const T slip0 = choose(parted, T(accepted.slip), T(slider0 + share));
        const T closed0 = choose(parted, T(positive_part(V(-accepted_opening))), closed);
        step.parting_loss = choose(parted, T(0.0), T(k * (share * slider0)));

        const T mix0 = mix_at_crossing(grows, x0, y0, x, y, step.lambda_before);
        const T mix1 = (x * inverse) * (x * inverse);
        const V b_i = elastic_ratio_i(p), b_ii = elastic_ratio_ii(p);
        step.q = 0.5 * (rate(b_i, b_ii, mix0) + rate(b_i, b_ii, mix1));
        const T mix = 0.5 * (mix0 + mix1);
        step.elastic_i = (p.tensile_strength / per_opening) * mix;
        step.elastic_ii = (p.cohesion / per_slip) * (T(1.0) - mix);

        const T grown = T(accepted.damage) + step.q * (lambda - step.lambda_before);
        step.damage = choose(grows, choose(plain(grown) < 1.0, grown, T(1.0)), T(accepted.damage));

        const V fall = p.tan_phi_residual - p.tan_phi_initial;
        const V coefficient0 = p.tan_phi_initial + fall * accepted.damage;
        const T coefficient1 = T(p.tan_phi_initial) + fall * step.damage;
        step.friction = slide(k, T((k * coefficient0) * closed0), T(coefficient1 * (k * closed)), slip0, slider0, slip);
        return step;
    }

    /// q(omega) = dD/d lambda
    template <class T, class V>
    static T rate(const V& b_i, const V& b_ii, const T& mix) {
        const T b = T(b_ii) + (b_i - b_ii) * mix;
        if constexpr (insertion == Insertion::extrinsic) return softening_integral * b;
        return softening_integral * b / (T(1.0) - 0.5 * b);
    }

    /// In units of A.
    template <class T>
    static T fracture_dissipation(const T& damage_before, const Step<T>& step) {
        const auto grows = plain(step.lambda_max) > plain(step.lambda_before);
        if (!any_lane(grows)) return T(0.0);
        const Softening<T> z0 = softening_and_integral(damage_before), z1 = softening_and_integral(step.damage);
        const T dissipated =
            (z1.integral - z0.integral) / step.q - 0.5 * (step.lambda_max * z1.value - step.lambda_before * z0.value);
        return choose(grows, dissipated, T(0.0));
    }
};

}  // namespace gneiss
