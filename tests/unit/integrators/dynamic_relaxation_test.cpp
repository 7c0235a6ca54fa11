// What dynamic relaxation alone does: the equilibria of Newton's method from forces alone, in as many iterations as
// theory says. What it shares with other static integrators: static_integrators_test.cpp.

#include "integrators/dynamic_relaxation.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/parallel.hpp"
#include "integrators/quasi_static.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator.hpp"
#include "unit/integrators/static_cases.hpp"

namespace gneiss {
namespace {

using test::held;
using test::run;
using test::Solution;
using testing::HasSubstr;

/// VERIFICATION 7: the unit square, left and bottom fixed, a force at the loaded corner; M = 0.6667 Pa, M_v = 1666.4 Pa
/// for nu = 0.4999, or M_v = M for nu = 0.25.
test::SolidDescription locking_problem(double force, double m_v = 1666.4) {
    test::SolidDescription what;
    what.materials[0].axes.angle = 0.0;
    what.materials[0].constants = {m_v, 0.6667, 0.6667, 0.6667};
    what.boundaries = {held("left", 0, 0), held("bottom", 0, 0)};
    what.loads = {test::loaded(LoadOptions::Kind::nodal_force, force, -force)};
    what.loads[0].on = "top_right";
    return what;
}

test::Solid square(bool compt, int n, const test::SolidDescription& what) {
    return test::make_solid(test::rectangle(compt, 1, 1, {n, n}, MeshOptions::Pattern::uniform_right), what);
}

/// Largest difference of displacements over the largest displacement.
double difference(const State& a, const State& b) {
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < a.u.size(); ++i) {
        largest = std::max(largest, std::abs(a.u[i]));
        difference = std::max(difference, std::abs(a.u[i] - b.u[i]));
    }
    return difference / largest;
}

TEST(DynamicRelaxation, LockingProblem_FiniteLoad_IsTheEquilibriumOfNewtonsMethod) {
    struct Case {
        const char* name;
        bool compt;
        int n;
        test::SolidDescription what;
    };
    std::vector<Case> cases;
    for (const double m_v : {1666.4, 0.6667}) {
        const double force = 0.01;
        cases.push_back({"cst", false, 4, locking_problem(force, m_v)});
        cases.push_back({"compt", true, 4, locking_problem(force, m_v)});
        cases.push_back({"hypo", true, 4, locking_problem(force, m_v)});
        cases.back().what.materials[0].form = Form::hypo;
        cases.push_back({"stiffening", true, 4, locking_problem(force, m_v)});
        cases.back().what.materials[0].form = Form::hypo;
        cases.back().what.materials[0].stiffening = {0.5, 0.1, 0.5};
        cases.push_back({"centre", true, 8, locking_problem(force, m_v)});
        cases.back().what.solid.volumetric = Volumetric::centre;
        cases.back().what.materials[0].stress_map = StressMap::direct;
        cases.push_back({"follower pressure", true, 4, locking_problem(force, m_v)});
        cases.back().what.loads = {test::loaded(LoadOptions::Kind::pressure, 0.1, 0)};
        cases.push_back({"moved side", true, 4, locking_problem(force, m_v)});
        cases.back().what.loads.clear();
        cases.back().what.boundaries[1] = held("right", 0.1, {});
    }
    for (const Case& c : cases) {
        const test::Solid solid = square(c.compt, c.n, c.what);
        const LoadStepping::Options options{.tolerance = 1e-9, .step = 0.25};
        QuasiStatic newton({options});
        DynamicRelaxation relaxation(options);
        const Solution expected = run(*solid.system, newton), found = run(*solid.system, relaxation);
        const auto [lowest, highest] = std::ranges::minmax(found.state.u);
        EXPECT_GT(highest - lowest, c.compt ? 0.01 : 1e-4) << c.name << ": a finite load";
        // what the project asks for; a force out of balance by 1e-9 displaces by it times the condition of some
        // thousand, of which the low modes that take part are the smaller part
        EXPECT_LE(difference(expected.state, found.state), 1e-6) << c.name;
        EXPECT_EQ(relaxation.counts().factorisations, 0u);
    }
}

TEST(DynamicRelaxation, SystemWithoutTangent_IsSolved) {
    // a chain of springs: K u = p
    test::OscillatorModel model;
    const Eigen::Index n = 20;
    model.mass = test::Vector::LinSpaced(n, 1, 50);  // fictitious masses do not care
    model.stiffness = test::Matrix::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        model.stiffness(i, i) = 2;
        if (i > 0) model.stiffness(i, i - 1) = model.stiffness(i - 1, i) = -1;
    }
    model.load = [n](double t, bool) { return test::Vector(t * test::Vector::LinSpaced(n, -1, 2)); };
    const test::Oscillator system(model);
    DynamicRelaxation integrator({.tolerance = 1e-12});
    const Solution found = run(system, integrator);
    const test::Vector expected = model.stiffness.ldlt().solve(model.load(1, false));
    EXPECT_LE((test::Oscillator::vector(found.state.u) - expected).cwiseAbs().maxCoeff(),
              1e-10 * expected.cwiseAbs().maxCoeff());
}

