#include "model/amplitude_course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "model/amplitude.hpp"
#include "model/expression_signals.hpp"
#include "model/jump_search.hpp"

namespace gneiss {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// ---- how closely time is looked at
constexpr std::size_t n_first_samples = 2048;      ///< of an expression of t alone
constexpr std::size_t n_first_samples_each = 256;  ///< of one that depends on the place, at each of them
constexpr std::size_t most_samples = 200000;       ///< of all places
constexpr std::size_t most_crossings = 60;         ///< of a part of the expression, whose neighbourhoods are looked at
constexpr std::size_t most_switches = 100000;
constexpr int n_halvings = 40;           ///< towards a crossing: widths down to 1e-12 of the run are found
constexpr double shortest_part = 1e-11;  ///< of the run, between samples; what varies within less is a jump
constexpr double largest_turn = std::numbers::pi / 4;  ///< of a phase between samples, rad

// ---- what a step has to see
constexpr double quiet = 1e-6;  ///< of the largest value: what varies less keeps its value
constexpr double coarse = 0.1;  ///< of the range of a stretch: how far a straight line along a step may be off
constexpr double longest_turn = std::numbers::pi / 2;  ///< of a phase within a step, rad

struct Sample {
    double t, value;
};

/// Changes of a signal that keeps its value but for jumps, each between two neighbouring doubles.
class SwitchSearch {
public:
    SwitchSearch(const ExpressionSignals::Switching& what, std::vector<AmplitudeCourse::Switch>& found)
        : what_(what), found_(found) {}

    void along(const std::vector<double>& times) {
        std::vector<double> values, differences;
        for (const double t : times) values.push_back(what_.value(t));
        for (std::size_t i = 0; i + 1 < times.size(); ++i) between(times[i], times[i + 1], values[i], values[i + 1]);
        if (what_.difference.empty()) return;
        for (const double t : times) differences.push_back(what_.difference.front()(t));
        for (std::size_t i = 1; i + 1 < times.size(); ++i)
            if (comes_near(differences[i - 1], differences[i], differences[i + 1]))
                near(times[i - 1], times[i], times[i + 1], values[i], differences[i] > 0);
    }

private:
    bool is_full() const { return found_.size() >= most_switches; }

    void between(double low, double high, double value_low, double value_high) {
        while (value_low != value_high && !is_full()) {
            double before = low, after = high, value_after = value_high;
            while (std::nextafter(before, after) < after) {
                const double middle = before + 0.5 * (after - before);
                const double value = what_.value(middle);
                if (value == value_low) {
                    before = middle;
                } else {
                    after = middle;
                    value_after = value;
                }
                if (after - before < eps * eps * high) break;  // at t = 0 doubles are too many
            }
            found_.push_back({before, after, after, false});
            low = after;
            value_low = value_after;
        }
    }

    static bool comes_near(double before, double at, double after) {
        const double sign = at > 0 ? 1 : -1;
        return at != 0 && sign * before >= sign * at && sign * after >= sign * at &&
               sign * (before + after) > 2 * sign * at;
    }
    /// Whether the difference passes zero and comes back between two samples: golden section towards zero.
    void near(double low, double middle, double high, double value, bool above) {
        const double sign = above ? 1 : -1, golden = 0.5 * (3 - std::sqrt(5.0));
        double at_middle = sign * what_.difference.front()(middle);
        constexpr int most = 60;
        for (int i = 0; i < most; ++i) {
            const bool right = high - middle > middle - low;
            const double t = middle + golden * (right ? high - middle : low - middle);
            const double now = what_.value(t), difference = sign * what_.difference.front()(t);
            if (now != value) {
                between(low, t, what_.value(low), now);
                between(t, high, now, what_.value(high));
                return;
            }
            if (difference < at_middle) {
                (right ? low : high) = middle;
                middle = t;
                at_middle = difference;
            } else {
                (right ? high : low) = t;
            }
        }
    }

