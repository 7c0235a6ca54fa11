#pragma once
// What couples many unknowns with each other, all by one number: the pressure of a gas and the whole wall around it.

#include <cstdint>
#include <span>
#include <vector>

namespace gneiss {

/// A sum of symmetric dyads s b b^T that stands beside a sparse matrix, which it would fill.
struct LowRank {
    struct Entry {
        std::int64_t row;
        double value;
    };
    struct Dyad {
        double factor;              ///< s
        std::vector<Entry> column;  ///< b, each row once
    };
    std::vector<Dyad> dyads;

    bool empty() const { return dyads.empty(); }

    /// y += scale b (b . x) s, summed over the dyads.
    void add_product(double scale, std::span<const double> x, std::span<double> y) const {
        for (const Dyad& dyad : dyads) {
            const double s = scale * dyad.factor * along(dyad, x);
            for (const Entry& entry : dyad.column) y[static_cast<std::size_t>(entry.row)] += s * entry.value;
        }
    }
    /// b . x
    static double along(const Dyad& dyad, std::span<const double> x) {
        double sum = 0;
        for (const Entry& entry : dyad.column) sum += entry.value * x[static_cast<std::size_t>(entry.row)];
        return sum;
    }
};

}  // namespace gneiss
