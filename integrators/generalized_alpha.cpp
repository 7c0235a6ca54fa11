#include "integrators/generalized_alpha.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "integrators/mass_and_damping.hpp"

namespace gneiss {
namespace {

constexpr double shortest_part = 1e-6;  ///< of the step wanted, at which a run gives up
/// Of Scheme::error_constant(), for errors of the next order not to rule the estimate.
constexpr double smallest_error_constant = 0.01;

}  // namespace

auto GeneralizedAlpha::Scheme::chung_hulbert(double rho_inf) -> Scheme {
    const double alpha_m = (2 * rho_inf - 1) / (rho_inf + 1), alpha_f = rho_inf / (rho_inf + 1);
    const double shift = 1 - alpha_m + alpha_f;
    return {alpha_m, alpha_f, 0.25 * shift * shift, 0.5 - alpha_m + alpha_f};
}

auto GeneralizedAlpha::Scheme::newmark(double beta, double gamma) -> Scheme { return {0, 0, beta, gamma}; }

auto GeneralizedAlpha::Scheme::hht(double alpha) -> Scheme {
    return {0, alpha, 0.25 * (1 + alpha) * (1 + alpha), 0.5 + alpha};
}

void GeneralizedAlpha::Options::validate() const {
    std::vector<Problem> problems;
    const auto need = [&](bool fine, const char* key, const std::string& message) {
        if (!fine) problems.push_back({std::string("integrator.") + key, message});
    };
    const auto [alpha_m, alpha_f, beta, gamma] = scheme;
    need(alpha_m <= 0.5 && alpha_f <= 0.5 && alpha_m <= alpha_f, "alpha",
         fmt::format("given alpha_m = {}, alpha_f = {}, must be alpha_m <= alpha_f <= 1/2", alpha_m, alpha_f));
    need(gamma >= 0.5 && gamma <= 2, "gamma", fmt::format("given {}, must be in [1/2, 2]: below, motion grows", gamma));
    need(beta > 0 && beta <= 2, "beta", fmt::format("given {}, must be in (0, 2]", beta));
    need(dt >= 0 && std::isfinite(dt), "dt", fmt::format("given {} s, must be >= 0 s", dt));
    need(rtol >= 0 && rtol <= 0.1, "rtol", fmt::format("given {}, must be in [0, 0.1]", rtol));
    need(dt > 0 || rtol > 0, "dt",
         "missing: give `dt` for fixed steps, or `adaptive = true` for steps from an error estimate");
    need(rtol == 0 || std::abs(scheme.error_constant()) >= smallest_error_constant, "rtol",
         fmt::format(
             "given {}, but with beta = {} the leading error of the displacement vanishes and cannot be estimated",
             rtol, beta));
    // otherwise velocities have an error of the second order, which the estimate, of displacements, does not see
    const double first_order = gamma - 0.5 + alpha_m - alpha_f;
    need(rtol == 0 || std::abs(first_order) < 1e-12, "rtol",
         fmt::format("given {}, but with gamma = {} the scheme is of order 1, whose error is not estimated: take "
                     "gamma = 1/2 - alpha_m + alpha_f = {}",
                     rtol, gamma, gamma - first_order));
    scales.check(problems);
    InterfaceBalance::check(interface_tolerance, problems);
    need(longest >= 0 && std::isfinite(longest), "longest", fmt::format("given {} s, must be >= 0 s", longest));
    newton().check(problems);
    if (!problems.empty()) throw InputError(problems);
}

GeneralizedAlpha::GeneralizedAlpha(const Options& options)
    : options_(options), newton_(options.newton(), options.name), scales_(options.scales) {
    options_.validate();
}

void GeneralizedAlpha::allocate(const SemiDiscrete& system) {
    newton_.bind(system);
    const Layout layout = system.layout();
    for (State* scratch : {&next_, &stage_}) {
        scratch->u.assign(layout.n_dof, 0.0);
        scratch->v.assign(layout.n_dof, 0.0);
    }
    next_.z.assign(layout.n_internal, 0.0);
    next_.history.assign(layout.n_history, 0.0);
    for (auto* values : {&a_, &a_next_, &f_}) values->assign(layout.n_dof, 0.0);
    if (options_.rtol > 0)
        for (auto* values : {&at_end_, &at_end_next_, &scratch_}) values->assign(layout.n_dof, 0.0);
    reactions_.assign(system.constraints().size(), 0.0);
    motion_.bind(system, omega_);
    interfaces_.bind(system);
    if (interfaces_.active())
        for (auto* values : {&joined_, &joined_next_, &impulse_}) values->assign(layout.n_dof, 0.0);
}

void GeneralizedAlpha::start(const SemiDiscrete& system, State& state, StartReason why) {
    if (why == StartReason::fresh) {
        omega_ = system.frequency_bound(state).omega;
        dt_ = 0;
        scales_ = ProblemScales(options_.scales);
        interfaces_.set_largest(0);
    }
    if (why != StartReason::reinitialise) allocate(system);
    forget(system, state);
    newton_.counts().starts += motion_.hold(system, state, why);
    newton_.counts().starts += scales_.start(system, state, omega_, motion_.velocity());
    if (dt_ == 0) {
        dt_ = options_.dt > 0 ? options_.dt : 1 / omega_;
        if (options_.rtol > 0 && options_.longest > 0) dt_ = std::min(dt_, options_.longest);
    }
    system.force(state, Trial::of(state), f_);
    ++newton_.counts().starts;
    motion_.reactions(system, state.v, f_, reactions_);
    motion_.accelerations(system, state.v, f_, a_);
    if (options_.rtol > 0) at_end_ = a_;
    if (!interfaces_.active()) return;
    interfaces_.start(system, state, omega_);
    interfaces_.force(system, state, Trial::of(state), joined_);
}

StepReport GeneralizedAlpha::advance(const SemiDiscrete& system, State& state, double t_stop) {
    const bool adaptive = options_.rtol > 0;
    const double remaining = t_stop - state.t;
    const double wanted = adaptive ? std::min(dt_, system.longest_step(state.t)) : dt_;
    motion_.step_from(system, state);
    StepReport report;
    const std::size_t evaluations_before = counts().evaluations;
    double limit = wanted;
    std::string why;
    for (;; ++report.n_rejected) {
        constexpr double round_off = 1e-9;  // a remainder of round-off is no step of its own
        const double dt = remaining / std::max(1.0, std::ceil(remaining / limit - round_off));
        next_.t = dt == remaining ? t_stop : state.t + dt;
        next_.last_event = stage_.last_event = state.last_event;
        report.dt = dt;
        try {
            solve(system, state, dt);
            arrive(system, state);
            const double e = adaptive ? error(dt) : 0;
            const double made = e <= 1 && interfaces_.active() ? excess(system, state, dt) : 0;
            if (e <= 1 && made <= 1) {
                finish_step(system, state);
                choose_next_step(dt, limit, e);
                break;
            }
            if (made > 1) {
                why = interfaces_.reason(made);
                limit = dt / 2;
            } else {
                why = "the error is too large";
                limit = dt * std::max(0.2, 0.9 * std::cbrt(1 / e));
            }
        } catch (const RecoverableError& failure) {
            newton_.drop_matrix();
            limit = dt / 2;
            why = failure.what();
        }
        if (limit < shortest_part * (adaptive ? wanted : options_.dt))
            throw RecoverableError(fmt::format("{} cannot go on from t = {:.9g} s, with steps down to {:.3g} s: {}",
                                               options_.name, state.t, dt, why));
    }
    std::swap(state, next_);
    a_.swap(a_next_);
    at_end_.swap(at_end_next_);
    joined_.swap(joined_next_);
    scales_.include(state);
    report.t = state.t;
    if (report.n_rejected > 0) report.rejected = why;
    report.n_force = counts().evaluations - evaluations_before;
    return report;
}

void GeneralizedAlpha::choose_next_step(double dt, double limit, double error) {
    if (options_.rtol == 0) {
        dt_ = std::min(options_.dt, 2 * limit);
        return;
    }
    const double best = 0.9 * dt * std::cbrt(1 / std::max(error, 1e-9));
    // a longer step asks for a new matrix: worth it for a fifth
    dt_ = best > 1.2 * limit ? std::min(best, 2 * limit) : std::min(best, limit);
    if (options_.longest > 0) dt_ = std::min(dt_, options_.longest);
}

double GeneralizedAlpha::error(double dt) const {
    const double factor = dt * dt * options_.scheme.error_constant();
    const auto free = newton_.free();
    const double sum = ordered_sum(free.size(), partial_, [&](std::size_t first, std::size_t last) {
        double part = 0;
        for (std::size_t i = first; i < last; ++i) {
            const double e = factor * (at_end_next_[free[i]] - at_end_[free[i]]);
            part += e * e;
        }
        return part;
    });
    const double n = std::max<double>(1, static_cast<double>(free.size()));
    return std::sqrt(sum / n) / (options_.rtol * scales_.displacement());
}

void GeneralizedAlpha::predict(const SemiDiscrete& system, const State& state, double dt) {
    std::ranges::copy(a_, a_next_.begin());
    motion_.evaluate(system, next_.t);
    place(state, dt);
    motion_.put(system, next_.u, next_.v);
    const auto supports = motion_.acceleration(system);
    const auto constraints = system.constraints();
    const double alpha_f = options_.scheme.alpha_f;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        a_next_[dof] = supports[k];
        stage_.u[dof] = (1 - alpha_f) * next_.u[dof] + alpha_f * state.u[dof];
        stage_.v[dof] = (1 - alpha_f) * next_.v[dof] + alpha_f * state.v[dof];
    }
    stage_.t = state.t + (1 - alpha_f) * dt;
}

