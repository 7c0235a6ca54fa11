#include "integrators/bathe.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "integrators/mass_and_damping.hpp"

namespace gneiss {
namespace {

constexpr double shortest_part = 1e-6;  ///< of the step given, at which a run gives up

}  // namespace

void Bathe::Options::validate() const {
    std::vector<Problem> problems;
    if (!(rho_inf >= 0 && rho_inf <= 1))
        problems.push_back({"integrator.rho_inf", fmt::format("given {}, must be in [0, 1]", rho_inf)});
    if (!(dt > 0 && std::isfinite(dt)))
        problems.push_back({"integrator.dt", fmt::format("given {} s, must be > 0 s", dt)});
    newton.check(problems);
    InterfaceBalance::check(interface_tolerance, problems);
    if (!problems.empty()) throw InputError(problems);
}

Bathe::Bathe(const Options& options)
    : options_(options),
      split_(2 / (2 + std::sqrt(2 + 2 * options.rho_inf))),
      q1_((1 + options.rho_inf) / (4 - 2 * split_ * (1 - options.rho_inf))),
      q2_(0.5 - split_ * q1_),
      newton_(options.newton, "bathe") {
    options_.validate();
    q0_ = 1 - q1_ - q2_;
}

void Bathe::allocate(const SemiDiscrete& system) {
    newton_.bind(system);
    const Layout layout = system.layout();
    for (State* scratch : {&next_, &middle_}) {
        scratch->u.assign(layout.n_dof, 0.0);
        scratch->v.assign(layout.n_dof, 0.0);
        scratch->z.assign(layout.n_internal, 0.0);
        scratch->history.assign(layout.n_history, 0.0);
    }
    for (auto* values : {&a_, &a_middle_, &a_next_, &known_u_, &known_v_, &f_}) values->assign(layout.n_dof, 0.0);
    for (auto* values : {&reactions_, &reactions_new_, &reactions_before_})
        values->assign(system.constraints().size(), 0.0);
    motion_.bind(system, omega_);
    interfaces_.bind(system);
    if (interfaces_.active())
        for (auto* values : {&joined_, &joined_middle_, &joined_next_, &impulse_}) values->assign(layout.n_dof, 0.0);
}

void Bathe::start(const SemiDiscrete& system, State& state, StartReason why) {
    if (why == StartReason::fresh) {
        omega_ = system.frequency_bound(state).omega;
        dt_ = options_.dt;
        interfaces_.set_largest(0);
    }
    if (why != StartReason::reinitialise) allocate(system);
    forget(system, state);
    newton_.counts().starts += motion_.hold(system, state, why);
    system.force(state, Trial::of(state), f_);
    ++newton_.counts().starts;
    motion_.reactions(system, state.v, f_, reactions_);
    motion_.accelerations(system, state.v, f_, a_);
    if (!interfaces_.active()) return;
    interfaces_.start(system, state, omega_);
    interfaces_.force(system, state, Trial::of(state), joined_);
}

StepReport Bathe::advance(const SemiDiscrete& system, State& state, double t_stop) {
    const double remaining = t_stop - state.t;
    motion_.step_from(system, state);
    StepReport report;
    const std::size_t evaluations_before = counts().evaluations;
    double limit = dt_;
    for (;; ++report.n_rejected) {
        constexpr double round_off = 1e-9;  // a remainder of round-off is no step of its own
        report.dt = remaining / std::max(1.0, std::ceil(remaining / limit - round_off));
        try {
            take(system, state, report.dt, report.dt == remaining ? t_stop : state.t + report.dt);
            const double made = interfaces_.active() ? excess(system, state, report.dt) : 0;
            if (made <= 1) break;
            limit = report.dt / 2;
            report.rejected = interfaces_.reason(made);
        } catch (const RecoverableError& failure) {
            newton_.drop_matrix();
            limit = report.dt / 2;
            report.rejected = failure.what();
            if (limit < shortest_part * options_.dt)
                throw RecoverableError(fmt::format("{} cannot go on from t = {:.9g} s, with steps down to {:.3g} s: {}",
                                                   name(), state.t, report.dt, failure.what()));
        }
    }
    dt_ = std::min(options_.dt, 2 * limit);
    if (interfaces_.active()) interfaces_.accept();
    std::swap(state, next_);
    a_.swap(a_next_);
    joined_.swap(joined_next_);
    reactions_.swap(reactions_new_);
    report.t = state.t;
    report.n_force = counts().evaluations - evaluations_before;
    return report;
}

void Bathe::take(const SemiDiscrete& system, const State& state, double dt, double t_end) {
    const std::size_t n = a_.size();
    std::ranges::copy(reactions_, reactions_new_.begin());
    const double h = split_ * dt, half = 0.5 * h;
    middle_.t = state.t + h;
    middle_.last_event = next_.last_event = state.last_event;
    parallel_ranges(n, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            known_v_[i] = state.v[i] + half * a_[i];
            known_u_[i] = state.u[i] + half * state.v[i];
        }
    });
    std::ranges::copy(a_, a_middle_.begin());
    solve(system, state, middle_, half, a_middle_);
    accept(system, state, middle_);

    next_.t = t_end;
    parallel_ranges(n, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            known_v_[i] = state.v[i] + dt * (q0_ * a_[i] + q1_ * a_middle_[i]);
            known_u_[i] = state.u[i] + dt * (q0_ * state.v[i] + q1_ * middle_.v[i]);
        }
    });
    std::ranges::copy(a_middle_, a_next_.begin());
    solve(system, middle_, next_, q2_ * dt, a_next_);
    accept(system, middle_, next_);
}

