#include "model/load_switch.hpp"

#include <gmock/gmock.h>

namespace gneiss {
namespace {

using testing::ElementsAre;

TEST(LoadSwitch, NextTime_FreshState_IsTheFirstSwitchEvenAtZero) {
    const LoadSwitch event({2.0, 0.0, 1.0, 2.0});
    EXPECT_THAT(event.times(), ElementsAre(0.0, 1.0, 2.0));
    State state;
    EXPECT_EQ(event.next_time(state), 0.0);
}

TEST(LoadSwitch, NextTime_AfterASwitch_IsTheFollowingOne) {
    const LoadSwitch event({0.0, 1.0});
    State state;
    state.t = 5;  // what counts is which switches have happened, not the clock
    state.last_event = 0;
    EXPECT_EQ(event.next_time(state), 1.0);
    state.last_event = 1;
    EXPECT_EQ(event.next_time(state), std::nullopt);
}

TEST(LoadSwitch, NextTime_NoSwitches_IsNever) { EXPECT_EQ(LoadSwitch({}).next_time(State{}), std::nullopt); }

TEST(LoadSwitch, Apply_StepEndedAtTheSwitch_MovesLastEventToItAndAsksForANewStart) {
    LoadSwitch event({0.25, 0.5});
    State state;
    state.t = 0.25;
    EXPECT_EQ(event.apply(state), EventOutcome::reinitialise);
    EXPECT_EQ(state.last_event, 0.25);
    EXPECT_EQ(event.apply(state), EventOutcome::none);
    EXPECT_EQ(state.last_event, 0.25);
}

TEST(LoadSwitch, Apply_BeforeTheFirstStep_LetsEverySwitchUpToTheStartHappen) {
    LoadSwitch event({-1.0, 0.0, 1.0});
    State state;
    while (event.next_time(state) && *event.next_time(state) <= state.t) event.apply(state);
    EXPECT_EQ(state.last_event, 0.0);
    EXPECT_EQ(event.next_time(state), 1.0);
}

TEST(LoadSwitch, Times_EqualButForRoundOff_AreOneSwitchAtTheLatest) {
    const double sum = 0.1 + 0.2;
    ASSERT_NE(sum, 0.3);
    EXPECT_THAT(LoadSwitch({sum, 0.3}).times(), ElementsAre(std::max(sum, 0.3)));
    const double later = 0.3 * (1 + 1e-12);  // far above round-off: two switches
    EXPECT_THAT(LoadSwitch({later, 0.3}).times(), ElementsAre(0.3, later));
}

}  // namespace
}  // namespace gneiss
