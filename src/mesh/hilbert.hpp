#pragma once
// The Hilbert curve through a square grid.

#include <cstdint>
#include <utility>

namespace gneiss {

/// Position of cell (x, y) on the Hilbert curve through a grid of 2^levels by 2^levels cells: cells that follow each
/// other on it are neighbours in the plane. Level by level: note the quadrant, then turn the frame so that the curve
/// of the next level enters where this one did.
/// @param x, y  in [0, 2^levels)
/// @param levels  in [1, 31]
constexpr std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, int levels) {
    const std::uint32_t last = (1u << levels) - 1;
    std::uint64_t index = 0;
    for (std::uint32_t half = 1u << (levels - 1); half > 0; half /= 2) {
        const bool right = (x & half) != 0;
        const bool upper = (y & half) != 0;
        index = 4 * index + (right ? (upper ? 2u : 3u) : (upper ? 1u : 0u));
        if (!upper) {
            if (right) {
                x = last - x;
                y = last - y;
            }
            std::swap(x, y);
        }
    }
    return index;
}

}  // namespace gneiss
