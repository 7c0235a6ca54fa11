// What is found of an expression before the run. All cases have instants that are known in closed form.

#include "model/amplitude_course.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "model/amplitude.hpp"
#include "unit/model/amplitude_options.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::array<Vec2<double>, 1> origin{{{0, 0}}};

AmplitudeCourse course(const std::string& expression, double until) {
    return course_of(test::expression(expression), until, origin);
}

std::vector<double> times(const AmplitudeCourse& course) {
    std::vector<double> all;
    for (const AmplitudeCourse::Switch& one : course.switches) all.push_back(one.time);
    return all;
}

TEST(AmplitudeCourse, PulseAfterARest_SwitchesAtItsEnds_AndBoundsSteps) {
    const AmplitudeCourse pulse = course("t>2e-3 && t<3e-3 ? sin(pi*(t-2e-3)/1e-3)^2 : 0", 5e-3);
    EXPECT_THAT(times(pulse), ElementsAre(2e-3, 3e-3));
    EXPECT_FALSE(pulse.switches[0].jumps);
    // a straight line that is off by a tenth of sin^2 at most is a fifth of its 1 ms long
    EXPECT_LE(pulse.longest_step(2.5e-3), 0.3e-3);
    EXPECT_GE(pulse.longest_step(2.5e-3), 0.1e-3);
    EXPECT_LE(pulse.longest_step(0), 2.4e-3);  // not over it
    EXPECT_EQ(pulse.longest_step(3.1e-3), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(pulse.largest_at, 2.5e-3, 1e-5);
    EXPECT_THAT(pulse.warnings, IsEmpty());
}

TEST(AmplitudeCourse, Switches_AreFoundHoweverShortWhatIsBetween) {
    EXPECT_THAT(times(course("t > 2.05e-3 && t < 2.05000001e-3 ? 1 : 0", 5e-3)), ElementsAre(2.05e-3, 2.05000001e-3));
    EXPECT_THAT(times(course("abs(t - 0.3)", 1)), ElementsAre(0.3));
    EXPECT_THAT(times(course("min(t/1e-3, 1)", 5e-3)), ElementsAre(1e-3));
    EXPECT_THAT(times(course("rint(4*t)", 1)), ElementsAre(0.125, 0.375, 0.625, 0.875));
    EXPECT_THAT(times(course("sign(t - 0.25)", 1)), ElementsAre(0.25));
    // sin rises above 0.999 for 1.4 % of each of 100 periods
    const AmplitudeCourse narrow = course("sin(2*pi*1000*t) > 0.999 ? 1 : 0", 0.1);
    ASSERT_EQ(narrow.switches.size(), 200u);
    EXPECT_NEAR(narrow.switches[0].time, std::asin(0.999) / (2000 * std::numbers::pi), 1e-15);
    EXPECT_TRUE(narrow.switches[0].jumps);
}

TEST(AmplitudeCourse, WhatIsSmoothAndShort_BoundsStepsWhereItIs) {
    for (const auto& [text, t0, width] : {std::tuple{"exp(-((t - 2e-3)/1e-7)^2)", 2e-3, 1e-7},
                                          {"1/(1 + ((t - 3e-3)/1e-7)^2)", 3e-3, 1e-7},
                                          {"tanh((t - 1e-3)/1e-8)", 1e-3, 1e-8}}) {
        const AmplitudeCourse bell = course(text, 5e-3);
        EXPECT_LE(bell.longest_step(t0 - width), 10 * width) << text;
        EXPECT_GE(bell.longest_step(t0 - width), 0.01 * width) << text;
        EXPECT_LE(bell.longest_step(0), t0 + width) << text;
    }
}

TEST(AmplitudeCourse, JumpWithoutAComparison_Switches) {
    for (const char* text :
         {"atan2(t - 1.013e-3, 0)", "atan(1/(t - 1.013e-3))", "1 - 2*atan(1/(t - 1.013e-3))/pi",
          "sqrt((t - 1.013e-3)^2)/(t - 1.013e-3)", "(t - 1.013e-3 + abs(t - 1.013e-3))/(t - 1.013e-3)",
          "exp(-t)*atan2(t - 1.013e-3, 0)", "sin(2*pi*1e4*t) + 0.3*atan2(t - 1.013e-3, 0)",
          "exp(-exp(-(t - 1.013e-3)/1e-30))", "1/(1 + exp(-1/(t - 1.013e-3)))"}) {
        const AmplitudeCourse jump = course(text, 5e-3);
        ASSERT_THAT(times(jump), ElementsAre(1.013e-3)) << text;
        EXPECT_TRUE(jump.switches[0].jumps) << text;
        EXPECT_LE(jump.switches[0].after - jump.switches[0].before, 1e-18) << text << ": doubles side by side";
        EXPECT_THAT(jump.warnings, IsEmpty()) << text;
    }
    const AmplitudeCourse pulse = course("atan2(t - 2e-3, 0) - atan2(t - 2.1e-3, 0)", 5e-3);
    EXPECT_THAT(times(pulse), ElementsAre(2e-3, 2.1e-3));
    // the fractional part of t/1 ms
    const AmplitudeCourse saw = course("0.5 + atan(tan(pi*(t/1e-3 - 0.5)))/pi", 4.5e-3);
    ASSERT_EQ(saw.switches.size(), 4u);
    constexpr double of_the_pole = 1e-17;  // round-off of pi times 4
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(saw.switches[k].time, 1e-3 * static_cast<double>(k + 1), of_the_pole);
        EXPECT_TRUE(saw.switches[k].jumps);
    }
}

