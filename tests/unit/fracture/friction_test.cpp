#include "fracture/friction.hpp"
#include "support/eps.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gneiss {
namespace {

using test::eps;

constexpr double k = 2e12;                    // Pa/m
constexpr double limit = 1e6;                 // Pa; reached at a slip of half a micrometre
constexpr double round_off = 16 * eps;        // relative: a dozen operations
constexpr double energy = limit * limit / k;  // J/m2, the scale of energies below

TEST(Slider, BelowItsLimit_IsASpringAndDissipatesNothing) {
    const auto step = slide(k, limit, limit, 0.0, 0.0, -0.4e-6);
    EXPECT_DOUBLE_EQ(step.traction, -0.8e6);
    EXPECT_EQ(step.slider, 0);
    EXPECT_EQ(step.dissipated, 0);
}

TEST(Slider, BeyondItsLimit_SlidesAndDissipatesLimitTimesWay) {
    for (const double sign : {1.0, -1.0}) {
        const auto step = slide(k, limit, limit, sign * 0.1e-6, 0.0, sign * 2.5e-6);
        EXPECT_DOUBLE_EQ(step.traction, sign * limit);
        EXPECT_NEAR(step.slider, sign * 2e-6, round_off * 2e-6);
        EXPECT_NEAR(step.dissipated, limit * 2e-6, round_off * limit * 2e-6);
    }
}

TEST(Slider, Turned_SpringsBackOverTwiceItsLimit) {
    const auto there = slide(k, limit, limit, 0.0, 0.0, 2.5e-6);
    const auto back = slide(k, limit, limit, 2.5e-6, there.slider, 1.6e-6);
    EXPECT_NEAR(back.traction, -0.8e6, 64 * round_off * limit);  // k times a difference of microns
    EXPECT_EQ(back.dissipated, 0);
}

TEST(Slider, WhereTheNormalTractionGoes_LosesTheEnergyOfItsSpring) {
    const auto step = slide(k, limit, 0.0, 0.5e-6, 0.0, 0.5e-6);
    EXPECT_EQ(step.traction, 0);
    EXPECT_NEAR(step.slider, 0.5e-6, round_off * 0.5e-6);
    EXPECT_NEAR(step.dissipated, 0.5 * energy, round_off * energy);
}

// One step with straight slip and straight limit against the same in many parts: each part is exact, so that they add
// up.
TEST(Slider, InOneStepOrMany_EndsWhereItEnds) {
    for (const double limit1 : {0.2 * limit, 1.7 * limit}) {
        const double s0 = 0.3e-6, s1 = 2.1e-6;
        const auto at_once = slide(k, limit, limit1, s0, 0.0, s1);
        constexpr int n = 100;
        double slider = 0, dissipated = 0, traction = 0;
        for (int i = 0; i < n; ++i) {
            const auto part = [&](double a, double b, int j) { return a + (b - a) * j / n; };
            const auto step = slide(k, part(limit, limit1, i), part(limit, limit1, i + 1), part(s0, s1, i), slider,
                                    part(s0, s1, i + 1));
            slider = step.slider;
            dissipated += step.dissipated;
            traction = step.traction;
        }
        EXPECT_NEAR(at_once.traction, traction, n * round_off * limit);
        EXPECT_NEAR(at_once.slider, slider, n * round_off * s1);
        EXPECT_NEAR(at_once.dissipated, dissipated, n * round_off * energy);
    }
}

}  // namespace
}  // namespace gneiss
