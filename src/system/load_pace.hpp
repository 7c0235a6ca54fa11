#pragma once
// Steps that see how loads vary.

#include "system/semi_discrete.hpp"

namespace gneiss {

/// Where a step from t has to end at the latest: at t_stop, or earlier where it would pass over a load unseen.
inline double stop_that_sees_loads(const SemiDiscrete& system, double t, double t_stop) {
    const double longest = system.longest_step(t);
    constexpr double round_off = 1e-9;  // a remainder of round-off is no step of its own
    return t_stop - t > (1 + round_off) * longest ? t + longest : t_stop;
}

}  // namespace gneiss