    const ExpressionSignals::Switching& what_;
    std::vector<AmplitudeCourse::Switch>& found_;
};

void sort_out(std::vector<double>& times) {
    std::ranges::sort(times);
    times.erase(std::ranges::unique(times).begin(), times.end());
}

/// Instants at which an expression is looked at first: evenly, so often that no phase turns far between two, and ever
/// more densely towards where a part of it passes zero.
class FirstTimes {
public:
    /// @param n     even ones
    /// @param most  of all, about
    FirstTimes(const ExpressionSignals& signals, double until, std::size_t n, std::size_t most)
        : signals_(signals), until_(until), most_(most) {
        for (std::size_t i = 0; i <= n; ++i) times_.push_back(until * static_cast<double>(i) / static_cast<double>(n));
        turn();
        const std::vector<double> so_far = times_;
        towards(0);
        for (const Signal& signal : signals.crossings) cross(signal, so_far);
        sort_out(times_);
    }
    const std::vector<double>& times() const { return times_; }
    /// Longest step along which phases turn no further than they may, in each interval of the even samples.
    double turns_slowly(double begin, double end) const {
        double longest = std::numeric_limits<double>::infinity();
        const double width = until_ / static_cast<double>(rates_.size());
        if (rates_.empty()) return longest;
        const auto last = rates_.size() - 1;
        const auto place = [&](double t) { return std::min(last, static_cast<std::size_t>(std::max(0.0, t / width))); };
        for (std::size_t i = place(begin); i <= place(end); ++i)
            if (rates_[i] > 0) longest = std::min(longest, longest_turn / rates_[i]);
        return longest;
    }

private:
    void turn() {
        if (signals_.phases.empty()) return;
        const std::vector<double> evenly = times_;
        rates_.assign(evenly.size() - 1, 0.0);
        for (const Signal& phase : signals_.phases)
            for (std::size_t i = 0; i + 1 < evenly.size(); ++i) {
                const double turned = std::abs(phase(evenly[i + 1]) - phase(evenly[i]));
                if (turned > 0) rates_[i] = std::max(rates_[i], turned / (evenly[i + 1] - evenly[i]));
            }
        for (std::size_t i = 0; i + 1 < evenly.size(); ++i) {
            const double width = evenly[i + 1] - evenly[i], parts = std::ceil(rates_[i] * width / largest_turn);
            if (static_cast<double>(times_.size()) + parts > static_cast<double>(most_)) break;
            for (double k = 1; k < parts; ++k) times_.push_back(evenly[i] + width * k / parts);
        }
        sort_out(times_);
    }
    void towards(double t) {
        double distance = until_;
        for (int i = 0; i < n_halvings; ++i, distance *= 0.5)
            for (const double near : {t - distance, t + distance})
                if (near > 0 && near < until_) times_.push_back(near);
        if (t > 0 && t < until_) times_.push_back(t);
    }
    void cross(const Signal& signal, const std::vector<double>& times) {
        double before = signal(times.front());
        std::size_t n_crossings = 0;
        for (std::size_t i = 1; i < times.size() && n_crossings < most_crossings; ++i) {
            const double now = signal(times[i]);
            if (before * now < 0 || now == 0) {
                double low = times[i - 1], high = times[i];
                while (high - low > 4 * eps * high) {
                    const double middle = 0.5 * (low + high);
                    (signal(middle) * now > 0 || signal(middle) == 0 ? high : low) = middle;
                }
                towards(high);
                ++n_crossings;
            }
            before = now;
        }
    }

