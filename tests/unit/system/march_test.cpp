#include "system/march.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "base/errors.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What happened, in order.
using Diary = std::vector<std::string>;

std::string number(double t) {
    std::string text = std::to_string(t);
    return text.substr(0, text.find_last_not_of('0') + 1);
}

/// Happens at given instants with a given outcome; keeps its own place, apart from other events.
class ScriptedEvent final : public Event {
public:
    ScriptedEvent(std::string name, std::vector<double> times, EventOutcome outcome, Diary& diary)
        : name_(std::move(name)), times_(std::move(times)), outcome_(outcome), diary_(diary) {}
    std::string name() const override { return name_; }
    std::optional<double> next_time(const State&) const override {
        return next_ < times_.size() ? std::optional(times_[next_]) : std::nullopt;
    }
    EventOutcome apply(State& accepted) override {
        diary_.push_back(name_ + " at " + number(accepted.t));
        accepted.last_event = times_[next_++];
        return outcome_;
    }

private:
    std::string name_;
    std::vector<double> times_;
    EventOutcome outcome_;
    Diary& diary_;
    std::size_t next_ = 0;
};

/// Has events and nothing else.
class EventsOnly final : public SemiDiscrete {
public:
    std::vector<std::unique_ptr<Event>> list;
    double longest = infinity;  ///< step that sees its loads, between 2 and 3 s; s

    double longest_step(double t) const override { return t >= 3 ? infinity : std::max(longest, 2 - t); }
    Layout layout() const override { return {}; }
    State initial_state() const override { return {}; }
    std::span<const double> lumped_mass() const override { return {}; }
    const Damping& damping() const override { return damping_; }
    std::span<const Constraint> constraints() const override { return {}; }
    void constraint_values(double, double, std::span<double>) const override {}
    bool force_depends_on_velocity() const override { return false; }
    void force(const State&, const Trial&, std::span<double>) const override {}
    void force_and_update(const State&, const Trial&, std::span<double>, std::span<double>,
                          std::span<double>) const override {}
    void external_force(const Trial&, std::span<double>) const override {}
    void internal_rate(const State&, const Trial&, std::span<double>) const override {}
    void internal_weights(std::span<double>) const override {}
    double smallest_length() const override { return 1; }
    FrequencyBound frequency_bound(const State&) const override { return {1, 0}; }
    StoredEnergies stored_energies(const State&) const override { return {}; }
    void add_path_energies(const State&, State&) const override {}
    std::span<const std::unique_ptr<Event>> events() const override { return list; }

private:
    Damping damping_;
};

/// Steps of at most 1 s that end at t_stop; writes what it is asked to do.
class ScriptedIntegrator final : public Integrator {
public:
    explicit ScriptedIntegrator(Diary& diary) : diary_(diary) {}
    double fails_at = infinity;

    std::string name() const override { return "scripted"; }
    void start(const SemiDiscrete&, State& state, StartReason why) override {
        const char* const reasons[] = {"fresh", "reinitialise", "resize", "recover"};
        last_ = state.t;
        diary_.push_back(std::string("start ") + reasons[static_cast<int>(why)] + " at " + number(state.t));
    }
    StepReport advance(const SemiDiscrete&, State& state, double t_stop) override {
        const double before = state.t;
        if (before >= fails_at) throw RecoverableError("told to fail");
        EXPECT_EQ(before, last_) << "a step begins where the integrator stands";
        state.t = last_ = std::min(before + 1, t_stop);
        diary_.push_back("step to " + number(state.t));
        return {state.t, state.t - before, 0, 1};
    }
    /// Two steps in one go, as far as that is allowed and no event is stirred.
    StepReport advance_unseen(const SemiDiscrete& system, State& state, double t_stop, double t_look) override {
        StepReport report = advance(system, state, t_stop);
        if (state.t < std::min(t_stop, t_look) && !system.stirred(state)) report = advance(system, state, t_stop);
        diary_.push_back("seen at " + number(state.t));
        return report;
    }
    double kinetic_energy(const SemiDiscrete&, const State&) const override { return 0; }
    std::span<const double> reactions(const SemiDiscrete&, const State&) override { return {}; }
    IntegratorMemory save() const override { return {{"t", {last_}}}; }
    void load(const SemiDiscrete&, State& state, const IntegratorMemory& memory) override {
        last_ = memory.at("t")[0];
        EXPECT_EQ(last_, state.t);
    }

private:
    Diary& diary_;
    double last_ = 0;  ///< where the last step has ended
};

