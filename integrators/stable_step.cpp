#include "integrators/stable_step.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "integrators/lanczos.hpp"

namespace gneiss {
namespace {

// How often the bound is looked at: twice as rarely while it stands still, twice as often when it moves. A change of
// the step by the safety factor takes far longer than this in any resolved motion.
constexpr double first_interval = 64, shortest_interval = 8, longest_interval = 1024;
constexpr double still = 0.005, moving = 0.02;  // relative change of the critical step between two looks

}  // namespace

double StabilityLimit::critical_time_step(const FrequencyBound& bound) const {
    const double c = bound.damping_rate / damping_dt;
    return 2 / (c + std::hypot(c, 2 * bound.omega / omega_dt));
}

void StableStep::Options::check(std::vector<Problem>& problems) const {
    if (!(safety > 0 && safety <= 1))
        problems.push_back({"integrator.safety", fmt::format("given {}, must be in (0, 1]", safety)});
    if (!(dt >= 0 && std::isfinite(dt)))
        problems.push_back({"integrator.dt", fmt::format("given {} s, must be >= 0 s", dt)});
    if (!(bound_interval >= 0))
        problems.push_back({"integrator.bound_interval", fmt::format("given {}, must be >= 0", bound_interval)});
}

void StableStep::Options::validate() const {
    std::vector<Problem> problems;
    check(problems);
    if (!problems.empty()) throw InputError(problems);
}

void StableStep::evaluate_bound(const SemiDiscrete& system, const State& state) {
    const double before = critical_;
    bound_ = levels_ != nullptr ? levels_->bound(state) : system.frequency_bound(state);
    take_bound(system, state);
    const double change = std::abs(critical_ - before) / critical_;
    if (options_.bound_interval > 0)
        bound_interval_ = options_.bound_interval;
    else if (bound_interval_ == 0)
        bound_interval_ = first_interval;
    else if (change < still)
        bound_interval_ = std::min(2 * bound_interval_, longest_interval);
    else if (change > moving)
        bound_interval_ = std::max(bound_interval_ / 2, shortest_interval);
    steps_since_bound_ = 0;
}

void StableStep::take_bound(const SemiDiscrete& system, const State& state) {
    FrequencyBound bound = bound_;
    if (options_.lanczos) bound.omega = std::min(bound.omega, lanczos_frequency_bound(system, state));
    bound.damping_rate += damping_rate_;
    critical_ = limit_.critical_time_step(bound);
    if (!(critical_ > 0 && std::isfinite(critical_)))
        throw RecoverableError(fmt::format("no stable time step at t = {:.9g} s: omega <= {}, damping rate <= {}",
                                           state.t, bound.omega, bound.damping_rate));
}

void StableStep::start(const SemiDiscrete& system, const State& state, StartReason why, double damping_rate) {
    const bool anew = why != StartReason::reinitialise;
    damping_rate_ = damping_rate;
    bound_held_ = why == StartReason::resize && critical_ > 0;  // what is new are bonds
    if (bound_held_) {
        const double of_bonds = system.bond_omega_squared(state);
        bound_.omega = std::sqrt(std::max(0.0, bound_.omega * bound_.omega - bound_.of_bonds + of_bonds));
        bound_.of_bonds = of_bonds;
        take_bound(system, state);
        // what has come apart deforms faster than before
        if (options_.bound_interval == 0) bound_interval_ = std::min(bound_interval_, first_interval);
    } else if (anew) {
        bound_interval_ = 0;
        evaluate_bound(system, state);
        if (dt_ == 0) dt_ = longest();
    } else if (options_.bound_interval == 0) {
        // what has been switched on may deform the solid soon; the count of steps goes on, so that frequent switches
        // do not put the next look off for ever
        bound_interval_ = std::min(bound_interval_, first_interval);
    }
}

void StableStep::supports_held(const SemiDiscrete& system, const State& state, StartReason why) {
    const bool anew = why != StartReason::reinitialise;
    if (anew && !bound_held_ && !system.constraints().empty()) evaluate_bound(system, state);
}

void StableStep::plan(const SemiDiscrete& system, const State& state, double t_stop) {
    if (look_due()) evaluate_bound(system, state);
    if (options_.dt > critical_)
        throw RecoverableError(
            fmt::format("the fixed step dt = {:.6g} s exceeds the critical step {:.6g} s at t = {:.9g} s", options_.dt,
                        critical_, state.t));
    const double remaining = t_stop - state.t;
    // equal steps up to the next stop; a remainder of round-off is no step of its own
    constexpr double round_off = 1e-9;
    dt_ = remaining / std::max(1.0, std::ceil(remaining / longest() - round_off));
}

void StableStep::save(IntegratorMemory& memory) const {
    memory["step"] = {dt_, critical_, bound_interval_, steps_since_bound_};
    memory["bound"] = {bound_.omega, bound_.damping_rate, bound_.of_bonds};
}

void StableStep::load(const std::string& integrator, const IntegratorMemory& memory, double damping_rate) {
    damping_rate_ = damping_rate;
    const std::vector<double>& step = remembered(memory, integrator, "step", 4);
    dt_ = step[0];
    critical_ = step[1];
    bound_interval_ = step[2];
    steps_since_bound_ = step[3];
    const std::vector<double>& bound = remembered(memory, integrator, "bound", 3);
    bound_ = {bound[0], bound[1], bound[2]};
}

}  // namespace gneiss
