#pragma once
// The largest magnitude of a row of numbers.

#include <cmath>
#include <span>

namespace gneiss {

/// 0 if there are none; NaN if there is one among them.
inline double largest_magnitude(std::span<const double> values) {
    double largest = 0;
    for (const double value : values) {
        if (std::isnan(value)) return value;
        if (std::abs(value) > largest) largest = std::abs(value);
    }
    return largest;
}

}  // namespace gneiss
