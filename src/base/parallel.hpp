#pragma once
// Loops over threads whose results do not depend on the number of threads.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gneiss {

/// Iterations that one thread takes at a time.
inline constexpr std::ptrdiff_t parallel_range = 4096;

/// body(first, last) on consecutive ranges that together make up [0, n).
/// @param range  iterations of each, shorter where one of them takes long
template <class Body>
void parallel_ranges(std::size_t n, Body body, std::ptrdiff_t range = parallel_range) {
    const auto end = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static) if (end > range)  // no threads for a single range
    for (std::ptrdiff_t first = 0; first < end; first += range)
        body(static_cast<std::size_t>(first), static_cast<std::size_t>(std::min(first + range, end)));
}

/// The sum of range(first, last) over the same ranges, added in ascending order.
/// @param partial  scratch, so that repeated sums do not allocate
template <class Range>
double ordered_sum(std::size_t n, std::vector<double>& partial, Range range) {
    partial.resize((n + parallel_range - 1) / parallel_range);
    parallel_ranges(n,
                    [&](std::size_t first, std::size_t last) { partial[first / parallel_range] = range(first, last); });
    double sum = 0;
    for (const double part : partial) sum += part;
    return sum;
}

}  // namespace gneiss
