#include "linear/free_matrix.hpp"

namespace gneiss {

FreeMatrix::FreeMatrix(const SparsePattern& full, std::span<const std::size_t> fixed) {
    // of each unknown: its number among the free ones, or -1 - its number among the fixed ones
    std::vector<std::int64_t> number(full.n());
    for (std::size_t dof = 0, k = 0; dof < full.n(); ++dof) {
        if (k < fixed.size() && fixed[k] == dof) {
            number[dof] = -1 - static_cast<std::int64_t>(k++);
        } else {
            number[dof] = static_cast<std::int64_t>(free_.size());
            free_.push_back(dof);
        }
    }
    row_starts_.push_back(0);
    for (std::size_t row = 0; row < free_.size(); ++row) {
        for (auto k = full.row_starts[free_[row]]; k < full.row_starts[free_[row] + 1]; ++k) {
            const std::int64_t column = number[static_cast<std::size_t>(full.columns[static_cast<std::size_t>(k)])];
            if (column >= 0) {
                columns_.push_back(column);
                source_.push_back(k);
            } else {
                couplings_.push_back({k, row, static_cast<std::size_t>(-1 - column)});
            }
        }
        row_starts_.push_back(static_cast<std::int64_t>(columns_.size()));
    }
}

void FreeMatrix::take_values(std::span<const double> full, std::span<double> values) const {
    for (std::size_t k = 0; k < source_.size(); ++k) values[k] = full[static_cast<std::size_t>(source_[k])];
}

void FreeMatrix::take(std::span<const double> full, std::span<double> vector) const {
    for (std::size_t i = 0; i < free_.size(); ++i) vector[i] = full[free_[i]];
}

void FreeMatrix::put(std::span<const double> vector, std::span<double> full) const {
    for (std::size_t i = 0; i < free_.size(); ++i) full[free_[i]] = vector[i];
}

void FreeMatrix::subtract_fixed(std::span<const double> full_values, std::span<const double> x_fixed,
                                std::span<double> right) const {
    for (const Coupling& c : couplings_)
        right[c.row] -= full_values[static_cast<std::size_t>(c.value)] * x_fixed[c.fixed];
}

}  // namespace gneiss
