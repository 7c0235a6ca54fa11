#include "integrators/sundials_ode.hpp"

#include <fmt/format.h>
#include <sunnonlinsol/sunnonlinsol_newton.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/errors.hpp"
#include "integrators/mass_and_damping.hpp"
#include "integrators/prescribed_motion.hpp"
#include "system/load_pace.hpp"

namespace gneiss {

void SundialsOde::Options::check(std::vector<Problem>& problems) const {
    const auto need = [&](bool fine, const char* key, const std::string& message) {
        if (!fine) problems.push_back({std::string("integrator.") + key, message});
    };
    need(rtol > 0 && rtol <= 0.1, "rtol", fmt::format("given {}, must be in (0, 0.1]", rtol));
    need(longest >= 0 && std::isfinite(longest), "longest", fmt::format("given {} s, must be >= 0 s", longest));
    scales.check(problems);
    solver.check(problems);
}

SundialsOde::SundialsOde(const Options& options, bool needs_newton)
    : options_(options), needs_newton_(needs_newton), scales_(options.scales) {}

void SundialsOde::check(int flag, const char* call) {
    guard_.rethrow();
    if (flag < 0) throw std::runtime_error(fmt::format("SUNDIALS: {} answers {}", call, flag_name(flag)));
}

void SundialsOde::allocate(const SemiDiscrete& system) {
    destroy();
    if (newton_) counts_.add(newton_->counts());
    newton_.reset();
    form_.bind(system, omega_);
    if (needs_newton_) newton_ = std::make_unique<NewtonSystem>(system, form_, options_.solver, context_);
    y_ = new_vector(form_.size(), context_);
    middle_y_ = new_vector(form_.size(), context_);
    const Layout layout = system.layout();
    path_.reset();
    for (State* scratch : {&next_, &middle_, &on_path_}) {
        scratch->u.assign(layout.n_dof, 0.0);
        scratch->v.assign(layout.n_dof, 0.0);
        scratch->z.assign(layout.n_internal, 0.0);
        scratch->history.assign(layout.n_history, 0.0);
    }
    f_.assign(layout.n_dof, 0.0);
    z_.assign(layout.n_internal, 0.0);
    for (Reactions* reactions : {&before_, &middle_reactions_, &after_})
        reactions->forces.assign(system.constraints().size(), 0.0);
}

void SundialsOde::start(const SemiDiscrete& system, State& state, StartReason why) {
    const bool anew = why != StartReason::reinitialise;
    if (why == StartReason::fresh) {
        const FrequencyBound bound = system.frequency_bound(state);
        omega_ = bound.omega;
        doubt_ = doubt(bound);
        scales_ = ProblemScales(options_.scales);
        counts_ = {};
    }
    if (anew) allocate(system);
    form_.forget_forces();
    after_.known = start_counted_ = false;
    counts_.starts += form_.motion().hold(system, state, why);
    counts_.starts += scales_.start(system, state, omega_, form_.motion().velocity());
    begin(system, state);
    if (anew) {
        create(state.t);
    } else {
        counts_.rejected += failed_before_;
        if (newton_) newton_->forget();
        restart(state.t);
    }
    failed_before_ = 0;
}

void SundialsOde::begin(const SemiDiscrete& system, const State& state) {
    system_ = &system;
    accepted_ = &state;
    form_.motion().step_from(system, state);
    form_.pack(state, values_of(y_.get()));
}

StepReport SundialsOde::advance(const SemiDiscrete& system, State& state, double t_stop) {
    system_ = &system;
    accepted_ = &state;
    guard_.forget();
    if (newton_) newton_->guard().forget();
    form_.motion().step_from(system, state);
    const std::size_t rates_before = counts().rates;
    double dt = 0;
    if (fixed_step() > 0) {
        constexpr double round_off = 1e-9;  // a remainder of round-off is no step of its own
        const double remaining = t_stop - state.t;
        dt = remaining / std::max(1.0, std::ceil(remaining / fixed_step() - round_off));
    } else {
        t_stop = stop_that_sees_loads(system, state.t, t_stop);
    }
    const int flag = step(dt, t_stop, next_.t);
    guard_.rethrow();
    if (newton_) newton_->guard().rethrow();
    if (flag < 0) {
        const std::string& own = guard_.failure();
        const std::string why = own.empty() && newton_ ? newton_->guard().failure() : own;
        throw RecoverableError(fmt::format("{} cannot go on from t = {:.9g} s: {}{}{}", name(), state.t,
                                           flag_name(flag), why.empty() ? "" : ", ", why));
    }
    next_.last_event = state.last_event;
    finish_step(system, state);
    std::swap(state, next_);
    scales_.include(state);
    ++counts_.steps;
    StepReport report;
    report.t = state.t;
    report.dt = last_step();
    report.n_rejected = failed_trials() - failed_before_;
    failed_before_ += report.n_rejected;
    report.n_force = counts().rates - rates_before;
    report.warning = std::exchange(doubt_, {});
    return report;
}

void SundialsOde::finish_step(const SemiDiscrete& system, const State& state) {
    form_.unpack(system, next_.t, values_of(y_.get()), next_);
    std::swap(before_, after_);
    after_.known = false;
    if (next_.history.empty()) {
        take_reactions(system, next_, after_);
    } else {
        update_history(system, path_ ? *path_ : state, next_, after_);
        ++counts_.rates;  // what is remembered is the scheme's own
    }
    add_path_energies(system, state, before_, next_, after_);
    start_counted_ = true;
}

void SundialsOde::update_history(const SemiDiscrete& system, const State& from, State& to, Reactions& reactions) {
    system.force_and_update(from, {to.t, to.last_event, to.u, to.v, {}}, f_, z_, to.history);
    form_.motion().reactions(system, to.v, f_, reactions.forces);
    reactions.known = true;
}

void SundialsOde::take_reactions(const SemiDiscrete& system, const State& at, Reactions& reactions) {
    const auto forces = form_.forces_at(at.t, values_of(y_.get()));
    reactions.known = system.constraints().empty() || !forces.empty();
    if (forces.empty()) return;
    form_.motion().evaluate(system, at.t);
    form_.motion().reactions(system, at.v, forces, reactions.forces);
}

void SundialsOde::find_reactions(const SemiDiscrete& system, const State& accepted, const State& at,
                                 Reactions& reactions) {
    if (!reactions.known) {
        system.force(accepted, FirstOrderForm::trial_of(at, at.last_event), f_);
        ++counts_.balance;
        form_.motion().evaluate(system, at.t);
        form_.motion().reactions(system, at.v, f_, reactions.forces);
    }
    reactions.known = true;
}

std::span<const double> SundialsOde::reactions(const SemiDiscrete& system, const State& state) {
    if (!after_.known) take_reactions(system, state, after_);
    find_reactions(system, state, state, after_);
    return after_.forces;
}

void SundialsOde::find_within(const SemiDiscrete& system, double t, State& at) {
    in_dense_output_ = true;
    const int flag = dense(t, middle_y_.get());
    in_dense_output_ = false;
    check(flag, "dense output");
    form_.unpack(system, t, values_of(middle_y_.get()), at);
}

void SundialsOde::state_within(const SemiDiscrete& system, double t, State& at, std::vector<double>& reactions) {
    const State& from = next_;  // where the last step began
    const State* const accepted = std::exchange(accepted_, &from);
    at = from;
    find_within(system, t, at);
    Reactions there{std::move(reactions)};
    there.forces.resize(after_.forces.size());
    if (at.history.empty()) {
        there.known = system.constraints().empty();
        find_reactions(system, from, at, there);
    } else {
        update_history(system, from, at, there);
        ++counts_.balance;
    }
    add_path_energies(system, from, before_, at, there);
    reactions = std::move(there.forces);
    accepted_ = accepted;
}

/// The trapezoidal rule over the step and over its halves, extrapolated: order 4, so that the ledger does not hide what
/// a scheme of high order conserves. Supports that rest do no work: reactions matter only where they move.
void SundialsOde::add_path_energies(const SemiDiscrete& system, const State& from, Reactions& before, State& to,
                                    Reactions& after) {
    middle_.t = 0.5 * (from.t + to.t);
    middle_.last_event = to.last_event;
    middle_.history = from.history;
    find_within(system, middle_.t, middle_);
    middle_reactions_.known = false;
    const bool supports_move = std::ranges::any_of(system.constraints(), [&](const Constraint& support) {
        return middle_.u[support.dof] != from.u[support.dof] || to.u[support.dof] != from.u[support.dof];
    });
    if (supports_move) {
        find_reactions(system, from, from, before);
        find_reactions(system, from, middle_, middle_reactions_);
        if (!after.known) take_reactions(system, to, after);
        find_reactions(system, from, to, after);
    }
    system.add_path_energies(from, to);
    add_support_work(system, before.forces, after.forces, from, to);
    PathEnergies whole = to.path;

    system.add_path_energies(from, middle_);
    add_support_work(system, before.forces, middle_reactions_.forces, from, middle_);
    system.add_path_energies(middle_, to);
    add_support_work(system, middle_reactions_.forces, after.forces, middle_, to);
    const double power = to.path.viscous_power;
    const auto halves = to.path.members(), once = whole.members();
    for (std::size_t k = 0; k < halves.size(); ++k) *halves[k] += (*halves[k] - *once[k]) / 3;
    to.path.viscous_power = power;
}

double SundialsOde::kinetic_energy(const SemiDiscrete& system, const State& state) const {
    return synchronised_kinetic_energy(system, state.v, partial_);
}

IntegratorMemory SundialsOde::save() const { return {{"omega", {omega_}}, {"scales", scales_.save()}}; }

void SundialsOde::load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) {
    scales_.load(system, remembered(memory, name(), "scales", 3));
    omega_ = remembered(memory, name(), "omega", 1)[0];
    start(system, state, StartReason::resize);
}

