#include "model/load_switch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace gneiss {
namespace {

/// Times that users compute in different ways differ by a few roundings.
constexpr double same_time = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

LoadSwitch::LoadSwitch(std::vector<double> times) {
    assert(std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t); }));
    std::sort(times.begin(), times.end());
    for (double t : times) {
        if (!times_.empty() && t - times_.back() <= same_time * std::abs(t)) {
            times_.back() = t;
        } else {
            times_.push_back(t);
        }
    }
}

std::optional<double> LoadSwitch::next_time(const State& state) const {
    const auto next = std::upper_bound(times_.begin(), times_.end(), state.last_event);
    if (next == times_.end()) return std::nullopt;
    return *next;
}

EventOutcome LoadSwitch::apply(State& accepted) {
    const std::optional<double> next = next_time(accepted);
    if (!next || *next > accepted.t) return EventOutcome::none;
    accepted.last_event = *next;
    return EventOutcome::reinitialise;
}

}  // namespace gneiss
