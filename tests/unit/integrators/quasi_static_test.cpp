// What Newton's method alone does. What it shares with other static integrators: static_integrators_test.cpp.

#include "integrators/quasi_static.hpp"

#include <gmock/gmock.h>

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
