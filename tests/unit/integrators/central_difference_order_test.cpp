// Observed order of central difference on damped, loaded, non-autonomous problems with internal variables.

#include <gtest/gtest.h>

#include <cmath>

#include "integrators/central_difference.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator_problems.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

using test::distance;
using test::Oscillator;
using test::OscillatorModel;

constexpr double end_time = test::oscillator_end;
/// STYLE: |p_obs - p| < 0.15 over three halvings.
constexpr double order_tolerance = 0.15;
State march(const OscillatorModel& model, double dt) {
    const Oscillator system(model);
    CentralDifference integrator({.safety = 1.0, .dt = dt});
    State state = system.initial_state();
    March march;
    march.t_end = end_time;
    // stops at irregular times, so that steps of different length follow each other
    march.next_stop = [](double t) {
        for (const double stop : {0.31, 0.6, 1.13, 1.7})
            if (stop > t) return stop;
        return end_time;
    };
    march.run(system, integrator, state, false);
    EXPECT_EQ(state.t, end_time);
    return state;
}

class CentralDifferenceOrder : public testing::TestWithParam<test::OscillatorProblem> {};

TEST_P(CentralDifferenceOrder, ThreeHalvings_WholeState_IsTwo) {
    const OscillatorModel model = GetParam().model();
    const State exact = runge_kutta(Oscillator(model), end_time, test::oscillator_reference_step);
    double before = distance(march(model, 0.01), exact);
    for (const double dt : {0.005, 0.0025, 0.00125}) {
        const double error = distance(march(model, dt), exact);
        EXPECT_NEAR(std::log2(before / error), 2.0, order_tolerance) << "dt = " << dt << ", error " << error;
        before = error;
    }
    EXPECT_LT(before, 1e-4);  // and it is the right solution
}

INSTANTIATE_TEST_SUITE_P(Problems, CentralDifferenceOrder, testing::ValuesIn(test::oscillator_problems()),
                         [](const auto& problem) { return std::string(problem.param.name); });

}  // namespace
}  // namespace gneiss
