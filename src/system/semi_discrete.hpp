#pragma once
// M a + C v = f(t, u, v, z),  z' = g(t, u, v, z)   [FORMULATION 1; Lei et al. 2016, (1)]:
// everything a time integrator, a static solver or a cross-check may know of a solid.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "system/event.hpp"
#include "system/levels.hpp"
#include "system/state.hpp"
#include "system/tangent.hpp"

namespace gneiss {

/// Sizes of a system.
struct Layout {
    std::size_t n_dof = 0;       ///< displacements: 2 per node, of the mesh and, behind them, of lumped models
    std::size_t n_internal = 0;  ///< z
    std::size_t n_history = 0;
};

/// The velocity-proportional forces that are linear and local to a node, C v.
struct Damping {
    /// A symmetric 2 x 2 matrix of one node, N s/m.
    struct Block {
        std::int32_t node;
        double xx, xy, yy;
    };
    double mass_proportional = 0;  ///< c in C = c M, 1/s
    std::vector<Block> blocks;     ///< absorbing boundaries, at most one per node, ascending
};

/// A degree of freedom whose motion is prescribed.
struct Constraint {
    enum class Kind { displacement, velocity };
    std::size_t dof;  ///< 2 node + component
    Kind kind;
};

/// Energies that are functions of the state, J.
struct StoredEnergies {
    double material = 0;      ///< of laws that have a stored energy
    double stress_power = 0;  ///< accumulated stress power of laws that have none
    double contact = 0;
    double joints = 0;
    double models = 0;  ///< lumped models: gas with its charge, springs

    double sum() const { return material + stress_power + contact + joints + models; }
};

/// What limits an explicit step.
struct FrequencyBound {
    double omega = 0;         ///< upper bound of the natural frequencies, rad/s
    double damping_rate = 0;  ///< upper bound of the eigenvalues of M^-1 (-df/dv), 1/s: viscous stress, not C
    double of_bonds = 0;      ///< what joints, contact, lumped models contribute to omega^2, (rad/s)^2
};

/// Displacements of a trial that are on their way.
class Arrival {
public:
    /// Puts those of the degrees of freedom [first, last) where the trial shows them.
    virtual void bring(std::size_t first, std::size_t last) const = 0;

protected:
    ~Arrival() = default;
};

class SemiDiscrete {
public:
    virtual ~SemiDiscrete() = default;

    virtual Layout layout() const = 0;
    /// At rest at t = 0 with the initial velocities and internal variables.
    virtual State initial_state() const = 0;

    /// Diagonal of M, kg, shape (n_dof): a node's mass stands at both of its components. All > 0.
    virtual std::span<const double> lumped_mass() const = 0;
    virtual const Damping& damping() const = 0;

    /// Prescribed motion, by ascending degree of freedom; its values are displacements (m) or velocities (m/s).
    virtual std::span<const Constraint> constraints() const = 0;
    /// @param[out] values  shape (constraints)
    virtual void constraint_values(double t, double last_event, std::span<double> values) const = 0;

    /// True if f depends on v (viscous stress, damping in contact): C v does not count.
    virtual bool force_depends_on_velocity() const = 0;

    /// True if history holds, or may come to hold, what a step back in time would not undo: damage, friction.
    virtual bool irreversible() const { return false; }

    /// f(t, u, v, z), N. Pure: the accepted state is read only.
    /// @param[out] f  overwritten, shape (n_dof); external, material and contact forces, without C v
    /// @throws RecoverableError if an element is inverted in the trial state
    virtual void force(const State& accepted, const Trial& trial, std::span<double> f) const = 0;

    /// force() together with the internal variables and the history that accepting the trial would leave.
    /// @param[out] z, history  overwritten, shapes (n_internal), (n_history); not the accepted state's own vectors
    virtual void force_and_update(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                                  std::span<double> history) const = 0;

    /// force(), or force_and_update() where z and history are not empty, at displacements that are on their way: a
    /// system that goes through its nodes piece by piece brings a piece right before it needs it, and has it near. Each
    /// degree of freedom is brought once, by any thread, before f is written there; all are when this returns or
    /// throws.
    virtual void force_on_arrival(const State& accepted, const Trial& trial, const Arrival& arrival,
                                  std::span<double> f, std::span<double> z, std::span<double> history) const {
        parallel_ranges(f.size(), [&](std::size_t first, std::size_t last) { arrival.bring(first, last); });
        if (z.empty() && history.empty())
            force(accepted, trial, f);
        else
            force_and_update(accepted, trial, f, z, history);
    }

