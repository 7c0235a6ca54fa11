#pragma once
// One contribution to f beside the elements: loads, later joints, contact and lumped models. The solid system sums
// them.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "system/state.hpp"

namespace gneiss {

/// A part of a nodal force that acts on one element: it stays with that element where the node parts.
struct CornerForce {
    std::int32_t element, node;
    Vec2<double> force;  ///< N
};

/// A contribution without internal variables that acts on few nodes: a load.
class ForceTerm {
public:
    virtual ~ForceTerm() = default;
    virtual std::string name() const = 0;

    /// Adds its forces, N, to f of shape (2 n_nodes). Pure; called by one thread, in the order of the terms.
    virtual void add_force(const Trial& trial, std::span<double> f) const = 0;

    /// Appends what of its forces acts on edges of elements, element by element; by default nothing is known of them.
    virtual void corner_forces(const Trial& trial, std::vector<CornerForce>& forces) const {
        (void)trial;
        (void)forces;
    }

    /// Pairs of nodes (a, b) where the force on a depends on the displacement of b, in any order; a pair may occur more
    /// than once. The nodes of a pair belong to one element.
    virtual std::vector<std::array<std::int32_t, 2>> couplings() const { return {}; }
    /// df_a/du_b, N/m.
    struct Stiffness {
        double xx, xy, yx, yy;  ///< first index: force
    };
    /// @param[out] df_du  overwritten, in the order of couplings()
    virtual void stiffness(const Trial& trial, std::span<Stiffness> df_du) const {
        (void)trial;
        (void)df_du;
    }

    /// Adds to `energies` what the step from one accepted state to the next adds: the trapezoidal rule
    /// 1/2 (f_from + f_to) . (u_to - u_from), which closes the balance of the leapfrog exactly.
    virtual void add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const = 0;

    /// Instants at which the force jumps or has a kink, ascending, s: steps end there.
    virtual std::vector<double> switch_times() const { return {}; }
};

}  // namespace gneiss