class MarchOverTime : public testing::Test {
protected:
    void add_event(const std::string& name, std::vector<double> times, EventOutcome outcome) {
        system.list.push_back(std::make_unique<ScriptedEvent>(name, std::move(times), outcome, diary));
    }
    MarchOutcome run(bool resumed = false) { return march.run(system, integrator, state, resumed); }

    Diary diary;
    EventsOnly system;
    ScriptedIntegrator integrator{diary};
    State state;
    March march{.t_end = 2.5, .next_stop = {}, .next_look = {}, .after_start = {}, .after_step = {}};
};

TEST_F(MarchOverTime, NextLook_StepsBeforeItPassUnseen) {
    march.next_look = [](double t) { return t < 1 ? 1.0 : infinity; };
    run();
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "step to 1.", "seen at 1.", "step to 2.", "step to 2.5",
                                   "seen at 2.5"));
}

TEST_F(MarchOverTime, NextLook_BesideAnEventThatWatches_ItLooksWhereItIsStirredOrStepsAreSeen) {
    class Watcher final : public Event {
    public:
        std::string name() const override { return "watcher"; }
        std::optional<double> next_time(const State&) const override { return {}; }
        explicit Watcher(Diary& diary) : diary_(diary) {}
        EventOutcome apply(State&) override { return EventOutcome::none; }
        bool watches() const override { return true; }
        bool stirred(const State& state) const override { return state.t == 2; }
        EventOutcome look(State& state) override {
            diary_.push_back("look at " + number(state.t));
            return state.t == 2 ? EventOutcome::resize : EventOutcome::none;
        }

    private:
        Diary& diary_;
    };
    system.list.push_back(std::make_unique<Watcher>(diary));
    march.next_look = [](double) { return infinity; };
    run();
    EXPECT_THAT(diary, ElementsAre("look at 0.", "start fresh at 0.", "step to 1.", "step to 2.", "seen at 2.",
                                   "look at 2.", "start resize at 2.", "step to 2.5", "seen at 2.5", "look at 2.5"));
}

TEST_F(MarchOverTime, BeforeEvents_IsCalledBetweenAStepAndTheEventsAtItsEnd) {
    add_event("jump", {1.5}, EventOutcome::reinitialise);
    march.before_events = [this](const StepReport& step) { diary.push_back("before events at " + number(step.t)); };
    march.t_end = 1.75;
    run();
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "step to 1.", "before events at 1.", "step to 1.5",
                                   "before events at 1.5", "jump at 1.5", "start reinitialise at 1.5", "step to 1.75",
                                   "before events at 1.75"));
}

TEST_F(MarchOverTime, NothingSpecial_StepsToTheEnd) {
    EXPECT_EQ(run(), MarchOutcome::finished);
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "step to 1.", "step to 2.", "step to 2.5"));
    EXPECT_EQ(state.t, 2.5);
}

TEST_F(MarchOverTime, Stops_EndStepsExactly) {
    march.next_stop = [](double t) { return t < 0.75 ? 0.75 : t < 1.25 ? 1.25 : infinity; };
    run();
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "step to 0.75", "step to 1.25", "step to 2.25", "step to 2.5"));
}

TEST_F(MarchOverTime, StopAndEventEqualButForRoundOff_EndOneStep) {
    const double sum = 0.1 + 0.2;  // differs from 0.3 by a rounding
    ASSERT_NE(sum, 0.3);
    march.t_end = 1;
    march.next_stop = [=](double t) { return t < 0.3 ? 0.3 : infinity; };
    add_event("jump", {sum}, EventOutcome::reinitialise);
    run();
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "step to 0.3", "jump at 0.3", "start reinitialise at 0.3",
                                   "step to 1."));
}

