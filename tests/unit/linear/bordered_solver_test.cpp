#include "linear/bordered_solver.hpp"

#include <gmock/gmock.h>

#include "sparse_matrices.hpp"
#include "support/one_thread.hpp"

namespace gneiss {
namespace {

/// Two dyads on every other, and every third unknown.
LowRank some_dyads(std::size_t n, double first, double second) {
    LowRank beside;
    beside.dyads = {{first, {}}, {second, {}}};
    for (std::size_t row = 0; row < n; row += 2)
        beside.dyads[0].column.push_back({static_cast<std::int64_t>(row), 1 + 0.1 * static_cast<double>(row % 7)});
    for (std::size_t row = 1; row < n; row += 3)
        beside.dyads[1].column.push_back({static_cast<std::int64_t>(row), -1 + 0.2 * static_cast<double>(row % 5)});
    return beside;
}

Eigen::MatrixXd dense(const Sparse& a, const LowRank& beside) {
    Eigen::MatrixXd matrix = a.dense();
    for (const auto& [factor, column] : beside.dyads)
        for (const auto& [row, value] : column)
            for (const auto& [other, more] : column) matrix(row, other) += factor * value * more;
    return matrix;
}

class BorderedSolverOf : public testing::TestWithParam<const char*> {};

TEST_P(BorderedSolverOf, DyadsBesideAMatrix_AreSolvedWithIt) {
    const Sparse a(0.1);
    const double stiff = std::ranges::max(a.values);
    BorderedSolver solver(make_linear_solver(GetParam(), true));
    solver.analyse(a.pattern);
    const Eigen::VectorXd b = right_side(a, 1);
    for (const double size : {1e-3, 1.0, 1e3}) {
        const LowRank beside = some_dyads(a.pattern.n(), size * stiff, 0.3 * size * stiff);
        solver.factorise(a.values, beside);
        Eigen::VectorXd x = b;
        const std::span<double> in_place(x.data(), a.pattern.n());
        solver.solve(in_place, in_place);
        // digits of the ratio of stiffnesses are lost; iterative solvers stop at 1e-8
        const bool iterative = std::string(GetParam()) == "pcg" || std::string(GetParam()) == "gmres";
        const double tolerance = iterative ? 1e-5 : 1e-12 * (1 + 100 * size);
        EXPECT_LT((dense(a, beside) * x - b).norm(), tolerance * b.norm()) << size;
        EXPECT_FALSE(solver.indefinite());
        std::vector<double> product(a.pattern.n());
        multiply(a.pattern, a.values, in_place, product);
        beside.add_product(1, in_place, product);
        EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(product.data(), b.size()) - dense(a, beside) * x).norm(),
                  1e-12 * (a.dense().norm() + dense(a, beside).norm()) * x.norm());
    }
}

INSTANTIATE_TEST_SUITE_P(Solvers, BorderedSolverOf,
                         testing::Values("automatic", "cholmod", "klu", "umfpack", "pcg", "gmres"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(BorderedSolver, WithoutDyads_HasTheBitsOfTheSolver) {
    const Sparse a(0.1);
    BorderedSolver bordered(make_cholmod());
    const auto plain = make_cholmod();
    bordered.analyse(a.pattern);
    plain->analyse(a.pattern);
    bordered.factorise(a.values, {});
    plain->factorise(a.values);
    const Eigen::VectorXd b = right_side(a, 2);
    Eigen::VectorXd x(b.size());
    bordered.solve({b.data(), a.pattern.n()}, {x.data(), a.pattern.n()});
    EXPECT_EQ(x, solve(*plain, b));
}

TEST(BorderedSolver, DyadThatTakesAway_IsToldToBeIndefinite) {
    const Sparse a(0.1);
    BorderedSolver solver(make_cholmod());
    solver.analyse(a.pattern);
    LowRank beside = some_dyads(a.pattern.n(), -10 * std::ranges::max(a.values), 0);
    beside.dyads.pop_back();
    ASSERT_LT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(a, beside)).eigenvalues()[0], 0);
    solver.factorise(a.values, beside);
    EXPECT_TRUE(solver.indefinite());
}

TEST(BorderedSolver, DyadThatLeavesNothing_IsSingular) {
    // 1 x 1: 4 - 2 * 2
    const std::vector<std::int64_t> starts{0, 1}, columns{0};
    const std::vector<double> values{4};
    BorderedSolver solver(make_umfpack());
    solver.analyse({starts, columns});
    LowRank beside;
    beside.dyads = {{-1, {{0, 2}}}};
    EXPECT_THROW(solver.factorise(values, beside), SingularMatrix);
}

}  // namespace
}  // namespace gneiss
