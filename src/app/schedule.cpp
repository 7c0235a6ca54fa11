#include "app/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "system/march.hpp"

namespace gneiss {
namespace {

constexpr double rows_by_default = 1000;

/// A time that should be a multiple of an interval counts as one despite round-off.
constexpr double round_off = 1e-9;

/// Number of the interval that t lies in.
double interval_number(double t, double interval) { return std::floor(t / interval + round_off); }

/// The next multiple of an interval after t; infinite if there is no interval.
double next_multiple(double t, double interval) {
    return interval > 0 ? (interval_number(t, interval) + 1) * interval : std::numeric_limits<double>::infinity();
}

bool passed_multiple(const StepReport& step, double interval) {
    return interval > 0 && interval_number(step.t, interval) > interval_number(step.t - step.dt, interval);
}

}  // namespace

Schedule::Schedule(const CaseOptions& options)
    : t_end_(options.run.t_end),
      fields_(options.output.fields),
      history_(options.output.history > 0 ? options.output.history : options.run.t_end / rows_by_default),
      checkpoint_(options.run.checkpoint),
      states_(options.output.states),
      field_times_(options.output.field_times) {}

double Schedule::next_stop(double t) const {
    double stop = std::min({next_multiple(t, fields_), next_multiple(t, checkpoint_), next_multiple(t, states_)});
    for (const double time : field_times_)
        if (!reached(t, time)) stop = std::min(stop, time);
    return stop;
}

double Schedule::next_look(double t) const { return (interval_number(t, history_) + 1 - round_off) * history_; }

bool Schedule::row_due(const StepReport& step) const { return passed_multiple(step, history_) || is_last(step); }

bool Schedule::frame_due(const StepReport& step) const {
    const auto passed = [&step](double time) { return reached(step.t, time) && !reached(step.t - step.dt, time); };
    return passed_multiple(step, fields_) || is_last(step) || std::ranges::any_of(field_times_, passed);
}

bool Schedule::checkpoint_due(const StepReport& step) const { return passed_multiple(step, checkpoint_); }

bool Schedule::state_due(const StepReport& step) const { return passed_multiple(step, states_); }

double Schedule::expected_rows(double dt) const { return 1 + std::ceil(t_end_ / std::max(dt, history_)); }

double Schedule::most_frames() const {
    const double multiples = fields_ > 0 ? interval_number(t_end_, fields_) : 0;
    return 2 + multiples + static_cast<double>(field_times_.size());
}

}  // namespace gneiss
