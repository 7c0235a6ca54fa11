#pragma once
// The one loop over time: steps, events, stops. It works for any system and any integrator.

#include <functional>

#include "system/integrator.hpp"

namespace gneiss {

enum class MarchOutcome { finished, interrupted };

struct March {
    double t_end = 0;  ///< s
    /// The next time after t at which a step has to end exactly (output of fields, checkpoints), s; may be infinite.
    std::function<double(double t)> next_stop;
    /// Called once before the first step, when the integrator has started.
    std::function<void()> after_start;
    /// Called after every accepted step, once its events have been applied. Returns false to stop.
    std::function<bool(const StepReport& step)> after_step;

    /// Applies events that are due, starts the integrator unless it goes on from a checkpoint, and steps to t_end.
    /// @param resumed  true: the integrator has been loaded
    /// @throws whatever a step throws; state is then the last accepted one
    MarchOutcome run(const SemiDiscrete& system, Integrator& integrator, State& state, bool resumed) const;
};

}  // namespace gneiss
