#include "integrators/load_stepping.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "integrators/prescribed_motion.hpp"

namespace gneiss {

void LoadStepping::Options::check(std::vector<Problem>& problems) const {
    const auto need = [&](bool fine, const char* key, const std::string& message) {
        if (!fine) problems.push_back({std::string("integrator.") + key, message});
    };
    need(tolerance > 0 && tolerance <= 0.01, "tolerance", fmt::format("given {}, must be in (0, 0.01]", tolerance));
    need(step >= 0 && std::isfinite(step), "step", fmt::format("given {} s, must be >= 0 s", step));
    need(longest >= 0 && std::isfinite(longest), "longest", fmt::format("given {} s, must be >= 0 s", longest));
    need(shortest > 0 && shortest < 1, "shortest", fmt::format("given {}, must be in (0, 1)", shortest));
    need(most_iterations >= 0, "most_iterations", fmt::format("given {}, must be >= 0", most_iterations));
}

LoadStepping::LoadStepping(const Options& options, int enough) : options_(options) {
    std::vector<Problem> problems;
    options.check(problems);
    if (!problems.empty()) throw InputError(problems);
    if (options_.most_iterations == 0) options_.most_iterations = enough;
}

void LoadStepping::allocate_all(const SemiDiscrete& system) {
    const Layout layout = system.layout();
    next_.u.assign(layout.n_dof, 0.0);
    next_.v.assign(layout.n_dof, 0.0);
    next_.z.assign(layout.n_internal, 0.0);
    next_.history.assign(layout.n_history, 0.0);
    f_.assign(layout.n_dof, 0.0);
    for (auto* values : {&prescribed_, &change_, &reactions_}) values->assign(system.constraints().size(), 0.0);
    allocate(system);
}

void LoadStepping::start(const SemiDiscrete& system, State& state, StartReason why) {
    if (why != StartReason::reinitialise) allocate_all(system);
    if (why == StartReason::fresh) dt_ = options_.step, first_dt_ = 0;
    std::ranges::fill(state.v, 0.0);
    state.path.viscous_power = 0;
    system.force(state, Trial::of(state), f_);
    ++counts_.starts;
    for (std::size_t k = 0; k < reactions_.size(); ++k) reactions_[k] = -f_[system.constraints()[k].dof];
    if (why == StartReason::fresh || why == StartReason::reinitialise) find_jump(system);
}

void LoadStepping::find_jump(const SemiDiscrete& system) {
    jumped_ = true;
    jump_ = f_;
    for (const Constraint& constraint : system.constraints()) jump_[constraint.dof] = 0;
}

StepReport LoadStepping::advance(const SemiDiscrete& system, State& state, double t_stop) {
    const double dt_before = dt_, first_before = first_dt_;
    const Counts before = counts_;
    StepReport report;
    warning_.clear();
    try {
        attempt(system, state, t_stop, report);
    } catch (...) {
        dt_ = dt_before;
        first_dt_ = first_before;
        throw;
    }
    const double unbalanced = accept(system, state);
    report.t = state.t;
    report.n_force = counts_.evaluations - before.evaluations;
    report.numbers = {static_cast<double>(counts_.iterations - before.iterations),
                      static_cast<double>(counts_.factorisations - before.factorisations),
                      static_cast<double>(counts_.linear_iterations - before.linear_iterations),
                      static_cast<double>(report.n_force), unbalanced > 0 ? unbalanced / largest_force_ : 0.0};
    report.warning = warning_;
    return report;
}

void LoadStepping::attempt(const SemiDiscrete& system, State& state, double t_stop, StepReport& report) {
    const double remaining = t_stop - state.t;
    if (dt_ == 0) dt_ = remaining;
    if (options_.longest > 0) dt_ = std::min(dt_, options_.longest);
    if (first_dt_ == 0) first_dt_ = dt_;
    next_.last_event = state.last_event;
    for (;; ++report.n_rejected) {
        constexpr double round_off = 1e-9;
        report.dt = remaining / std::max(1.0, std::ceil(remaining / dt_ - round_off));
        next_.t = report.dt == remaining ? t_stop : state.t + report.dt;
        const auto fail = [&](const std::exception& error) {
            throw RecoverableError(
                fmt::format("no equilibrium found after load time t = {:.9g} s, with load steps down to {:.3g} s: {}",
                            state.t, report.dt, error.what()));
        };
        try {
            find_changes(system, state);
            std::ranges::copy(state.u, next_.u.begin());
            const bool easy = solve(system, state);
            // not shorter: a remainder before a stop may be
            if (easy && report.n_rejected == 0) dt_ = std::max(dt_, 2 * report.dt);
            return;
        } catch (const Exhausted& error) {
            fail(error);
        } catch (const RecoverableError& error) {
            report.rejected = error.what();
            dt_ = report.dt / 2;
            if (dt_ < options_.shortest * first_dt_) fail(error);
        }
    }
}

void LoadStepping::find_changes(const SemiDiscrete& system, const State& state) {
    const auto constraints = system.constraints();
    system.constraint_values(next_.t, next_.last_event, prescribed_);
    for (std::size_t k = 0; k < constraints.size(); ++k)
        change_[k] =
            constraints[k].kind == Constraint::Kind::velocity ? 0.0 : prescribed_[k] - state.u[constraints[k].dof];
    add_travel(system, state.t, next_.t, next_.last_event, prescribed_, change_);
}

double LoadStepping::accept(const SemiDiscrete& system, State& state) {
    const bool remembers = !(next_.z.empty() && next_.history.empty());
    ++(remembers ? counts_.evaluations : counts_.balance);
    system.force_and_update(state, trial(), f_, next_.z, next_.history);
    system.add_path_energies(state, next_);
    for (std::size_t k = 0; k < reactions_.size(); ++k) {
        const std::size_t dof = system.constraints()[k].dof;
        next_.path.support_work += 0.5 * (reactions_[k] - f_[dof]) * (next_.u[dof] - state.u[dof]);
        reactions_[k] = -f_[dof];
        f_[dof] = 0;
    }
    if (jumped_)
        for (std::size_t i = 0; i < jump_.size(); ++i)
            next_.path.external_work -= 0.5 * jump_[i] * (next_.u[i] - state.u[i]);
    jumped_ = false;
    std::swap(state, next_);
    double unbalanced = 0;
    for (const double force : f_) unbalanced = std::max(unbalanced, std::abs(force));
    return unbalanced;
}

void LoadStepping::load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) {
    allocate_all(system);
    const auto take = [&](const char* entry, std::size_t size) -> const std::vector<double>& {
        return remembered(memory, name(), entry, size);
    };
    reactions_ = take("reactions", reactions_.size());
    dt_ = take("step", 2)[0];
    first_dt_ = take("step", 2)[1];
    jumped_ = false;
    if (take("jumped", 1)[0] == 0) return;
    system.force(state, Trial::of(state), f_);
    find_jump(system);
}

}  // namespace gneiss
