#pragma once
// The one loop over time: steps, events, stops. It works for any system and any integrator.

#include <cmath>
#include <functional>

#include "system/integrator.hpp"

namespace gneiss {

/// Whether t has come to `time`, or fails to by round-off alone. Times that are one instant to the user, 3 * 0.1 and
/// 0.3 say, must not have a step between them: it would be as short as round-off, and rates are divided by it.
inline bool reached(double t, double time) {
    constexpr double round_off = 1e-12;  // thousands of eps: sums and products of a deck's numbers
    return time - t <= round_off * std::abs(t);
}

/// Lets every event happen that is due at state.t, and those look at the state that watch it, in their order.
/// @return the strongest outcome
EventOutcome apply_due_events(const SemiDiscrete& system, State& state);

/// Event::renew() of all of them.
/// @return the strongest outcome
EventOutcome renew_events(const SemiDiscrete& system, const State& state);

enum class MarchOutcome { finished, interrupted };

struct March {
    double t_end = 0;  ///< s
    /// The next time after t at which a step has to end (output of fields, checkpoints), s; may be infinite. Where it
    /// differs from t_end or from an event by round-off alone, the step ends at the last of them.
    std::function<double(double t)> next_stop;
    /// The instant after t at which after_step() wants to see the state next, s: steps before it may pass unseen.
    /// Without this it sees every step.
    std::function<double(double t)> next_look;
    /// > 0: where an event's indicator rises above zero within a step, the step is taken again, shorter, until the
    /// event is known to happen within this time, s. 0: such an event happens at the end of the step.
    double event_tolerance = 0;
    /// Called once before the first step, when the integrator has started.
    std::function<void()> after_start;
    /// Called after every such step before its events are applied: while Integrator::state_within() is to be had.
    std::function<void(const StepReport& step)> before_events = {};
    /// Called after every accepted step that is not passed unseen, once its events have been applied. Returns false to
    /// stop.
    std::function<bool(const StepReport& step)> after_step;
    /// Called in every iteration of steps that iterate. Returns false to stop before the step is done.
    std::function<bool(const StepProgress& progress)> within_step = {};

    /// Applies events that are due, starts the integrator unless it goes on from a checkpoint, and steps to t_end.
    /// @param resumed  true: the integrator has been loaded
    /// @throws whatever a step throws; state is then the last accepted one
    MarchOutcome run(const SemiDiscrete& system, Integrator& integrator, State& state, bool resumed) const;
};

}  // namespace gneiss
