// Magnitudes that tolerances are measured against.

#include "integrators/problem_scales.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "support/oscillator.hpp"

namespace gneiss {
namespace {

using test::Oscillator;
using test::OscillatorModel;
using test::Vector;

constexpr double nodal_stiffness = 3e10, nodal_mass = 2700;  ///< of a metre of rock, N/m, kg
constexpr double stress_at_rest = 3e7;                       ///< its force on a metre, N
/// What is left where four such forces cancel, N.
constexpr double of_round_off = 4 * std::numeric_limits<double>::epsilon() * stress_at_rest;
const double omega = std::sqrt(nodal_stiffness / nodal_mass);

class ProblemScalesAtRest : public ::testing::Test {
protected:
    ProblemScalesAtRest() {
        model_.stiffness = test::Matrix::Identity(2, 2) * nodal_stiffness;
        model_.mass = Vector::Constant(2, nodal_mass);
    }
    void load(std::function<double(double t)> force) {
        model_.load = [force](double t, bool) { return Vector{{force(t), 0.0}}; };
    }
    void start(std::span<const double> supports = {}) {
        const Oscillator system(model_);
        scales_.start(system, system.initial_state(), omega, supports);
    }

    OscillatorModel model_;
    ProblemScales scales_;
};

TEST_F(ProblemScalesAtRest, NoForces_ScalesAreASmallPartOfAnEdge) {
    start();
    EXPECT_DOUBLE_EQ(scales_.displacement(), 1e-9);  // of 1 m
    EXPECT_DOUBLE_EQ(scales_.velocity(), 1e-9 * omega);
}

TEST_F(ProblemScalesAtRest, ForcesOfRoundOff_AreNoForces) {
    load([](double) { return of_round_off; });
    start();
    EXPECT_DOUBLE_EQ(scales_.displacement(), 1e-9);
    EXPECT_DOUBLE_EQ(scales_.velocity(), 1e-9 * omega);
}

TEST_F(ProblemScalesAtRest, ForcesOfALoad_AreTheScaleHoweverSmall) {
    load([](double) { return 1e-3; });  // 1 mPa on rock: strains of 3e-14
    start();
    EXPECT_EQ(scales_.velocity(), 1e-3 / (nodal_mass * omega));
    EXPECT_EQ(scales_.displacement(), 1e-3 / (nodal_mass * omega) / omega);
}

TEST_F(ProblemScalesAtRest, LoadThatComesSoon_IsTheScaleBesideRoundOff) {
    load([](double t) { return t > 0 ? 1.0 : of_round_off; });
    start();
    EXPECT_EQ(scales_.velocity(), 1 / (nodal_mass * omega));
}

TEST_F(ProblemScalesAtRest, SupportsThatCreep_AreTheScaleBesideRoundOff) {
    load([](double) { return of_round_off; });
    const double slow = 1e-14;  // m/s
    start({&slow, 1});
    EXPECT_EQ(scales_.velocity(), slow);
}

TEST_F(ProblemScalesAtRest, LargerScalesOfEarlier_Stay) {
    load([](double) { return 1.0; });
    start();
    const double before = scales_.velocity();
    load([](double) { return of_round_off; });
    start();
    EXPECT_EQ(scales_.velocity(), before);
}

}  // namespace
}  // namespace gneiss
