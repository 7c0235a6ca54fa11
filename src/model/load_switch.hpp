#pragma once
// The event of loads and prescribed motions: steps end where an amplitude jumps or has a kink.

#include <vector>

#include "system/event.hpp"

namespace gneiss {

/// Switches every amplitude of a system. It keeps no memory of its own: what has been switched is State::last_event.
class LoadSwitch final : public Event {
public:
    /// @param times  of all force terms and constraints, s, in any order, finite. Times that differ by round-off alone
    /// (0.3 and 0.1 + 0.2) become one, the latest of them: a step between them would be as short as round-off.
    explicit LoadSwitch(std::vector<double> times);

    std::string name() const override { return "load switch"; }

    /// The smallest switch time after state.last_event, s.
    std::optional<double> next_time(const State& state) const override;

    /// Lets one switch that is due happen: state.last_event becomes its time. Before the first step a driver calls it
    /// until next_time() lies in the future.
    /// @return reinitialise, or none if nothing was due at state.t
    EventOutcome apply(State& accepted) override;

    const std::vector<double>& times() const { return times_; }  ///< ascending, s

private:
    std::vector<double> times_;
};

}  // namespace gneiss
