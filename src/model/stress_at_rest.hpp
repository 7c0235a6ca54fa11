#pragma once
// The stress that a solid is under before anything has moved: what is stressed in situ.

#include <array>
#include <vector>

#include "model/solid_system.hpp"

namespace gneiss {

/// Mean Cauchy stress of each element at the start, Pa: xx, yy, xy, shape (n_elements).
std::vector<std::array<double, 3>> stress_at_rest(const SolidSystem& solid);

}  // namespace gneiss