    const ExpressionSignals& signals_;
    double until_;
    std::size_t most_;
    std::vector<double> times_, rates_;
};

/// What two samples in a row belong to.
struct Range {
    std::size_t first, last;  ///< samples
    double tolerance;         ///< of straight lines; 0: it keeps its value
};

/// Flat tops and places that were looked at closely do not end a run of intervals within which a signal varies.
std::vector<Range> joined(const std::vector<Range>& ranges, const std::vector<Sample>& samples) {
    constexpr double short_rest = 0.1;  // of what is before and after it
    const auto length = [&](const Range& range) { return samples[range.last].t - samples[range.first].t; };
    std::vector<Range> all;
    for (std::size_t k = 0; k < ranges.size(); ++k) {
        const bool between = !all.empty() && k + 1 < ranges.size() && ranges[k].tolerance == 0;
        if (between && length(ranges[k]) < short_rest * std::min(length(all.back()), length(ranges[k + 1])))
            all.back().last = ranges[++k].last;
        else
            all.push_back(ranges[k]);
    }
    return all;
}

/// Runs of intervals within which a signal varies, and does not.
std::vector<Range> ranges_of(const std::vector<Sample>& samples, double largest) {
    std::vector<Range> ranges;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        const bool varies = std::abs(samples[i + 1].value - samples[i].value) > quiet * largest;
        if (!ranges.empty() && (ranges.back().tolerance > 0) == varies)
            ranges.back().last = i + 1;
        else
            ranges.push_back({i, i + 1, varies ? 1.0 : 0.0});
    }
    ranges = joined(ranges, samples);
    for (Range& range : ranges) {
        if (range.tolerance == 0) continue;
        const auto part = std::span(samples).subspan(range.first, range.last - range.first + 1);
        const auto [low, high] = std::ranges::minmax(part, {}, &Sample::value);
        range.tolerance = coarse * (high.value - low.value);
    }
    return ranges;
}

/// Halves an interval until straight lines follow the signal.
void refine(const Signal& signal, const Sample& a, const Sample& b, double tolerance, double shortest, std::size_t most,
            std::vector<Sample>& into) {
    const Sample middle{0.5 * (a.t + b.t), signal(0.5 * (a.t + b.t))};
    const bool off = std::abs(middle.value - 0.5 * (a.value + b.value)) > tolerance;
    if (off && b.t - a.t > shortest && into.size() < most) {
        refine(signal, a, middle, tolerance, shortest, most, into);
        refine(signal, middle, b, tolerance, shortest, most, into);
        return;
    }
    into.push_back(middle);
    into.push_back(b);
}

/// Straight lines, as long as can be, along samples that vary.
/// @param shortest  no step has to resolve shorter ones, s
void add_lines(std::span<const Sample> samples, double tolerance, double shortest,
               std::vector<AmplitudeCourse::Stretch>& stretches) {
    double before = 0;  // length of the last line, s
    for (std::size_t begin = 0; begin + 1 < samples.size();) {
        const Sample& from = samples[begin];
        double least = -std::numeric_limits<double>::infinity(), most = -least;
        std::size_t end = begin + 1;
        for (std::size_t i = begin + 1; i < samples.size() && least <= most; ++i) {
            const double dt = samples[i].t - from.t, rise = samples[i].value - from.value;
            if (rise / dt >= least && rise / dt <= most) end = i;
            least = std::max(least, (rise - tolerance) / dt);
            most = std::min(most, (rise + tolerance) / dt);
        }
        const double length = samples[end].t - from.t;
        // a rest at the end is no reason for a short step
        const double longest = begin > 0 && end + 1 == samples.size() ? std::max(length, 0.5 * before) : length;
        if (length > shortest) stretches.push_back({from.t, samples[end].t, longest});
        before = length;
        begin = end;
    }
}

/// Joins switches that round-off alone keeps apart, and gives each the time that a user would have written.
void join(std::vector<AmplitudeCourse::Switch>& switches) {
    using Switch = AmplitudeCourse::Switch;
    std::ranges::sort(switches, {}, [](const Switch& s) { return std::pair(s.before, s.after); });
    std::vector<Switch> apart;
    for (const Switch& one : switches) {
        const double round_off = 8 * eps * std::abs(one.before);
        if (!apart.empty() && one.before - apart.back().after <= round_off)
            apart.back().after = std::max(apart.back().after, one.after);
        else
            apart.push_back(one);
    }
    for (Switch& one : apart) {
        constexpr int most_candidates = 32;
        double t = one.before;
        one.time = one.after;
        for (int i = 0; i < most_candidates && t <= one.after; ++i, t = std::nextafter(t, one.after)) {
            if (fmt::format("{}", t).size() < fmt::format("{}", one.time).size()) one.time = t;
            if (t == one.after) break;
        }
    }
    switches = std::move(apart);
}

/// At most so many of them, the first and the last among them.
std::vector<Vec2<double>> some_of(std::span<const Vec2<double>> all, std::size_t most) {
    if (all.size() <= most) return {all.begin(), all.end()};
    std::vector<Vec2<double>> some;
    for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * (all.size() - 1) / (most - 1)]);
    return some;
}

