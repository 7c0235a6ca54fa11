#include "integrators/quasi_static.hpp"

#include <fmt/format.h>
#include <kinsol/kinsol.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "base/errors.hpp"
#include "base/largest.hpp"

namespace gneiss {
namespace {

constexpr long few_iterations = 4;  // a step that needs no more is followed by one twice as long

void free_kinsol(void* memory) { KINFree(&memory); }

}  // namespace

/// Lives while KINSol() runs.
struct QuasiStatic::Problem {
    QuasiStatic& self;
    const SemiDiscrete& system;
    const State& state;
    std::size_t iteration = 0;  ///< tangents so far
    CallbackGuard guarded = {};

    static int residual(N_Vector u, N_Vector r, void* problem) {
        auto& p = *static_cast<Problem*>(problem);
        return p.guarded([&] {
            p.self.tangent_->free().put(values_of(u), p.self.next_.u);
            p.self.evaluate(p.system, p.state);
            p.self.tangent_->free().take(p.self.f_, values_of(r));
            for (double& force : values_of(r)) force = -force;
            p.self.tell({p.self.next_.t, p.iteration, largest_magnitude(values_of(r)) / p.self.largest_force_});
        });
    }
    static int jacobian(N_Vector u, N_Vector, SUNMatrix, void* problem, N_Vector, N_Vector) {
        auto& p = *static_cast<Problem*>(problem);
        return p.guarded([&] {
            p.self.tangent_->free().put(values_of(u), p.self.next_.u);
            p.self.tangent_->linearise(p.state, p.self.trial());
            ++p.self.counts_.factorisations;
            ++p.iteration;
        });
    }
};

/// Counts what is done for the tangent while it lives, however a load step ends.
struct QuasiStatic::Tally {
    const StaticTangent& tangent;
    Counts& counts;
    std::size_t iterations = tangent.iterations(), evaluations = tangent.evaluations();

