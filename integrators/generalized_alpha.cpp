#include "integrators/generalized_alpha.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/largest.hpp"
#include "base/parallel.hpp"
#include "integrators/free_part.hpp"
#include "integrators/mass_and_damping.hpp"

namespace gneiss {
namespace {

constexpr double shortest_part = 1e-6;  ///< of the step wanted, at which a run gives up
/// The matrix at hand is kept as long as an iteration leaves no more than this of the forces out of balance.
constexpr double progress = 0.1;

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
    solver.check(problems);
    need(longest >= 0 && std::isfinite(longest), "longest", fmt::format("given {} s, must be >= 0 s", longest));
    need(tolerance > 0 && tolerance <= 0.01, "tolerance", fmt::format("given {}, must be in (0, 0.01]", tolerance));
    need(most_iterations >= 1, "most_iterations", fmt::format("given {}, must be >= 1", most_iterations));
    if (!problems.empty()) throw InputError(problems);
}

GeneralizedAlpha::GeneralizedAlpha(const Options& options) : options_(options), scales_(options.scales) {
    options_.validate();
}

void GeneralizedAlpha::allocate(const SemiDiscrete& system) {
    const Tangent& tangent = tangent_of(system, options_.name);
    const Layout layout = system.layout();
    for (State* scratch : {&next_, &stage_}) {
        scratch->u.assign(layout.n_dof, 0.0);
        scratch->v.assign(layout.n_dof, 0.0);
    }
    next_.z.assign(layout.n_internal, 0.0);
    next_.history.assign(layout.n_history, 0.0);
    for (auto* values : {&a_, &a_next_, &f_, &residual_}) values->assign(layout.n_dof, 0.0);
    reactions_.assign(system.constraints().size(), 0.0);
    free_ = std::make_unique<FreeMatrix>(free_part(system, tangent));
    full_values_.assign(tangent.n_nonzero(), 0.0);
    values_.assign(free_->pattern().n_nonzero(), 0.0);
    change_.assign(free_->n(), 0.0);
    solver_ = std::make_unique<BorderedSolver>(make_linear_solver(options_.solver, tangent.symmetric()));
    if (free_->n() > 0) solver_->analyse(free_->pattern());
    motion_.bind(system, omega_);
}

void GeneralizedAlpha::start(const SemiDiscrete& system, State& state, StartReason why) {
    if (why == StartReason::fresh) {
        omega_ = system.frequency_bound(state).omega;
        dt_ = 0;
        scales_ = ProblemScales(options_.scales);
    }
    if (why != StartReason::reinitialise) allocate(system);
    forget(system, state);
    motion_.hold(system, state, why);
    scales_.start(system, state, omega_, motion_.velocity());
    if (dt_ == 0) {
        dt_ = options_.dt > 0 ? options_.dt : 1 / omega_;
        if (options_.rtol > 0 && options_.longest > 0) dt_ = std::min(dt_, options_.longest);
    }
    system.force(state, Trial::of(state), f_);
    ++counts_.evaluations;
    motion_.reactions(system, state.v, f_, reactions_);
    subtract_damping(system, state.v, f_);
    const auto mass = system.lumped_mass();
    for (std::size_t i = 0; i < a_.size(); ++i) a_[i] = f_[i] / mass[i];
    const auto constraints = system.constraints();
    const auto supports = motion_.acceleration(system);
    for (std::size_t k = 0; k < constraints.size(); ++k) a_[constraints[k].dof] = supports[k];
}

StepReport GeneralizedAlpha::advance(const SemiDiscrete& system, State& state, double t_stop) {
    const bool adaptive = options_.rtol > 0;
    const double remaining = t_stop - state.t, wanted = adaptive ? dt_ : options_.dt;
    motion_.step_from(system, state);
    StepReport report;
    const std::size_t evaluations_before = counts_.evaluations;
    double limit = wanted;
    for (;; ++report.n_rejected) {
        constexpr double round_off = 1e-9;  // a remainder of round-off is no step of its own
        const double dt = remaining / std::max(1.0, std::ceil(remaining / limit - round_off));
        next_.t = dt == remaining ? t_stop : state.t + dt;
        next_.last_event = stage_.last_event = state.last_event;
        report.dt = dt;
        std::string why = "the error is too large";
        try {
            solve(system, state, dt);
            const double e = adaptive ? error(dt) : 0;
            if (e <= 1) {
                finish_step(system, state);
                if (adaptive) choose_next_step(dt, limit, e);
                break;
            }
            limit = dt * std::max(0.2, 0.9 * std::cbrt(1 / e));
        } catch (const RecoverableError& failure) {
            factorised_dt_ = 0;
            limit = dt / 2;
            why = failure.what();
        }
        if (limit < shortest_part * wanted)
            throw RecoverableError(fmt::format("{} cannot go on from t = {:.9g} s, with steps down to {:.3g} s: {}",
                                               options_.name, state.t, dt, why));
    }
    std::swap(state, next_);
    a_.swap(a_next_);
    scales_.include(state);
    report.t = state.t;
    report.n_force = counts_.evaluations - evaluations_before;
    return report;
}

void GeneralizedAlpha::choose_next_step(double dt, double limit, double error) {
    const double best = 0.9 * dt * std::cbrt(1 / std::max(error, 1e-9));
    // a longer step asks for a new matrix: worth it for a fifth
    dt_ = best > 1.2 * limit ? std::min(best, 2 * limit) : std::min(best, limit);
    if (options_.longest > 0) dt_ = std::min(dt_, options_.longest);
}

double GeneralizedAlpha::error(double dt) const {
    const double factor = dt * dt * options_.scheme.error_constant();
    const auto free = free_->free();
    const double sum = ordered_sum(free.size(), partial_, [&](std::size_t first, std::size_t last) {
        double part = 0;
        for (std::size_t i = first; i < last; ++i) {
            const double e = factor * (a_next_[free[i]] - a_[free[i]]);
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
    const auto free = free_->free();
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

double GeneralizedAlpha::evaluate_stage(const SemiDiscrete& system, const State& state) {
    system.force(state, {stage_.t, stage_.last_event, stage_.u, stage_.v, {}}, f_);
    ++counts_.evaluations;
    subtract_damping(system, stage_.v, f_);
    const auto mass = system.lumped_mass();
    const double alpha_m = options_.scheme.alpha_m;
    double largest = largest_magnitude(f_);
    for (const std::size_t dof : free_->free()) {
        const double inertia = mass[dof] * ((1 - alpha_m) * a_next_[dof] + alpha_m * a_[dof]);
        largest = std::max(largest, std::abs(inertia));
        residual_[dof] = inertia - f_[dof];
    }
    return largest;
}

void GeneralizedAlpha::factorise(const SemiDiscrete& system, const State& state, double dt) {
    const auto [alpha_m, alpha_f, beta, gamma] = options_.scheme;
    const double velocity = (1 - alpha_f) * gamma * dt;
    const Trial stage{stage_.t, stage_.last_event, stage_.u, stage_.v, {}};
    const Tangent::Factors factors{
        .mass = 1 - alpha_m, .damping = velocity, .stiffness = (1 - alpha_f) * beta * dt * dt, .velocity = velocity};
    system.tangent()->assemble(state, stage, factors, full_values_);
    free_->take_values(full_values_, values_);
    solver_->factorise(values_, free_->take(system.tangent()->beside(state, stage, factors)));
    factorised_dt_ = dt;
    ++counts_.factorisations;
}

void GeneralizedAlpha::solve(const SemiDiscrete& system, const State& state, double dt) {
    predict(system, state, dt);
    if (free_->n() == 0) return;
    const double beta = options_.scheme.beta;
    double before = 0;
    for (int iteration = 0;; ++iteration) {
        const double largest = evaluate_stage(system, state);
        free_->take(residual_, change_);
        const double left = largest_magnitude(change_);
        if (!std::isfinite(left)) throw RecoverableError("the forces are not finite");
        if (left <= options_.tolerance * largest) return;
        if (iteration == options_.most_iterations)
            throw RecoverableError(
                fmt::format("{} iterations of Newton's method leave {:.3g} of the forces out of balance", iteration,
                            left / largest));
        // steps that share an interval evenly differ by round-off
        constexpr double same = 1e-9;
        const bool stalled = iteration > 0 && left > progress * before;
        if (std::abs(factorised_dt_ - dt) > same * dt || stalled) factorise(system, state, dt);
        before = left;
        solver_->solve(change_, change_);
        // round-off: what is left moves no digit of the step
        constexpr double eps = 1e-14;
        double moved = 0, step = 0;
        const auto free = free_->free();
        for (std::size_t i = 0; i < free.size(); ++i) {
            a_next_[free[i]] -= change_[i];
            moved = std::max(moved, std::abs(beta * dt * dt * change_[i]));
            step = std::max({step, std::abs(next_.u[free[i]] - state.u[free[i]]), dt * std::abs(next_.v[free[i]])});
        }
        place(state, dt);
        if (moved <= eps * step) return;
    }
}

void GeneralizedAlpha::finish_step(const SemiDiscrete& system, const State& state) {
    system.force_and_update(state, {next_.t, next_.last_event, next_.u, next_.v, {}}, f_, next_.z, next_.history);
    ++counts_.evaluations;
    system.add_path_energies(state, next_);
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

double GeneralizedAlpha::matrix_bytes() const {
    return static_cast<double>((full_values_.size() + values_.size()) * sizeof(double) + free_->bytes()) +
           (free_->n() > 0 ? solver_->expected_factor_bytes() : 0.0);
}

IntegratorMemory GeneralizedAlpha::save() const {
    return {{"acceleration", a_}, {"reactions", reactions_}, {"scales", scales_.save()}, {"step", {dt_, omega_}}};
}

void GeneralizedAlpha::forget(const SemiDiscrete&, State&) {
    solver_->forget();
    factorised_dt_ = 0;
}

void GeneralizedAlpha::load(const SemiDiscrete& system, State&, const IntegratorMemory& memory) {
    const auto take = [&](const char* entry, std::size_t size) -> const std::vector<double>& {
        return remembered(memory, name(), entry, size);
    };
    dt_ = take("step", 2)[0];
    omega_ = take("step", 2)[1];
    scales_.load(system, take("scales", 3));
    allocate(system);
    a_ = take("acceleration", a_.size());
    reactions_ = take("reactions", reactions_.size());
}

}  // namespace gneiss