void SundialsOde::forget(const SemiDiscrete& system, State& state) { start(system, state, StartReason::reinitialise); }

SundialsOde::Counts SundialsOde::counts() const {
    Counts counts = counts_;
    counts.rejected += failed_before_;
    if (newton_) counts.add(newton_->counts());
    return counts;
}

WorkCounts SundialsOde::work() const {
    const Counts all = counts();
    return {.jacobians = all.linearisations,
            .factorisations = all.factorisations,
            .iterations = all.solves,
            .interactions = all.interaction_rates,
            .balance = all.balance,
            .starts = all.starts};
}

bool SundialsOde::of_dense_output_alone(double t) const {
    constexpr double round_off = 1e-9;  // of a step: the solver's time, or that of the stop that it was to reach
    return in_dense_output_ && std::abs(t - next_.t) > round_off * std::abs(next_.t - accepted_->t);
}

void SundialsOde::count(double t, std::span<const double> y, FirstOrderForm::Part part) {
    using Part = FirstOrderForm::Part;
    if (part == Part::external) return;
    if (part == Part::interactions) {
        ++counts_.interaction_rates;
        return;
    }
    if (of_dense_output_alone(t)) {
        ++counts_.balance;
        return;
    }
    // not y(), in which SUNDIALS works while a step is under way
    const bool at_start = !start_counted_ && t == accepted_->t && form_.is_packed(*accepted_, y);
    start_counted_ = start_counted_ || at_start;
    ++(at_start ? counts_.starts : counts_.rates);
}