void GeneralizedAlpha::place(const State& state, double dt) {
    const auto [alpha_m, alpha_f, beta, gamma] = options_.scheme;
    const auto free = newton_.free();
    parallel_ranges(free.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const std::size_t dof = free[i];
            next_.u[dof] = state.u[dof] + dt * (state.v[dof] + dt * ((0.5 - beta) * a_[dof] + beta * a_next_[dof]));
            next_.v[dof] = state.v[dof] + dt * ((1 - gamma) * a_[dof] + gamma * a_next_[dof]);
            stage_.u[dof] = (1 - alpha_f) * next_.u[dof] + alpha_f * state.u[dof];
            stage_.v[dof] = (1 - alpha_f) * next_.v[dof] + alpha_f * state.v[dof];
        }
    });
}

void GeneralizedAlpha::solve(const SemiDiscrete& system, const State& state, double dt) {
    predict(system, state, dt);
    const auto [alpha_m, alpha_f, beta, gamma] = options_.scheme;
    const double velocity = (1 - alpha_f) * gamma * dt, m = alpha_m;  // no structured binding in a lambda
    newton_.solve(system, state,
                  {.at = stage_,
                   .end = next_,
                   .dt = dt,
                   .matrix_dt = dt,
                   .factors = {.mass = 1 - alpha_m,
                               .damping = velocity,
                               .stiffness = (1 - alpha_f) * beta * dt * dt,
                               .velocity = velocity},
                   .displacement = beta * dt * dt,
                   .place = [&, dt] { place(state, dt); },
                   .acceleration = [this, m](std::size_t dof) { return (1 - m) * a_next_[dof] + m * a_[dof]; }},
                  a_next_);
}

