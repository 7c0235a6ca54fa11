#include "integrators/quasi_static.hpp"

#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <stdexcept>

#include "base/errors.hpp"

namespace gneiss {
namespace {

constexpr std::size_t few_iterations = 4;  // a step that needs no more is followed by one twice as long

void free_kinsol(void* memory) { KINFree(&memory); }

}  // namespace

/// Lives while KINSol() runs.
struct QuasiStatic::Problem {
    QuasiStatic& self;
    const SemiDiscrete& system;
    const State& state;
    std::string failure = {};               ///< of the last evaluation that failed
    std::exception_ptr unrecoverable = {};  ///< what no other step would cure

    Trial trial() const { return {self.next_.t, self.next_.last_event, self.next_.u, self.next_.v, {}}; }

    /// What SUNDIALS is to know of an exception: 1, try again elsewhere; -1, give up.
    template <class Body>
    int guarded(Body body) {
        try {
            body();
            return 0;
        } catch (const RecoverableError& error) {
            failure = error.what();
            return 1;
        } catch (...) {
            unrecoverable = std::current_exception();
            return -1;
        }
    }

    static int residual(N_Vector u, N_Vector r, void* problem) {
        auto& p = *static_cast<Problem*>(problem);
        return p.guarded([&] {
            p.self.free_->put(values_of(u), p.self.next_.u);
            p.system.force(p.state, p.trial(), p.self.f_);
            ++p.self.counts_.evaluations;
            p.self.free_->take(p.self.f_, values_of(r));
            for (double& force : values_of(r)) force = -force;
        });
    }
    static int jacobian(N_Vector u, N_Vector, SUNMatrix, void* problem, N_Vector, N_Vector) {
        auto& p = *static_cast<Problem*>(problem);
        return p.guarded([&] {
            p.self.free_->put(values_of(u), p.self.next_.u);
            p.system.tangent()->assemble(p.state, p.trial(), {.stiffness = 1}, p.self.values_);
            p.self.free_->take_values(p.self.values_, p.self.matrix_->values());
            ++p.self.counts_.factorisations;
        });
    }
};

void QuasiStatic::Options::validate() const {
    std::vector<gneiss::Problem> problems;
    const auto need = [&](bool fine, const char* key, const std::string& message) {
        if (!fine) problems.push_back({std::string("integrator.") + key, message});
    };
    need(tolerance > 0 && tolerance <= 0.01, "tolerance", fmt::format("given {}, must be in (0, 0.01]", tolerance));
    need(step >= 0 && std::isfinite(step), "step", fmt::format("given {} s, must be >= 0 s", step));
    need(longest >= 0 && std::isfinite(longest), "longest", fmt::format("given {} s, must be >= 0 s", longest));
    need(shortest > 0 && shortest < 1, "shortest", fmt::format("given {}, must be in (0, 1)", shortest));
    need(most_iterations >= 1, "most_iterations", fmt::format("given {}, must be >= 1", most_iterations));
    if (!problems.empty()) throw InputError(problems);
}

QuasiStatic::QuasiStatic(const Options& options) : options_(options), kinsol_(nullptr, free_kinsol) {
    options_.validate();
}
QuasiStatic::~QuasiStatic() = default;

void QuasiStatic::allocate(const SemiDiscrete& system) {
    const Tangent* tangent = system.tangent();
    if (tangent == nullptr) throw InputError("integrator", "quasi_static needs tangents, and this system has none");
    kinsol_.reset();  // before what it refers to
    const Layout layout = system.layout();
    next_.u.assign(layout.n_dof, 0.0);
    next_.v.assign(layout.n_dof, 0.0);
    next_.z.assign(layout.n_internal, 0.0);
    next_.history.assign(layout.n_history, 0.0);
    f_.assign(layout.n_dof, 0.0);
    std::vector<std::size_t> fixed;
    for (const Constraint& constraint : system.constraints()) fixed.push_back(constraint.dof);
    for (auto* values : {&prescribed_, &change_, &reactions_}) values->assign(fixed.size(), 0.0);

    const MatrixPattern pattern = tangent->pattern();
    values_.assign(tangent->n_nonzero(), 0.0);
    free_ = std::make_unique<FreeMatrix>(SparsePattern{pattern.row_starts, pattern.columns}, fixed);
    right_.assign(free_->n(), 0.0);
    if (free_->n() == 0) return;  // nothing to solve for
    solver_ = make_linear_solver(options_.solver, tangent->symmetric());
    solver_->analyse(free_->pattern());
    matrix_ = std::make_unique<SundialsMatrix>(free_->pattern(), values_, context_);  // the free ones in front
    linear_ = std::make_unique<SundialsSolver>(*solver_, *matrix_, context_);
    for (OwnedVector* vector : {&unknowns_, &unknown_scale_, &force_scale_}) *vector = new_vector(free_->n(), context_);

    kinsol_.reset(KINCreate(context_));
    void* kinsol = kinsol_.get();
    const auto check = [](int flag, const char* call) {
        if (flag != KIN_SUCCESS) throw std::runtime_error(fmt::format("SUNDIALS: {} answers {}", call, flag));
    };
    check(KINInit(kinsol, Problem::residual, unknowns_.get()), "KINInit");
    KINSetErrFile(kinsol, nullptr);  // what went wrong is told by return values
    check(KINSetLinearSolver(kinsol, linear_->get(), matrix_->get()), "KINSetLinearSolver");
    check(KINSetJacFn(kinsol, Problem::jacobian), "KINSetJacFn");
    check(KINSetMaxSetupCalls(kinsol, 1), "KINSetMaxSetupCalls");  // a new tangent in every iteration
    check(KINSetNumMaxIters(kinsol, options_.most_iterations), "KINSetNumMaxIters");
    check(KINSetFuncNormTol(kinsol, options_.tolerance), "KINSetFuncNormTol");
    check(KINSetScaledStepTol(kinsol, 1e-14), "KINSetScaledStepTol");
    // no limit to a step: a displacement of a million edges is no solution anyway
    check(KINSetMaxNewtonStep(kinsol, 1e6 * std::sqrt(static_cast<double>(free_->n()))), "KINSetMaxNewtonStep");
    N_VConst(1 / system.smallest_length(), unknown_scale_.get());
}

void QuasiStatic::start(const SemiDiscrete& system, State& state, StartReason why) {
    if (why != StartReason::reinitialise) allocate(system);
    if (why == StartReason::fresh) dt_ = options_.step, first_dt_ = 0;
    std::ranges::fill(state.v, 0.0);
    system.force(state, Trial::of(state), f_);
    for (std::size_t k = 0; k < reactions_.size(); ++k) reactions_[k] = -f_[system.constraints()[k].dof];
}

StepReport QuasiStatic::advance(const SemiDiscrete& system, State& state, double t_stop) {
    const double remaining = t_stop - state.t;
    if (dt_ == 0) dt_ = remaining;
    if (options_.longest > 0) dt_ = std::min(dt_, options_.longest);
    if (first_dt_ == 0) first_dt_ = dt_;
    StepReport report;
    next_.last_event = state.last_event;
    const std::size_t iterations_before = counts_.iterations, evaluations_before = counts_.evaluations;
    for (;; ++report.n_rejected) {
        constexpr double round_off = 1e-9;
        report.dt = remaining / std::max(1.0, std::ceil(remaining / dt_ - round_off));
        next_.t = report.dt == remaining ? t_stop : state.t + report.dt;
        try {
            solve(system, state);
            break;
        } catch (const RecoverableError& error) {
            dt_ = report.dt / 2;
            if (dt_ < options_.shortest * first_dt_)
                throw RecoverableError(
                    fmt::format("no equilibrium found after load time t = {:.9g} s, with load steps "
                                "down to {:.3g} s: {}",
                                state.t, report.dt, error.what()));
        }
    }
    if (counts_.iterations - iterations_before <= few_iterations)
        dt_ = std::max(dt_, 2 * report.dt);  // a remainder before a stop may be short

    ++counts_.evaluations;
    system.force_and_update(state, {next_.t, next_.last_event, next_.u, next_.v, {}}, f_, next_.z, next_.history);
    system.add_path_energies(state, next_);
    for (std::size_t k = 0; k < reactions_.size(); ++k) {
        const std::size_t dof = system.constraints()[k].dof;
        next_.path.support_work += 0.5 * (reactions_[k] - f_[dof]) * (next_.u[dof] - state.u[dof]);
        reactions_[k] = -f_[dof];
    }
    std::swap(state, next_);
    report.t = state.t;
    report.n_force = counts_.evaluations - evaluations_before;
    return report;
}

void QuasiStatic::set_prescribed(const SemiDiscrete& system, const State& state) {
    const auto constraints = system.constraints();
    const double dt = next_.t - state.t;
    std::ranges::copy(state.u, next_.u.begin());
    system.constraint_values(next_.t, next_.last_event, prescribed_);
    system.constraint_values(state.t + 0.5 * dt, next_.last_event, change_);
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        change_[k] =
            constraints[k].kind == Constraint::Kind::velocity ? dt * change_[k] : prescribed_[k] - state.u[dof];
        next_.u[dof] += change_[k];
    }
}