/// Looks at an expression place by place.
class Survey {
public:
    Survey(const std::string& expression, double until, std::size_t n_places)
        : signals_(expression),
          until_(until),
          n_first_(n_places == 1 ? n_first_samples : n_first_samples_each),
          most_(std::max(n_first_, most_samples / n_places)) {}

    AmplitudeCourse over(std::span<const Vec2<double>> places) {
        for (const Vec2<double>& place : places) find_switches(place);
        join(course_.switches);
        if (places.size() > 1 && course_.switches.size() > most_of_places) thin_out();
        constexpr std::size_t most_followed = 16;
        for (const Vec2<double>& place : some_of(places, most_followed)) follow(place);
        if (no_value_at_)
            course_.warnings.push_back(
                fmt::format("has no value at t = {:.6g} s: a run that comes there ends", *no_value_at_));
        else if (pole_at_)
            course_.warnings.push_back(fmt::format(
                "grows without bound towards t = {:.6g} s: no step there gives what it would do", *pole_at_));
        if (spike_at_)
            course_.warnings.push_back(fmt::format(
                "has a value of its own at the one instant t = {:.9g} s, which acts on nothing", *spike_at_));
        if (course_.switches.size() >= most_switches)
            course_.warnings.push_back(
                fmt::format("jumps or bends more than {} times: steps end at the first of them", most_switches));
        return std::move(course_);
    }

private:
    static constexpr std::size_t most_of_places = 256;  ///< switches of an expression that depends on the place

    void find_switches(const Vec2<double>& place) {
        signals_.stand_at(place);
        const FirstTimes first(signals_, until_, n_first_, most_);
        for (const auto& switching : signals_.switchings)
            SwitchSearch(switching, course_.switches).along(first.times());
        // those that no comparison gives away; the others are found again, between the same doubles
        for (const FoundJump& jump :
             JumpSearch(signals_.whole, until_, shortest_part * until_, quiet).along(first.times())) {
            course_.switches.push_back({jump.before, jump.after, jump.after, false});
            if (jump.is_pole && !pole_at_) pole_at_ = jump.before;
        }
    }

    /// A front that runs over many nodes switches at each of them. Steps end where it comes and goes, and cannot miss
    /// what is between.
    void thin_out() {
        const double begin = course_.switches.front().before, end = course_.switches.back().after;
        constexpr double parts = 64;
        course_.stretches.push_back({{begin, end, (end - begin) / parts}});
        course_.switches = {course_.switches.front(), course_.switches.back()};
    }

    void follow(const Vec2<double>& place) {
        signals_.stand_at(place);
        const FirstTimes first(signals_, until_, n_first_, most_);
        std::vector<std::vector<Sample>> pieces;
        double begin = 0, largest = 0;
        auto next = first.times().begin();
        for (std::size_t k = 0; k <= course_.switches.size(); ++k) {
            const double end = k < course_.switches.size() ? course_.switches[k].before : until_;
            std::vector<double> times{begin};
            while (next != first.times().end() && *next <= begin) ++next;
            for (; next != first.times().end() && *next < end; ++next) times.push_back(*next);
            if (end > begin) times.push_back(end);
            pieces.emplace_back();
            for (const double t : times) {
                pieces.back().push_back({t, value(t)});
                largest = std::max(largest, std::abs(pieces.back().back().value));
            }
            if (k < course_.switches.size()) begin = course_.switches[k].after;
        }
        note_jumps(pieces, largest);
        std::vector<AmplitudeCourse::Stretch> stretches;
        for (std::vector<Sample>& piece : pieces) follow_piece(piece, largest, stretches);
        for (auto& stretch : stretches)
            stretch.longest = std::min(stretch.longest, first.turns_slowly(stretch.begin, stretch.end));
        course_.stretches.push_back(std::move(stretches));
    }

    double value(double t) {
        const double value = signals_.whole(t);
        if (!std::isnan(value)) return value;
        if (!no_value_at_ || t < *no_value_at_) no_value_at_ = t;
        return 0;
    }

