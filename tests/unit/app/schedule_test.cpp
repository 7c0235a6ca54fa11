#include "app/schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "system/march.hpp"

namespace gneiss {
namespace {

struct Counts {
    int rows = 0, checkpoints = 0, steps = 0;
    double shortest = 1e300;
    std::vector<double> frames;
};

/// Steps of at most dt to the end, as a run takes them.
Counts march(const CaseOptions& options, double dt) {
    const Schedule schedule(options);
    Counts counts;
    for (double t = 0; t < options.run.t_end;) {
        double stop = schedule.next_stop(t);
        if (!(stop < options.run.t_end) || reached(stop, options.run.t_end)) stop = options.run.t_end;
        const double n = std::ceil((stop - t) / dt - 1e-9), step_length = (stop - t) / std::max(1.0, n);
        const double next = n > 1 ? t + step_length : stop;
        const StepReport step{next, step_length};
        counts.rows += schedule.row_due(step);
        // whoever looks when told to misses no row
        EXPECT_EQ(schedule.row_due(step), !(next < schedule.next_look(t)) || !(next < options.run.t_end))
            << "t = " << t;
        counts.checkpoints += schedule.checkpoint_due(step);
        if (schedule.frame_due(step)) counts.frames.push_back(next);
        counts.shortest = std::min(counts.shortest, length);
        ++counts.steps;
        t = next;
    }
    return counts;
}

CaseOptions options_until(double t_end) {
    CaseOptions options;
    options.run.t_end = t_end;
    return options;
}

TEST(Schedule, NothingAsked_ThousandRowsAndTheLastFrame) {
    const Counts counts = march(options_until(1), 1e-4);
    EXPECT_EQ(counts.rows, 1000);
    EXPECT_EQ(counts.frames, std::vector<double>{1});
    EXPECT_EQ(counts.checkpoints, 0);
}

TEST(Schedule, NothingAsked_StepsAreNotShortened) {
    EXPECT_TRUE(std::isinf(Schedule(options_until(1)).next_stop(0.3)));
    EXPECT_EQ(march(options_until(1), 0.25).rows, 4);  // a row a step at most
}

TEST(Schedule, Intervals_TenthsOfOne_HitTheirMultiplesOnce) {
    CaseOptions options = options_until(1);
    options.output.fields = 0.1;
    options.output.history = 0.05;
    options.run.checkpoint = 0.3;
    const Counts counts = march(options, 0.007);
    ASSERT_EQ(counts.frames.size(), 10u);
    for (int k = 0; k < 10; ++k) EXPECT_DOUBLE_EQ(counts.frames[static_cast<std::size_t>(k)], 0.1 * (k + 1));
    EXPECT_EQ(counts.frames.back(), 1);
    EXPECT_EQ(counts.rows, 20);
    EXPECT_EQ(counts.checkpoints, 3);
    EXPECT_GT(counts.shortest, 0.005);  // 0.3 and 3 * 0.1 are one instant: no step between them
}

TEST(Schedule, FieldTimes_BesideAnInterval_AreHitOnce) {
    CaseOptions options = options_until(1);
    options.output.fields = 0.1;
    options.output.field_times = {0.3, 0.6, 0.123, 1, 0, 0.7};
    const Counts counts = march(options, 0.02);
    EXPECT_EQ(counts.frames.size(), 11u);
    EXPECT_EQ(counts.frames[1], 0.123);
    EXPECT_GT(counts.shortest, 0.002);
}

TEST(Schedule, EndBetweenMultiples_HasARowAndAFrame) {
    CaseOptions options = options_until(0.95);
    options.output.fields = options.output.history = 0.1;
    const Counts counts = march(options, 0.01);
    EXPECT_EQ(counts.rows, 10);
    EXPECT_EQ(counts.frames.size(), 10u);
    EXPECT_EQ(counts.frames.back(), 0.95);
}

TEST(Schedule, Expected_CountsRowsAndFrames) {
    CaseOptions options = options_until(1);
    options.output.fields = 0.1;
    options.output.history = 0.01;
    options.output.field_times = {0.123};
    EXPECT_EQ(Schedule(options).expected_rows(1e-3), 101);
    EXPECT_EQ(Schedule(options).expected_rows(0.1), 101);  // steps are made shorter
    EXPECT_EQ(Schedule(options).most_frames(), 13);
    options.output.history = 0;
    EXPECT_EQ(Schedule(options).expected_rows(1e-4), 1001);
    EXPECT_EQ(Schedule(options).expected_rows(0.1), 11);
    options.output.history = 0.01;
    options.output.rows_at_steps = true;
    EXPECT_EQ(Schedule(options).expected_rows(0.1), 11);
}

TEST(Schedule, IntervalOfRows_StepsEndAtItsMultiples) {
    CaseOptions options = options_until(0.05);
    options.output.history = 1e-3;
    EXPECT_EQ(Schedule(options).next_stop(0), 1e-3);
    EXPECT_EQ(Schedule(options).next_stop(0.0029), 0.003);
    for (const double dt : {1e-4, 3.7e-4, 0.02}) EXPECT_EQ(march(options, dt).rows, 50) << dt;
    EXPECT_EQ(march(options, 0.02).steps, 50);
}

TEST(Schedule, IntervalOfRowsAndAnIntegratorThatInterpolates_RowsFallWithinSteps) {
    CaseOptions options = options_until(0.05);
    options.output.history = 1e-3;
    const Schedule schedule(options, true);
    EXPECT_TRUE(std::isinf(schedule.next_stop(0)));
    EXPECT_EQ(schedule.rows_between(0.0069, 0.0112), (std::vector<double>{0.007, 0.008, 0.009, 0.01, 0.011}));
    // what a step ends at is a row of the state itself; where it began has been one
    EXPECT_EQ(schedule.rows_between(0.002, 0.004), std::vector<double>{0.003});
    EXPECT_TRUE(schedule.row_due({0.004, 0.002}));
    EXPECT_FALSE(schedule.row_due({0.0041, 0.0011}));
    EXPECT_FALSE(schedule.row_due({0.004 + 2e-13, 2e-13}));  // the first step of a solver that has started anew
    EXPECT_TRUE(schedule.row_due({0.05, 0.0001}));
    EXPECT_TRUE(schedule.rows_between(0.0041, 0.0042).empty());
    options.output.history = 0;
    EXPECT_TRUE(Schedule(options, true).rows_between(0, 0.05).empty());
}

TEST(Schedule, RowsAtSteps_AreTheFirstThatReachAMultiple) {
    CaseOptions options = options_until(1);
    options.output.history = 1e-9;
    options.output.rows_at_steps = true;
    const Counts counts = march(options, 0.03);
    EXPECT_EQ(counts.rows, counts.steps);
    EXPECT_EQ(counts.steps, 34);
    EXPECT_TRUE(std::isinf(Schedule(options).next_stop(0.3)));
    options.output.history = 0.1;
    EXPECT_EQ(march(options, 0.03).rows, 10);
    EXPECT_EQ(march(options, 0.03).steps, 34);
}

TEST(Multiples, Decimals_AreTheNearestDoubles) {
    const Multiples multiples(3e-4);
    EXPECT_NE(5 * 3e-4, 0.0015);  // the product of doubles is another one
    EXPECT_EQ(multiples.time(5), 0.0015);
    EXPECT_EQ(multiples.time(10), 3e-3);
    EXPECT_EQ(multiples.next(0.0012), 0.0015);
    EXPECT_EQ(Multiples(0.1).time(3), 0.3);
    EXPECT_EQ(Multiples(0.004 / 20).time(7), 0.0014);
    EXPECT_EQ(Multiples(2.5).time(7), 17.5);
    EXPECT_EQ(Multiples(1e7).time(3), 3e7);
    EXPECT_EQ(Multiples(1e-9).time(123456789), 0.123456789);
    EXPECT_EQ(Multiples(1.0 / 3).time(2), 2.0 / 3);  // no decimal: products
    EXPECT_TRUE(std::isinf(Multiples(0).next(1)));
    EXPECT_FALSE(Multiples(0).contains(0));
}

TEST(Multiples, RoundOff_IsNoDistance) {
    const Multiples multiples(0.1);
    EXPECT_TRUE(multiples.contains(0.1 + 0.2));
    EXPECT_FALSE(multiples.contains(0.3001));
    EXPECT_EQ(multiples.number(0.1 + 0.2), 3);
    EXPECT_EQ(multiples.number(0.3 - 1e-16), 3);
    EXPECT_EQ(multiples.number(0.2999), 2);
}

TEST(Reached, RoundOff_IsNoTime) {
    EXPECT_TRUE(reached(0.3, 3 * 0.1));
    EXPECT_TRUE(reached(3 * 0.1, 0.3));
    EXPECT_FALSE(reached(0.3, 0.3 + 1e-9));
    EXPECT_FALSE(reached(0, 1e-300));
    EXPECT_FALSE(reached(1, INFINITY));
}

}  // namespace
}  // namespace gneiss
