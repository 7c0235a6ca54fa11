#include "integrators/problem_scales.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.hpp"
#include "integrators/mass_and_damping.hpp"

namespace gneiss {
namespace {

double largest_of(std::span<const double> values) {
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    return largest;
}

double largest_of(std::span<const double> values, std::span<const double> weights) {
    double largest = 0;
    for (std::size_t k = 0; k < values.size(); ++k) largest = std::max(largest, weights[k] * std::abs(values[k]));
    return largest;
}

}  // namespace

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
    grow(0, largest_of(accepted.u));
    grow(1, largest_of(accepted.v));
    grow(2, largest_of(accepted.z, weights_));
}

void ProblemScales::start(const SemiDiscrete& system, const State& state, double omega,
                          std::span<const double> supports) {
    load(system, scales_);
    include(state);
    const auto mass = system.lumped_mass();
    std::vector<double> f(state.u.size()), velocity(state.u.size(), 0.0);
    double largest = 0;
    for (const double t : {state.t, state.t + 10 / omega}) {
        Trial trial = Trial::of(state);
        trial.t = t;
        trial.z = state.z;
        try {
            system.force(state, trial, f);
        } catch (const InputError&) {
            if (t == state.t) throw;
            continue;  // a formula that has no value later may never be asked for one
        }
        subtract_damping(system, state.v, f);
        for (const Constraint& constraint : system.constraints()) f[constraint.dof] = 0;
        for (std::size_t i = 0; i < f.size(); ++i) f[i] /= mass[i] * omega;
        if (const double now = largest_of(f); now > largest) {
            largest = now;
            velocity.swap(f);
        }
    }
    largest = std::max({largest, largest_of(state.v), largest_of(supports)});
    // nothing moves, nor will soon: any scale does
    if (largest == 0) largest = 1e-6 * system.smallest_length() * omega;
    grow(1, largest);
    grow(0, largest / omega);
    if (weights_.empty()) return;
    std::vector<double> rate(state.z.size());
    Trial trial = Trial::of(state);
    trial.v = velocity;
    trial.z = state.z;
    system.internal_rate(state, trial, rate);
    grow(2, largest_of(rate, weights_) / omega);
    if (scales_[2] == 0) grow(2, 1);  // nothing strains yet: 1 Pa, until something does
}

}  // namespace gneiss
