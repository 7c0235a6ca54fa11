#include "system/march.hpp"

#include <algorithm>
#include <initializer_list>
#include <iomanip>
#include <limits>
#include <sstream>

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

/// Searches for the instant at which an indicator rises to zero, by steps that are taken again: to within a time, or
/// until it is no larger than its event allows.
class EventSearch {
public:
    EventSearch(const SemiDiscrete& system, Integrator& integrator, double tolerance)
        : system_(system), integrator_(integrator), tolerance_(tolerance) {}

    /// Whether there is anything to search for.
    bool wanted() const {
        return std::ranges::any_of(system_.events(), [&](const auto& event) { return searched(*event); });
    }

    /// A step as advance() takes it, which ends at the latest where an event is known to have happened.
    StepReport advance(State& state, double stop) {
        const double before = indicator_of(state);
        if (!(before < 0)) {
            crossed_.reset();
            return integrator_.advance(system_, state, stop);
        }
        std::size_t n_rejected = 0, n_force = 0;  // of trials thrown away
        for (;;) {
            const State start = state;
            const IntegratorMemory memory = integrator_.save();
            const double way = crossed_ ? *crossed_ - start.t : 0;
            StepReport step = integrator_.advance(system_, state, crossed_ ? guess(start.t, before) : stop);
            step.n_rejected += n_rejected;
            const double now = indicator_of(state);
            if (now <= allowed_ || is_short(start.t, state.t)) {
                if (now >= 0 || (crossed_ && !(state.t < *crossed_))) crossed_.reset();
                if (crossed_) slow_ = *crossed_ - state.t > 0.5 * way;
                step.n_force_searching = n_force;
                return step;
            }
            if (!crossed_) whole_ = state.t - start.t;
            slow_ = crossed_ && state.t - start.t > 0.5 * way;
            crossed_ = state.t;
            after_ = now;
            n_rejected = step.n_rejected + 1;
            n_force += step.n_force;
            state = start;
            integrator_.load(system_, state, memory);
        }
    }

private:
    bool searched(const Event& event) const {
        return event.has_indicator() && (tolerance_ > 0 || event.indicator_tolerance() > 0);
    }
    /// The largest indicator of the events that are searched for; `allowed_` is what that event allows.
    double indicator_of(const State& state) {
        double largest = -1;
        allowed_ = below_zero;
        for (const auto& event : system_.events())
            if (searched(*event))
                if (const double indicator = event->indicator(state); indicator > largest) {
                    largest = indicator;
                    allowed_ = tolerance_ > 0 ? below_zero : event->indicator_tolerance();
                }
        return largest;
    }

    /// No step has to be shorter than the tolerance, or than round-off lets it be; where it is the indicator that has
    /// one, than a ten-thousandth of the step that was too long: then the indicator jumps.
    bool is_short(double from, double to) const {
        return to - from <= (tolerance_ > 0 ? tolerance_ : 1e-4 * whole_) || reached(from, to);
    }

    /// Where a straight line says that it happens, but not closer than half the tolerance to either end; the middle
    /// where nothing is known of before, or where the last line has not halved what is left. An indicator with a
    /// tolerance is aimed at half of that.
    double guess(double t, double before) const {
        if (is_short(t, *crossed_)) return *crossed_;
        const double way = *crossed_ - t, room = tolerance_ > 0 ? std::min(0.5, 0.5 * tolerance_ / way) : 0.01;
        const double target = 0.5 * std::max(allowed_, 0.0);
        const bool straight = before > -1 && after_ > 0 && !slow_;
        return t + way * std::clamp(straight ? (before - target) / (before - after_) : 0.5, room, 1 - room);
    }

    static constexpr double below_zero = -std::numeric_limits<double>::min();

    const SemiDiscrete& system_;
    Integrator& integrator_;
    double tolerance_;
    std::optional<double> crossed_;  ///< an instant at which it will have happened, s
    double after_ = 0;               ///< the indicator there
    double allowed_ = 0;             ///< an indicator up to this is near enough
    double whole_ = 0;               ///< length of the step that was first found too long, s
    bool slow_ = false;              ///< the last trial has left more than half of the way to it
};

/// Tells once of steps that pass over a load: of those that are given, or follow from stability alone.
class LoadWatch {
public:
    explicit LoadWatch(const SemiDiscrete& system) : system_(system) {}

    /// @param from  where the first step of the report began, s
    void look(double from, StepReport& step) {
        constexpr double round_off = 1e-6;
        for (double t = from; !told_ && t < step.t;) {
            const double longest = system_.longest_step(t);
            if (step.dt > (1 + round_off) * longest) {
                told_ = true;
                std::ostringstream text;
                text << (step.warning.empty() ? "" : "; ") << std::setprecision(3) << "a step of " << step.dt
                     << " s near t = " << std::setprecision(6) << t << " s is longer than " << std::setprecision(3)
                     << longest << " s, within which a load or a support varies: what it does in between may be "
                     << "missed; take shorter steps";
                step.warning += text.str();
            }
            t += std::max(longest, step.dt);
        }
    }

private:
    const SemiDiscrete& system_;
    bool told_ = false;
};

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

EventOutcome renew_events(const SemiDiscrete& system, const State& state) {
    EventOutcome strongest = EventOutcome::none;
    for (const auto& event : system.events()) strongest = std::max(strongest, event->renew(state));
    return strongest;
}

MarchOutcome March::run(const SemiDiscrete& system, Integrator& integrator, State& state, bool resumed) const {
    const Watch watch(integrator, within_step);
    if (!resumed) {
        apply_due_events(system, state);
        integrator.start(system, state, StartReason::fresh);
    }
    if (after_start) after_start();
    EventSearch search(system, integrator, event_tolerance);
    const bool searches = search.wanted();
    const bool unseen = next_look && !searches;
    LoadWatch loads(system);
    try {
        while (state.t < t_end) {
            const double planned = next_stop ? next_stop(state.t) : t_end;
            const double stop = first_instant({t_end, planned, next_event_time(system, state)});
            const double from = state.t;
            StepReport step = searches ? search.advance(state, stop)
                              : unseen ? integrator.advance_unseen(system, state, stop, next_look(state.t))
                                       : integrator.advance(system, state, stop);
            if (before_events) before_events(step);
            if (!integrator.is_static()) loads.look(from, step);
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
