#include "fracture/y_code_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/fracture/loaded_point.hpp"

namespace gneiss {
namespace {

constexpr double round_off = 1e-12;  // relative: some tens of operations, sums over up to a thousand steps
constexpr double o_p = 2 * peak_opening, s_p = 2 * peak_slip;  // the parabola begins with slope k
constexpr double o_t = 3 * 50 / 3e6, s_t = 3 * 300 / 6e6;

// The shape as Munjiza (2004) gives it, with o_t behind the peak.
TEST(YCodeLaw, PureModes_OnTheWayOut_FollowThePublishedCurve) {
    LoadedPoint<YCodeLaw> tension, shear;
    for (int i = 1; i <= 400; ++i) {
        const double o = 60e-6 * i / 400, s = -170e-6 * i / 400;
        tension.move_to(o, 0);
        shear.move_to(0, s);
        const auto curve = [](double x, double peak, double end) {
            if (x < peak) return 2 * x / peak - (x / peak) * (x / peak);
            return softening_value(std::min(1.0, (x - peak) / end));
        };
        EXPECT_NEAR(tension.traction().normal, 3e6 * curve(o, o_p, o_t), round_off * 3e6) << o;
        EXPECT_NEAR(shear.traction().shear, -6e6 * curve(-s, s_p, s_t), round_off * 6e6) << s;
    }
}

// Known: 3 Z G = 1.159 G in the softening branch, and the rise, 2/3 f o_p, on top. Not an error of ours.
TEST(YCodeLaw, CompleteFailure_DissipatesOneSixthMoreThanGAndTheRise) {
    EXPECT_NEAR(3 * softening_integral, 1.159, 0.5e-3);
    for (const int n : {1, 2, 3, 17, 1000}) {
        LoadedPoint<YCodeLaw> tension, shear;
        tension.move_to(60e-6, 0, n);
        shear.move_to(0, 170e-6, n);
        EXPECT_NEAR(tension.history.fracture(), 3 * softening_integral * 50 + 2.0 / 3 * 3e6 * o_p, round_off * 50) << n;
        EXPECT_NEAR(shear.history.fracture(), 3 * softening_integral * 300 + 2.0 / 3 * 6e6 * s_p, round_off * 300) << n;
        EXPECT_EQ(tension.stored(), 0);
    }
}

TEST(YCodeLaw, ClosedAndOpenedAgain_HasNotHealed) {
    LoadedPoint<YCodeLaw> joint;
    joint.move_to(20e-6, 0, 5);
    const double traction = joint.traction().normal, fracture = joint.history.fracture();
    ASSERT_LT(traction, 2e6);
    joint.move_to(0, 0);
    EXPECT_EQ(joint.traction().normal, 0);
    joint.move_to(10e-6, 0);
    EXPECT_NEAR(joint.traction().normal, 0.75 * traction, round_off * traction);  // g(1/2)
    joint.move_to(20e-6, 0);
    EXPECT_NEAR(joint.traction().normal, traction, round_off * traction);
    EXPECT_NEAR(joint.history.fracture(), fracture, round_off * fracture);
}

TEST(YCodeLaw, OpeningAndSlip_BehindTheirPeaks_ShareOneDamage) {
    LoadedPoint<YCodeLaw> joint;
    joint.move_to(o_p + 0.3 * o_t, s_p + 0.4 * s_t);
    EXPECT_NEAR(joint.history.damage, 0.5, round_off);
    EXPECT_NEAR(joint.traction().normal, 3e6 * softening_value(0.5), round_off * 3e6);
    EXPECT_NEAR(joint.traction().shear, 6e6 * softening_value(0.5), round_off * 6e6);
}

TEST(YCodeLaw, FailedUnderPressure_HasCompressionAndResidualFriction) {
    LoadedPoint<YCodeLaw> joint;
    joint.move_to(-2e-6, 0);
    joint.move_to(-2e-6, 300e-6, 100);
    EXPECT_EQ(joint.history.damage, 1);
    EXPECT_NEAR(joint.traction().normal, -6e6, round_off * 6e6);
    EXPECT_NEAR(joint.traction().shear, 0.5 * 6e6, round_off * 6e6);
    EXPECT_GT(joint.history.friction, 0.5 * 6e6 * 290e-6);
}

}  // namespace
}  // namespace gneiss
