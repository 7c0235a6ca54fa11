#include "contact/touches.hpp"

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"

namespace gneiss {

Touches::Touches(const Contact& contact, const Walls* walls)
    : contact_(contact), walls_(walls), range_(contact.options().skin) {
    double farthest = 0;
    for (const double x : contact.bodies().reference()) farthest = std::max(farthest, std::abs(x));
    constexpr double digits = 1e-14;  // some fifty units in the last place
    rounding_ = digits * farthest;
}

Gaps Touches::gaps(const State& state) const {
    Gaps gaps = contact_.gaps(state.u);
    if (walls_ != nullptr) gaps.merge(walls_->gaps(state.t, state.u));
    return gaps;
}

double Touches::indicator(const State& state) const {
    const Gaps now = gaps(state);
    double largest = -1;
    for (const auto& [pair, gap] : now) {
        const bool touches = std::ranges::binary_search(touching_, pair);
        largest = std::max(largest, ((touches ? gap : -gap) - rounding_) / range_);
    }
    for (const Touching& pair : touching_)
        if (!now.contains(pair)) largest = std::max(largest, 1.0);  // too far apart to be looked for
    return largest;
}

EventOutcome Touches::look(State& accepted) {
    std::vector<Touching> now;
    for (const auto& [pair, gap] : gaps(accepted)) {
        const bool touched = std::ranges::binary_search(touching_, pair);
        if (touched ? gap < rounding_ : gap <= -rounding_) now.push_back(pair);
    }
    const auto count_missing = [](const std::vector<Touching>& some, const std::vector<Touching>& others) {
        return static_cast<std::size_t>(std::ranges::count_if(
            some, [&](const Touching& pair) { return !std::ranges::binary_search(others, pair); }));
    };
    const std::size_t touched = count_missing(now, touching_), parted = count_missing(touching_, now);
    if (touched > 0 && !record_.first_touch) record_.first_touch = accepted.t;
    if (parted > 0) record_.last_parting = accepted.t;
    record_.n_touched += touched;
    record_.n_parted += parted;
    touching_ = std::move(now);
    return touched + parted > 0 ? EventOutcome::reinitialise : EventOutcome::none;
}

std::vector<double> Touches::save() const {
    std::vector<double> saved{static_cast<double>(record_.n_touched), static_cast<double>(record_.n_parted),
                              record_.first_touch.value_or(-1), record_.last_parting.value_or(-1)};
    for (const auto& [one, other] : touching_) saved.insert(saved.end(), {double(one), double(other)});
    return saved;
}

void Touches::load(const std::vector<double>& saved) {
    constexpr std::size_t n_front = 4;
    if (saved.size() < n_front || saved.size() % 2 != 0) throw InputError("touches", "of the checkpoint are damaged");
    record_ = {static_cast<std::size_t>(saved[0]), static_cast<std::size_t>(saved[1]), std::nullopt, std::nullopt};
    if (saved[2] >= 0) record_.first_touch = saved[2];
    if (saved[3] >= 0) record_.last_parting = saved[3];
    touching_.clear();
    for (std::size_t i = n_front; i < saved.size(); i += 2)
        touching_.emplace_back(static_cast<std::int32_t>(saved[i]), static_cast<std::int32_t>(saved[i + 1]));
}

}  // namespace gneiss
