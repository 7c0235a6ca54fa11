#pragma once
// Sorting of whole numbers by some of their bits, in time proportional to their number.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gneiss {

/// Sorts ascending by bits [first_bit, last_bit), least significant digit first; numbers that agree there keep their
/// order.
/// @param scratch  resized to the same length; its contents are of no use afterwards
inline void radix_sort(std::vector<std::uint64_t>& numbers, std::vector<std::uint64_t>& scratch, int first_bit,
                       int last_bit) {
    constexpr int digit_bits =
        11;  // the cells of a million triangles in two digits; the counts fit into the first cache
    scratch.resize(numbers.size());
    for (int shift = first_bit; shift < last_bit; shift += digit_bits) {
        const int bits = last_bit - shift < digit_bits ? last_bit - shift : digit_bits;
        const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
        std::array<std::size_t, 1 << digit_bits> next{};
        for (const std::uint64_t number : numbers) ++next[(number >> shift) & mask];
        std::size_t sum = 0;
        for (std::size_t& place : next) {
            const std::size_t count = place;
            place = sum;
            sum += count;
        }
        for (const std::uint64_t number : numbers) scratch[next[(number >> shift) & mask]++] = number;
        numbers.swap(scratch);
    }
}

}  // namespace gneiss