int SundialsOde::rate(double t, N_Vector y, FirstOrderForm::Part part, N_Vector dydt) {
    return guard_([&] {
        if (form_.repeat(*accepted_, t, values_of(y), part, values_of(dydt))) return;
        count(t, values_of(y), part);
        const State& from = path_ && part == FirstOrderForm::Part::interactions ? *path_ : *accepted_;
        form_.rate(*system_, from, t, values_of(y), part, values_of(dydt), !of_dense_output_alone(t));
    });
}

void SundialsOde::begin_path() {
    if (!accepted_->history.empty()) path_ = *accepted_;
}

int SundialsOde::follow_interactions(double t, N_Vector y) {
    return guard_([&] {
        if (!path_) return;
        form_.unpack(*system_, t, values_of(y), on_path_);
        system_->interaction_force(*path_, FirstOrderForm::trial_of(on_path_, path_->last_event), f_, on_path_.history);
        ++counts_.interaction_rates;
        std::swap(path_->history, on_path_.history);
    });
}

int SundialsOde::linear_system(double t, N_Vector y, bool reuse, double gamma, double right_scale) {
    return guard_([&] {
        if (!reuse) newton_->linearise(*accepted_, t, values_of(y));
        newton_->set(gamma, right_scale);
    });
}

OwnedNonlinearSolver SundialsOde::new_newton_iteration() {
    OwnedNonlinearSolver solver(SUNNonlinSol_Newton(y(), context_));
    if (!solver) throw std::bad_alloc();
    return solver;
}

void SundialsOde::trust_no_earlier_rate(SUNNonlinearSolver solver) {
    // Hairer and Wanner, Solving Ordinary Differential Equations II (1996), IV.8: what is left after a correction is at
    // most rate/(1 - rate) of it
    const auto test = [](SUNNonlinearSolver nonlinear, N_Vector, N_Vector correction, sunrealtype tolerance,
                         N_Vector weights, void* self) {
        double& before = static_cast<SundialsOde*>(self)->correction_before_;
        const double now = N_VWrmsNorm(correction, weights);
        int iteration = 0;
        SUNNonlinSolGetCurIter(nonlinear, &iteration);
        const double rate = iteration == 0 ? 0.5 : now / before;
        before = now;
        if (now == 0 || (rate < 1 && rate / (1 - rate) * now <= tolerance)) return 0;
        constexpr double diverging = 2;  // as in CVODE
        return rate > diverging ? SUN_NLS_CONV_RECVR : SUN_NLS_CONTINUE;
    };
    check(SUNNonlinSolSetConvTestFn(solver, test, this), "SUNNonlinSolSetConvTestFn");
}

int SundialsOde::error_weights(N_Vector weights) const {
    const std::span<double> w = values_of(weights);
    const std::size_t n = form_.n_free();
    std::fill_n(w.begin(), n, 1 / (options_.rtol * scales_.displacement()));
    std::fill_n(w.begin() + static_cast<std::ptrdiff_t>(n), n, 1 / (options_.rtol * scales_.velocity()));
    constexpr double counted_only = 1e-30;  // no error of theirs matters; zero would be divided by
    const auto internal = scales_.internal_weights();
    for (std::size_t k = 0; k < form_.n_internal(); ++k)
        w[2 * n + k] = internal[k] > 0 ? internal[k] / (options_.rtol * scales_.internal()) : counted_only;
    return 0;
}

}  // namespace gneiss