void GeneralizedAlpha::arrive(const SemiDiscrete& system, const State& state) {
    const Trial end{next_.t, next_.last_event, next_.u, next_.v, {}};
    const bool remembers = !(next_.z.empty() && next_.history.empty()), estimates = options_.rtol > 0;
    const auto solved = newton_.forces();  // of the stage
    if (remembers) {
        system.force_and_update(state, end, f_, next_.z, next_.history);
        ++newton_.counts().evaluations;
    } else if (options_.scheme.alpha_f == 0 && !solved.empty()) {
        f_.assign(solved.begin(), solved.end());
    } else {
        system.force(state, end, f_);
        ++(estimates ? newton_.counts().evaluations : newton_.counts().balance);
    }
    system.add_path_energies(state, next_);
    if (!estimates) return;
    std::ranges::copy(f_, scratch_.begin());
    motion_.accelerations(system, next_.v, scratch_, at_end_next_);
}

double GeneralizedAlpha::excess(const SemiDiscrete& system, const State& state, double dt) {
    // the part of M a(n+1) that is theirs goes by the recursion of the scheme, and so does their impulse
    const double m = options_.scheme.alpha_m, gamma = options_.scheme.gamma;
    interfaces_.force(system, state, Trial::of(stage_), joined_next_);
    parallel_ranges(joined_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            joined_next_[i] = (joined_next_[i] - m * joined_[i]) / (1 - m);
            impulse_[i] = dt * ((1 - gamma) * joined_[i] + gamma * joined_next_[i]);
        }
    });
    return interfaces_.excess(system, interfaces_.work(system, impulse_, state, next_), state, next_);
}

void GeneralizedAlpha::finish_step(const SemiDiscrete& system, const State& state) {
    if (interfaces_.active()) interfaces_.accept();
    const auto constraints = system.constraints();
    for (std::size_t k = 0; k < constraints.size(); ++k)
        next_.path.support_work += 0.5 * reactions_[k] * (next_.u[constraints[k].dof] - state.u[constraints[k].dof]);
    motion_.reactions(system, next_.v, f_, reactions_);
    for (std::size_t k = 0; k < constraints.size(); ++k)
        next_.path.support_work += 0.5 * reactions_[k] * (next_.u[constraints[k].dof] - state.u[constraints[k].dof]);
}

double GeneralizedAlpha::kinetic_energy(const SemiDiscrete& system, const State& state) const {
    return synchronised_kinetic_energy(system, state.v, partial_);
}

double GeneralizedAlpha::matrix_bytes() const { return newton_.bytes(); }

IntegratorMemory GeneralizedAlpha::save() const {
    return {
        {"acceleration", a_},      {"acceleration_at_end", at_end_}, {"joints_and_contact", joined_},
        {"reactions", reactions_}, {"scales", scales_.save()},       {"step", {dt_, omega_, interfaces_.largest()}}};
}

void GeneralizedAlpha::forget(const SemiDiscrete&, State&) { newton_.forget(); }

void GeneralizedAlpha::load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) {
    const auto take = [&](const char* entry, std::size_t size) -> const std::vector<double>& {
        return remembered(memory, name(), entry, size);
    };
    dt_ = take("step", 3)[0];
    omega_ = take("step", 3)[1];
    scales_.load(system, take("scales", 3));
    allocate(system);
    a_ = take("acceleration", a_.size());
    at_end_ = take("acceleration_at_end", at_end_.size());
    reactions_ = take("reactions", reactions_.size());
    if (!interfaces_.active()) return;
    interfaces_.start(system, state, omega_);
    interfaces_.set_largest(take("step", 3)[2]);
    joined_ = take("joints_and_contact", joined_.size());
}

}  // namespace gneiss
