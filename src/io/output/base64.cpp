#include "io/output/base64.hpp"

#include <algorithm>
#include <cstdint>

namespace gneiss {

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text((bytes.size() + 2) / 3 * 4, '=');
    for (std::size_t i = 0, at = 0; i < bytes.size(); i += 3, at += 4) {
        const std::size_t n_bytes = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;  // 24 of them, zero where bytes are missing
        for (std::size_t k = 0; k < n_bytes; ++k)
            bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + k])) << (16 - 8 * k);
        for (std::size_t k = 0; k <= n_bytes; ++k) text[at + k] = letters[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

}  // namespace gneiss
