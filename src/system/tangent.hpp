#pragma once
// The matrices that implicit and static solvers need.

#include <cstdint>
#include <span>

#include "system/state.hpp"

namespace gneiss {

/// c_M M + c_C C - c_K df/du - c_V df/dv, dz/du folded in, as a compressed-row matrix over all degrees of freedom.
class Tangent {
public:
    struct Factors {
        double mass = 0, damping = 0, stiffness = 0, velocity = 0;
    };

    virtual ~Tangent() = default;
    virtual bool symmetric() const = 0;
    /// Pattern, fixed while the topology stands: row starts, shape (n_dof + 1), and ascending columns, shape
    /// (n_nonzero).
    virtual std::span<const std::int64_t> row_starts() const = 0;
    virtual std::span<const std::int64_t> columns() const = 0;
    /// @param[out] values  overwritten, shape (n_nonzero)
    virtual void assemble(const State& accepted, const Trial& trial, const Factors& factors,
                          std::span<double> values) const = 0;
};

}  // namespace gneiss
