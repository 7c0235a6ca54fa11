// Every direct solver on matrices of elastic solids, against dense factorisations.

#include "linear/linear_solver.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "sparse_matrices.hpp"
#include "support/eps.hpp"
#include "support/one_thread.hpp"

namespace gneiss {
namespace {

using test::eps;

struct Choice {
    const char* name;
    std::function<std::unique_ptr<LinearSolver>()> make;
};

/// Largest |A x - b| over |A||x|, in eps.
double backward_error(const Sparse& a, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
    const Eigen::MatrixXd dense = a.dense();
    return (dense * x - b).cwiseAbs().maxCoeff() / (dense.cwiseAbs() * x.cwiseAbs()).maxCoeff() / eps;
}

std::unique_ptr<LinearSolver> make_automatic() { return make_linear_solver("automatic", true); }

std::string name_of(const testing::TestParamInfo<Choice>& test_case) { return test_case.param.name; }

class LinearSolverOf : public testing::TestWithParam<Choice> {
protected:
    std::unique_ptr<LinearSolver> solver = GetParam().make();
};
/// Those that take any regular matrix.
class GeneralLinearSolverOf : public LinearSolverOf {};

TEST_P(LinearSolverOf, PositiveDefinite_SolvesToRoundOff) {
    const Sparse a(0.1);
    solver->analyse(a.pattern);
    solver->factorise(a.values);
    for (const unsigned seed : {1u, 2u}) {
        const Eigen::VectorXd b = right_side(a, seed);
        EXPECT_LE(backward_error(a, solve(*solver, b), b), 100);
    }
    EXPECT_GT(solver->factor_bytes(), a.pattern.n_nonzero() / 2 * sizeof(double));
    EXPECT_FALSE(solver->indefinite());
}

TEST_P(LinearSolverOf, AnalysisAlone_TellsTheMemoryOfTheFactors) {
    const Sparse a(0.1);
    solver->analyse(a.pattern);
    const double expected = solver->expected_factor_bytes();
    solver->factorise(a.values);
    const auto needed = static_cast<double>(solver->factor_bytes());
    constexpr double excess = 10;  // of UMFPACK's upper bound; CHOLMOD knows it exactly, KLU as well as its ordering
    EXPECT_GE(expected, 0.8 * needed);
    EXPECT_LE(expected, excess * needed);
}

TEST_P(LinearSolverOf, InPlace_SameBits) {
    const Sparse a(0.1);
    solver->analyse(a.pattern);
    solver->factorise(a.values);
    Eigen::VectorXd b = right_side(a, 1);
    const Eigen::VectorXd x = solve(*solver, b);
    solver->solve({b.data(), a.pattern.n()}, {b.data(), a.pattern.n()});
    EXPECT_EQ(b, x);
}

TEST_P(LinearSolverOf, NewValuesAndNewPattern_AreTaken) {
    Sparse a(0.1);
    solver->analyse(a.pattern);
    solver->factorise(a.values);
    for (double& value : a.values) value *= 3;
    solver->factorise(a.values);
    const Eigen::VectorXd b = right_side(a, 1);
    EXPECT_LE(backward_error(a, solve(*solver, b), b), 100);

    const std::vector<std::int64_t> starts{0, 1, 2}, columns{0, 1};
    solver->analyse({starts, columns});
    solver->factorise(std::vector<double>{4, 16});  // with exact roots
    EXPECT_EQ(solve(*solver, Eigen::Vector2d(4, 8)), Eigen::Vector2d(1, 0.5));
}

TEST_P(GeneralLinearSolverOf, Unsymmetric_SolvesTheMatrixAndNotItsTranspose) {
    Sparse a(1);
    a.disturb();
    solver->analyse(a.pattern);
    solver->factorise(a.values);
    const Eigen::VectorXd b = right_side(a, 1);
    EXPECT_LE(backward_error(a, solve(*solver, b), b), 1000);
}

TEST_P(GeneralLinearSolverOf, SmallPivotsAfterNewValues_ArePivotedAnew) {
    // the pivots that serve the first matrix vanish in the second
    const std::vector<std::int64_t> starts{0, 2, 4}, columns{0, 1, 0, 1};
    solver->analyse({starts, columns});
    solver->factorise(std::vector<double>{1, 0.5, 0.5, 1});
    solver->factorise(std::vector<double>{1e-18, 1, 1, 1e-18});
    const Eigen::VectorXd x = solve(*solver, Eigen::Vector2d(3, 5));
    EXPECT_NEAR(x[0], 5, 1e-14);
    EXPECT_NEAR(x[1], 3, 1e-14);
}

TEST_P(LinearSolverOf, FreeBody_IsSingular) {
    const Sparse a(0);
    solver->analyse(a.pattern);
    EXPECT_THROW(solver->factorise(a.values), SingularMatrix);
}

TEST_P(GeneralLinearSolverOf, Indefinite_Solves) {
    const Sparse a(-0.5);
    solver->analyse(a.pattern);
    solver->factorise(a.values);
    const Eigen::VectorXd b = right_side(a, 1);
    EXPECT_LE(backward_error(a, solve(*solver, b), b), 1000);
}

TEST_P(GeneralLinearSolverOf, OddNumberOfNegativeEigenvalues_IsKnown) {
    const std::vector<std::int64_t> starts{0, 2, 4, 5}, columns{0, 1, 0, 1, 2};
    solver->analyse({starts, columns});
    solver->factorise(std::vector<double>{2, 1, 1, 2, 3});
    EXPECT_FALSE(solver->indefinite());
    solver->factorise(std::vector<double>{2, 1, 1, 2, -3});
    EXPECT_TRUE(solver->indefinite());
    solver->factorise(std::vector<double>{1, 2, 2, 1, 3});
    EXPECT_TRUE(solver->indefinite());
    int odd = 0;
    for (const double mass : {-0.1, -0.3, -0.5, -0.7, -0.9, -1.1}) {
        const Sparse a(mass);
        solver->analyse(a.pattern);
        solver->factorise(a.values);
        const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a.dense()).eigenvalues();
        EXPECT_EQ(solver->indefinite(), (eigenvalues.array() < 0).count() % 2 == 1) << mass;
        odd += solver->indefinite();
    }
    EXPECT_GT(odd, 0);
    EXPECT_LT(odd, 6);
}

TEST(Cholmod, Indefinite_IsRefused) {
    const Sparse a(-0.5);
    const auto solver = make_cholmod();
    solver->analyse(a.pattern);
    EXPECT_THROW(solver->factorise(a.values), NotPositiveDefinite);
}

TEST_P(LinearSolverOf, AfterAFailure_GoesOn) {
    const Sparse singular(0), sound(0.1);
    solver->analyse(singular.pattern);
    EXPECT_THROW(solver->factorise(singular.values), SingularMatrix);
    solver->factorise(sound.values);
    const Eigen::VectorXd b = right_side(sound, 1);
    EXPECT_LE(backward_error(sound, solve(*solver, b), b), 100);
}

INSTANTIATE_TEST_SUITE_P(Direct, LinearSolverOf,
                         testing::Values(Choice{"Cholmod", make_cholmod}, Choice{"Klu", make_klu},
                                         Choice{"Umfpack", make_umfpack}, Choice{"Automatic", make_automatic}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Direct, GeneralLinearSolverOf,
                         testing::Values(Choice{"Klu", make_klu}, Choice{"Umfpack", make_umfpack}), name_of);

TEST(Automatic, IndefiniteAmongDefinite_SolvesBoth) {
    const Sparse definite(0.1), indefinite(-0.5);
    const auto solver = make_automatic();
    solver->analyse(definite.pattern);
    for (const Sparse* a : {&definite, &indefinite, &definite}) {
        solver->factorise(a->values);
        const Eigen::VectorXd b = right_side(*a, 1);
        EXPECT_LE(backward_error(*a, solve(*solver, b), b), 1000);
        EXPECT_EQ(solver->indefinite(), a == &indefinite);
    }
}

TEST(MakeLinearSolver, NamesAndSymmetry_AreChecked) {
    EXPECT_EQ(make_linear_solver("klu", false)->name(), "klu");
    EXPECT_EQ(make_linear_solver("umfpack", true)->name(), "umfpack");
    EXPECT_EQ(make_linear_solver("cholmod", true)->name(), "cholmod");
    EXPECT_EQ(make_linear_solver("automatic", false)->name(), "umfpack");
    EXPECT_EQ(make_linear_solver("pcg", true)->name(), "pcg");
    EXPECT_EQ(make_linear_solver("gmres", false)->name(), "gmres");
    EXPECT_THROW(make_linear_solver("cholmod", false), InputError);
    EXPECT_THROW(make_linear_solver("pcg", false), InputError);
    EXPECT_THROW(make_linear_solver("mumps", true), InputError);
}

TEST(LinearSolverOptions, OutOfRange_AreNamedAllAtOnce) {
    LinearSolverOptions options("mumps");
    options.preconditioner = "multigrid";
    options.tolerance = 0;
    options.most_iterations = 0;
    try {
        make_linear_solver(options, true);
        FAIL() << "no error";
    } catch (const InputError& error) {
        using testing::HasSubstr;
        EXPECT_THAT(error.what(),
                    HasSubstr("given `mumps`, must be one of automatic, cholmod, klu, umfpack, pcg, gmres"));
        EXPECT_THAT(error.what(), HasSubstr("given `multigrid`, must be one of incomplete, diagonal"));
        EXPECT_THAT(error.what(), HasSubstr("integrator.linear_tolerance"));
        EXPECT_THAT(error.what(), HasSubstr("integrator.most_linear_iterations"));
    }
}

}  // namespace
}  // namespace gneiss
