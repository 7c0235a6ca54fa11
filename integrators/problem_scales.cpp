#include "integrators/problem_scales.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

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
    load(system, scales_);
    include(state);
    const auto mass = system.lumped_mass();
    std::vector<double> f(state.u.size()), velocity(state.u.size(), 0.0);
    double largest = 0;
    std::size_t n_evaluations = 0;
    for (const double t : {state.t, state.t + 10 / omega}) {
        Trial trial = Trial::of(state);
        trial.t = t;
        trial.z = state.z;
        try {
            ++n_evaluations;
            system.force(state, trial, f);
        } catch (const InputError&) {
            if (t == state.t) throw;
            continue;  // a formula that has no value later may never be asked for one
        }
        subtract_damping(system, state.v, f);
        for (const Constraint& constraint : system.constraints()) f[constraint.dof] = 0;
        for (std::size_t i = 0; i < f.size(); ++i) f[i] /= mass[i] * omega;
        if (const double now = largest_magnitude(f); now > largest) {
            largest = now;
            velocity.swap(f);
        }
    }
    largest = std::max({largest, largest_magnitude(state.v), largest_magnitude(supports)});
    // nothing moves, nor will soon: any scale does
    if (largest == 0) largest = 1e-6 * system.smallest_length() * omega;
    grow(1, largest);
    grow(0, largest / omega);
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
