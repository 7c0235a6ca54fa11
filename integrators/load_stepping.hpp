#pragma once
// Equilibria under slowly growing loads, f(t, u, 0) = 0 on the free degrees of freedom at a sequence of load times t:
// what static integrators have in common. They differ in how one equilibrium is found.
//
// A load step that fails is halved; one that comes easily is followed by one twice as long. Laws with memory take the
// exact update of the step. The work of supports is a trapezoidal rule over load steps, and so is that of loads.
// Statics know of no time: a load that jumps grows from what it was to what it is while the solid follows, and its work
// is that. Taken at its full size all the way, it would do twice the work, of which half is vibration that there is
// not.

#include <string>
#include <vector>

#include "base/errors.hpp"
#include "base/scheme_defaults.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class LoadStepping : public Integrator {
public:
    struct Options {
        double tolerance = scheme_defaults::tolerance;  ///< largest force out of balance over the largest of the step's
                                                        ///< forces, (0, 0.01]
        double step = 0;                                ///< first load step, s; 0: up to the next stop
        double longest = 0;                             ///< longest load step, s; 0: no limit
        double shortest = scheme_defaults::shortest;  ///< load step at which to give up, part of the first one, (0, 1)
        int most_iterations = 0;                      ///< in a load step, >= 0; 0: as many as the method should need

        /// Adds what is wrong, under "integrator.".
        void check(std::vector<Problem>& problems) const;

        friend bool operator==(const Options&, const Options&) = default;
    };
    /// Of what has been done since the integrator was made, rejected trials included.
    struct Counts {
        std::size_t evaluations = 0;        ///< of forces, by the method
        std::size_t starts = 0;             ///< those in states that starts begin from
        std::size_t balance = 0;            ///< those for energies and reactions alone
        std::size_t iterations = 0;         ///< of the method
        std::size_t factorisations = 0;     ///< of tangents
        std::size_t linear_iterations = 0;  ///< of iterative linear solvers
    };

    bool is_static() const final { return true; }
    std::vector<StepColumn> step_columns() const final {
        return {{"iterations"}, {"factorisations"}, {"linear_iterations"}, {"force_evaluations"}, {"unbalanced"}};
    }
    WorkCounts work() const final {
        return {.jacobians = counts_.factorisations,
                .factorisations = counts_.factorisations,
                .iterations = counts_.iterations,
                .balance = counts_.balance,
                .starts = counts_.starts};
    }
    void start(const SemiDiscrete& system, State& state, StartReason why) final;
    StepReport advance(const SemiDiscrete& system, State& state, double t_stop) final;
    /// Nothing moves: zero.
    double kinetic_energy(const SemiDiscrete&, const State&) const final { return 0; }
    std::span<const double> reactions(const SemiDiscrete&, const State&) final { return reactions_; }
    IntegratorMemory save() const final {
        return {{"reactions", reactions_}, {"step", {dt_, first_dt_}}, {"jumped", {jumped_ ? 1.0 : 0.0}}};
    }
    void load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) final;

    const Counts& counts() const { return counts_; }

protected:
    /// A failure that no shorter load step would cure.
    class Exhausted : public RecoverableError {
    public:
        using RecoverableError::RecoverableError;
    };

    /// @param enough  iterations where options leave their number to the method
    /// @throws InputError
    LoadStepping(const Options& options, int enough);

    /// For a system of this layout.
    virtual void allocate(const SemiDiscrete& system) = 0;
    /// Moves next_.u from the last accepted displacements to the equilibrium at next_.t.
    /// @return whether a load step twice as long may be tried next
    /// @throws RecoverableError, Interrupted
    virtual bool solve(const SemiDiscrete& system, const State& state) = 0;

    const Options& options() const { return options_; }
    /// What forces are evaluated in.
    Trial trial() const { return {next_.t, next_.last_event, next_.u, next_.v, {}}; }
    void evaluate(const SemiDiscrete& system, const State& state) {
        system.force(state, trial(), f_);
        ++counts_.evaluations;
    }

    double largest_force_ = 0;  ///< of the step, N, set by solve(): what forces out of balance are measured by
    std::string warning_;       ///< set by solve(): what a user should know once
    State next_;
    std::vector<double> f_;       ///< N, at next_
    std::vector<double> change_;  ///< of prescribed displacements in the step, m, shape (constraints)
    Counts counts_;

private:
    void allocate_all(const SemiDiscrete& system);
    /// One load step, which may fail.
    void attempt(const SemiDiscrete& system, State& state, double t_stop, StepReport& report);
    /// Finds jump_ in a state whose f_ is known.
    void find_jump(const SemiDiscrete& system);
    void find_changes(const SemiDiscrete& system, const State& state);
    /// @return the largest force out of balance, N
    double accept(const SemiDiscrete& system, State& state);

    Options options_;
    double dt_ = 0, first_dt_ = 0;  ///< next load step, first one, s
    bool jumped_ = false;           ///< forces are out of balance where the next load step begins
    std::vector<double> jump_;      ///< what they are out of balance by on the free degrees of freedom, N
    std::vector<double> prescribed_, reactions_;
};

}  // namespace gneiss
