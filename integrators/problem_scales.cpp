#include "integrators/problem_scales.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "base/largest.hpp"
#include "integrators/mass_and_damping.hpp"

namespace gneiss {
namespace {

double largest_weighted(std::span<const double> values, std::span<const double> weights) {
    double largest = 0;
    for (std::size_t k = 0; k < values.size(); ++k) largest = std::max(largest, weights[k] * std::abs(values[k]));
    return largest;
}

/// What the largest acceleration of the loads at t does to a single node within 1/omega, m/s.
/// @param[out] velocity  of all degrees of freedom, written where the result exceeds `above`
double velocity_of_loads(const SemiDiscrete& system, const State& state, double t, double last_event, double omega,
                         double above, std::vector<double>& velocity) {
    std::vector<double> f(state.u.size());
    Trial trial = Trial::of(state);
    trial.t = t;
    trial.last_event = last_event;
    trial.z = state.z;
    try {
        system.force(state, trial, f);
    } catch (const InputError&) {
        if (t == state.t) throw;
        return 0;  // a formula that has no value later may never be asked for one
    }
    subtract_damping(system, state.v, f);
    for (const Constraint& constraint : system.constraints()) f[constraint.dof] = 0;
    for (std::size_t i = 0; i < f.size(); ++i) f[i] /= system.lumped_mass()[i] * omega;
    const double largest = largest_magnitude(f);
    if (largest > above) velocity.swap(f);
    return largest;
}

struct Magnitudes {
    double displacement = 0, velocity = 0;  ///< m, m/s
    std::size_t n_evaluations = 0;          ///< of forces, that it took
};

/// What loads and supports will do where they are largest and where they vary fastest.
Magnitudes expected(const SemiDiscrete& system, const State& state, double omega) {
    Magnitudes all;
    const auto constraints = system.constraints();
    std::vector<double> now(constraints.size()), later(constraints.size()), unused;
    std::vector<double> f(state.u.size());
    for (const double t : system.load_peaks()) {
        if (!(t > state.t)) continue;
        const double infinite = std::numeric_limits<double>::infinity();
        all.velocity = std::max(all.velocity, velocity_of_loads(system, state, t, t, omega, infinite, unused));
        ++all.n_evaluations;
        if (constraints.empty()) continue;
        const double dt = 1e-3 / omega;
        try {
            system.constraint_values(t, t, now);
            system.constraint_values(t + dt, t, later);
        } catch (const InputError&) {
            continue;
        }
        for (std::size_t k = 0; k < constraints.size(); ++k) {
            const bool is_velocity = constraints[k].kind == Constraint::Kind::velocity;
            const double velocity = is_velocity ? now[k] : (later[k] - now[k]) / dt;
            if (!is_velocity)
                all.displacement = std::max(all.displacement, std::abs(now[k] - state.u[constraints[k].dof]));
            all.velocity = std::max(all.velocity, std::abs(velocity));
        }
    }
    return all;
}

}  // namespace

void ProblemScales::Given::check(std::vector<Problem>& problems) const {
    const auto need = [&](double value, const char* key, const char* unit) {
        if (!(value >= 0 && std::isfinite(value)))
            problems.push_back(
                {std::string("integrator.") + key, fmt::format("given {} {}, must be >= 0 {}", value, unit, unit)});
    };
    need(displacement, "displacement_scale", "m");
    need(velocity, "velocity_scale", "m/s");
    need(internal, "stress_scale", "Pa");
}

void ProblemScales::grow(std::size_t kind, double value) {
    const double given = std::array{given_.displacement, given_.velocity, given_.internal}[kind];
    scales_[kind] = given > 0 ? given : std::max(scales_[kind], value);
}

void ProblemScales::load(const SemiDiscrete& system, const std::vector<double>& scales) {
    scales_ = scales;
    weights_.resize(system.layout().n_internal);
    system.internal_weights(weights_);
}

void ProblemScales::include(const State& accepted) {
    grow(0, largest_magnitude(accepted.u));
    grow(1, largest_magnitude(accepted.v));
    grow(2, largest_weighted(accepted.z, weights_));
}

std::size_t ProblemScales::start(const SemiDiscrete& system, const State& state, double omega,
                                 std::span<const double> supports) {
    const bool is_new = scales_[1] == 0;
    load(system, scales_);
    include(state);
    std::vector<double> velocity(state.u.size(), 0.0);
    double largest = 0;
    std::size_t n_evaluations = 0;
    for (const double t : {state.t, state.t + 10 / omega}) {
        largest = std::max(largest, velocity_of_loads(system, state, t, state.last_event, omega, largest, velocity));
        ++n_evaluations;
    }
    // Stress at rest leaves forces of round-off at nodes where it balances: n eps sigma of each element, which within
    // 1/omega move a node by less than n eps sigma/E of an edge. No deformation gradient, 1 + du/dx, tells such a
    // displacement from none, and no tolerance could be measured against it.
    constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();
    if (largest < round_off * system.smallest_length() * omega) {
        largest = 0;
        std::ranges::fill(velocity, 0.0);
    }
    largest = std::max({largest, largest_magnitude(state.v), largest_magnitude(supports)});
    // while nothing moves: a part of what is to come, so that neither a load that has hardly begun nor a scale out of
    // nowhere says what is small
    constexpr double part = 1e-3;
    const Magnitudes to_come = is_new ? expected(system, state, omega) : Magnitudes{};
    n_evaluations += to_come.n_evaluations;
    largest = std::max(largest, part * to_come.velocity);
    double displacement = std::max(largest / omega, part * to_come.displacement);
    if (is_new && largest == 0 && displacement == 0) {
        // nothing ever moves: any scale does of which a small part is seen
        displacement = 1e-9 * system.smallest_length();
        largest = displacement * omega;
    }
    grow(1, largest);
    grow(0, displacement);
    if (weights_.empty()) return n_evaluations;
    std::vector<double> rate(state.z.size());
    Trial trial = Trial::of(state);
    trial.v = velocity;
    trial.z = state.z;
    system.internal_rate(state, trial, rate);
    grow(2, largest_weighted(rate, weights_) / omega);
    if (scales_[2] == 0) grow(2, 1);  // nothing strains yet: 1 Pa, until something does
    return n_evaluations;
}

}  // namespace gneiss
