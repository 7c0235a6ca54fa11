// What Newton's method alone does. What it shares with other static integrators: static_integrators_test.cpp.

#include "integrators/quasi_static.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "support/one_thread.hpp"
#include "support/oscillator.hpp"
#include "unit/integrators/static_cases.hpp"

namespace gneiss {
namespace {

using test::held;
using test::run;
using test::Solution;
using testing::HasSubstr;

TEST(QuasiStatic, FiniteLoad_ConvergesQuadratically) {
    for (const test::FiniteLoad& c : test::finite_loads()) {
        const test::Solid solid = test::distorted_solid(c.compt, c.what);
        QuasiStatic integrator({{.tolerance = 1e-10, .step = 0.25}});
        const Solution found = run(*solid.system, integrator);
        EXPECT_LE(integrator.counts().iterations, 5 * found.n_steps);
    }
}

TEST(QuasiStatic, TooLongAStep_IsCutAndGrowsAgain) {
    // squeezed by 0.38 at once: elements turn inside out in the first iterate
    test::SolidDescription what;
    what.boundaries = {held("bottom", 0, 0), held("top", 0, -0.38)};
    const test::Solid solid = test::distorted_solid(true, what);
    QuasiStatic integrator({{.most_iterations = 5}});
    const Solution found = run(*solid.system, integrator);
    EXPECT_GT(found.n_rejected, 0u);
    EXPECT_LE(test::out_of_balance(*solid.system, found.state), 1e-8);
    EXPECT_EQ(found.times.back(), 1);
    EXPECT_TRUE(std::ranges::is_sorted(found.times));
}

TEST(QuasiStatic, WithoutSupports_IsSingularAndMovesNothing) {
    test::SolidDescription what = test::sheared(1e6);
    what.boundaries.clear();
    const test::Solid solid = test::distorted_solid(true, what);
    QuasiStatic integrator({});
    State state = solid.system->initial_state();
    integrator.start(*solid.system, state, StartReason::fresh);
    const State before = state;
    try {
        integrator.advance(*solid.system, state, 1);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no equilibrium found after load time t = 0 s"));
        EXPECT_THAT(error.what(), HasSubstr("singular"));
    }
    EXPECT_EQ(state, before);
}

TEST(QuasiStatic, PredictionFarOutOfBalance_DoesNotLoosenTheTolerance) {
    // a rotation in the linear prediction compresses a solid that hardly can be
    test::SolidDescription what = test::sheared(2e8);
    what.materials[0].constants = {1e13, 1e9, 1e9, 1e9};
    const test::Solid solid = test::distorted_solid(true, what);
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
        QuasiStatic integrator({{.tolerance = tolerance}});
        const test::Solution found = test::run(*solid.system, integrator);
        EXPECT_LE(test::out_of_balance(*solid.system, found.state), tolerance);
    }
}

TEST(QuasiStatic, SolverThatKeepsItsPivots_SavedAndLoaded_GoesOnWithTheSameBits) {
    const test::Solid solid = test::distorted_solid(true, test::sheared(1e8));
    QuasiStatic integrator({{.step = 0.25}, "klu"}), other({{.step = 0.25}, "klu"});
    test::expect_other_goes_on_with_the_same_bits(*solid.system, integrator, other);
}

TEST(QuasiStatic, PressedColumnStraightPastBuckling_WarnsOnce) {
    // Euler's load of a cantilever without transverse strain, pi^2 E I/(4 L^2): over a height h, E pi^2/48 (h/L)^2
    const double modulus = 1e9, height = 0.5, length = 10;
    const double critical = modulus * M_PI * M_PI / 48 * height * height / (length * length);
    test::SolidDescription what;
    what.materials[0] = test::rock(0);
    what.materials[0].constants = {0, modulus, modulus, modulus};
    what.boundaries = {held("left", 0, 0)};
    what.loads = {test::loaded(LoadOptions::Kind::traction, -4 * critical, 0)};
    what.loads[0].on = "right";
    const test::Solid solid =
        test::make_solid(test::rectangle(true, length, height, {40, 2}, MeshOptions::Pattern::crossed), what);
    QuasiStatic integrator({{.step = 0.1, .longest = 0.1}});
    State state = solid.system->initial_state();
    std::vector<std::string> warnings;
    March march;
    march.t_end = 1;
    march.after_step = [&](const StepReport& step) {
        if (!step.warning.empty()) warnings.push_back(step.warning);
        return true;
    };
    march.run(*solid.system, integrator, state, false);
    ASSERT_EQ(warnings.size(), 1u);
    // critical at t = 0.25; the mesh of four elements over the height is stiffer by some per cent
    EXPECT_THAT(warnings[0], HasSubstr("the tangent is indefinite at load time t = 0.3 s"));
}

TEST(QuasiStatic, SystemWithoutTangent_IsRefused) {
    test::OscillatorModel model;
    model.mass = test::Vector{{1, 1}};
    model.stiffness = test::Matrix::Identity(2, 2);
    model.has_tangent = false;
    const test::Oscillator system(model);
    QuasiStatic integrator({});
    State state = system.initial_state();
    EXPECT_THROW(integrator.start(system, state, StartReason::fresh), InputError);
}

}  // namespace
}  // namespace gneiss
