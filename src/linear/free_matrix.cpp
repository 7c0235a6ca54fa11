#include "linear/free_matrix.hpp"

#include <algorithm>

namespace gneiss {

FreeMatrix::FreeMatrix(const SparsePattern& full, std::span<const std::size_t> fixed) {
    // of each unknown: its number among the free ones, or -1 - its number among the fixed ones
    std::vector<std::int64_t> number(full.n());
    free_.reserve(full.n() - fixed.size());
    for (std::size_t dof = 0, k = 0; dof < full.n(); ++dof) {
        if (k < fixed.size() && fixed[k] == dof) {
            number[dof] = -1 - static_cast<std::int64_t>(k++);
        } else {
            number[dof] = static_cast<std::int64_t>(free_.size());
            free_.push_back(dof);
        }
    }
    row_starts_.reserve(free_.size() + 1);
    columns_.reserve(full.n_nonzero());
    row_starts_.push_back(0);
    for (std::size_t row = 0; row < free_.size(); ++row) {
        for (auto k = full.row_starts[free_[row]]; k < full.row_starts[free_[row] + 1]; ++k) {
            const std::int64_t column = number[static_cast<std::size_t>(full.columns[static_cast<std::size_t>(k)])];
            if (column >= 0) {
                columns_.push_back(column);
                if (!runs_.empty() && runs_.back().from + runs_.back().length == k)
                    ++runs_.back().length;
                else
                    runs_.push_back({k, 1});
            } else {
                couplings_.push_back({k, row, static_cast<std::size_t>(-1 - column)});
            }
        }
        row_starts_.push_back(static_cast<std::int64_t>(columns_.size()));
    }
}

std::size_t FreeMatrix::bytes() const {
    return free_.size() * sizeof(free_[0]) + (row_starts_.size() + columns_.size()) * sizeof(std::int64_t) +
           runs_.size() * sizeof(Run) + couplings_.size() * sizeof(Coupling);
}

void FreeMatrix::take_values(std::span<const double> full, std::span<double> values) const {
    // forwards: values move to the front alone
    double* to = values.data();
    for (const Run& run : runs_) {
        const double* from = full.data() + run.from;
        to = to == from ? to + run.length : std::copy_n(from, run.length, to);
    }
}

void FreeMatrix::take(std::span<const double> full, std::span<double> vector) const {
    for (std::size_t i = 0; i < free_.size(); ++i) vector[i] = full[free_[i]];
}

LowRank FreeMatrix::take(const LowRank& full) const {
    LowRank taken;
    for (const LowRank::Dyad& dyad : full.dyads) {
        LowRank::Dyad& to = taken.dyads.emplace_back(LowRank::Dyad{dyad.factor, {}});
        for (const auto& [row, value] : dyad.column) {
            const auto place = std::ranges::lower_bound(free_, static_cast<std::size_t>(row));
            if (place != free_.end() && *place == static_cast<std::size_t>(row))
                to.column.push_back({place - free_.begin(), value});
        }
    }
    return taken;
}

void FreeMatrix::put(std::span<const double> vector, std::span<double> full) const {
    for (std::size_t i = 0; i < free_.size(); ++i) full[free_[i]] = vector[i];
}

void FreeMatrix::subtract_fixed(std::span<const double> full_values, std::span<const double> x_fixed,
                                std::span<double> right) const {
    for (const Coupling& c : couplings_)
        right[c.row] -= full_values[static_cast<std::size_t>(c.value)] * x_fixed[c.fixed];
}

void FreeMatrix::subtract_fixed(const LowRank& full, std::span<const double> x_fixed, std::span<double> right) const {
    for (const LowRank::Dyad& dyad : full.dyads) {
        double along = 0;  // b_c . x_c
        std::vector<LowRank::Entry> column;
        for (const auto& [row, value] : dyad.column) {
            const auto place = std::ranges::lower_bound(free_, static_cast<std::size_t>(row)) - free_.begin();
            if (place < std::ssize(free_) && free_[static_cast<std::size_t>(place)] == static_cast<std::size_t>(row))
                column.push_back({place, value});
            else
                along += value * x_fixed[static_cast<std::size_t>(row - place)];
        }
        for (const auto& [row, value] : column) right[static_cast<std::size_t>(row)] -= dyad.factor * along * value;
    }
}

}  // namespace gneiss
