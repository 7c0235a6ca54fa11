// Iterative solvers on matrices of elastic solids, against dense factorisations.

#include <gmock/gmock.h>
#include <omp.h>

#include "linear/krylov.hpp"
#include "linear/linear_solver.hpp"
#include "sparse_matrices.hpp"
#include "support/one_thread.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;

constexpr double tolerance = 1e-10;
constexpr double slack = 2;  ///< the residual has round-off of its own

struct KrylovChoice {
    const char *name, *solver, *preconditioner;
};

LinearSolverOptions choice(const char* solver, const char* preconditioner) {
    LinearSolverOptions options(solver);
    options.preconditioner = preconditioner;
    options.tolerance = tolerance;
    return options;
}

class KrylovOf : public testing::TestWithParam<KrylovChoice> {
protected:
    LinearSolverOptions options = choice(GetParam().solver, GetParam().preconditioner);
    std::unique_ptr<LinearSolver> solver = make_linear_solver(options, true);

    void take(const Sparse& a) {
        solver->analyse(a.pattern);
        solver->factorise(a.values);
    }
};

double residual(const Sparse& a, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
    return (a.dense() * x - b).norm() / b.norm();
}

TEST_P(KrylovOf, PositiveDefinite_SolvesToItsTolerance) {
    const Sparse a(0.01);
    take(a);
    for (const unsigned seed : {1u, 2u}) {
        const Eigen::VectorXd b = right_side(a, seed);
        EXPECT_LE(residual(a, solve(*solver, b), b), slack * tolerance);
    }
    EXPECT_GT(solver->iterations(), 1u);
    EXPECT_GT(solver->factor_bytes(), a.pattern.n() * sizeof(double));
    EXPECT_EQ(solver->name(), GetParam().solver);
}

TEST_P(KrylovOf, ZeroRightSide_IsSolvedByZero) {
    const Sparse a(0.01);
    take(a);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(a.pattern.n()));
    EXPECT_EQ(solve(*solver, zero), zero);
    EXPECT_EQ(solver->iterations(), 0u);
}

TEST_P(KrylovOf, InPlaceAndOnTwoThreads_SameBits) {
    const Sparse a(0.01);
    take(a);
    Eigen::VectorXd b = right_side(a, 1);
    const Eigen::VectorXd x = solve(*solver, b);
    omp_set_num_threads(2);
    EXPECT_EQ(solve(*solver, b), x);
    omp_set_num_threads(1);
    solver->solve({b.data(), a.pattern.n()}, {b.data(), a.pattern.n()});
    EXPECT_EQ(b, x);
}

TEST_P(KrylovOf, NewValuesAndNewPattern_AreTaken) {
    Sparse a(0.01);
    take(a);
    for (double& value : a.values) value *= 3;
    solver->factorise(a.values);
    const Eigen::VectorXd b = right_side(a, 1);
    EXPECT_LE(residual(a, solve(*solver, b), b), slack * tolerance);

    const std::vector<std::int64_t> starts{0, 1, 2}, columns{0, 1};
    const std::vector<double> values{4, 16};
    solver->analyse({starts, columns});
    solver->factorise(values);
    const Eigen::VectorXd x = solve(*solver, Eigen::Vector2d(4, 8));
    EXPECT_NEAR(x[0], 1, 1e-9);
    EXPECT_NEAR(x[1], 0.5, 1e-9);
}

TEST_P(KrylovOf, TooFewIterations_AreARecoverableErrorThatSaysHowFarItCame) {
    options.most_iterations = 3;
    solver = make_linear_solver(options, true);
    const Sparse a(1e-4);
    take(a);
    const Eigen::VectorXd b = right_side(a, 1);
    try {
        solve(*solver, b);
        FAIL() << "no error";
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), HasSubstr(solver->name() + " is left with"));
        EXPECT_THAT(error.what(), HasSubstr("after 3 iterations, asked for 1e-10"));
    }
    EXPECT_EQ(solver->iterations(), 3u);
}

TEST_P(KrylovOf, MostIterations_AreThoseOfTheWholeSolve) {
    // few enough that neither gets there, and no multiple of the 50 after which GMRES starts anew
    options.most_iterations = 60;
    options.tolerance = 1e-14;
    solver = make_linear_solver(options, true);
    const Sparse a(0);  // singular: there is no end
    try {
        take(a);
    } catch (const SingularMatrix&) {
        return;  // an incomplete factorisation may find out first
    }
    EXPECT_THROW(solve(*solver, right_side(a, 1)), RecoverableError);
    EXPECT_LE(solver->iterations(), 60u);
}

