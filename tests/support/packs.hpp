#pragma once
// Lanes of a pack, one by one.

#include <array>

#include "base/pack.hpp"

namespace gneiss {

inline std::array<double, pack_width> lanes(const Pack& pack) {
    std::array<double, pack_width> values;
    pack.store_unaligned(values.data());
    return values;
}

/// The pack of value(0), value(1), ...
template <class Value>
Pack pack_of(Value value) {
    std::array<double, pack_width> values;
    for (std::size_t lane = 0; lane < pack_width; ++lane) values[lane] = value(lane);
    return Pack::load_unaligned(values.data());
}

}  // namespace gneiss
