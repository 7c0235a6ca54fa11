#pragma once
// The energy balance of a run: where energy came from, where it is, where it went  [FORMULATION 5].

#include "system/semi_discrete.hpp"

namespace gneiss {

struct EnergyLedger {
    double kinetic = 0;         ///< 1/2 v . M v, J
    double scheme = 0;          ///< what the integrator's own measure of kinetic energy has beyond that, J
    StoredEnergies stored;      ///< J
    PathEnergies path;          ///< J since t = 0
    double initial = 0;         ///< kinetic and stored energy at t = 0, J
    double largest_before = 0;  ///< largest_entry() of earlier states of the run, J

    /// What is there and what has left, minus what was there and what came in, J. Zero for exact integration; above
    /// zero energy has been made from nothing, below zero it has got lost.
    double left_over() const;
    /// The largest energy by size that the run has had in any place so far, J.
    double largest_entry() const;
    /// left_over() relative to largest_entry(); 0 where there has been no energy at all.
    double relative_left_over() const;
    double balance_error() const;  ///< its size
};

}  // namespace gneiss
