#include "integrators/noh_bathe.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.hpp"

namespace gneiss {

void NohBathe::Options::validate() const {
    std::vector<Problem> problems;
    step.check(problems);
    if (!(split >= 0.5 && split <= 0.7))
        problems.push_back({"integrator.split", fmt::format("given {}, must be in [0.5, 0.7]", split)});
    if (!problems.empty()) throw InputError(problems);
}

StabilityLimit NohBathe::stability_limit(double split) {
    return {2 / std::sqrt((1 - split) * (3 * split - 1)), 2 * split / (4 * split - 2 * split * split - 1)};
}

NohBathe::NohBathe(const Options& options)
    : ExplicitSubSteps(options.step, stability_limit(options.split)), split_(options.split) {
    options.validate();
    const double q1 = (1 - 2 * split_) / (2 * split_ * (1 - split_)), q2 = 0.5 - split_ * q1;
    second_ = {0.5 - q1 - q2, 0.5 + q1, q2};
}

void NohBathe::take(const SemiDiscrete& system, const State& state, double dt, double t_end) {
    sub_step(system, state, split_ * dt, state.t + split_ * dt, {});
    sub_step(system, go_on(), (1 - split_) * dt, t_end, second_);
}

}  // namespace gneiss
