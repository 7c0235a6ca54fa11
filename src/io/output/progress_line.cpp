#include "io/output/progress_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gneiss {
namespace {

constexpr int smallest_bar = 10, largest_bar = 40;  // marks between the brackets
constexpr std::string_view gap = "  ";

/// Part of the run that is done, in [0, 1].
double fraction(const ProgressState& state) {
    if (!(state.t > 0 && state.t_end > 0)) return 0;
    return std::min(state.t / state.t_end, 1.0);
}

/// A field of the bar. The place in the list is its place on the line, `rank` says how late it is left out.
struct Field {
    std::string text;
    int rank;
};

std::string percent_text(const ProgressState& state) {
    // Rounded down: 100 % stands only at the end.
    return fmt::format("{:3d} %", static_cast<int>(std::floor(100 * fraction(state))));
}

std::string balance_text(const ProgressState& state) {
    return fmt::format("balance error {:.1e}", state.balance_error);
}

std::vector<Field> fields_of(const ProgressState& state, double left) {
    const bool within = !state.within.empty();
    std::vector<Field> fields{
        {percent_text(state), 0},
        {fmt::format("t = {:.2e} / {:.2e} s", state.t, state.t_end), 3},
        {fmt::format("step {}", state.step), 5},
    };
    if (within) fields.push_back({state.within, 1});
    if (!within) fields.push_back({fmt::format("dt = {:.1e} s", state.dt), 6});
    fields.push_back({"left " + duration_text(left), 2});
    if (!within && !std::isnan(state.balance_error)) fields.push_back({balance_text(state), 4});
    int rank = 7;
    for (const std::string& text : state.extra) fields.push_back({text, rank++});
    return fields;
}

}  // namespace

void TimeLeft::observe(double t, double wall) {
    const double passed = wall - wall_;
    if (!(passed > 0)) return;
    const double old = std::exp(-passed / memory);
    speed_ = old * speed_ + (1 - old) * (t - t_) / passed;
    weight_ = old * weight_ + (1 - old);
    t_ = t;
    wall_ = wall;
}

double TimeLeft::until(double t_end) const {
    const double speed = speed_ / weight_;
    if (!(speed > 0)) return std::numeric_limits<double>::quiet_NaN();
    return std::max(0.0, (t_end - t_) / speed);
}

std::string duration_text(double seconds) {
    if (!(seconds >= 0 && seconds < 1e9)) return "--";
    if (seconds > 0 && seconds < 0.95) return fmt::format("{:.1g} s", seconds);
    const auto s = static_cast<std::int64_t>(std::llround(seconds));
    constexpr std::int64_t minute = 60, hour = 60 * minute, day = 24 * hour;
    if (s < minute) return fmt::format("{} s", s);
    if (s < hour) return fmt::format("{} min {:02} s", s / minute, s % minute);
    if (s < day) return fmt::format("{} h {:02} min", s / hour, s % hour / minute);
    return fmt::format("{} d {:02} h", s / day, s % day / hour);
}

std::string progress_bar(const ProgressState& state, double left, int width) {
    const int room = width - 1;
    const auto needed = [](const Field& field) { return static_cast<int>(gap.size()) + display_width(field.text); };

    // In order of importance, as long as the line holds the field and the smallest bar.
    std::vector<Field> fields = fields_of(state, left);
    std::vector<const Field*> by_rank;
    for (const Field& field : fields) by_rank.push_back(&field);
    std::ranges::sort(by_rank, {}, &Field::rank);
    int used = 2;  // the brackets
    int last_rank = -1;
    for (const Field* field : by_rank) {
        if (used + needed(*field) + smallest_bar > room) break;
        used += needed(*field);
        last_rank = field->rank;
    }
    if (last_rank < 0) return percent_text(state).substr(0, static_cast<std::size_t>(std::max(0, room)));

    const int marks = std::min(room - used, largest_bar);
    const int done = static_cast<int>(std::floor(marks * fraction(state)));
    std::string line = '[' + std::string(static_cast<std::size_t>(done), '#') +
                       std::string(static_cast<std::size_t>(marks - done), '-') + ']';
    for (const Field& field : fields)
        if (field.rank <= last_rank) line.append(gap).append(field.text);
    return line;
}

std::string progress_record(const ProgressState& state, double elapsed, double left) {
    std::string line = "progress: " + duration_text(elapsed) + " spent";
    for (const Field& field : fields_of(state, left))
        line.append(", ").append(field.text.substr(field.text.find_first_not_of(' ')));
    return line;
}

std::string final_line(std::string_view word, const ProgressState& state, double elapsed) {
    std::string line = fmt::format("{}: t = {:.6g} s, {} {} in {}", word, state.t, state.step,
                                   state.step == 1 ? "step" : "steps", duration_text(elapsed));
    if (!std::isnan(state.balance_error)) line += ", " + balance_text(state);
    for (const std::string& text : state.extra) line += ", " + text;
    return line;
}

int display_width(std::string_view text) {
    // Bytes that continue a character (10xxxxxx) take no column of their own.
    return static_cast<int>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

double record_interval(double elapsed) { return std::clamp(elapsed / 20, 10.0, 300.0); }

}  // namespace gneiss
