#pragma once
// What of an expression of t can jump, bend, or pass quickly: parts of it that are looked at one by one.

#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "model/formula.hpp"

namespace gneiss {

/// A part of an expression as a function of t at one place.
class Signal {
public:
    explicit Signal(const std::string& text) : formula_(Formula(text), "xyt") {}
    void stand_at(const Vec2<double>& place) { place_ = place; }
    /// Not a number where it has no value.
    double operator()(double t) const;

private:
    CompiledFormula formula_;
    Vec2<double> place_{0, 0};
};

/// The parts of one expression, those alone that depend on t.
struct ExpressionSignals {
    /// What keeps its value but for jumps, where the expression jumps or bends: the truth of a comparison, the sign of
    /// what abs() is taken of.
    struct Switching {
        Signal value;
        std::vector<Signal> difference;  ///< jumps where it passes zero; none: not known
    };
    Signal whole;
    std::vector<Switching> switchings;
    std::vector<Signal> crossings;  ///< near their zeros the expression may vary quickly: (t - t0)/width
    std::vector<Signal> phases;     ///< of sin, cos, tan, rad

    /// @throws InputError for a faulty expression
    explicit ExpressionSignals(const std::string& expression);
    void stand_at(const Vec2<double>& place);
};

}  // namespace gneiss
