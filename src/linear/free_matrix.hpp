#pragma once
// The part of a matrix over all degrees of freedom that belongs to the free ones: prescribed ones are eliminated.

#include <cstdint>
#include <span>
#include <vector>

#include "base/low_rank.hpp"
#include "linear/linear_solver.hpp"

namespace gneiss {

class FreeMatrix {
public:
    /// @param fixed  ascending, each once
    FreeMatrix(const SparsePattern& full, std::span<const std::size_t> fixed);

    SparsePattern pattern() const { return {row_starts_, columns_}; }
    std::size_t n() const { return free_.size(); }
    /// Number in the full matrix of each free degree of freedom, ascending.
    std::span<const std::size_t> free() const { return free_; }

    /// Memory of the pattern and of the way to it.
    std::size_t bytes() const;

    /// @param[out] values  free rows and columns of the full ones; may begin where `full` does
    void take_values(std::span<const double> full, std::span<double> values) const;
    /// @param[out] vector  free entries of a full one
    void take(std::span<const double> full, std::span<double> vector) const;
    /// Its free rows and columns.
    LowRank take(const LowRank& full) const;
    /// Writes the free entries of a full vector; leaves the others.
    void put(std::span<const double> vector, std::span<double> full) const;
    /// right -= A_fc x_c: what given changes of the fixed unknowns leave for the free equations.
    /// @param x_fixed  in the order of `fixed`
    void subtract_fixed(std::span<const double> full_values, std::span<const double> x_fixed,
                        std::span<double> right) const;
    /// The same of what stands beside the matrix.
    void subtract_fixed(const LowRank& full, std::span<const double> x_fixed, std::span<double> right) const;

private:
    struct Coupling {
        std::int64_t value;      ///< in the full matrix
        std::size_t row, fixed;  ///< free row; which of the fixed unknowns
    };
    /// Values that follow each other in both matrices: whole rows but for those of the neighbours of fixed unknowns.
    struct Run {
        std::int64_t from, length;  ///< first value in the full matrix, number of values
    };
    std::vector<std::size_t> free_;
    std::vector<std::int64_t> row_starts_, columns_;
    std::vector<Run> runs_;
    std::vector<Coupling> couplings_;
};

}  // namespace gneiss
