#pragma once

#include <limits>

namespace gneiss::test {

inline constexpr double eps = std::numeric_limits<double>::epsilon();  ///< in tolerances of round-off, c eps scale

}  // namespace gneiss::test
