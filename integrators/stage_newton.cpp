#include "integrators/stage_newton.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/largest.hpp"
#include "integrators/free_part.hpp"
#include "integrators/mass_and_damping.hpp"

namespace gneiss {
namespace {

/// The matrix at hand is kept as long as an iteration leaves no more than this of the forces out of balance.
constexpr double progress = 0.1;

}  // namespace

void StageNewton::Options::check(std::vector<Problem>& problems) const {
    if (!(tolerance > 0 && tolerance <= 0.01))
        problems.push_back({"integrator.tolerance", fmt::format("given {}, must be in (0, 0.01]", tolerance)});
    if (!(most_iterations >= 1))
        problems.push_back({"integrator.most_iterations", fmt::format("given {}, must be >= 1", most_iterations)});
    solver.check(problems);
}

void StageNewton::bind(const SemiDiscrete& system) {
    const Tangent& tangent = tangent_of(system, name_);
    const std::size_t n_dof = system.layout().n_dof;
    free_ = std::make_unique<FreeMatrix>(free_part(system, tangent));
    for (auto* values : {&f_, &residual_}) values->assign(n_dof, 0.0);
    full_values_.assign(tangent.n_nonzero(), 0.0);
    values_.assign(free_->pattern().n_nonzero(), 0.0);
    change_.assign(free_->n(), 0.0);
    solver_ = std::make_unique<BorderedSolver>(make_linear_solver(options_.solver, tangent.symmetric()));
    if (free_->n() > 0) solver_->analyse(free_->pattern());
    drop_matrix();
}

void StageNewton::forget() {
    solver_->forget();
    drop_matrix();
}

double StageNewton::bytes() const {
    return static_cast<double>((full_values_.size() + values_.size()) * sizeof(double) + free_->bytes()) +
           (free_->n() > 0 ? solver_->expected_factor_bytes() : 0.0);
}

double StageNewton::evaluate(const SemiDiscrete& system, const State& accepted, const Stage& stage) {
    system.force(accepted, Trial::of(stage.at), f_);
    ++counts_.evaluations;
    solved_f_ = f_;
    subtract_damping(system, stage.at.v, f_);
    const auto mass = system.lumped_mass();
    double largest = largest_magnitude(f_);
    for (const std::size_t dof : free_->free()) {
        const double inertia = mass[dof] * stage.acceleration(dof);
        largest = std::max(largest, std::abs(inertia));
        residual_[dof] = inertia - f_[dof];
    }
    return largest;
}

void StageNewton::factorise(const SemiDiscrete& system, const State& accepted, const Stage& stage) {
    const Trial at = Trial::of(stage.at);
    system.tangent()->assemble(accepted, at, stage.factors, full_values_);
    free_->take_values(full_values_, values_);
    solver_->factorise(values_, free_->take(system.tangent()->beside(accepted, at, stage.factors)));
    factorised_dt_ = stage.matrix_dt;
    ++counts_.factorisations;
}

void StageNewton::solve(const SemiDiscrete& system, const State& accepted, const Stage& stage, std::span<double> a) {
    solved_f_.clear();
    if (free_->n() == 0) return;
    double before = 0;
    for (int iteration = 0;; ++iteration) {
        const double largest = evaluate(system, accepted, stage);
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
        if (std::abs(factorised_dt_ - stage.matrix_dt) > same * stage.matrix_dt || stalled)
            factorise(system, accepted, stage);
        before = left;
        ++counts_.iterations;
        solver_->solve(change_, change_);
        // round-off: what is left moves no digit of the step
        constexpr double eps = 1e-14;
        double moved = 0, step = 0;
        const auto free = free_->free();
        for (std::size_t i = 0; i < free.size(); ++i) {
            const std::size_t dof = free[i];
            a[dof] -= change_[i];
            moved = std::max(moved, std::abs(stage.displacement * change_[i]));
            step =
                std::max({step, std::abs(stage.end.u[dof] - accepted.u[dof]), stage.dt * std::abs(stage.end.v[dof])});
        }
        stage.place();
        solved_f_.clear();
        if (moved <= eps * step) return;
    }
}

}  // namespace gneiss
