#include "app/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "system/march.hpp"

namespace gneiss {
namespace {

constexpr double rows_by_default = 1000;

/// A time that should be a multiple of an interval counts as one despite round-off; part of the interval.
constexpr double round_off = 1e-9;

}  // namespace

Multiples::Multiples(double interval) : interval_(interval), numerator_(interval), denominator_(1) {
    constexpr double most_digits = 1e15;  // of a decimal that a double tells apart
    constexpr int largest_power = 22;     // of ten that is a double
    constexpr double one_decimal = 4 * std::numeric_limits<double>::epsilon();  // quotients of a deck's numbers, too
    double power = 1;
    for (int k = 0; k <= largest_power; ++k, power *= 10) {
        const double digits = std::round(interval * power);
        if (digits >= most_digits) break;
        if (digits >= 1 && std::abs(digits / power - interval) <= one_decimal * interval) {
            numerator_ = digits;
            denominator_ = power;
            break;
        }
    }
}

double Multiples::number(double t) const { return std::floor(t / interval_ + round_off); }

double Multiples::next(double t) const { return any() ? time(number(t) + 1) : std::numeric_limits<double>::infinity(); }

bool Multiples::contains(double t) const {
    return any() && std::abs(t - time(std::round(t / interval_))) <= round_off * interval_;
}

bool Multiples::arrived(const StepReport& step) const {
    const double before = step.t - step.dt;  // a solver that starts anew takes steps as short as round-off
    const bool began_there = contains(before) && std::round(before / interval_) == std::round(step.t / interval_);
    return contains(step.t) && !began_there;
}

bool Multiples::passed(const StepReport& step) const { return any() && number(step.t) > number(step.t - step.dt); }

Schedule::Schedule(const CaseOptions& options, bool interpolates)
    : rows_at_times_(options.output.history > 0 && !options.output.rows_at_steps),
      interpolates_(interpolates),
      t_end_(options.run.t_end),
      fields_(options.output.fields),
      history_(options.output.history > 0 ? options.output.history : options.run.t_end / rows_by_default),
      checkpoint_(options.run.checkpoint),
      states_(options.output.states),
      field_times_(options.output.field_times) {}

double Schedule::next_stop(double t) const {
    double stop = std::min({fields_.next(t), checkpoint_.next(t), states_.next(t)});
    if (rows_at_times_ && !interpolates_) stop = std::min(stop, history_.next(t));
    for (const double time : field_times_)
        if (!reached(t, time)) stop = std::min(stop, time);
    return stop;
}

double Schedule::next_look(double t) const { return history_.next(t) - round_off * history_.interval(); }

bool Schedule::row_due(const StepReport& step) const {
    return (rows_at_times_ ? history_.arrived(step) : history_.passed(step)) || is_last(step);
}

double Schedule::row_time(double t) const {
    return rows_at_times_ && history_.contains(t) ? history_.time(history_.number(t)) : t;
}

std::vector<double> Schedule::rows_between(double from, double to) const {
    std::vector<double> times;
    if (!rows_at_times_) return times;
    for (double time = history_.next(from); time < to - round_off * history_.interval();
         time = history_.time(history_.number(time) + 1))
        times.push_back(time);
    return times;
}

bool Schedule::frame_due(const StepReport& step) const {
    const auto passed = [&step](double time) { return reached(step.t, time) && !reached(step.t - step.dt, time); };
    return fields_.passed(step) || is_last(step) || std::ranges::any_of(field_times_, passed);
}

bool Schedule::checkpoint_due(const StepReport& step) const { return checkpoint_.passed(step); }

bool Schedule::state_due(const StepReport& step) const { return states_.passed(step); }

double Schedule::expected_rows(double dt) const {
    return 1 +
           std::ceil(t_end_ / (rows_at_times_ ? history_.interval() : std::max(dt, history_.interval())) - round_off);
}

double Schedule::most_frames() const {
    const double multiples = fields_.any() ? fields_.number(t_end_) : 0;
    return 2 + multiples + static_cast<double>(field_times_.size());
}

}  // namespace gneiss