TEST_F(MarchOverTime, EventsDueAtTheStart_HappenBeforeTheIntegratorStarts) {
    add_event("early", {-1, 0}, EventOutcome::reinitialise);
    run();
    EXPECT_EQ(diary[0], "early at 0.");
    EXPECT_EQ(diary[1], "early at 0.");
    EXPECT_EQ(diary[2], "start fresh at 0.");
    EXPECT_EQ(std::count(diary.begin(), diary.end(), "start reinitialise at 0."), 0);
}

TEST_F(MarchOverTime, EventInsideAStep_EndsTheStepAndRestartsTheIntegrator) {
    add_event("jump", {1.5}, EventOutcome::reinitialise);
    run();
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "step to 1.", "step to 1.5", "jump at 1.5",
                                   "start reinitialise at 1.5", "step to 2.5"));
    EXPECT_EQ(state.last_event, 1.5);
}

TEST_F(MarchOverTime, EventWithoutConsequence_DoesNotRestart) {
    add_event("look", {1.5}, EventOutcome::none);
    run();
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "step to 1.", "step to 1.5", "look at 1.5", "step to 2.5"));
}

TEST_F(MarchOverTime, EventsAtOneInstant_AllHappenAndTheStrongestCounts) {
    add_event("look", {1}, EventOutcome::none);
    add_event("split", {1}, EventOutcome::resize);
    add_event("jump", {1}, EventOutcome::reinitialise);
    run();
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "step to 1.", "look at 1.", "split at 1.", "jump at 1.",
                                   "start resize at 1.", "step to 2.", "step to 2.5"));
}

TEST_F(MarchOverTime, EventAtTheEnd_StillHappensAndLaterOnesDoNot) {
    add_event("last", {2.5, 3}, EventOutcome::reinitialise);
    run();
    EXPECT_EQ(std::count(diary.begin(), diary.end(), "last at 2.5"), 1);
    EXPECT_EQ(state.t, 2.5);
}

TEST_F(MarchOverTime, Callbacks_SeeTheStartOnceAndEveryStepAfterItsEvents) {
    add_event("jump", {1.5}, EventOutcome::reinitialise);
    march.after_start = [&] { diary.push_back("after start"); };
    march.after_step = [&](const StepReport& step) {
        diary.push_back("after step " + number(step.dt));
        return true;
    };
    EXPECT_EQ(run(), MarchOutcome::finished);
    EXPECT_THAT(diary, ElementsAre("start fresh at 0.", "after start", "step to 1.", "after step 1.", "step to 1.5",
                                   "jump at 1.5", "start reinitialise at 1.5", "after step 0.5", "step to 2.5",
                                   "after step 1."));
}

TEST_F(MarchOverTime, AfterStepSaysStop_RunIsInterruptedThere) {
    march.after_step = [](const StepReport& step) { return step.t < 2; };
    EXPECT_EQ(run(), MarchOutcome::interrupted);
    EXPECT_EQ(state.t, 2);
}

TEST_F(MarchOverTime, Resumed_NeitherStartsNorRepeatsEvents) {
    add_event("jump", {1.5}, EventOutcome::reinitialise);
    state.t = 0.5;
    integrator.load(system, state, {{"t", {0.5}}});
    march.after_start = [&] { diary.push_back("after start"); };
    run(true);
    EXPECT_THAT(diary,
                ElementsAre("after start", "step to 1.5", "jump at 1.5", "start reinitialise at 1.5", "step to 2.5"));
}

/// Happens when its indicator has risen to zero, as often as that is told.
class Threshold final : public Event {
public:
    Threshold(std::vector<double> instants, bool tells, std::vector<double>& happened)
        : instants_(std::move(instants)), tells_(tells), happened_(happened) {}
    std::string name() const override { return "threshold"; }
    std::optional<double> next_time(const State&) const override { return {}; }
    EventOutcome apply(State&) override { return EventOutcome::none; }
    bool watches() const override { return true; }
    bool has_indicator() const override { return true; }
    /// A square root of time: straight lines do not find it at once.
    double indicator(const State& state) const override {
        if (next_ == instants_.size()) return -1;
        const double value = std::sqrt(state.t / instants_[next_]) - 1;
        return value < 0 && !tells_ ? -1 : jumps ? (value < 0 ? -0.9 : 1e-3) : value;
    }
    bool jumps = false;  ///< by nearly 1, and by little beyond: lines are no use
    EventOutcome look(State& state) override {
        if (indicator(state) < 0) return EventOutcome::none;
        happened_.push_back(state.t);
        ++next_;
        return EventOutcome::reinitialise;
    }

private:
    std::vector<double> instants_;
    bool tells_;
    std::vector<double>& happened_;
    std::size_t next_ = 0;
};