TEST(AmplitudeCourse, StepShorterThanAnyStep_IsAJump_ButAPeakIsNot) {
    const AmplitudeCourse step = course("tanh((t - 2e-3)/1e-15)", 5e-3);
    ASSERT_EQ(step.switches.size(), 1u);
    EXPECT_TRUE(step.switches[0].jumps);
    EXPECT_NEAR(step.switches[0].time, 2e-3, 1e-10 * 5e-3);
    EXPECT_THAT(times(course("exp(-((t - 2e-3)/1e-15)^2)", 5e-3)), IsEmpty());
}

TEST(AmplitudeCourse, WhatIsContinuous_HasNoJumpHoweverSteep) {
    for (const char* width : {"1e-4", "1e-6", "1e-8", "1e-10", "1e-11", "1e-12"})
        for (const char* of_u : {"tanh({})", "exp(-({})^2)", "1/(1 + ({})^2)", "atan({})", "1/(1 + exp(-{}))"}) {
            std::string text = of_u;
            text.replace(text.find("{}"), 2, std::string("(t - 2e-3)/") + width);
            EXPECT_THAT(times(course(text, 5e-3)), IsEmpty()) << text;
        }
    for (const char* text : {"sqrt(t)", "sqrt(sqrt((t - 2e-3)^2))", "((t - 2e-3)^2)^0.1", "sin(2*pi*1e9*t)",
                             "exp(1e4*t)", "sin(t - 2e-3)/(t - 2e-3)", "tan(100*t)", "t^20", "ln(t + 1e-12)"})
        EXPECT_THAT(times(course(text, 5e-3)), IsEmpty()) << text;
}

TEST(AmplitudeCourse, Pole_IsAJumpThatIsTold) {
    const AmplitudeCourse tangent = course("tan(pi*t/4e-3)", 5e-3);
    ASSERT_EQ(tangent.switches.size(), 1u);
    EXPECT_TRUE(tangent.switches[0].jumps);
    EXPECT_NEAR(tangent.switches[0].time, 2e-3, 1e-17);
    EXPECT_THAT(tangent.warnings, ElementsAre(HasSubstr("grows without bound towards t = 0.002 s")));
    EXPECT_TRUE(course("1/(t - 1e-3)", 5e-3).switches.at(0).jumps);
}

TEST(AmplitudeCourse, Harmonic_BoundsStepsToAQuarterOfItsPeriod_HoweverManyThereAre) {
    for (const char* text : {"sin(2*pi*50*t)", "exp(-t)*sin(2*pi*50*t)"}) {
        const AmplitudeCourse harmonic = course(text, 10);
        for (const double t : {0.0, 3.123, 9.9}) {
            EXPECT_LE(harmonic.longest_step(t), 0.25 * 0.02 + 1e-9) << text;
            EXPECT_GE(harmonic.longest_step(t), 0.05 * 0.02) << text;
        }
    }
    EXPECT_LE(course("sin(2*pi*1e6*t)", 10).longest_step(7), 0.25e-6 + 1e-12);  // ten million periods
}

