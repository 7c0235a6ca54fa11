#pragma once
// What happens at an instant: load switches now; joint failure, contact search and node splitting use the same words.

#include <optional>
#include <span>
#include <string>

#include "system/state.hpp"

namespace gneiss {

/// What an event leaves for the integrator to do.
enum class EventOutcome {
    none,          ///< carry on
    reinitialise,  ///< forces have jumped: start anew from this state
    resize         ///< the number of unknowns has changed as well
};

class Event {
public:
    virtual ~Event() = default;
    virtual std::string name() const = 0;

    /// The next instant known beforehand, later than state.last_event; steps end there exactly.
    virtual std::optional<double> next_time(const State& state) const = 0;

    /// Whether it looks at every accepted state, not at its own instants alone.
    virtual bool watches() const { return false; }
    /// Whether look() may do anything in this state, whose velocities need not be there: integrators that can save work
    /// where nobody sees a step ask for no more.
    virtual bool stirred(const State& state) const {
        (void)state;
        return true;
    }
    /// After every accepted step of an event that watches, and before the first one.
    virtual EventOutcome look(State& accepted) {
        (void)accepted;
        return EventOutcome::none;
    }

    /// What rises to zero where the event happens, at the next look(); below zero: it does not happen yet, and at -1 or
    /// below nothing is known of when it will. None: there is nothing to search for.
    virtual bool has_indicator() const { return false; }
    virtual double indicator(const State&) const { return -1; }
    /// > 0: the event may be found with an indicator up to this. A step that ends beyond it is taken again, shorter.
    virtual double indicator_tolerance() const { return 0; }

    /// Finds anew in this state what it has found on the way and no checkpoint holds (a search of contacts). Called
    /// where a checkpoint is written and where one is taken up: both runs then go on alike.
    virtual EventOutcome renew(const State& accepted) {
        (void)accepted;
        return EventOutcome::none;
    }

    /// Changes the accepted state: the only place where topology may change.
    virtual EventOutcome apply(State& accepted) = 0;
};

}  // namespace gneiss
