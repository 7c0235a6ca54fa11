#pragma once
// Arrays as VTK's XML files hold them: cut into blocks that zlib compresses one by one (vtkZLibDataCompressor).

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace gneiss {

/// Uncompressed size of a block, bytes: the window of zlib, so that larger ones would hardly shrink further.
inline constexpr std::size_t zlib_block_size = 32768;

/// An array before it is compressed.
struct RawArray {
    std::span<const std::byte> bytes;
    bool plane_vectors = false;  ///< doubles (x, y) that stand in the file as (x, y, 0)

    std::size_t size() const { return plane_vectors ? bytes.size() / 2 * 3 : bytes.size(); }
    std::size_t n_blocks() const { return (size() + zlib_block_size - 1) / zlib_block_size; }
};

/// Compresses the blocks of all arrays on all threads and hands them over one by one in their order, on the thread of
/// the caller. Each block is compressed alone, so that its bytes do not depend on the number of threads.
/// @throws what `take` throws; std::bad_alloc if there is no memory
void compress_blocks(std::span<const RawArray> arrays,
                     const std::function<void(std::size_t array, std::string_view block)>& take);

/// What stands in front of an array's blocks: their number, the size of a block, that of the last one where it is
/// smaller, else 0; then the compressed size of each.
std::vector<std::uint64_t> block_header(const RawArray& array, std::span<const std::uint64_t> compressed_sizes);

}  // namespace gneiss