/// Iterations of the best constant damping for an error that falls by 1/tolerance.
double best_iterations(const test::Solid& solid, double tolerance) {
    const State rest = solid.system->initial_state();
    const Eigen::MatrixXd stiffness = test::dense_stiffness(*solid.system, rest);
    std::vector<double> mass(rest.u.size());
    solid.system->stiffness_bound(rest, Trial::of(rest), mass);
    const std::vector<bool> fixed = test::is_fixed(*solid.system);
    std::vector<Eigen::Index> free;
    for (std::size_t i = 0; i < fixed.size(); ++i)
        if (!fixed[i]) free.push_back(static_cast<Eigen::Index>(i));
    Eigen::MatrixXd scaled = stiffness(free, free);
    for (Eigen::Index i = 0; i < scaled.rows(); ++i)
        for (Eigen::Index j = 0; j < scaled.cols(); ++j)
            scaled(i, j) /= std::sqrt(mass[static_cast<std::size_t>(free[static_cast<std::size_t>(i)])] *
                                      mass[static_cast<std::size_t>(free[static_cast<std::size_t>(j)])]);
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (scaled + scaled.transpose())).eigenvalues();
    // the error of a critically damped mode falls by exp(-omega h) in a step, and the largest stable h is 2
    return -std::log(tolerance) / (2 * std::sqrt(eigenvalues[0]));
}

TEST(DynamicRelaxation, Iterations_AreNearlyThoseOfTheBestDamping_WhateverTheMesh) {
    for (const bool compt : {false, true}) {
        for (const int n : {2, 4, 8}) {
            const test::Solid solid = square(compt, n, locking_problem(1e-5));
            const double tolerance = 1e-9;
            DynamicRelaxation integrator({.tolerance = tolerance});
            run(*solid.system, integrator);
            // the step is 0.89 of the largest one, and c has to be found first
            EXPECT_LE(static_cast<double>(integrator.counts().iterations), 1.5 * best_iterations(solid, tolerance))
                << compt << " " << n;
            EXPECT_GE(static_cast<double>(integrator.counts().iterations), 0.5 * best_iterations(solid, tolerance));
        }
    }
}

TEST(DynamicRelaxation, AnyNumberOfThreads_SameBits) {
    // several chunks of elements, several ranges of nodes
    const test::Solid solid = square(true, 32, locking_problem(1e-3, 0.6667));
    ASSERT_GT(solid.system->layout().n_dof, 2 * static_cast<std::size_t>(parallel_range));
    std::vector<State> states;
    for (const int threads : {1, 2, 3}) {
        omp_set_num_threads(threads);
        DynamicRelaxation integrator({.tolerance = 0.01});
        states.push_back(run(*solid.system, integrator).state);
    }
    omp_set_num_threads(1);
    EXPECT_EQ(states[0], states[1]);
    EXPECT_EQ(states[0], states[2]);
}

TEST(DynamicRelaxation, TooFewIterations_SaysHowFarItHasCome) {
    const test::Solid solid = square(true, 2, locking_problem(0.01));
    DynamicRelaxation integrator({.most_iterations = 50});
    State state = solid.system->initial_state();
    const State before = state;
    integrator.start(*solid.system, state, StartReason::fresh);
    try {
        integrator.advance(*solid.system, state, 1);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no equilibrium found after load time t = 0 s"));
        EXPECT_THAT(error.what(), testing::ContainsRegex("not at rest after 50 iterations, 0\\.[0-9]+ of the forces"));
    }
    EXPECT_EQ(state, before);
    EXPECT_EQ(integrator.counts().iterations, 50u) << "a shorter load step would need as many";
}

TEST(DynamicRelaxation, ToleranceBelowRoundOff_EndsWithAnError) {
    const test::Solid solid = square(true, 4, locking_problem(0.01));
    DynamicRelaxation integrator({.tolerance = 1e-16});
    State state = solid.system->initial_state();
    integrator.start(*solid.system, state, StartReason::fresh);
    try {
        integrator.advance(*solid.system, state, 1);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), HasSubstr("by round-off: tolerance = 1e-16 cannot be reached"));
    }
}

TEST(DynamicRelaxation, SqueezedAtOnce_SupportsMoveInBeforeAnythingTurnsInsideOut) {
    test::SolidDescription what;
    what.boundaries = {held("bottom", 0, 0), held("top", 0, -0.38)};
    const test::Solid solid = test::distorted_solid(true, what);
    DynamicRelaxation integrator({});
    const Solution found = run(*solid.system, integrator);
    EXPECT_EQ(found.n_steps, 1u);
    EXPECT_EQ(found.n_rejected, 0u);
    EXPECT_LE(test::out_of_balance(*solid.system, found.state), 1e-9);
}

}  // namespace
}  // namespace gneiss
