#pragma once
// Derivatives to compare with, and orders of errors.

#include <cmath>

namespace gneiss {

/// Step of the central difference below for functions that vary over a length of 1 and are known to eps: truncation
/// h^4/30 times the fifth derivative and round-off eps/h are then both near 1e-12.
inline constexpr double difference_step = 5e-4;

/// f'(0) by the central difference of order 4.
template <class Function>
auto derivative_at_zero(Function f, double h = difference_step) {
    using Value = decltype(f(h));  // not auto: an expression of values that are gone by then
    return Value((8.0 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) * (1 / (12 * h)));
}

/// p from two errors, the second at half the step.
inline double observed_order(double error, double error_at_half) { return std::log2(error / error_at_half); }

}  // namespace gneiss
