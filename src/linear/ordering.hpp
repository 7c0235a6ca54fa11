#pragma once
// In which order unknowns are eliminated, so that the factors of a sparse matrix stay sparse.

#include <cstdint>
#include <vector>

#include "linear/linear_solver.hpp"

namespace gneiss {

/// Whether every entry of the pattern has its mirror image, and no entry of the diagonal is missing.
bool is_structurally_symmetric(const SparsePattern& pattern);

struct Ordering {
    std::vector<std::int64_t> unknowns;  ///< in the order of their elimination
    double factor_entries = 0;           ///< entries of L to be expected
};

/// For patterns that are structurally symmetric. Unknowns side by side with the same row, the components of a node, are
/// ordered as one: a quarter of the entries to look at. Minimum degree for small systems; nested dissection (METIS) for
/// large ones: slower than a factorisation, which it then saves a third of, and a fifth of the memory.
Ordering fill_reducing_ordering(const SparsePattern& pattern);

}  // namespace gneiss