void QuasiStatic::predict(const SemiDiscrete& system, const State& state) {
    const Trial old{next_.t, next_.last_event, state.u, next_.v, {}};
    system.force(state, old, f_);
    ++counts_.evaluations;
    system.tangent()->assemble(state, old, {.stiffness = 1}, values_);
    free_->take(f_, right_);
    free_->subtract_fixed(values_, change_, right_);
    free_->take_values(values_, matrix_->values());
    ++counts_.factorisations;
    solver_->factorise(matrix_->values());
    solver_->solve(right_, right_);
    const std::span<double> u = values_of(unknowns_.get());
    free_->take(state.u, u);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += right_[i];
}

void QuasiStatic::solve(const SemiDiscrete& system, const State& state) {
    set_prescribed(system, state);
    if (free_->n() == 0) return;
    predict(system, state);
    const auto largest_of = [](const std::vector<double>& forces) {
        double largest = 0;
        for (const double force : forces) largest = std::max(largest, std::abs(force));
        return largest;
    };
    double largest = largest_of(f_);  // supports, and loads out of balance before the step
    Problem problem{*this, system, state};
    free_->put(values_of(unknowns_.get()), next_.u);
    system.force(state, problem.trial(), f_);
    ++counts_.evaluations;
    largest = std::max(largest, largest_of(f_));
    if (largest == 0) return;
    N_VConst(1 / largest, force_scale_.get());

    KINSetUserData(kinsol_.get(), &problem);
    const int flag = KINSol(kinsol_.get(), unknowns_.get(), KIN_LINESEARCH, unknown_scale_.get(), force_scale_.get());
    KINSetUserData(kinsol_.get(), nullptr);
    if (problem.unrecoverable) std::rethrow_exception(problem.unrecoverable);
    linear_->rethrow_unrecoverable();
    long iterations = 0;
    KINGetNumNonlinSolvIters(kinsol_.get(), &iterations);
    counts_.iterations += static_cast<std::size_t>(std::max(iterations, 0L));
    free_->put(values_of(unknowns_.get()), next_.u);
    if (flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK) return;

    const std::unique_ptr<char, void (*)(void*)> name(KINGetReturnFlagName(flag), std::free);
    const bool linear_failed = flag == KIN_LSETUP_FAIL || flag == KIN_LSOLVE_FAIL;
    const bool force_failed =
        flag == KIN_SYSFUNC_FAIL || flag == KIN_FIRST_SYSFUNC_ERR || flag == KIN_REPTD_SYSFUNC_ERR;
    if (linear_failed && !linear_->failure().empty()) throw RecoverableError(linear_->failure());
    if (force_failed && !problem.failure.empty()) throw RecoverableError(problem.failure);
    // Where no step makes the forces smaller they have come to round-off: the end as well, if near the tolerance.
    system.force(state, problem.trial(), f_);
    ++counts_.evaluations;
    free_->take(f_, right_);
    const double left = largest_of(right_) / largest;
    constexpr double near = 10;
    if ((flag == KIN_STEP_LT_STPTOL || flag == KIN_LINESEARCH_NONCONV) && left <= near * options_.tolerance) return;
    throw RecoverableError(
        fmt::format("{} after {} iterations, {:.3g} of the forces out of balance", name.get(), iterations, left));
}

IntegratorMemory QuasiStatic::save() const { return {{"reactions", reactions_}, {"step", {dt_, first_dt_}}}; }

void QuasiStatic::load(const SemiDiscrete& system, State&, const IntegratorMemory& memory) {
    allocate(system);
    const auto take = [&](const char* entry, std::size_t size) -> const std::vector<double>& {
        return remembered(memory, name(), entry, size);
    };
    reactions_ = take("reactions", reactions_.size());
    dt_ = take("step", 2)[0];
    first_dt_ = take("step", 2)[1];
}

}  // namespace gneiss
