#include "model/amplitude.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "unit/model/amplitude_options.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double never = -std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Amplitude heaviside(double start) { return Amplitude(test::heaviside(start)); }
Amplitude ramp(double start, double end) { return Amplitude(test::ramp(start, end)); }
Amplitude table(std::vector<double> times, std::vector<double> values) {
    return Amplitude(test::table(std::move(times), std::move(values)));
}
Amplitude expression(const std::string& text) { return Amplitude(test::expression(text)); }

std::vector<std::string> messages(const AmplitudeOptions& options) {
    try {
        Amplitude amplitude(options);
    } catch (const InputError& error) {
        std::vector<std::string> all;
        for (const Problem& problem : error.problems()) {
            EXPECT_EQ(problem.where, "");
            all.push_back(problem.message);
        }
        return all;
    }
    return {};
}

TEST(Amplitude, Constant_AnyTime_IsOne) {
    const Amplitude one{AmplitudeOptions{}};
    EXPECT_EQ(one.value(-1, never), 1);
    EXPECT_EQ(one.value(1e9, 3), 1);
    EXPECT_THAT(one.switch_times(), IsEmpty());
    EXPECT_FALSE(one.has_jump());
}

TEST(Amplitude, Heaviside_AtItsStart_SwitchesWithTheEventAndNotWithTheClock) {
    const Amplitude step = heaviside(0.5);
    EXPECT_EQ(step.value(0.4, never), 0);
    EXPECT_EQ(step.value(0.5, never), 0);  // a step that ends at the jump
    EXPECT_EQ(step.value(std::nextafter(0.5, 1), never), 0);
    EXPECT_EQ(step.value(0.5, 0.5), 1);  // after the event
    EXPECT_EQ(step.value(std::nextafter(0.5, 0), 0.5), 1);
    EXPECT_EQ(step.value(0.7, 0.6), 1);  // a later event of another load
    EXPECT_THAT(step.switch_times(), ElementsAre(0.5));
    EXPECT_TRUE(step.has_jump());
}

TEST(Amplitude, Heaviside_AtZero_IsOffUntilTheEventAtZero) {
    EXPECT_EQ(heaviside(0).value(0, never), 0);
    EXPECT_EQ(heaviside(0).value(0, 0), 1);
}

TEST(Amplitude, Ramp_BetweenStartAndEnd_IsLinearAndHeldOutside) {
    const Amplitude rising = ramp(1, 3);
    EXPECT_EQ(rising.value(0, never), 0);
    EXPECT_EQ(rising.value(1, never), 0);
    EXPECT_EQ(rising.value(1.5, 1), 0.25);
    EXPECT_EQ(rising.value(3, 1), 1);
    EXPECT_EQ(rising.value(4, 3), 1);
    EXPECT_THAT(rising.switch_times(), ElementsAre(1, 3));
    EXPECT_FALSE(rising.has_jump());
}

TEST(Amplitude, Table_JumpBetweenSlopes_IsSeenFromBothSides) {
    const Amplitude saw = table({0, 1, 1, 2}, {0, 4, -2, 0});
    EXPECT_EQ(saw.value(0.5, 0), 2);
    EXPECT_EQ(saw.value(1, 0), 4);
    EXPECT_EQ(saw.value(std::nextafter(1, 2), 0), 4);  // left limit held until the event
    EXPECT_EQ(saw.value(1, 1), -2);
    EXPECT_EQ(saw.value(std::nextafter(1, 0), 1), -2);
    EXPECT_EQ(saw.value(1.5, 1), -1);
    EXPECT_EQ(saw.value(-7, never), 0);
    EXPECT_EQ(saw.value(9, 2), 0);
    EXPECT_THAT(saw.switch_times(), ElementsAre(0, 1, 2));
}