TEST_P(KrylovOf, RightSideThatIsNoNumber_IsRefused) {
    const Sparse a(0.01);
    take(a);
    Eigen::VectorXd b = right_side(a, 1);
    b[3] = std::nan("");
    EXPECT_THROW(solve(*solver, b), RecoverableError);
}

TEST_P(KrylovOf, FreeBodyUnderALoadOutOfBalance_IsNotSolved) {
    options.most_iterations = 2000;
    solver = make_linear_solver(options, true);
    const Sparse a(0);
    EXPECT_THROW(
        {
            take(a);
            solve(*solver, right_side(a, 1));
        },
        RecoverableError);
}

INSTANTIATE_TEST_SUITE_P(Krylov, KrylovOf,
                         testing::Values(KrylovChoice{"PcgDiagonal", "pcg", "diagonal"},
                                         KrylovChoice{"PcgIncomplete", "pcg", "incomplete"},
                                         KrylovChoice{"GmresDiagonal", "gmres", "diagonal"},
                                         KrylovChoice{"GmresIncomplete", "gmres", "incomplete"}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(Pcg, Indefinite_IsRefusedAndGoesOnAfterwards) {
    const Sparse indefinite(-0.5), definite(0.01);
    for (const char* preconditioner : {"diagonal", "incomplete"}) {
        const auto solver = make_linear_solver(choice("pcg", preconditioner), true);
        solver->analyse(indefinite.pattern);
        EXPECT_THROW(
            {
                solver->factorise(indefinite.values);
                solve(*solver, right_side(indefinite, 1));
            },
            NotPositiveDefinite);
        solver->factorise(definite.values);
        const Eigen::VectorXd b = right_side(definite, 1);
        EXPECT_LE(residual(definite, solve(*solver, b), b), slack * tolerance);
    }
}

TEST(Gmres, IndefiniteWithAnIncompleteFactorisation_Solves) {
    const Sparse a(-0.5);
    const auto solver = make_linear_solver(choice("gmres", "incomplete"), true);
    solver->analyse(a.pattern);
    solver->factorise(a.values);
    const Eigen::VectorXd b = right_side(a, 1);
    EXPECT_LE(residual(a, solve(*solver, b), b), slack * tolerance);
}

TEST(Gmres, Unsymmetric_SolvesTheMatrixAndNotItsTranspose) {
    for (const char* preconditioner : {"diagonal", "incomplete"}) {
        Sparse a(1);
        a.disturb();
        const auto solver = make_linear_solver(choice("gmres", preconditioner), false);
        solver->analyse(a.pattern);
        solver->factorise(a.values);
        const Eigen::VectorXd b = right_side(a, 1);
        EXPECT_LE(residual(a, solve(*solver, b), b), slack * tolerance);
    }
}

TEST(Preconditioners, IncompleteFactorisation_SavesIterations) {
    const Sparse a(1e-3);
    const Eigen::VectorXd b = right_side(a, 1);
    for (const char* method : {"pcg", "gmres"}) {
        std::size_t iterations[2] = {};
        for (const int incomplete : {0, 1}) {
            const auto solver = make_linear_solver(choice(method, incomplete ? "incomplete" : "diagonal"), true);
            solver->analyse(a.pattern);
            solver->factorise(a.values);
            solve(*solver, b);
            iterations[incomplete] = solver->iterations();
        }
        EXPECT_LT(2 * iterations[1], iterations[0]) << method;
    }
}

TEST(Preconditioners, ADiagonalThatIsNotPositive_IsRefusedByPcg) {
    const std::vector<std::int64_t> starts{0, 2, 4}, columns{0, 1, 0, 1};
    const std::vector<double> values{1, 0.5, 0.5, -2};
    const auto solver = make_linear_solver(choice("pcg", "diagonal"), true);
    solver->analyse({starts, columns});
    EXPECT_THROW(solver->factorise(values), NotPositiveDefinite);
}

TEST(Krylov, WhatAProductThrows_GoesThrough) {
    Krylov krylov(Krylov::Method::gmres, 2, {});
    const Krylov::Product copy = [](std::span<const double> x, std::span<double> y) {
        std::ranges::copy(x, y.begin());
    };
    const Krylov::Product fails = [](std::span<const double>, std::span<double>) { throw std::logic_error("here"); };
    std::vector<double> b{1, 2}, x(2);
    EXPECT_THROW(krylov.solve(fails, copy, b, x), std::logic_error);
    krylov.solve(copy, copy, b, x);
    EXPECT_THAT(x, testing::Pointwise(testing::DoubleNear(1e-9), b));
}

}  // namespace
}  // namespace gneiss
