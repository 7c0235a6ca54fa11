#pragma once
// Natural frequencies of the assembled system without its matrix.

#include "system/semi_discrete.hpp"

namespace gneiss {

/// An upper estimate of the largest natural frequency, rad/s: the largest Ritz value of M^-1/2 K M^-1/2 after a Lanczos
/// recursion plus its residual. K x is a central difference of the force along x, constrained degrees of freedom are
/// held. Closer than the element bound (which is never too small), at the price of two force evaluations per iteration.
/// @param state  accepted state around which the system is linearised
double lanczos_frequency_bound(const SemiDiscrete& system, const State& state);

}  // namespace gneiss
