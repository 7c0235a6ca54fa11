#pragma once
// Jumps of a function of time that no comparison in it gives away: atan2(t - t0, 0), atan(1/(t - t0)), abs(u)/u, tan.

#include <optional>
#include <vector>

#include "model/expression_signals.hpp"

namespace gneiss {

/// An interval over which a signal jumps.
struct FoundJump {
    double before, after;  ///< s; neighbouring doubles, or with one between them, or what a continuous change takes
    bool is_pole;          ///< the signal grows without bound towards it
};

/// Halves intervals as long as the change over them does not spread: that of a jump stays in one half whole, that of a
/// continuous function is shared by both sooner or later.
class JumpSearch {
public:
    /// @param until     end of the run, s
    /// @param shortest  what varies within less is a jump, s
    /// @param quiet     of the largest value: what varies less keeps its value
    JumpSearch(const Signal& signal, double until, double shortest, double quiet)
        : signal_(signal), until_(until), shortest_(shortest), quiet_(quiet) {}

    /// Of several jumps between two times in a row, one is found.
    /// @param times  ascending, s
    std::vector<FoundJump> along(const std::vector<double>& times);

private:
    struct Sample {
        double t, value;
    };

    std::optional<FoundJump> between(Sample low, Sample high) const;
    std::optional<FoundJump> tight(double low, double high) const;
    std::optional<FoundJump> steep(double low, double high) const;
    std::optional<Sample> middle(const Sample& low, const Sample& high) const;
    double value(double t) const;
    double change(double from, double to) const;

    const Signal& signal_;
    double until_, shortest_, quiet_;
    double small_ = 0;  ///< what varies less keeps its value
};

}  // namespace gneiss
