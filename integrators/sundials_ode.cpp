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
    for (State* scratch : {&next_, &middle_}) {
        scratch->u.assign(layout.n_dof, 0.0);
        scratch->v.assign(layout.n_dof, 0.0);
        scratch->z.assign(layout.n_internal, 0.0);
        scratch->history.assign(layout.n_history, 0.0);
    }
    f_.assign(layout.n_dof, 0.0);
    z_.assign(layout.n_internal, 0.0);
    for (auto* values : {&reactions_before_, &reactions_middle_, &reactions_})
        values->assign(system.constraints().size(), 0.0);
}

void SundialsOde::start(const SemiDiscrete& system, State& state, StartReason why) {
    const bool anew = why != StartReason::reinitialise;
    if (why == StartReason::fresh) {
        omega_ = system.frequency_bound(state).omega;
        scales_ = ProblemScales(options_.scales);
        counts_ = {};
    }
    if (anew) allocate(system);
    form_.motion().hold(system, state, why);
    scales_.start(system, state, omega_, form_.motion().velocity());
    begin(system, state);
    if (anew) {
        create(state.t);
    } else {
        counts_.rejected += failed_before_;
        if (newton_) newton_->forget();
        restart(state.t);
    }
    failed_before_ = 0;
    system.force(state, FirstOrderForm::trial_of(state, state.last_event), f_);
    form_.motion().evaluate(system, state.t);
    form_.motion().reactions(system, state.v, f_, reactions_);
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
    const std::size_t rates_before = counts_.rates;
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
    report.n_force = counts_.rates - rates_before;
    return report;
}

void SundialsOde::finish_step(const SemiDiscrete& system, const State& state) {
    form_.unpack(system, next_.t, values_of(y_.get()), next_);
    reactions_before_.swap(reactions_);
    evaluate(system, state, next_, reactions_);
    add_path_energies(system, state, reactions_before_, next_, reactions_);
}

void SundialsOde::evaluate(const SemiDiscrete& system, const State& from, State& to, std::vector<double>& reactions) {
    if (to.history.empty())
        system.force(from, FirstOrderForm::trial_of(to, to.last_event), f_);
    else
        system.force_and_update(from, {to.t, to.last_event, to.u, to.v, {}}, f_, z_, to.history);
    ++counts_.rates;
    form_.motion().reactions(system, to.v, f_, reactions);
}

void SundialsOde::state_within(const SemiDiscrete& system, double t, State& at, std::vector<double>& reactions) {
    const State& from = next_;  // where the last step began
    const State* const accepted = std::exchange(accepted_, &from);
    const Counts counts = counts_;  // what output evaluates is no work of the scheme
    at = from;
    at.t = t;
    check(dense(t, middle_y_.get()), "dense output");
    form_.unpack(system, t, values_of(middle_y_.get()), at);
    reactions.resize(reactions_.size());
    evaluate(system, from, at, reactions);
    add_path_energies(system, from, reactions_before_, at, reactions);
    counts_ = counts;
    accepted_ = accepted;
}

/// The trapezoidal rule over the step and over its halves, extrapolated: order 4, so that the ledger does not hide what
/// a scheme of high order conserves.
void SundialsOde::add_path_energies(const SemiDiscrete& system, const State& from, std::span<const double> before,
                                    State& to, std::span<const double> after) {
    system.add_path_energies(from, to);
    add_support_work(system, before, after, from, to);
    PathEnergies whole = to.path;

    middle_.t = 0.5 * (from.t + to.t);
    middle_.last_event = to.last_event;
    check(dense(middle_.t, middle_y_.get()), "dense output");
    form_.unpack(system, middle_.t, values_of(middle_y_.get()), middle_);
    middle_.history = from.history;
    system.add_path_energies(from, middle_);
    if (!system.constraints().empty()) {
        system.force(from, FirstOrderForm::trial_of(middle_, middle_.last_event), f_);
        ++counts_.rates;
        form_.motion().reactions(system, middle_.v, f_, reactions_middle_);
        add_support_work(system, before, reactions_middle_, from, middle_);
    }
    system.add_path_energies(middle_, to);
    add_support_work(system, reactions_middle_, after, middle_, to);
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

int SundialsOde::rate(double t, N_Vector y, FirstOrderForm::Part part, N_Vector dydt) {
    return guard_([&] {
        ++(part == FirstOrderForm::Part::interactions ? counts_.interaction_rates : counts_.rates);
        form_.rate(*system_, *accepted_, t, values_of(y), part, values_of(dydt));
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
    const auto test = [](SUNNonlinearSolver nonlinear, N_Vector, N_Vector correction, realtype tolerance,
                         N_Vector weights, void* self) {
        double& before = static_cast<SundialsOde*>(self)->correction_before_;
        const double now = N_VWrmsNorm(correction, weights);
        int iteration = 0;
        SUNNonlinSolGetCurIter(nonlinear, &iteration);
        const double rate = iteration == 0 ? 0.5 : now / before;
        before = now;
        if (now == 0 || (rate < 1 && rate / (1 - rate) * now <= tolerance)) return SUN_NLS_SUCCESS;
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
