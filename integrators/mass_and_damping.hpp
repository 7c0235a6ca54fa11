#pragma once
// What the diagonal M and the nodal C do to a vector of all degrees of freedom.

#include <span>

#include "base/parallel.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// f -= C v.
/// @param v  m/s, shape (n_dof)
/// @param f  N, same shape
inline void subtract_damping(const SemiDiscrete& system, std::span<const double> v, std::span<double> f) {
    const Damping& damping = system.damping();
    if (const double c = damping.mass_proportional; c > 0) {
        const auto mass = system.lumped_mass();
        parallel_ranges(f.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) f[i] -= c * mass[i] * v[i];
        });
    }
    for (const Damping::Block& block : damping.blocks) {
        const auto x = 2 * static_cast<std::size_t>(block.node), y = x + 1;
        f[x] -= block.xx * v[x] + block.xy * v[y];
        f[y] -= block.xy * v[x] + block.yy * v[y];
    }
}

/// 1/2 v . M v, J.
/// @param partial  scratch
inline double synchronised_kinetic_energy(const SemiDiscrete& system, std::span<const double> v,
                                          std::vector<double>& partial) {
    const auto mass = system.lumped_mass();
    return 0.5 * ordered_sum(v.size(), partial, [&](std::size_t first, std::size_t last) {
               double sum = 0;
               for (std::size_t i = first; i < last; ++i) sum += mass[i] * v[i] * v[i];
               return sum;
           });
}

}  // namespace gneiss
