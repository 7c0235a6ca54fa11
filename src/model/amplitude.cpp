#include "model/amplitude.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.hpp"
#include "model/amplitude_course.hpp"

namespace gneiss {
namespace {

void check_finite(double value, const std::string& name, std::vector<Problem>& problems) {
    if (!std::isfinite(value)) problems.push_back({"", fmt::format("{} = {} must be finite", name, value)});
}

std::vector<Problem> table_problems(const std::vector<double>& times, const std::vector<double>& values) {
    std::vector<Problem> problems;
    if (times.empty()) problems.push_back({"", "a table needs at least one time"});
    if (times.size() != values.size()) {
        problems.push_back(
            {"", fmt::format("a table needs one value per time: {} times, {} values", times.size(), values.size())});
    }
    for (std::size_t i = 0; i < times.size(); ++i) check_finite(times[i], fmt::format("times[{}]", i), problems);
    for (std::size_t i = 0; i < values.size(); ++i) check_finite(values[i], fmt::format("values[{}]", i), problems);
    for (std::size_t i = 1; i < times.size(); ++i) {
        if (times[i] < times[i - 1]) {
            problems.push_back(
                {"", fmt::format("times must ascend: times[{}] = {} s comes after {} s", i, times[i], times[i - 1])});
        }
        if (i > 1 && times[i] == times[i - 2]) {
            problems.push_back(
                {"", fmt::format("times[{}] = {} s is the third of equal times; two make a jump", i, times[i])});
        }
    }
    return problems;
}

void require(const std::vector<Problem>& problems) {
    if (!problems.empty()) throw InputError(problems);
}

bool depends_on_time_alone(const std::string& expression) {
    try {
        CompiledFormula(Formula(expression), "t");
        return true;
    } catch (const InputError&) {
        return false;  // it has been compiled with x and y before, so these are what is missing
    }
}

}  // namespace

Amplitude::Amplitude(const AmplitudeOptions& options, std::shared_ptr<const AmplitudeCourse> course) {
    std::vector<Problem> problems;
    switch (options.kind) {
        case AmplitudeOptions::Kind::constant:
            points_ = {{0, 1}};
            break;
        case AmplitudeOptions::Kind::heaviside:
            check_finite(options.start, "start", problems);
            require(problems);
            points_ = {{options.start, 0}, {options.start, 1}};
            break;
        case AmplitudeOptions::Kind::ramp:
            check_finite(options.start, "start", problems);
            check_finite(options.end, "end", problems);
            if (options.end <= options.start) {
                problems.push_back({"", fmt::format("a ramp must end after its start: start = {} s, end = {} s",
                                                    options.start, options.end)});
            }
            require(problems);
            points_ = {{options.start, 0}, {options.end, 1}};
            break;
        case AmplitudeOptions::Kind::table:
            require(table_problems(options.times, options.values));
            for (std::size_t i = 0; i < options.times.size(); ++i) {
                points_.push_back({options.times[i], options.values[i]});
            }
            break;
        case AmplitudeOptions::Kind::expression:
            text_ = options.expression;
            expression_.emplace(Formula(text_), "xyt");
            depends_on_position_ = !depends_on_time_alone(text_);
            course_ = std::move(course);
            return;
    }
    pieces_.push_back(0);
    for (std::size_t i = 1; i < points_.size(); ++i) {
        if (points_[i].t == points_[i - 1].t) {
            jumps_.push_back(points_[i].t);
            pieces_.push_back(i);
        }
    }
    pieces_.push_back(points_.size());
}

double Amplitude::table_value(double t, double last_event) const {
    const auto passed = std::upper_bound(jumps_.begin(), jumps_.end(), last_event) - jumps_.begin();
    const Point* first = points_.data() + pieces_[static_cast<std::size_t>(passed)];
    const Point* end = points_.data() + pieces_[static_cast<std::size_t>(passed) + 1];
    const Point* next = std::upper_bound(first, end, t, [](double time, const Point& p) { return time < p.t; });
    if (next == first) return first->value;
    const Point& before = next[-1];
    if (next == end) return before.value;
    return before.value + (next->value - before.value) * ((t - before.t) / (next->t - before.t));
}

double Amplitude::within_piece(double t, double last_event) const {
    if (!course_) return t;
    const auto& switches = course_->switches;
    const auto next = std::ranges::upper_bound(switches, last_event, {}, &AmplitudeCourse::Switch::time);
    if (next != switches.end()) t = std::min(t, next->before);
    if (next != switches.begin()) t = std::max(t, next[-1].after);
    return t;
}

bool Amplitude::has_jump() const {
    return !jumps_.empty() || (course_ && std::ranges::any_of(course_->switches, &AmplitudeCourse::Switch::jumps));
}

std::vector<double> Amplitude::switch_times() const {
    std::vector<double> times;
    if (course_)
        for (const AmplitudeCourse::Switch& one : course_->switches) times.push_back(one.time);
    // Slope of the segment that ends at point i; zero outside the table, where the value is held.
    const auto slope = [&](std::size_t i) {
        if (i == 0 || i == points_.size()) return 0.0;
        return (points_[i].value - points_[i - 1].value) / (points_[i].t - points_[i - 1].t);
    };
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const bool jump_follows = i + 1 < points_.size() && points_[i + 1].t == points_[i].t;
        const bool jump = i > 0 && points_[i].t == points_[i - 1].t;
        if (!jump_follows && (jump || slope(i) != slope(i + 1))) times.push_back(points_[i].t);
    }
    return times;
}

}  // namespace gneiss
