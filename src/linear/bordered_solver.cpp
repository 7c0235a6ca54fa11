#include "linear/bordered_solver.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace gneiss {

void BorderedSolver::factorise(std::span<const double> values, const LowRank& beside) {
    solver_->factorise(values);
    beside_ = beside;
    turned_ = false;
    const auto m = static_cast<Eigen::Index>(beside.dyads.size());
    y_.resize(beside.dyads.size());
    along_.resize(beside.dyads.size());
    if (m == 0) return;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Rows small = Rows::Identity(m, m), s = Rows::Zero(m, m);
    const auto index = [](Eigen::Index k) { return static_cast<std::size_t>(k); };
    for (Eigen::Index k = 0; k < m; ++k) {
        const LowRank::Dyad& dyad = beside.dyads[index(k)];
        std::vector<double>& y = y_[index(k)];
        y.assign(n_, 0.0);
        for (const LowRank::Entry& entry : dyad.column) y[static_cast<std::size_t>(entry.row)] += entry.value;
        solver_->solve(y, y);
        s(k, k) = dyad.factor;
        for (Eigen::Index i = 0; i < m; ++i) {
            const LowRank::Dyad& row = beside.dyads[index(i)];
            small(i, k) += row.factor * LowRank::along(row, y);
        }
    }
    const Eigen::PartialPivLU<Rows> lu(small);
    const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
    const double largest = std::max(1.0, pivots.maxCoeff());
    if (!(pivots.minCoeff() > smallest_pivot_ratio * largest))
        throw SingularMatrix(singular_text(pivots.minCoeff() / largest));
    turned_ = lu.determinant() < 0;
    inverse_.resize(index(m * m));
    Eigen::Map<Rows>(inverse_.data(), m, m) = lu.solve(s);
}

void BorderedSolver::solve(std::span<const double> b, std::span<double> x) {
    solver_->solve(b, x);
    const std::size_t m = beside_.dyads.size();
    for (std::size_t k = 0; k < m; ++k) along_[k] = LowRank::along(beside_.dyads[k], x);
    for (std::size_t k = 0; k < m; ++k) {
        double c = 0;
        for (std::size_t i = 0; i < m; ++i) c += inverse_[k * m + i] * along_[i];
        for (std::size_t row = 0; row < x.size(); ++row) x[row] -= c * y_[k][row];
    }
}

}  // namespace gneiss
