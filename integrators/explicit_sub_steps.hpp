#pragma once
// What explicit schemes have in common whose steps are made of sub-steps: the stable step, supports, damping solved
// node by node, the energies of every sub-step, memory.

#include <vector>

#include "integrators/absorbing_nodes.hpp"
#include "integrators/leapfrog_energy.hpp"
#include "integrators/prescribed_motion.hpp"
#include "integrators/stable_step.hpp"

namespace gneiss {

class ExplicitSubSteps : public Integrator {
public:
    void start(const SemiDiscrete& system, State& state, StartReason why) final;
    StepReport advance(const SemiDiscrete& system, State& state, double t_stop) final;
    double kinetic_energy(const SemiDiscrete& system, const State& state) const final;
    std::span<const double> reactions(const SemiDiscrete&, const State&) final { return reactions_; }
    WorkCounts work() const final { return {.balance = n_balance_, .starts = n_starts_}; }
    IntegratorMemory save() const final;
    void load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) final;

    /// Critical step of the bound last evaluated, s, without the safety factor.
    double critical_time_step() const { return step_.critical_time_step(); }

protected:
    ExplicitSubSteps(const StableStep::Options& step, const StabilityLimit& limit) : step_(step, limit) {}

    // ---- what a scheme answers
    /// All sub-steps of a step of length dt, from an accepted state; the last one, to t_end, into next_.
    virtual void take(const SemiDiscrete& system, const State& state, double dt, double t_end) = 0;
    /// @throws InputError if the scheme cannot have this system
    virtual void check(const SemiDiscrete& system) const { (void)system; }
    virtual void allocate(const SemiDiscrete& system);
    /// How often forces that depend on velocity are evaluated in a sub-step.
    virtual int evaluations_with_velocity() const { return 1; }
    /// Whether C limits the step, as viscous stress does.
    virtual bool damping_limits() const { return false; }
    /// Whether 1/2 v . M v less LeapfrogEnergy::excess() is the kinetic energy in which the balance is sharpest.
    virtual bool has_excess() const { return false; }

    // ---- what it builds on
    /// In units of the sub-step: v' = v + h (before a_before + now a + next a').
    struct Weights {
        double before = 0, now = 0.5, next = 0.5;
    };
    /// A sub-step of length h to t into next_, explicit but for C:
    /// u' = u + h v + h^2/2 a, M a' = f' - C v', with the forces that depend on velocity at v + h a at first.
    void sub_step(const SemiDiscrete& system, const State& from, double h, double t, const Weights& weights);
    /// Makes next_ the state that the next sub-step begins from.
    const State& go_on() {
        std::swap(sub_, next_);
        return sub_;
    }
    /// f_ at a trial that comes after `from`; z and history into `to`.
    void evaluate(const SemiDiscrete& system, const State& from, const Trial& trial, State& to) {
        evaluate(system, from, trial, to, n_force_);
    }
    /// For reactions alone.
    void evaluate_for_balance(const SemiDiscrete& system, const State& from, const Trial& trial, State& to) {
        evaluate(system, from, trial, to, n_balance_);
    }
    /// Solves (1 + w M^-1 C) v = right_ + w_force M^-1 f_ for the free velocities; supports have those of their motion.
    void kick(const SemiDiscrete& system, double w, double w_force, State& to);
    /// rate -= w M^-1 C v.
    void subtract_damping_rate(const SemiDiscrete& system, double w, std::span<const double> v,
                               std::span<double> rate) const;

    int evaluations_ = 1;  ///< of forces in a sub-step
    PrescribedMotion motion_;
    State next_;
    std::vector<double> a_new_;      ///< acceleration at the last evaluation
    std::vector<double> f_, right_;  ///< right_: of the equation for v, without forces
    std::vector<double> reactions_new_, reactions_before_;

private:
    double damping_rate(const SemiDiscrete& system) const;
    void evaluate(const SemiDiscrete& system, const State& from, const Trial& trial, State& to, std::size_t& count);
    /// a_new_ from the forces f_ at a velocity.
    void accelerate(const SemiDiscrete& system, std::span<const double> v);

    StableStep step_;
    LeapfrogEnergy energy_;
    double omega_ = 0;         ///< upper bound of the natural frequencies at the start of the run, rad/s
    std::size_t n_force_ = 0;  ///< evaluations of forces in this step, by the scheme
    std::size_t n_balance_ = 0, n_starts_ = 0;
    std::vector<double> inverse_mass_;
    std::vector<AbsorbingNode> absorbing_;
    std::vector<double> a_, a_before_;  ///< acceleration at the accepted state, and at the last end but one
    std::vector<double> reactions_;
    State sub_;
    mutable std::vector<double> partial_;
};

}  // namespace gneiss
