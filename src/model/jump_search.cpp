#include "model/jump_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gneiss {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Neighbouring doubles, or with one between them where the signal has no value. At t = 0 doubles are too many.
bool are_neighbours(double low, double high, double until) {
    return std::nextafter(std::nextafter(low, high), high) >= high || high - low < eps * eps * until;
}

}  // namespace

std::vector<FoundJump> JumpSearch::along(const std::vector<double>& times) {
    std::vector<Sample> samples;
    double largest = 0;
    for (const double t : times) {
        const double value = signal_(t);
        if (std::isnan(value)) continue;
        samples.push_back({t, value});
        largest = std::max(largest, std::abs(value));
    }
    small_ = quiet_ * largest;
    std::vector<FoundJump> found;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
        if (const auto jump = between(samples[i], samples[i + 1])) found.push_back(*jump);
    return found;
}

std::optional<FoundJump> JumpSearch::between(Sample low, Sample high) const {
    if (!(std::abs(high.value - low.value) > small_)) return std::nullopt;
    // second differences: those of a smooth function become a fourth, of one with a kink a half, of a jump they stay
    constexpr double stays = 0.6;
    const auto bend = [](const Sample& a, const std::optional<Sample>& m, const Sample& b) {
        return m ? std::abs(a.value - 2 * m->value + b.value) : std::abs(b.value - a.value);
    };
    for (std::optional<Sample> at = middle(low, high); at;) {
        const std::optional<Sample> left = middle(low, *at), right = middle(*at, high);
        const double on_left = bend(low, left, *at), on_right = bend(*at, right, high);
        const double more = std::max(on_left, on_right);
        if (!(more > small_ && more >= stays * bend(low, at, high))) break;
        (on_left >= on_right ? high : low) = *at;
        at = on_left >= on_right ? left : right;
    }
    if (high.t - low.t > shortest_) return std::nullopt;
    Sample before = low, after = high;
    while (const std::optional<Sample> at = middle(before, after))
        (std::abs(at->value - before.value) >= std::abs(after.value - at->value) ? after : before) = *at;
    if (are_neighbours(before.t, after.t, until_))
        if (const auto jump = tight(before.t, after.t)) return jump;
    return steep(low.t, high.t);
}

/// A jump between neighbouring doubles, or of two parts with one double between them.
std::optional<FoundJump> JumpSearch::tight(double low, double high) const {
    constexpr double flat = 0.1;  // of the jump: what is not even that, beside it, is a root, whose slope has no bound
    const double one_less = std::nextafter(low, -1.0), one_more = std::nextafter(high, 2 * until_);
    for (const auto& [before, after] : {std::pair(low, high), {one_less, high}, {low, one_more}}) {
        const double jump = change(before, after), beside = flat * jump;
        if (jump > small_ && change(before - shortest_, before) <= beside && change(after, after + shortest_) <= beside)
            return FoundJump{std::max(before, 0.0), std::min(after, until_), false};
    }
    // values next to a pole, even to a root of one, are far above those of some ten thousand doubles away
    constexpr double far_above = 100;
    const double far = std::fmax(std::abs(value(low - shortest_)), std::abs(value(high + shortest_)));
    const double near = std::min(std::abs(value(low)), std::abs(value(high)));
    if (!(value(low) * value(high) < 0 && near > far_above * far)) return std::nullopt;
    // where the pole has no value, the run has to come to it and end
    const double at = std::nextafter(low, high);
    return FoundJump{at < high && std::isnan(value(at)) ? at : low, high, true};
}

/// A change that is continuous, but within less than any step resolves, from one rest to another.
std::optional<FoundJump> JumpSearch::steep(double low, double high) const {
    const double before = std::max(0.0, low - 2 * shortest_), after = std::min(until_, high + 2 * shortest_);
    const double within = change(before, after), beyond = change(before - 8 * shortest_, after + 8 * shortest_);
    constexpr double rests = 0.1;
    const bool is_step = within > small_ && within >= 0.5 * change(low, high);  // a peak comes back
    if (is_step && std::abs(within - beyond) <= rests * within) return FoundJump{before, after, false};
    return std::nullopt;
}

/// A sample between two others, the middle or beside it; none: the signal has no value there, or there is no double.
std::optional<JumpSearch::Sample> JumpSearch::middle(const Sample& low, const Sample& high) const {
    if (high.t - low.t < eps * eps * until_) return std::nullopt;
    const double t = low.t + 0.5 * (high.t - low.t);
    for (const double one : {t, std::nextafter(t, high.t), std::nextafter(t, low.t)}) {
        if (!(low.t < one && one < high.t)) continue;
        if (const double value = signal_(one); !std::isnan(value)) return Sample{one, value};
    }
    return std::nullopt;
}

double JumpSearch::value(double t) const { return signal_(std::clamp(t, 0.0, until_)); }
double JumpSearch::change(double from, double to) const { return std::abs(value(to) - value(from)); }

}  // namespace gneiss
