#pragma once
// Models of a few numbers that the solid is coupled to: a gas in a cavity, a platen on a spring  [FORMULATION 8].

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/low_rank.hpp"
#include "base/vec2.hpp"
#include "model/force_term.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// Part of the one system M a = f(t, u, v, z), z' = g(t, u, v, z). It may have internal variables of its own, in Pa,
/// and a point of mass of its own, which stands behind the nodes of the mesh and moves as they do. The trials that its
/// functions take hold its own z and nothing else's; what moves is the whole solid.
class LumpedModel {
public:
    virtual ~LumpedModel() = default;
    /// Heads its columns of history.csv.
    virtual const std::string& name() const = 0;

    // ---- its unknowns
    /// At most `most_internal`.
    virtual std::size_t n_internal() const { return 0; }
    static constexpr std::size_t most_internal = 2;
    virtual void initial_internal(std::span<double> z) const { (void)z; }
    struct Point {
        double mass;            ///< kg, > 0
        Vec2<double> velocity;  ///< at t = 0, m/s
    };
    virtual std::optional<Point> point() const { return std::nullopt; }
    /// Where its point stands among the nodes; told again when that changes.
    virtual void place_point(std::int32_t node) { (void)node; }

    // ---- its part of f and g
    virtual void add_force(const Trial& at, std::span<double> f) const = 0;
    /// As ForceTerm::corner_forces().
    virtual void corner_forces(const Trial& at, std::vector<CornerForce>& forces) const { (void)at, (void)forces; }
    virtual bool depends_on_velocity() const { return false; }
    /// z' at a trial.
    virtual void internal_rate(const Trial& at, std::span<double> rate) const {
        (void)at;
        (void)rate;
    }
    /// z at the end of a step of a scheme that takes z from u: of order 2 or better in the step.
    /// @param to  without z
    virtual void update_internal(const Trial& from, const Trial& to, std::span<double> z) const {
        (void)from;
        (void)to;
        (void)z;
    }

    // ---- its part of the tangent: symmetric
    /// Pairs of nodes (a, b), as Interaction::couplings().
    virtual std::vector<std::array<std::int32_t, 2>> couplings() const { return {}; }
    /// df_a/du_b, N/m, and df_a/dv_b, N s/m, in the order of couplings(), overwritten.
    virtual void stiffness(const Trial& at, std::span<ForceTerm::Stiffness> df_du) const { (void)at, (void)df_du; }
    virtual void velocity_stiffness(const Trial& at, std::span<ForceTerm::Stiffness> df_dv) const {
        (void)at, (void)df_dv;
    }
    /// The rest of -df/du, where all of its nodes are coupled by one number.
    /// @param from  null: z is given; otherwise z follows u from there, as update_internal() says, and `at` has it
    virtual std::optional<LowRank::Dyad> dyad(const Trial* from, const Trial& at) const {
        (void)from;
        (void)at;
        return std::nullopt;
    }

    // ---- what limits a step
    /// Upper bounds of the eigenvalues of -M^-1 df/du, (rad/s)^2, and of -M^-1 df/dv, 1/s.
    struct Rates {
        double omega_squared = 0, damping = 0;
    };
    virtual Rates largest_rates(const Trial& at, std::span<const double> lumped_mass) const = 0;
    /// Adds to the diagonal of a matrix D with x.K x <= x.D x for K = -df/du, N/m.
    virtual void add_stiffness_bound(const Trial& at, std::span<double> bound) const = 0;

    // ---- energies and output
    virtual double stored_energy(const Trial& at) const = 0;  ///< J
    /// Adds what the step between two accepted states adds, by the trapezoidal rule, as ForceTerm does.
    virtual void add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const = 0;
    /// As ForceTerm::switch_times().
    virtual std::vector<double> switch_times() const { return {}; }
    struct Quantity {
        std::string name, unit;
        double value;
    };
    /// What there is to tell of it, always the same in number and order.
    virtual std::vector<Quantity> quantities(const Trial& at) const = 0;
};

}  // namespace gneiss
