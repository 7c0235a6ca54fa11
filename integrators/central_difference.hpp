#pragma once
// Explicit central difference (leapfrog), FORMULATION 5, in its synchronised form: displacement, velocity and
// acceleration are all known at the end of a step. With v(n+1/2) = v(n) + dt/2 a(n),
//
//     u(n+1) = u(n) + dt v(n+1/2),    (1 + dt c/2 + dt/2 M^-1 C) v(n+1) = v(n+1/2) + dt/2 M^-1 f(n+1)
//
// which is the leapfrog [ (1/dt + c/2) v(n+1/2) = (1/dt - c/2) v(n-1/2) + M^-1 f(n) ] with v(n) the mean of its two
// neighbours. Order 2, also in damping; absorbing boundaries are solved node by node. Reactions take the inertia of a
// support as its mean over the step: exact where it does not accelerate, order 1 where it does.

#include <memory>
#include <vector>

#include "integrators/absorbing_nodes.hpp"
#include "integrators/leapfrog_energy.hpp"
#include "integrators/local_steps.hpp"
#include "integrators/stable_step.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class CentralDifference final : public Integrator {
public:
    using Options = StableStep::Options;

    /// @param levels  most lengths of local steps, [1, LocalSteps::most_levels]; 1: one step for all elements
    explicit CentralDifference(const Options& options, int levels = 1);

    std::string name() const override { return "central_difference"; }
    void start(const SemiDiscrete& system, State& state, StartReason why) override;
    StepReport advance(const SemiDiscrete& system, State& state, double t_stop) override;
    /// One pass over the nodes per step instead of two, where neither forces nor energies need v(n).
    StepReport advance_unseen(const SemiDiscrete& system, State& state, double t_stop, double t_look) override;
    /// With it the leapfrog conserves the energy of a linear system to round-off; see LeapfrogEnergy.
    double kinetic_energy(const SemiDiscrete& system, const State& state) const override;
    std::span<const double> reactions(const SemiDiscrete&, const State&) override { return reactions_; }
    WorkCounts work() const override {
        return {.elements = n_local_ + (local_ ? local_->n_evaluated() : 0), .starts = n_starts_};
    }
    IntegratorMemory save() const override;
    void load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) override;

    /// Critical step of the bound last evaluated, s, without the safety factor. For forces that are evaluated at the
    /// velocity v(n-1/2) + dt/2 a(n-1) it is dt^2 omega^2 + 4 dt c <= 4, from an eigenvalue -1 of the recursion.
    double critical_time_step() const { return step_.critical_time_step(); }

private:
    void allocate(const SemiDiscrete& system);
    /// Position (of a new run) and velocity of prescribed motion at the instant of a start.
    void hold_constraints(const SemiDiscrete& system, State& state, StartReason why);
    /// Chooses the next step, and the time in next_.
    void plan_step(const SemiDiscrete& system, const State& state, double t_stop);
    void kick_and_drift(const SemiDiscrete& system, const State& state);
    void prescribe(const SemiDiscrete& system, const State& state);
    /// The end of the step.
    Trial trial() const { return {next_.t, next_.last_event, next_.u, next_.v, {}}; }
    /// f(n+1) into a_; z and history into next_.
    void evaluate(const SemiDiscrete& system, const State& state);
    /// Of local steps: the mean of a_ over them, at what the forces in it were evaluated at.
    void average(const SemiDiscrete& system, const State& accepted, const Trial& at);
    void kick(const SemiDiscrete& system, const State& state);
    /// On constrained and absorbing degrees of freedom: keeps v(n+1/2) and f(n+1), from which kick_special() makes
    /// v(n+1) and a(n+1).
    void remember_special();
    void kick_special(const SemiDiscrete& system, const State& state);
    void add_path_energies(const SemiDiscrete& system, const State& state);

    /// Whether accepting a step changes more than u and v.
    bool remembers() const { return !next_.z.empty() || !next_.history.empty(); }

    // Steps that nobody sees keep v(n+1/2) in next_.v; state.v holds v(n) on special degrees of freedom alone.
    bool can_pass_unseen(const SemiDiscrete& system) const;
    /// Accepts a step unseen.
    void accept_unseen(State& state);
    /// The end of a step of length dt_before and the beginning of the next one, on all degrees of freedom, with the
    /// evaluation that ends it: a piece of the nodes is moved when the system asks for it.
    void kick_on_and_evaluate(const SemiDiscrete& system, const State& state, double dt_before);
    class KickAndDrift;
    /// state.v and a_ at the last accepted state, after a later step has failed.
    void synchronise(const SemiDiscrete& system, State& state, double dt_before);
    /// From forces in a_ to accelerations; and net_, at an accepted state.
    void settle(const SemiDiscrete& system, const State& state);
    /// Subtracts C v from forces on the constrained degrees of freedom.
    void subtract_damping(const SemiDiscrete& system, std::span<const double> v, std::vector<double>& net) const;

    /// Before the step's second half.
    struct HalfKicked : AbsorbingNode {
        Vec2<double> v_half, f;
    };

    StableStep step_;
    int levels_;
    std::unique_ptr<LocalSteps> local_;  ///< null: one step for all elements
    std::size_t n_local_ = 0;            ///< elements evaluated by earlier local_
    LeapfrogEnergy energy_;
    std::size_t n_starts_ = 0;  ///< evaluations of forces where starts begin
    std::vector<double> inverse_mass_;
    std::vector<double> a_;       ///< acceleration at the accepted state; f while a step is under way
    std::vector<double> v_half_;  ///< v(n+1/2), kept where the force needs another velocity
    State next_;

    // constrained degrees of freedom
    std::vector<double> prescribed_, middle_;  ///< values at the end and in the middle of a step
    std::vector<double> end_velocity_;         ///< v(n+1) of prescribed motion
    std::vector<double> net_, net_before_, reactions_;
    std::vector<HalfKicked> absorbing_;
    std::vector<std::size_t> special_;  ///< degrees of freedom that are constrained or absorbing
    /// Where a step moves a special degree of freedom to.
    struct Moved {
        std::size_t dof;
        double u, v;
    };
    std::vector<Moved> moved_;  ///< by ascending degree of freedom
    mutable std::vector<double> partial_;
};

}  // namespace gneiss
