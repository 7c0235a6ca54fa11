#include "integrators/sundials_objects.hpp"

#include <algorithm>
#include <new>

namespace gneiss {

SundialsMatrix::SundialsMatrix(const SparsePattern& pattern, SUNContext context)
    : pattern_(pattern), values_(pattern.n_nonzero()), matrix_(SUNMatNewEmpty(context)) {
    if (matrix_ == nullptr) throw std::bad_alloc();
    matrix_->content = this;
    matrix_->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    matrix_->ops->zero = [](SUNMatrix matrix) {
        std::ranges::fill(static_cast<SundialsMatrix*>(matrix->content)->values_, 0.0);
        return 0;
    };
    matrix_->ops->matvec = multiply;
}

int SundialsMatrix::multiply(SUNMatrix matrix, N_Vector x_vector, N_Vector y_vector) {
    const auto& self = *static_cast<SundialsMatrix*>(matrix->content);
    const std::span<const double> x = values_of(x_vector);
    const std::span<double> y = values_of(y_vector);
    const auto n = static_cast<std::ptrdiff_t>(y.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t row = 0; row < n; ++row) {
        const auto i = static_cast<std::size_t>(row);
        double sum = 0;
        for (auto k = static_cast<std::size_t>(self.pattern_.row_starts[i]);
             k < static_cast<std::size_t>(self.pattern_.row_starts[i + 1]); ++k)
            sum += self.values_[k] * x[static_cast<std::size_t>(self.pattern_.columns[k])];
        y[i] = sum;
    }
    return 0;
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
    // exceptions must not pass through C
    try {
        solver.failure_.clear();
        solver.solver_.factorise(solver.matrix_.values());
        return 0;
    } catch (const RecoverableError& error) {
        solver.failure_ = error.what();
        return 1;
    } catch (...) {
        solver.unrecoverable_ = std::current_exception();
        return -1;
    }
}

int SundialsSolver::solve(SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, realtype) {
    try {
        static_cast<SundialsSolver*>(self->content)->solver_.solve(values_of(b), values_of(x));
        return 0;
    } catch (...) {
        static_cast<SundialsSolver*>(self->content)->unrecoverable_ = std::current_exception();
        return -1;
    }
}

}  // namespace gneiss
