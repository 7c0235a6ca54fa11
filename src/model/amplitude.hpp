#pragma once
// Factors on loads and prescribed motions against time.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/formula.hpp"
#include "model/options.hpp"

namespace gneiss {

struct AmplitudeCourse;

/// A factor without unit against time, and for expressions against position.
///
/// A jump happens at an event and not at an instant: it counts as passed once the time of the last event has reached it
/// (State::last_event). A step that ends exactly at a jump still sees the left limit; the step after the event starts
/// from the right one. A comparison with t would let round-off, or a stage of an integrator, decide.
/// An expression whose course is known does the same; any other is taken as it stands.
class Amplitude {
public:
    /// The amplitude at one instant. Where it does not depend on position it has been evaluated once.
    class Instant {
    public:
        /// @param x, y  reference position, m
        double operator()(double x, double y) const {
            return amplitude_->depends_on_position_ ? amplitude_->value(t_, last_event_, x, y) : value_;
        }

    private:
        friend class Amplitude;
        Instant(const Amplitude& amplitude, double t, double last_event)
            : amplitude_(&amplitude),
              t_(t),
              last_event_(last_event),
              value_(amplitude.depends_on_position_ ? 0 : amplitude.value(t, last_event)) {}

        const Amplitude* amplitude_;
        double t_, last_event_, value_;
    };

    /// @throws InputError with empty `where` and every problem: a time or value that is not finite, a ramp that does
    /// not end after its start, an empty table, times that descend, more than two equal times, a faulty expression
    /// @param course  of an expression, as course_of() finds it; null: nobody has looked
    explicit Amplitude(const AmplitudeOptions& options, std::shared_ptr<const AmplitudeCourse> course = nullptr);

    /// @param t           s
    /// @param last_event  s; jumps at or before it have happened
    /// @param x, y        reference position, m
    /// @throws InputError if an expression is not finite there
    double value(double t, double last_event, double x = 0, double y = 0) const {
        return expression_ ? (*expression_)(x, y, within_piece(t, last_event)) : table_value(t, last_event);
    }
    /// Valid as long as the amplitude is.
    Instant at(double t, double last_event) const { return {*this, t, last_event}; }

    bool depends_on_position() const { return depends_on_position_; }
    bool has_jump() const;

    /// Instants of jumps and kinks, ascending, s.
    std::vector<double> switch_times() const;

    /// True if both are the same function as written: a ramp equals the table that says the same.
    friend bool operator==(const Amplitude& a, const Amplitude& b) {
        return a.points_ == b.points_ && a.text_ == b.text_;
    }

private:
    struct Point {
        double t, value;
        friend bool operator==(const Point&, const Point&) = default;
    };

    double table_value(double t, double last_event) const;
    /// t, or the nearest instant between the switches that have happened and those that have not.
    double within_piece(double t, double last_event) const;

    std::vector<Point> points_;        ///< linear between them, held outside; two equal times make a jump
    std::vector<double> jumps_;        ///< ascending, s
    std::vector<std::size_t> pieces_;  ///< first point of each continuous piece, and the number of points
    std::string text_;
    std::optional<CompiledFormula> expression_;
    std::shared_ptr<const AmplitudeCourse> course_;  ///< of an expression; null: nobody has looked
    bool depends_on_position_ = false;
};

}  // namespace gneiss
