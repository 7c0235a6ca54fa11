#pragma once
// When a run writes what: rows of the tables, frames of the fields, checkpoints, whole states.

#include <vector>

#include "model/options.hpp"
#include "system/integrator.hpp"

namespace gneiss {

/// Frames, checkpoints and whole states are taken at their times exactly, so that steps have to end there; a row of the
/// tables is taken at the first step that reaches its time, so that tables do not shorten steps. Rows and a frame are
/// also due at the end. Stateless: what is due follows from where a step began and ended, hence after a restart as
/// without one.
class Schedule {
public:
    explicit Schedule(const CaseOptions& options);

    /// Where the step that begins at t has to end at the latest, s; infinite if nothing is planned. See reached().
    double next_stop(double t) const;

    /// The instant from which on a step that begins at t makes the next row due, s.
    double next_look(double t) const;

    bool row_due(const StepReport& step) const;
    bool frame_due(const StepReport& step) const;
    bool checkpoint_due(const StepReport& step) const;
    bool state_due(const StepReport& step) const;

    /// Rows of a table over a whole run with steps of dt (s), about, and frames of it, at most.
    double expected_rows(double dt) const;
    double most_frames() const;

private:
    bool is_last(const StepReport& step) const { return !(step.t < t_end_); }

    double t_end_, fields_, history_, checkpoint_, states_;  ///< s; intervals 0 where there is none
    std::vector<double> field_times_;                        ///< s
};

}  // namespace gneiss
