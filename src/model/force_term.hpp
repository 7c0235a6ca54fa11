#pragma once
// One contribution to f beside the elements: loads, later joints, contact and lumped models. The solid system sums
// them.

#include <span>
#include <string>
#include <vector>

#include "system/state.hpp"

namespace gneiss {

/// A contribution without internal variables that acts on few nodes: a load.
class ForceTerm {
public:
    virtual ~ForceTerm() = default;
    virtual std::string name() const = 0;

    /// Adds its forces, N, to f of shape (2 n_nodes). Pure; called by one thread, in the order of the terms.
    virtual void add_force(const Trial& trial, std::span<double> f) const = 0;

    /// Adds to `energies` what the step from one accepted state to the next adds: the trapezoidal rule
    /// 1/2 (f_from + f_to) . (u_to - u_from), which closes the balance of the leapfrog exactly.
    virtual void add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const = 0;

    /// Instants at which the force jumps or has a kink, ascending, s: steps end there.
    virtual std::vector<double> switch_times() const { return {}; }
};

}  // namespace gneiss
