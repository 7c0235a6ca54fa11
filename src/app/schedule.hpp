#pragma once
// When a run writes what: rows of the tables, frames of the fields, checkpoints, whole states.

#include <vector>

#include "model/options.hpp"
#include "system/integrator.hpp"

namespace gneiss {

/// Multiples of an interval, each the double nearest to its decimal: five times 3e-4 is 0.0015, which the product of
/// doubles is not.
class Multiples {
public:
    /// @param interval  s; 0: there are none
    explicit Multiples(double interval);

    bool any() const { return interval_ > 0; }
    double interval() const { return interval_; }
    double time(double number) const { return number * numerator_ / denominator_; }
    /// Number of the last one that t has come to, but for round-off.
    double number(double t) const;
    /// The first one after t, s; infinite if there are none.
    double next(double t) const;
    /// Whether t is one of them, but for round-off.
    bool contains(double t) const;
    /// Whether a step ends at one of them, and did not begin there.
    bool arrived(const StepReport& step) const;
    /// Whether a step has come to one of them.
    bool passed(const StepReport& step) const;

private:
    double interval_, numerator_, denominator_;
};

/// Frames, checkpoints and whole states are taken at their times exactly, so that steps have to end there. So are rows
/// of the tables whose interval is given, unless the integrator interpolates: then they are taken within steps. Rows
/// without an interval, or wanted so, are taken at the first step that reaches their time, so that no step is
/// shortened. Rows and a frame are also due at the end. Stateless: what is due follows from where a step began and
/// ended, hence after a restart as without one.
class Schedule {
public:
    /// @param interpolates  whether the integrator does
    explicit Schedule(const CaseOptions& options, bool interpolates = false);

    /// Where the step that begins at t has to end at the latest, s; infinite if nothing is planned. See reached().
    double next_stop(double t) const;

    /// The instant from which on a step that begins at t makes the next row due, s.
    double next_look(double t) const;

    bool row_due(const StepReport& step) const;
    /// The time that a row at t stands for, s: the one that was asked for, where t is that but for round-off.
    double row_time(double t) const;
    /// Times of rows between two instants, s, that are to be interpolated.
    std::vector<double> rows_between(double from, double to) const;
    bool frame_due(const StepReport& step) const;
    bool checkpoint_due(const StepReport& step) const;
    bool state_due(const StepReport& step) const;

    /// Rows of a table over a whole run with steps of dt (s), about, and frames of it, at most.
    double expected_rows(double dt) const;
    double most_frames() const;

private:
    bool is_last(const StepReport& step) const { return !(step.t < t_end_); }

    bool rows_at_times_, interpolates_;
    double t_end_;  ///< s
    Multiples fields_, history_, checkpoint_, states_;
    std::vector<double> field_times_;  ///< s
};

}  // namespace gneiss
