#pragma once
// Numbers of nodes, elements and edges are kept as 32 bits; containers count in std::size_t.

#include <cstddef>
#include <cstdint>

namespace gneiss {

/// @param number  >= 0
constexpr std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number); }

}  // namespace gneiss
