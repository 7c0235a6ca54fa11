#pragma once
// An upper bound of the largest eigenvalue of small symmetric matrices, for a pack of them at once.

#include <array>

#include "base/pack.hpp"

namespace gneiss {

/// lambda_max <= (sum lambda^p)^(1/p) = (tr A^p)^(1/p) with p = 2^squarings: at most n^(1/p) too large (2 % for n = 6
/// and p = 64), never too small.
/// @param a  symmetric, row by row, shape (n, n); overwritten
template <int n>
Pack largest_eigenvalue_bound(std::array<Pack, n * n>& a, int squarings = 6);

// CST and COMPT
extern template Pack largest_eigenvalue_bound<6>(std::array<Pack, 36>&, int);
extern template Pack largest_eigenvalue_bound<12>(std::array<Pack, 144>&, int);

}  // namespace gneiss