TEST(Amplitude, Table_SeveralJumps_PassOneByOne) {
    const Amplitude pulses = table({1, 1, 2, 2}, {0, 5, 5, 1});
    EXPECT_EQ(pulses.value(3, never), 0);
    EXPECT_EQ(pulses.value(3, 1), 5);
    EXPECT_EQ(pulses.value(3, 2), 1);
    EXPECT_THAT(pulses.switch_times(), ElementsAre(1, 2));
}

TEST(Amplitude, Table_PointsWithoutAKink_AreNoSwitchTimes) {
    EXPECT_THAT(table({0, 1, 2, 3}, {0, 1, 2, 2}).switch_times(), ElementsAre(0, 2));
    EXPECT_THAT(table({5}, {3}).switch_times(), IsEmpty());
    EXPECT_EQ(table({5}, {3}).value(0, never), 3);
}

TEST(Amplitude, Expression_OfTimeAlone_DoesNotDependOnPosition) {
    const Amplitude burst = expression("sin(2*pi*t)*exp(-t)");
    EXPECT_FALSE(burst.depends_on_position());
    EXPECT_DOUBLE_EQ(burst.value(0.25, never), std::exp(-0.25));
    EXPECT_DOUBLE_EQ(burst.at(0.25, never)(3, 4), std::exp(-0.25));
    EXPECT_THAT(burst.switch_times(), IsEmpty());
}

TEST(Amplitude, Expression_OfPosition_IsEvaluatedThere) {
    const Amplitude travelling = expression("t - x + 10*y");
    EXPECT_TRUE(travelling.depends_on_position());
    EXPECT_DOUBLE_EQ(travelling.value(5, never, 2, 3), 33);
    EXPECT_DOUBLE_EQ(travelling.at(5, never)(2, 3), 33);
}

TEST(Amplitude, Equality_SameFunctionAsWritten_IsEqual) {
    EXPECT_EQ(ramp(1, 2), table({1, 2}, {0, 1}));
    EXPECT_EQ(expression("t"), expression("t"));
    EXPECT_NE(expression("t"), expression("2*t"));
    EXPECT_NE(heaviside(1), heaviside(2));
    EXPECT_NE(expression("1"), Amplitude{AmplitudeOptions{}});
}

TEST(Amplitude, Options_EmptyTable_IsRefused) {
    EXPECT_THAT(messages(test::table({}, {})), ElementsAre("a table needs at least one time"));
}

TEST(Amplitude, Options_TableOfUnequalLengths_IsRefused) {
    EXPECT_THAT(messages(test::table({0, 1}, {1})), ElementsAre("a table needs one value per time: 2 times, 1 values"));
}

TEST(Amplitude, Options_EveryFaultOfATable_IsReportedAtOnce) {
    EXPECT_THAT(messages(test::table({0, 2, 1, 1, 1}, {0, nan, 1, 2, 3})),
                ElementsAre("values[1] = nan must be finite", "times must ascend: times[2] = 1 s comes after 2 s",
                            "times[4] = 1 s is the third of equal times; two make a jump"));
    EXPECT_THAT(messages(test::table({0, infinity}, {0, 1})), ElementsAre("times[1] = inf must be finite"));
}

TEST(Amplitude, Options_RampThatDoesNotRise_IsRefused) {
    EXPECT_THAT(messages(test::ramp(2, 2)), ElementsAre("a ramp must end after its start: start = 2 s, end = 2 s"));
    EXPECT_THAT(messages(test::ramp(nan, infinity)),
                ElementsAre("start = nan must be finite", "end = inf must be finite"));
}

TEST(Amplitude, Options_HeavisideThatIsNeverSwitched_IsRefused) {
    EXPECT_THAT(messages(test::heaviside(infinity)), ElementsAre("start = inf must be finite"));
}

TEST(Amplitude, Options_FaultyExpression_IsRefusedWithItsText) {
    EXPECT_THAT(messages(test::expression("sin(z)")),
                ElementsAre(testing::AllOf(HasSubstr("sin(z)"), HasSubstr("`z`"), HasSubstr("x, y, t"))));
}

}  // namespace
}  // namespace gneiss
