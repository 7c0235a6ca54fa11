#pragma once
// Matrices of elastic solids, sparse and dense.

#include <Eigen/Dense>
#include <algorithm>
#include <random>
#include <vector>

#include "linear/linear_solver.hpp"
#include "support/small_solids.hpp"

namespace gneiss {

/// A matrix in compressed rows with the pattern of a solid.
struct Sparse {
    test::Solid solid = test::distorted_solid(true);
    const Tangent& tangent = *solid.system->tangent();
    MatrixPattern arrays = tangent.pattern();
    SparsePattern pattern{arrays.row_starts, arrays.columns};
    std::vector<double> values = std::vector<double>(pattern.n_nonzero());

    /// K + mass times M in relative units: positive definite if mass > 0, with the rigid modes of K if mass = 0.
    explicit Sparse(double mass) {
        const State state = solid.system->initial_state();
        std::vector<double> m(values.size());
        tangent.assemble(state, Trial::of(state), {.stiffness = 1}, values);
        tangent.assemble(state, Trial::of(state), {.mass = 1}, m);
        const double scale = std::ranges::max(values) / std::ranges::max(m);
        for (std::size_t k = 0; k < values.size(); ++k) values[k] += mass * scale * m[k];
    }
    /// Makes it unsymmetric; still far from singular.
    void disturb() {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> factor(0.9, 1.1);
        for (double& value : values) value *= factor(random);
    }
    Eigen::MatrixXd dense() const { return test::dense(pattern, values); }
};

inline Eigen::VectorXd solve(LinearSolver& solver, const Eigen::VectorXd& b) {
    Eigen::VectorXd x(b.size());
    const auto n = static_cast<std::size_t>(b.size());
    solver.solve({b.data(), n}, {x.data(), n});
    return x;
}

inline Eigen::VectorXd right_side(const Sparse& a, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(a.pattern.n()), [&] { return normal(random); });
}

}  // namespace gneiss
