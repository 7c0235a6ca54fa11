#include "io/output/fingerprint.hpp"

#include <fmt/format.h>

namespace gneiss {

std::uint64_t fingerprint(std::string_view bytes, std::uint64_t state) {
    constexpr std::uint64_t prime = 0x100000001b3u;
    for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * prime;
    return state;
}

std::string fingerprint_text(std::string_view bytes) { return fmt::format("fnv1a64:{:016x}", fingerprint(bytes)); }

}  // namespace gneiss
