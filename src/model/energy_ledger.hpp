#pragma once
// The energy ledger of a run: where energy came from, where it is, where it went  [FORMULATION 5].

#include "system/semi_discrete.hpp"

namespace gneiss {

struct EnergyLedger {
    double kinetic = 0;     ///< J, in the measure of the integrator
    StoredEnergies stored;  ///< J
    PathEnergies path;      ///< J since t = 0
    double initial = 0;     ///< kinetic and stored energy at t = 0, J

    /// What is there and what has left, minus what was there and what came in, J. Zero for exact integration.
    double left_over() const;
    /// |left over| relative to the largest entry; 0 where there is no energy at all.
    double balance_error() const;
};

}  // namespace gneiss
