#pragma once
// A short number that tells whether two texts are the same.

#include <cstdint>
#include <string>
#include <string_view>

namespace gneiss {

/// Offset basis of FNV-1a with 64 bits: the fingerprint of nothing.
inline constexpr std::uint64_t fnv1a_basis = 0xcbf29ce484222325u;

/// FNV-1a, 64 bits [Fowler, Noll, Vo; RFC 9923]. Tells decks apart and finds damaged files; no defence against someone
/// who makes two texts collide on purpose. Pass the last result as `state` to go on with more bytes.
std::uint64_t fingerprint(std::string_view bytes, std::uint64_t state = fnv1a_basis);

/// "fnv1a64:" and 16 hexadecimal digits, as it stands in summary.json and checkpoint.h5.
std::string fingerprint_text(std::string_view bytes);

}  // namespace gneiss
