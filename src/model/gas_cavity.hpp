#pragma once
// Ideal gas in a cavity: its pressure follows the volume that the current boundary encloses  [FORMULATION 8].
//
// Energy balance of a gas with p V = (kappa - 1) U, from which a part r of its mass leaks per unit of time at its own
// enthalpy, and into which a charge burns with the power q V_0:
//
//     U' = -p V' - kappa r U + q V_0
//
// With p = a (V_0/V)^kappa, U = p V/(kappa - 1), what is left of it is a' alone: without leak and charge a is constant,
// p V^kappa as well, and the gas is a spring with the energy U(V). The charge e, in J per initial volume, burns by
// Vieille's law with what is left of it as a factor:
//
//     a' = -kappa r a + (kappa - 1) (V/V_0)^(kappa-1) q,   e' = -q,   q = (e/tau) (p/p_ref)^n
//
// Nodal forces are p dV/du, so that work on the wall is what the gas loses. No gas flows into cracks: where one opens
// in the wall a straight line closes its mouth.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/lumped_model.hpp"
#include "model/options.hpp"

namespace gneiss {

class GasCavity final : public LumpedModel {
public:
    /// @param options    of a gas
    /// @param edges      of the boundary, the cavity on their right
    /// @param thickness  h, m, > 0
    /// @throws InputError with empty `where` if the boundary encloses no cavity, or is open where it may not be
    GasCavity(const LumpedOptions& options, const Mesh& mesh, const std::vector<BoundaryEdge>& edges, double thickness);

    const std::string& name() const override { return options_.name; }
    /// a and, with a charge, e; both in Pa. None where neither changes.
    std::size_t n_internal() const override { return burns() ? 2 : options_.leak > 0 ? 1 : 0; }
    void initial_internal(std::span<double> z) const override;

    void add_force(const Trial& at, std::span<double> f) const override;
    void corner_forces(const Trial& at, std::vector<CornerForce>& forces) const override;
    void internal_rate(const Trial& at, std::span<double> rate) const override;
    /// V linear in time along the step, exponentials of mean rates: positive for any step, order 2, symmetric in time.
    void update_internal(const Trial& from, const Trial& to, std::span<double> z) const override;

    std::vector<std::array<std::int32_t, 2>> couplings() const override;
    void stiffness(const Trial& at, std::span<ForceTerm::Stiffness> df_du) const override;
    /// -dp/dV (dV/du) (dV/du)^T
    std::optional<LowRank::Dyad> dyad(const Trial* from, const Trial& at) const override;

    Rates largest_rates(const Trial& at, std::span<const double> lumped_mass) const override;
    void add_stiffness_bound(const Trial& at, std::span<double> bound) const override;

    /// That of the gas and of what is left of the charge.
    double stored_energy(const Trial& at) const override;
    /// What has leaked.
    void add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const override;
    std::vector<Quantity> quantities(const Trial& at) const override;

    /// Of the cavity, m3. @throws RecoverableError if nothing is left of it
    double volume(const Trial& at) const;
    double initial_volume() const { return initial_volume_; }
    double pressure(const Trial& at) const;

private:
    struct Segment {
        std::int32_t a, b;
        Vec2<double> x_a, x_b;  ///< reference positions about centre_, m
        std::int32_t element;   ///< -1: a line across the mouth of a crack
    };
    /// a and e, Pa, over any scalar.
    template <class T>
    struct Contents {
        T a, e;
    };

    bool burns() const { return options_.burn.has_value(); }
    Contents<double> contents(std::span<const double> z) const;
    /// Adds the lines across the mouths of cracks; whether the boundary then closes.
    bool close(const Mesh& mesh);
    double volume_of(std::span<const double> u) const;
    /// dV/du, in the order of the nodes.
    std::vector<LowRank::Entry> volume_gradient(const Trial& at) const;
    template <class T>
    T pressure(const T& a, const T& volume) const;
    /// q/e at a pressure, 1/s.
    template <class T>
    T burning_rate(const T& pressure) const;
    template <class T>
    Contents<T> updated(const Contents<double>& from, double volume_from, const T& volume_to, double dt) const;

    LumpedOptions options_;
    double thickness_;
    Vec2<double> centre_{0, 0};
    std::vector<Segment> segments_;
    std::vector<std::int32_t> nodes_;  ///< of the segments, ascending, each once
    double initial_volume_ = 0;
};

}  // namespace gneiss
