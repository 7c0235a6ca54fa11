#pragma once
// When bodies come to touch one another, or a wall, and when they part: instants that steps can be made to end at.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contact/walls.hpp"
#include "system/event.hpp"

namespace gneiss {

/// An event whenever two bodies, or a body and a wall, begin to touch or have parted. It changes nothing, but forces
/// are less smooth there: integrators start anew. Faces of cracks in one body are not among them.
class Touches final : public Event {
public:
    /// @param walls  null: none
    Touches(const Contact& contact, const Walls* walls);

    std::string name() const override { return "touches"; }
    std::optional<double> next_time(const State&) const override { return std::nullopt; }
    EventOutcome apply(State&) override { return EventOutcome::none; }
    bool watches() const override { return true; }
    EventOutcome look(State& accepted) override;
    bool has_indicator() const override { return true; }
    double indicator(const State& state) const override;

    struct Record {
        std::size_t n_touched = 0, n_parted = 0;
        std::optional<double> first_touch, last_parting;  ///< s
    };
    const Record& record() const { return record_; }
    /// What touches now, ascending.
    const std::vector<Touching>& touching() const { return touching_; }

    std::vector<double> save() const;
    /// @throws InputError if save() has not written it
    void load(const std::vector<double>& saved);

private:
    Gaps gaps(const State& state) const;

    const Contact& contact_;
    const Walls* walls_;
    double range_;     ///< within which pairs are known, m
    double rounding_;  ///< of positions, m: no nearer is neither touching nor apart
    std::vector<Touching> touching_;
    Record record_;
};

}  // namespace gneiss
