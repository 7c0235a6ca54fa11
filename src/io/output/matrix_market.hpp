#pragma once
// Sparse matrices as text that other programs read: Matrix Market's coordinate format [Boisvert, Pozo and Remington,
// The Matrix Market Exchange Formats: Initial Design, NISTIR 5935 (1996)].

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace gneiss {

/// A square matrix of compressed rows with ascending columns. Refers to arrays of somebody else.
struct CompressedRows {
    std::span<const std::int64_t> row_starts;  ///< shape (n + 1)
    std::span<const std::int64_t> columns;     ///< shape (n_nonzero)
    std::span<const double> values;            ///< shape (n_nonzero)
};

/// Writes all entries that are not zero, rows and columns from 1, numbers that read back exactly. Symmetric matrices
/// are written in full too: half of one would hide it if it were not.
/// @param comment  stands below the heading; no line break
/// @throws IoError
void write_matrix_market(const std::filesystem::path& path, const CompressedRows& matrix, const std::string& comment);

}  // namespace gneiss