void Bathe::solve(const SemiDiscrete& system, const State& from, State& to, double w, std::vector<double>& a) {
    const auto free = newton_.free();
    const auto place = [&] {
        parallel_ranges(free.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const std::size_t dof = free[i];
                to.v[dof] = known_v_[dof] + w * a[dof];
                to.u[dof] = known_u_[dof] + w * to.v[dof];
            }
        });
    };
    motion_.evaluate(system, to.t);
    motion_.put(system, to.u, to.v);
    motion_.put_acceleration(system, a);
    place();
    newton_.solve(system, from,
                  {.at = to,
                   .end = to,
                   .dt = to.t - from.t,
                   .matrix_dt = w,
                   .factors = {.mass = 1, .damping = w, .stiffness = w * w, .velocity = w},
                   .displacement = w * w,
                   .place = place,
                   .acceleration = [&a](std::size_t dof) { return a[dof]; }},
                  a);
}

void Bathe::accept(const SemiDiscrete& system, const State& from, State& to) {
    const bool remembers = !(to.z.empty() && to.history.empty());
    const auto solved = newton_.forces();
    if (remembers) {
        system.force_and_update(from, Trial::of(to), f_, to.z, to.history);
        ++newton_.counts().evaluations;
    } else if (!solved.empty()) {
        f_.assign(solved.begin(), solved.end());
    } else if (!system.constraints().empty()) {
        system.force(from, Trial::of(to), f_);
        ++newton_.counts().balance;
    }
    system.add_path_energies(from, to);
    reactions_before_.swap(reactions_new_);
    motion_.reactions(system, to.v, f_, reactions_new_);
    add_support_work(system, reactions_before_, reactions_new_, from, to);
}

double Bathe::excess(const SemiDiscrete& system, const State& state, double dt) {
    const double half = 0.5 * split_ * dt;
    interfaces_.force(system, state, Trial::of(middle_), joined_middle_);
    interfaces_.force(system, middle_, Trial::of(next_), joined_next_);
    const auto to_middle = [&](std::size_t i) { return half * (joined_[i] + joined_middle_[i]); };
    const auto work = [&](auto impulse, const State& from, const State& to) {
        parallel_ranges(impulse_.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) impulse_[i] = impulse(i);
        });
        return interfaces_.work(system, impulse_, from, to);
    };
    const double first = work(to_middle, state, middle_);
    const double second = work(
        [&](std::size_t i) {
            return dt * (q0_ * joined_[i] + q1_ * joined_middle_[i] + q2_ * joined_next_[i]) - to_middle(i);
        },
        middle_, next_);
    return interfaces_.excess(system, first + second, state, next_);
}

double Bathe::kinetic_energy(const SemiDiscrete& system, const State& state) const {
    return synchronised_kinetic_energy(system, state.v, partial_);
}

IntegratorMemory Bathe::save() const {
    return {{"acceleration", a_},
            {"joints_and_contact", joined_},
            {"reactions", reactions_},
            {"step", {dt_, omega_, interfaces_.largest()}}};
}

void Bathe::forget(const SemiDiscrete&, State&) { newton_.forget(); }

void Bathe::load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) {
    const std::vector<double>& step = remembered(memory, name(), "step", 3);
    dt_ = step[0];
    omega_ = step[1];
    allocate(system);
    a_ = remembered(memory, name(), "acceleration", a_.size());
    reactions_ = remembered(memory, name(), "reactions", reactions_.size());
    if (!interfaces_.active()) return;
    interfaces_.start(system, state, omega_);
    interfaces_.set_largest(step[2]);
    joined_ = remembered(memory, name(), "joints_and_contact", joined_.size());
}

}  // namespace gneiss
