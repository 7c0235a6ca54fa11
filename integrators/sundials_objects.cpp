#include "integrators/sundials_objects.hpp"

#include <algorithm>
#include <new>

namespace gneiss {

SundialsMatrix::SundialsMatrix(const SparsePattern& pattern, std::span<double> values, SUNContext context)
    : pattern_(pattern), values_(values.first(pattern.n_nonzero())), matrix_(SUNMatNewEmpty(context)) {
    if (matrix_ == nullptr) throw std::bad_alloc();
    matrix_->content = this;
    matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    matrix_->ops->zero = [](SUNMatrix matrix) {
        std::ranges::fill(static_cast<SundialsMatrix*>(matrix->content)->values_, 0.0);
        return 0;
    };
    matrix_->ops->matvec = [](SUNMatrix matrix, N_Vector x, N_Vector y) {
        const auto& self = *static_cast<SundialsMatrix*>(matrix->content);
        multiply(self.pattern_, self.values_, values_of(x), values_of(y));
        return 0;
    };
}

SundialsSolver::SundialsSolver(LinearSolver& solver, SundialsMatrix& matrix, SUNContext context)
    : solver_(solver), matrix_(matrix), linear_solver_(SUNLinSolNewEmpty(context)) {
    if (linear_solver_ == nullptr) throw std::bad_alloc();
    linear_solver_->content = this;
    linear_solver_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    linear_solver_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
    linear_solver_->ops->initialize = [](SUNLinearSolver) { return 0; };
    linear_solver_->ops->setup = setup;
    linear_solver_->ops->solve = solve;
}

int SundialsSolver::setup(SUNLinearSolver self, SUNMatrix) {
    auto& solver = *static_cast<SundialsSolver*>(self->content);
    solver.guard_.forget();
    return solver.guard_([&] { solver.solver_.factorise(solver.matrix_.values()); });
}

int SundialsSolver::solve(SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, realtype) {
    auto& solver = *static_cast<SundialsSolver*>(self->content);
    return solver.guard_([&] { solver.solver_.solve(values_of(b), values_of(x)); });
}

}  // namespace gneiss