    /// The part of f that additive schemes may leave to their explicit half: what acts from outside and is not stiff.
    /// @param[out] f  overwritten, N, shape (n_dof)
    virtual void external_force(const Trial& trial, std::span<double> f) const = 0;

    /// The part of f that parts of the solid exert on each other, joints and contact: stiff, of few nodes, and cheap
    /// beside the rest. Multirate schemes take it in shorter steps.
    /// @param[out] f        overwritten, N, shape (n_dof)
    /// @param[out] history  if not empty, overwritten by what interactions alone would remember of the trial if it were
    ///                      accepted, and by the accepted history for the rest; shape (n_history), not the accepted one
    virtual void interaction_force(const State& accepted, const Trial& trial, std::span<double> f,
                                   std::span<double> history) const {
        (void)trial;
        std::ranges::fill(f, 0.0);
        if (!history.empty()) std::ranges::copy(accepted.history, history.begin());
    }
    void interaction_force(const State& accepted, const Trial& trial, std::span<double> f) const {
        interaction_force(accepted, trial, f, {});
    }

    /// z' = g(t, u, v, z) at the trial's own z. Linear in v but for a part that does not depend on it, as f is in z.
    /// @param[out] rate  overwritten, shape (n_internal)
    virtual void internal_rate(const State& accepted, const Trial& trial, std::span<double> rate) const = 0;

    /// Which internal variables forces depend on: 1, or 0 for what is only counted, as accumulated stress power is.
    /// @param[out] weights  overwritten, shape (n_internal)
    virtual void internal_weights(std::span<double> weights) const = 0;

    /// A length that displacements can be measured against, m: the shortest edge. Scales of differences and tolerances.
    virtual double smallest_length() const = 0;

    /// Exact tangents, or nullptr where a system has none.
    virtual const Tangent* tangent() const { return nullptr; }

    /// From the tangents in the accepted state.
    virtual FrequencyBound frequency_bound(const State& accepted) const = 0;
    /// FrequencyBound::of_bonds alone, which is what changes where a mesh comes apart. Far cheaper than the whole.
    virtual double bond_omega_squared(const State& accepted) const {
        (void)accepted;
        return 0;
    }
    /// Its elements in levels, in the state at t = 0: as many as save most work, but no more than `most`. None: there
    /// is nothing to save.
    /// @throws InputError if something acts that cannot be told apart by elements
    virtual std::unique_ptr<Levels> levels(int most) const {
        (void)most;
        return nullptr;
    }
    /// A diagonal matrix D with x.K x <= x.D x for K = -df/du at a trial: fictitious masses of pseudo-time. Where
    /// nothing better is known it is the mass times the square of the largest frequency of the accepted state.
    /// @param[out] bound  overwritten, N/m, shape (n_dof)
    virtual void stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const {
        (void)trial;
        const double omega = frequency_bound(accepted).omega;
        for (std::size_t i = 0; i < bound.size(); ++i) bound[i] = omega * omega * lumped_mass()[i];
    }

    virtual StoredEnergies stored_energies(const State& state) const = 0;
    /// Adds to to.path what the step between two accepted states adds: the work of loads and the dissipation of
    /// viscous stress and absorbing boundaries, by the trapezoidal rule along the step.
    virtual void add_path_energies(const State& from, State& to) const = 0;

    virtual std::span<const std::unique_ptr<Event>> events() const = 0;
    /// Whether an event that watches wants to look at this state; see Event::stirred().
    bool stirred(const State& state) const {
        for (const auto& event : events())
            if (event->watches() && event->stirred(state)) return true;
        return false;
    }

    /// The longest step that begins at t and still sees how loads and prescribed motions vary, s: a longer one may pass
    /// over a pulse. Where they jump or bend is for events(), which end steps anyway.
    virtual double longest_step(double t) const {
        (void)t;
        return std::numeric_limits<double>::infinity();
    }
    /// Instants at which loads and prescribed motions are largest, or vary fastest, s, ascending: magnitudes to expect
    /// while nothing moves yet.
    virtual std::span<const double> load_peaks() const { return {}; }
};

}  // namespace gneiss