class MarchToThreshold : public MarchOverTime, public testing::WithParamInterface<bool> {
protected:
    std::vector<double> happened;
    std::size_t n_rejected = 0, n_steps = 0, n_force = 0, n_force_searching = 0;
    void watch(std::vector<double> instants) {
        system.list.push_back(std::make_unique<Threshold>(std::move(instants), GetParam(), happened));
        march.after_step = [this](const StepReport& step) {
            n_rejected += step.n_rejected;
            n_steps += step.n_steps;
            n_force += step.n_force;
            n_force_searching += step.n_force_searching;
            return true;
        };
    }
};
INSTANTIATE_TEST_SUITE_P(Indicators, MarchToThreshold, testing::Bool(), [](const auto& instance) {
    return std::string(instance.param ? "Tell" : "TellNothingBefore");
});

TEST_P(MarchToThreshold, WithATolerance_HappensWithinIt_NeverBefore) {
    const std::vector<double> instants{0.3337, 0.7, 1.9};
    watch(instants);
    march.event_tolerance = 1e-6;
    run();
    ASSERT_EQ(happened.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GE(happened[i], instants[i]);
        EXPECT_LE(happened[i], instants[i] + 1e-6);
    }
    EXPECT_EQ(state.t, 2.5);
    EXPECT_GT(n_rejected, 3u);
    // halving takes log2(1/1e-6) = 20 steps for each
    EXPECT_LE(n_steps + n_rejected, 3u * 22 + 4);
    // one evaluation to a step
    EXPECT_EQ(n_force, n_steps);
    EXPECT_EQ(n_force_searching, n_rejected);
    EXPECT_EQ(std::ranges::count_if(diary, [](const std::string& entry) { return entry.starts_with("step"); }),
              static_cast<std::ptrdiff_t>(n_steps + n_rejected));
}

TEST_P(MarchToThreshold, IndicatorThatJumps_IsFoundByHalving) {
    watch({0.3337});
    static_cast<Threshold&>(*system.list.back()).jumps = true;
    march.event_tolerance = 1e-6;
    run();
    ASSERT_EQ(happened.size(), 1u);
    EXPECT_GE(happened[0], 0.3337);
    EXPECT_LE(happened[0], 0.3337 + 1e-6);
    EXPECT_LE(n_steps + n_rejected, 2u * 22 + 4);
}

TEST_P(MarchToThreshold, ToleranceBelowRoundOff_EndsNevertheless) {
    watch({0.3337});
    march.event_tolerance = 1e-30;
    run();
    ASSERT_EQ(happened.size(), 1u);
    EXPECT_NEAR(happened[0], 0.3337, 1e-12);
    EXPECT_LE(n_steps + n_rejected, 2u * 45 + 4);  // halvings and lines in turn
}

TEST_P(MarchToThreshold, WithoutATolerance_HappensAtTheEndOfTheStep) {
    watch({0.3337, 1.9});
    run();
    EXPECT_EQ(happened, (std::vector<double>{1, 2}));
    EXPECT_EQ(n_rejected, 0u);
}

TEST_F(MarchOverTime, FailedStep_LeavesTheLastAcceptedState) {
    integrator.fails_at = 2;
    EXPECT_THROW(run(), RecoverableError);
    EXPECT_EQ(state.t, 2);
}

TEST_F(MarchOverTime, StepsThatPassOverALoad_AreToldOfOnce) {
    std::vector<std::string> warnings;
    march.after_step = [&](const StepReport& step) {
        if (!step.warning.empty()) warnings.push_back(step.warning);
        return true;
    };
    system.longest = 0.25;
    march.t_end = 5;
    run();
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_THAT(warnings[0], testing::HasSubstr("a step of 1 s near t = 2 s is longer than 0.25 s"));
    warnings.clear();
    state = {};
    system.longest = 1;
    run();
    EXPECT_THAT(warnings, testing::IsEmpty());
}

}  // namespace
}  // namespace gneiss
