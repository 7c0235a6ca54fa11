#include "integrators/lanczos.hpp"

#include <gtest/gtest.h>

#include <random>

#include "integrators/central_difference.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

using test::Matrix;
using test::Oscillator;
using test::OscillatorModel;
using test::Vector;

/// The recursion stops when the residual is 1 % of omega^2; forces are differences with 1e-6 of a length.
constexpr double lanczos_excess = 0.011, difference_error = 1e-6;

TEST(Lanczos, RandomSystem_Bound_LiesJustAboveTheLargestFrequency) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const int n : {2, 6, 40}) {
        OscillatorModel model;
        Matrix a(n, n);
        for (double& value : a.reshaped()) value = uniform(random);
        model.stiffness = a * a.transpose();
        model.mass = Vector::Constant(n, 2.0);
        for (double& value : model.mass) value += uniform(random);
        const Oscillator system(model);
        const double bound = lanczos_frequency_bound(system, system.initial_state()),
                     exact = system.exact_bound().omega;
        EXPECT_GE(bound, exact * (1 - difference_error)) << n;
        EXPECT_LE(bound, exact * (1 + lanczos_excess)) << n;
    }
}

TEST(Lanczos, ConstrainedDegreesOfFreedom_AreHeld) {
    OscillatorModel model;
    model.mass = Vector{{1, 1, 1, 1}};
    model.stiffness = Vector{{1, 4, 100, 9}}.asDiagonal();
    model.prescribed = {{{2, Constraint::Kind::velocity}, nullptr, [](double) { return 0.0; }, nullptr}};
    const Oscillator system(model);
    EXPECT_NEAR(lanczos_frequency_bound(system, system.initial_state()), 3, 3 * lanczos_excess);
}

TEST(Lanczos, SmallSolids_Bound_LiesBetweenTheTrueFrequencyAndTheElementBound) {
    for (const bool compt : {false, true}) {
        const test::Solid solid = test::distorted_solid(compt);
        const State state = solid.system->initial_state();
        const double exact = test::dense_frequencies(*solid.system, state).maxCoeff();
        const double lanczos = lanczos_frequency_bound(*solid.system, state);
        const double elements = solid.system->frequency_bound(state).omega;
        EXPECT_GE(lanczos, exact * (1 - difference_error)) << compt;
        EXPECT_LE(lanczos, exact * (1 + lanczos_excess)) << compt;
        EXPECT_GT(elements, lanczos) << compt;
    }
}

TEST(Lanczos, CentralDifferenceOption_TakesTheLargerStep) {
    const test::Solid solid = test::distorted_solid(true);
    State state = solid.system->initial_state();
    CentralDifference by_elements({.safety = 0.9}), by_lanczos({.safety = 0.9, .lanczos = true});
    by_elements.start(*solid.system, state, StartReason::fresh);
    by_lanczos.start(*solid.system, state, StartReason::fresh);
    EXPECT_GT(by_lanczos.critical_time_step(), 1.01 * by_elements.critical_time_step());
}

}  // namespace
}  // namespace gneiss