    void note_jumps(const std::vector<std::vector<Sample>>& pieces, double largest) {
        for (std::size_t k = 0; k < course_.switches.size(); ++k) {
            AmplitudeCourse::Switch& one = course_.switches[k];
            const double left = pieces[k].back().value, right = pieces[k + 1].front().value;
            const double at = signals_.whole(one.time);  // no run evaluates it: it may have no value
            const double small = quiet * largest;
            if (std::abs(right - left) > small)
                one.jumps = true;
            else if (std::abs(at - left) > small && !spike_at_)
                spike_at_ = one.time;
        }
    }

    void follow_piece(std::vector<Sample>& piece, double largest, std::vector<AmplitudeCourse::Stretch>& stretches) {
        if (piece.size() < 2 || largest == 0) return;
        std::vector<Sample> samples{piece.front()};
        for (const Range& range : ranges_of(piece, largest)) {
            const double tolerance = range.tolerance > 0 ? range.tolerance : quiet * largest;
            for (std::size_t i = range.first; i < range.last; ++i)
                refine(signals_.whole, piece[i], piece[i + 1], tolerance, shortest_part * until_, 2 * most_, samples);
        }
        for (std::size_t i = 0; i < samples.size(); ++i) {
            if (std::isnan(samples[i].value)) samples[i].value = 0;
            note_largest(samples[i]);
            if (i > 0) note_fastest(samples[i - 1], samples[i]);
        }
        for (const Range& range : ranges_of(samples, largest))
            if (range.tolerance > 0)
                add_lines(std::span(samples).subspan(range.first, range.last - range.first + 1), range.tolerance,
                          2 * shortest_part * until_, stretches);
    }

    void note_largest(const Sample& sample) {
        if (!(std::abs(sample.value) > largest_)) return;
        largest_ = std::abs(sample.value);
        course_.largest_at = sample.t;
    }
    void note_fastest(const Sample& a, const Sample& b) {
        const double rate = std::abs(b.value - a.value) / (b.t - a.t);
        if (!(rate > fastest_)) return;
        fastest_ = rate;
        course_.fastest_at = 0.5 * (a.t + b.t);
    }

    ExpressionSignals signals_;
    double until_;
    std::size_t n_first_, most_;  ///< samples of a place: even ones, and all
    AmplitudeCourse course_;
    double largest_ = 0, fastest_ = 0;
    std::optional<double> no_value_at_, spike_at_, pole_at_;
};

/// Of an amplitude that is linear between switches that it knows itself.
AmplitudeCourse course_of_table(const Amplitude& amplitude, double until) {
    AmplitudeCourse course;
    std::vector<double> times{0, until};
    for (const double t : amplitude.switch_times())
        if (t > 0 && t < until) times.push_back(t);
    std::ranges::sort(times);
    double largest = 0, fastest = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (const double value = std::abs(amplitude.value(times[i], times[i])); value > largest) {
            largest = value;
            course.largest_at = times[i];
        }
        if (i == 0) continue;
        const double rise = amplitude.value(times[i], times[i - 1]) - amplitude.value(times[i - 1], times[i - 1]);
        if (const double rate = std::abs(rise) / (times[i] - times[i - 1]); rate > fastest) {
            fastest = rate;
            course.fastest_at = 0.5 * (times[i - 1] + times[i]);
        }
    }
    return course;
}

}  // namespace

double AmplitudeCourse::longest_step(double t) const {
    double longest = std::numeric_limits<double>::infinity();
    for (const std::vector<Stretch>& line : stretches) {
        auto stretch = std::ranges::upper_bound(line, t, {}, &Stretch::end);
        for (; stretch != line.end() && stretch->begin - t < longest; ++stretch)
            longest = std::min(longest, std::max(stretch->longest, stretch->begin - t));
    }
    return longest;
}

AmplitudeCourse course_of(const AmplitudeOptions& options, double until, std::span<const Vec2<double>> places) {
    const Amplitude amplitude(options);
    if (options.kind != AmplitudeOptions::Kind::expression) return course_of_table(amplitude, until);
    constexpr std::size_t most_places = 200;
    if (!amplitude.depends_on_position()) places = places.first(1);
    const std::vector<Vec2<double>> looked_at = some_of(places, most_places);
    return Survey(options.expression, until, looked_at.size()).over(looked_at);
}

}  // namespace gneiss
