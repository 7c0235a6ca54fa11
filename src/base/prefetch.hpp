#pragma once
// Asking memory for values before they are used. The processor does so by itself within a page of 4 KiB and begins anew
// in the next one; long arrays that are read once gain from being asked for across that border.

#include <algorithm>
#include <cstddef>

namespace gneiss {

/// Values of a prefetch go to the second-level cache: the nearest one has what is at work.
enum class Access { read, write };

template <Access access = Access::read, class T>
void prefetch(const T* value) {
    __builtin_prefetch(value, access == Access::write, 2);
}

/// The cache lines of values[first .. last), as far as the array goes.
/// @param n  size of the array
template <Access access = Access::read, class T>
void prefetch(const T* values, std::size_t first, std::size_t last, std::size_t n) {
    constexpr std::size_t line = 64 / sizeof(T);
    for (std::size_t i = first; i < std::min(last, n); i += line) prefetch<access>(values + i);
}

}  // namespace gneiss
