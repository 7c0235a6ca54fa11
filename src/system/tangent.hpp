#pragma once
// The matrices that implicit and static solvers need.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/low_rank.hpp"
#include "system/state.hpp"

namespace gneiss {

/// Where a square matrix has entries: compressed rows with ascending columns.
struct MatrixPattern {
    std::vector<std::int64_t> row_starts;  ///< shape (n + 1)
    std::vector<std::int64_t> columns;     ///< shape (n_nonzero)
};

/// c_M M + c_C C - c_K df/du - c_V df/dv, dz/du folded in, over all degrees of freedom: a compressed-row matrix and,
/// where one number couples many degrees of freedom, a few dyads beside it.
class Tangent {
public:
    struct Factors {
        double mass = 0, damping = 0, stiffness = 0, velocity = 0;
    };

    virtual ~Tangent() = default;
    virtual bool symmetric() const = 0;
    /// The diagonal of all of it alone: what preconditions iterations without a matrix.
    /// @param[out] diagonal  overwritten, shape (n_dof)
    virtual void assemble_diagonal(const State& accepted, const Trial& trial, const Factors& factors,
                                   std::span<double> diagonal) const = 0;
    virtual std::size_t n_nonzero() const = 0;
    /// Over all degrees of freedom, fixed while the topology stands; made anew by every call.
    virtual MatrixPattern pattern() const = 0;
    /// @param[out] values  overwritten, shape (n_nonzero)
    virtual void assemble(const State& accepted, const Trial& trial, const Factors& factors,
                          std::span<double> values) const = 0;
    /// What stands beside the compressed rows.
    virtual LowRank beside(const State& accepted, const Trial& trial, const Factors& factors) const {
        (void)accepted;
        (void)trial;
        (void)factors;
        return {};
    }
};

}  // namespace gneiss
