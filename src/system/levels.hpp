#pragma once
// The elements of a system in levels, by the step that each of them stands: those of level k stand steps that are 2^k
// times shorter than those of level 0.

#include <cstddef>
#include <cstdint>
#include <span>

#include "system/state.hpp"

namespace gneiss {

struct FrequencyBound;

class Levels {
public:
    virtual ~Levels() = default;

    /// There are levels 0 to finest() >= 1.
    virtual int finest() const = 0;
    virtual std::size_t n_elements(int level) const = 0;

    /// Nodes of the elements of this level, 1 <= level <= finest(), and of all finer ones, ascending: those of level +
    /// 1 are among those of level.
    virtual std::span<const std::int32_t> nodes(int level) const = 0;

    /// Forces of the elements of one level alone, 1 <= level <= finest(). Pure.
    /// @param trial   its velocities, where forces depend on them, and its time
    /// @param u       displacements in place of the trial's, m, pairs, shape (nodes(level))
    /// @param[out] f  overwritten, N, same shape
    /// @throws RecoverableError if an element is inverted
    virtual void force(int level, const State& accepted, const Trial& trial, std::span<const double> u,
                       std::span<double> f) const = 0;

    /// What limits the step of level 0: SemiDiscrete::frequency_bound() with the frequencies of elements of level k
    /// divided by 2^k.
    virtual FrequencyBound bound(const State& accepted) const = 0;
};

}  // namespace gneiss
