#include "io/output/zlib_blocks.hpp"

#include <omp.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

namespace gneiss {
namespace {

// A frame of doubles shrinks by 1 % more at level 6, which takes twice as long.
constexpr int level = 1;

/// Blocks that are compressed before any of them is handed over, so that threads seldom wait for each other.
constexpr std::size_t batch = 64;

using Slot = std::vector<char>;

/// Compresses the blocks that one thread takes: tables and buffer are made once.
class BlockCompressor {
public:
    BlockCompressor() {
        if (deflateInit(&stream_, level) != Z_OK) throw std::bad_alloc();
    }
    BlockCompressor(const BlockCompressor&) = delete;
    BlockCompressor& operator=(const BlockCompressor&) = delete;
    ~BlockCompressor() { deflateEnd(&stream_); }

    std::size_t bound() { return deflateBound(&stream_, zlib_block_size); }

    /// The block that begins at byte `first`, into a slot of bound() bytes.
    std::string_view operator()(const RawArray& array, std::size_t first, Slot& slot) {
        const std::size_t size = std::min(zlib_block_size, array.size() - first);
        const std::byte* raw = array.plane_vectors ? padded(array.bytes, first / sizeof(double), size / sizeof(double))
                                                   : array.bytes.data() + first;
        deflateReset(&stream_);
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(raw));  // zlib only reads it
        stream_.avail_in = static_cast<uInt>(size);
        stream_.next_out = reinterpret_cast<Bytef*>(slot.data());
        stream_.avail_out = static_cast<uInt>(slot.size());
        deflate(&stream_, Z_FINISH);  // to the end: there is room for the worst case
        return {slot.data(), stream_.total_out};
    }

private:
    /// `n` numbers of (x, y, 0), (x, y, 0), … from number `first` on.
    const std::byte* padded(std::span<const std::byte> pairs, std::size_t first, std::size_t n) {
        for (std::size_t i = 0, row = first / 3, component = first % 3; i < n; ++i) {
            padded_[i] = 0;
            if (component < 2)
                std::memcpy(&padded_[i], pairs.data() + (2 * row + component) * sizeof(double), sizeof(double));
            if (++component == 3) component = 0, ++row;
        }
        return reinterpret_cast<const std::byte*>(padded_.data());
    }

    z_stream stream_{};
    std::array<double, zlib_block_size / sizeof(double)> padded_;
};

}  // namespace

void compress_blocks(std::span<const RawArray> arrays,
                     const std::function<void(std::size_t array, std::string_view block)>& take) {
    struct Block {
        const RawArray* array;
        std::size_t first;
    };
    std::vector<Block> blocks;
    for (const RawArray& array : arrays)
        for (std::size_t first = 0; first < array.size(); first += zlib_block_size) blocks.push_back({&array, first});
    if (blocks.empty()) return;

    std::vector<BlockCompressor> compressors(blocks.size() == 1 ? 1 : static_cast<std::size_t>(omp_get_max_threads()));
    std::vector<Slot> slots(std::min(batch, blocks.size()), Slot(compressors.front().bound()));
    std::vector<std::string_view> compressed(slots.size());
    for (std::size_t first = 0; first < blocks.size(); first += batch) {
        const auto n = static_cast<std::ptrdiff_t>(std::min(batch, blocks.size() - first));
#pragma omp parallel for schedule(dynamic) if (n > 1)
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            const auto k = static_cast<std::size_t>(i);
            BlockCompressor& compress = compressors[static_cast<std::size_t>(omp_get_thread_num())];
            compressed[k] = compress(*blocks[first + k].array, blocks[first + k].first, slots[k]);
        }
        for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k)
            take(static_cast<std::size_t>(blocks[first + k].array - arrays.data()), compressed[k]);
    }
}

std::vector<std::uint64_t> block_header(const RawArray& array, std::span<const std::uint64_t> compressed_sizes) {
    std::vector<std::uint64_t> header{array.n_blocks(), zlib_block_size, array.size() % zlib_block_size};
    header.insert(header.end(), compressed_sizes.begin(), compressed_sizes.end());
    return header;
}

}  // namespace gneiss
