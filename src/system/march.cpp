#include "system/march.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>

namespace gneiss {
namespace {

double next_event_time(const SemiDiscrete& system, const State& state) {
    double next = std::numeric_limits<double>::infinity();
    for (const auto& event : system.events()) next = std::min(next, event->next_time(state).value_or(next));
    return next;
}

/// Watches an integrator as long as it lives.
class Watch {
public:
    Watch(Integrator& integrator, const std::function<bool(const StepProgress&)>& watcher) : integrator_(integrator) {
        integrator_.watch(watcher);
    }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
    ~Watch() { integrator_.watch({}); }

private:
    Integrator& integrator_;
};

/// The first of some times, or the last of those that are the same instant.
double first_instant(std::initializer_list<double> times) {
    double first = std::min(times);
    for (const double time : times)
        if (reached(first, time)) first = std::max(first, time);
    return first;
}

}  // namespace

EventOutcome apply_due_events(const SemiDiscrete& system, State& state) {
    EventOutcome strongest = EventOutcome::none;
    for (const auto& event : system.events()) {
        for (auto next = event->next_time(state); next && *next <= state.t; next = event->next_time(state))
            strongest = std::max(strongest, event->apply(state));
        if (event->watches()) strongest = std::max(strongest, event->look(state));
    }
    return strongest;
}

MarchOutcome March::run(const SemiDiscrete& system, Integrator& integrator, State& state, bool resumed) const {
    const Watch watch(integrator, within_step);
    if (!resumed) {
        apply_due_events(system, state);
        integrator.start(system, state, StartReason::fresh);
    }
    if (after_start) after_start();
    const bool unseen =
        next_look && std::ranges::none_of(system.events(), [](const auto& event) { return event->n_indicators() > 0; });
    try {
        while (state.t < t_end) {
            const double planned = next_stop ? next_stop(state.t) : t_end;
            const double stop = first_instant({t_end, planned, next_event_time(system, state)});
            const StepReport step = unseen ? integrator.advance_unseen(system, state, stop, next_look(state.t))
                                           : integrator.advance(system, state, stop);
            switch (apply_due_events(system, state)) {
                case EventOutcome::none:
                    break;
                case EventOutcome::reinitialise:
                    integrator.start(system, state, StartReason::reinitialise);
                    break;
                case EventOutcome::resize:
                    integrator.start(system, state, StartReason::resize);
                    break;
            }
            if (after_step && !after_step(step) && state.t < t_end) return MarchOutcome::interrupted;
        }
    } catch (const Interrupted&) {
        return MarchOutcome::interrupted;
    }
    return MarchOutcome::finished;
}

}  // namespace gneiss