TEST(AmplitudeCourse, WhatVariesAlongAStraightLine_BoundsNothing) {
    EXPECT_GE(course("t/10", 10).longest_step(1), 5);
    EXPECT_THAT(course("2", 10).stretches, ElementsAre(IsEmpty()));
}

TEST(AmplitudeCourse, AFront_SwitchesAtEachOfItsPlaces) {
    const std::array<Vec2<double>, 3> places{{{0.1, 0}, {0.2, 0}, {0.4, 1}}};
    const AmplitudeCourse front = course_of(test::expression("t > x/1000 ? 1 : 0"), 1e-3, places);
    EXPECT_THAT(times(front), ElementsAre(1e-4, 2e-4, 4e-4));
    std::vector<Vec2<double>> many;
    for (int i = 0; i < 3000; ++i) many.push_back({1e-4 * i, 0});
    const AmplitudeCourse dense = course_of(test::expression("t > 1e-4 + x/1000 ? 1 : 0"), 1e-3, many);
    EXPECT_LE(dense.switches.size(), 256u);
    EXPECT_THAT(times(course_of(test::expression("atan2(t - x/1000, 0)"), 1e-3, places)),
                ElementsAre(1e-4, 2e-4, 4e-4));
    EXPECT_EQ(dense.switches.front().time, 1e-4);
    EXPECT_DOUBLE_EQ(dense.switches.back().time, 1e-4 + 0.2999 / 1000);
    EXPECT_GT(dense.longest_step(2e-4), 1e-7) << "no step as short as a jump";
}

TEST(AmplitudeCourse, WhatNoRunWillSee_IsSaid) {
    EXPECT_THAT(course("t == 2e-3 ? 1 : 0", 5e-3).warnings,
                ElementsAre(HasSubstr("a value of its own at the one instant t = 0.002 s")));
    EXPECT_THAT(course("t == 0 ? 1 : sin(t)/t", 5e-3).warnings, IsEmpty());
    EXPECT_THAT(course("1/(t - 1e-3)", 5e-3).warnings, ElementsAre(HasSubstr("has no value at t = 0.001 s")));
}

TEST(AmplitudeCourse, ExpressionThatJumps_SwitchesWithTheEventAndNotWithTheClock) {
    const AmplitudeOptions options = test::expression("t >= 0.5 ? 2 + t : t");
    const Amplitude amplitude(options, std::make_shared<const AmplitudeCourse>(course_of(options, 1, origin)));
    constexpr double never = -std::numeric_limits<double>::infinity(), one_ulp = 1e-15;
    EXPECT_THAT(amplitude.switch_times(), ElementsAre(0.5));
    EXPECT_TRUE(amplitude.has_jump());
    EXPECT_NEAR(amplitude.value(0.5, never), 0.5, one_ulp);
    EXPECT_NEAR(amplitude.value(0.6, never), 0.5, one_ulp);  // a stage beyond the event sees the left limit
    EXPECT_NEAR(amplitude.value(0.5, 0.5), 2.5, one_ulp);
    EXPECT_NEAR(amplitude.value(0.4, 0.5), 2.5, one_ulp);
    EXPECT_EQ(amplitude.value(0.7, 0.5), 2.7);
}

TEST(AmplitudeCourse, Table_IsLargestAndFastestWhereItsPointsSay) {
    const AmplitudeCourse table = course_of(test::table({1, 2, 3, 4}, {0, 1, -5, -5}), 10, origin);
    EXPECT_EQ(table.largest_at, 3);
    EXPECT_EQ(table.fastest_at, 2.5);
    EXPECT_THAT(table.switches, IsEmpty());  // the amplitude knows its own
    EXPECT_EQ(course_of(test::ramp(1, 3), 2, origin).largest_at, 2) << "the run ends before the ramp";
}

}  // namespace
}  // namespace gneiss
