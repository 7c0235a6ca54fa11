#include "model/element_block.hpp"

#include <algorithm>

namespace gneiss {

std::vector<PackRange> pack_ranges(std::span<const std::unique_ptr<ElementBlock>> blocks, std::size_t n_sub_triangles) {
    std::vector<PackRange> ranges;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const ElementBlock& block = *blocks[b];
        const std::size_t step = n_sub_triangles / (static_cast<std::size_t>(block.n_sub_triangles()) * pack_width);
        for (std::size_t first = 0; first < block.n_packs(); first += step)
            ranges.push_back({b, first, std::min(first + step, block.n_packs())});
    }
    return ranges;
}

}  // namespace gneiss