    ~Tally() {
        counts.linear_iterations += tangent.iterations() - iterations;
        counts.evaluations += tangent.evaluations() - evaluations;
    }
};

const QuasiStatic::Options& QuasiStatic::checked(const Options& options) {
    std::vector<::gneiss::Problem> problems;
    options.check(problems);
    options.solver.check(problems);
    if (options.matrix_free) check_matrix_free(options.solver, problems);
    if (!problems.empty()) throw InputError(problems);
    return options;
}

QuasiStatic::QuasiStatic(const Options& options)
    : LoadStepping(checked(options), scheme_defaults::newton_iterations),
      solver_options_(options.solver),
      matrix_free_(options.matrix_free),
      contact_(options.contact),
      kinsol_(nullptr, free_kinsol) {}
QuasiStatic::~QuasiStatic() = default;

void QuasiStatic::allocate(const SemiDiscrete& system) {
    kinsol_.reset();  // before what it refers to
    indefinite_ = false;
    tangent_ = (matrix_free_ ? make_matrix_free_tangent : make_assembled_tangent)(system, solver_options_, context_);
    const std::size_t n = tangent_->n();
    right_.assign(n, 0.0);
    if (n == 0) return;  // nothing to solve for
    if (contact_) {
        constexpr double part = 1e-6;  // of the stiffest motion: a million times softer than any that something holds
        const double omega = system.frequency_bound(system.initial_state()).omega;
        tangent_->brace(part * omega * omega);
    }
    for (OwnedVector* vector : {&unknowns_, &unknown_scale_, &force_scale_}) *vector = new_vector(n, context_);

    kinsol_.reset(KINCreate(context_));
    void* kinsol = kinsol_.get();
    const auto check = [](int flag, const char* call) {
        if (flag != KIN_SUCCESS) throw std::runtime_error(fmt::format("SUNDIALS: {} answers {}", call, flag));
    };
    check(KINInit(kinsol, Problem::residual, unknowns_.get()), "KINInit");
    GNEISS_SUNDIALS_SILENCE(KIN, kinsol);
    check(KINSetLinearSolver(kinsol, tangent_->linear_solver(), tangent_->matrix()), "KINSetLinearSolver");
    check(KINSetJacFn(kinsol, Problem::jacobian), "KINSetJacFn");
    check(KINSetMaxSetupCalls(kinsol, 1), "KINSetMaxSetupCalls");  // a new tangent in every iteration
    check(KINSetNumMaxIters(kinsol, options().most_iterations), "KINSetNumMaxIters");
    check(KINSetFuncNormTol(kinsol, options().tolerance), "KINSetFuncNormTol");
    check(KINSetScaledStepTol(kinsol, 1e-14), "KINSetScaledStepTol");
    // no limit to a step: a displacement of a million edges is no solution anyway
    check(KINSetMaxNewtonStep(kinsol, 1e6 * std::sqrt(static_cast<double>(n))), "KINSetMaxNewtonStep");
    N_VConst(1 / system.smallest_length(), unknown_scale_.get());
}

double QuasiStatic::matrix_bytes() const {
    if (!tangent_) return 0;
    constexpr std::size_t vectors_of_kinsol = 8;
    return static_cast<double>(vectors_of_kinsol * tangent_->n() * sizeof(double)) + tangent_->bytes();
}

void QuasiStatic::predict(const SemiDiscrete& system, const State& state) {
    const Trial old{next_.t, next_.last_event, state.u, next_.v, {}};
    system.force(state, old, f_);
    ++counts_.evaluations;
    tangent_->linearise(state, old);
    tangent_->free().take(f_, right_);
    tangent_->subtract_fixed(change_, right_);
    ++counts_.factorisations;
    tangent_->forget();  // pivots of earlier load steps, which a resumed run has not
    try {
        tangent_->factorise();
        tangent_->solve(right_, right_);
    } catch (const SingularMatrix& error) {
        throw Exhausted(fmt::format("in the last equilibrium {}", error.what()));  // whatever the step
    }
    const std::span<double> u = values_of(unknowns_.get());
    tangent_->free().take(state.u, u);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += right_[i];
}

bool QuasiStatic::solve(const SemiDiscrete& system, const State& state) {
    const auto constraints = system.constraints();
    for (std::size_t k = 0; k < constraints.size(); ++k) next_.u[constraints[k].dof] += change_[k];
    if (tangent_->n() == 0) return true;
    const Tally tally{*tangent_, counts_};
    predict(system, state);
    if (tangent_->braced())
        warning_ = fmt::format(
            "at load time t = {:.9g} s something hangs free that contact has not reached yet: until it does nothing "
            "but what pushes it says where it goes",
            state.t);
    const double before = largest_magnitude(f_);  // supports, and loads out of balance before the step
    tangent_->free().put(values_of(unknowns_.get()), next_.u);
    evaluate(system, state);
    largest_force_ = std::max(before, largest_magnitude(f_));
    if (largest_force_ == 0) return true;
    long iterations = 0;
    for (bool better = true; better;) {
        better = iterate(system, state, iterations);
        // The prediction of a large rotation may have asked for far larger forces than there are in the end.
        evaluate(system, state);
        const double acting = std::max(before, largest_magnitude(f_));
        tangent_->free().take(f_, right_);
        better = better && largest_magnitude(right_) > options().tolerance * acting;
        if (better) largest_force_ = acting;
    }
    if (tangent_->indefinite() && !indefinite_)
        warning_ = fmt::format(
            "the tangent is indefinite at load time t = {:.9g} s: a limit or bifurcation point lies before it, and "
            "beside the equilibria found from there on there are others",
            iterations > 0 ? next_.t : state.t);
    indefinite_ = tangent_->indefinite();
    return iterations <= few_iterations;
}

bool QuasiStatic::iterate(const SemiDiscrete& system, const State& state, long& iterations) {
    N_VConst(1 / largest_force_, force_scale_.get());
    Problem problem{*this, system, state};
    KINSetUserData(kinsol_.get(), &problem);
    const int flag = KINSol(kinsol_.get(), unknowns_.get(), KIN_LINESEARCH, unknown_scale_.get(), force_scale_.get());
    KINSetUserData(kinsol_.get(), nullptr);
    problem.guarded.rethrow();
    tangent_->guard().rethrow();
    long taken = 0;
    KINGetNumNonlinSolvIters(kinsol_.get(), &taken);
    counts_.iterations += static_cast<std::size_t>(std::max(taken, 0L));
    iterations += taken;
    tangent_->free().put(values_of(unknowns_.get()), next_.u);
    if (flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK) return true;

    const std::unique_ptr<char, void (*)(void*)> name(KINGetReturnFlagName(flag), std::free);
    const bool linear_failed = flag == KIN_LSETUP_FAIL || flag == KIN_LSOLVE_FAIL;
    const bool force_failed =
        flag == KIN_SYSFUNC_FAIL || flag == KIN_FIRST_SYSFUNC_ERR || flag == KIN_REPTD_SYSFUNC_ERR;
    if (linear_failed && !tangent_->guard().failure().empty()) throw RecoverableError(tangent_->guard().failure());
    if (force_failed && !problem.guarded.failure().empty()) throw RecoverableError(problem.guarded.failure());
    // Where no step makes the forces smaller they have come to round-off: the end as well, if near the tolerance.
    evaluate(system, state);
    tangent_->free().take(f_, right_);
    const double left = largest_magnitude(right_) / largest_force_;
    constexpr double near = 10;
    if ((flag == KIN_STEP_LT_STPTOL || flag == KIN_LINESEARCH_NONCONV) && left <= near * options().tolerance)
        return false;
    throw RecoverableError(
        fmt::format("{} after {} iterations, {:.3g} of the forces out of balance{}", name.get(), iterations, left,
                    tangent_->indefinite() ? ", the tangent indefinite: near a limit or bifurcation point" : ""));
}

}  // namespace gneiss
