#pragma once
// Sparse matrices with a few dyads beside them, solved by the factors of the sparse part alone.

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/low_rank.hpp"
#include "linear/linear_solver.hpp"

namespace gneiss {

/// Solves (A + B S B^T) x = y, S diagonal  [Woodbury; Golub and Van Loan, Matrix Computations, 2.1.4]:
///
///     x = x_0 - Y (1 + S B^T Y)^-1 S B^T x_0,   A x_0 = y,   A Y = B
///
/// Nothing is filled: every dyad costs one more solve per factorisation. A has to be regular by itself. Where dyads are
/// far stiffer than A, the digits of their ratio are lost.
class BorderedSolver {
public:
    /// @param solver  of the sparse part
    explicit BorderedSolver(std::unique_ptr<LinearSolver> solver) : solver_(std::move(solver)) {}

    void analyse(const SparsePattern& pattern) {
        n_ = pattern.n();
        solver_->analyse(pattern);
    }
    /// @param values  as LinearSolver takes them
    /// @throws SingularMatrix, NotPositiveDefinite
    void factorise(std::span<const double> values, const LowRank& beside);
    /// @param[out] x  shape (n); may be b itself
    /// @throws RecoverableError  iterative solvers, where they do not get to their tolerance
    void solve(std::span<const double> b, std::span<double> x);
    void forget() { solver_->forget(); }
    double expected_factor_bytes() const { return solver_->expected_factor_bytes(); }
    std::size_t iterations() const { return solver_->iterations(); }
    /// As LinearSolver::indefinite(), of the whole matrix: a dyad may make it definite where A is not, and the other
    /// way round.
    bool indefinite() const { return solver_->indefinite() != turned_; }

private:
    std::unique_ptr<LinearSolver> solver_;
    std::size_t n_ = 0;
    LowRank beside_;
    std::vector<std::vector<double>> y_;  ///< columns of Y
    std::vector<double> inverse_;         ///< (1 + S B^T Y)^-1 S, by rows
    bool turned_ = false;                 ///< the dyads turn the sign of the determinant
    std::vector<double> along_;           ///< scratch
};

}  // namespace gneiss
