#pragma once
// A time integrator: it sees a semi-discrete system and its state, never an element, a material or a contact pair.

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "system/semi_discrete.hpp"

namespace gneiss {

/// Why an integrator (re)starts.
enum class StartReason {
    fresh,         ///< a new run
    reinitialise,  ///< forces have jumped
    resize,        ///< the number of unknowns has changed
    recover        ///< a step has failed: the state is the last accepted one, nothing has jumped
};

/// What one accepted step was, or several of them taken in one go.
struct StepReport {
    double t = 0;                       ///< time reached, s
    double dt = 0;                      ///< of the last step, s
    std::size_t n_rejected = 0;         ///< trials thrown away on the way
    std::size_t n_force = 0;            ///< evaluations of all forces by the scheme itself, rejected trials included
    std::size_t n_steps = 1;            ///< accepted steps, >= 1
    std::vector<double> numbers = {};   ///< what Integrator::step_columns() names
    std::string rejected = {};          ///< why the last trial thrown away was; empty: none was
    std::string warning = {};           ///< what a user should know once
    std::size_t n_force_searching = 0;  ///< those of steps that a search for an event has thrown away
};

/// A number that an integrator reports of each of its steps.
struct StepColumn {
    std::string name;
    std::string unit = {};
};

/// What an integrator has done beside the evaluations that StepReport::n_force counts, since it was made.
struct WorkCounts {
    std::size_t jacobians = 0;       ///< tangents assembled
    std::size_t factorisations = 0;  ///< of matrices
    std::size_t iterations = 0;      ///< of Newton's method: each solves a linear system
    std::size_t interactions = 0;    ///< evaluations of joints and contact alone
    std::size_t elements = 0;        ///< evaluations of single elements
    std::size_t balance = 0;         ///< evaluations of all forces for the energy balance and the reactions alone
    std::size_t starts = 0;          ///< evaluations of all forces in the states that starts begin from
};

/// Where a step stands that takes many iterations.
struct StepProgress {
    double t = 0;               ///< time that the step goes to, s
    std::size_t iteration = 0;  ///< of this trial of it
    double unbalanced = 0;      ///< largest force out of balance over the largest force
};

/// Ends a step whose watcher wants no more of it.
class Interrupted : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("a step was interrupted") {}
};

/// An integrator's own memory, by name: saved in checkpoints beside the state.
using IntegratorMemory = std::map<std::string, std::vector<double>>;

/// @param size  that the entry must have
/// @throws InputError naming the integrator if the entry is missing or has another size
const std::vector<double>& remembered(const IntegratorMemory& memory, const std::string& integrator,
                                      const std::string& entry, std::size_t size);

class Integrator {
public:
    virtual ~Integrator() = default;
    virtual std::string name() const = 0;
    /// Whether time is load time and nothing moves: no inertia, no damping.
    virtual bool is_static() const { return false; }
    /// What it reports of each step beside StepReport's own members; empty: its steps are not worth a table.
    virtual std::vector<StepColumn> step_columns() const { return {}; }
    virtual WorkCounts work() const { return {}; }
    /// Matrices and their factors, bytes, as far as the pattern tells; once started.
    virtual double matrix_bytes() const { return 0; }

    /// Takes the system and an accepted state. Also called after an event that asks for it.
    virtual void start(const SemiDiscrete& system, State& state, StartReason why) = 0;

    /// One accepted step, that does not pass t_stop.
    /// @throws RecoverableError if the step failed; the state is then still the last accepted one
    virtual StepReport advance(const SemiDiscrete& system, State& state, double t_stop) = 0;

    /// Steps of which nobody sees any but the last: those that advance() would take, with the same bits, until one
    /// comes to t_look, an event is stirred, or there have been enough of them for once. An integrator that need not
    /// complete its state after every step saves work here.
    /// @throws RecoverableError if the first step failed; later ones are left to the next call
    virtual StepReport advance_unseen(const SemiDiscrete& system, State& state, double t_stop, double t_look) {
        (void)t_look;
        return advance(system, state, t_stop);
    }

    /// @param watcher  called in every iteration of a step that iterates; where it returns false the step ends with
    /// Interrupted, and state and memory are those of the last accepted one. Empty: nobody watches.
    void watch(std::function<bool(const StepProgress&)> watcher) { watcher_ = std::move(watcher); }

    /// Whether states within the last step are known as exactly as its end.
    virtual bool interpolates() const { return false; }
    /// The state at a time within the last accepted step, its memory and the energies of its path included: of
    /// integrators that interpolate, until the next call that changes anything.
    /// @param t               from the beginning of the step to its end, s
    /// @param[out] at         overwritten
    /// @param[out] reactions  forces of supports there, N, overwritten, shape (constraints)
    virtual void state_within(const SemiDiscrete& system, double t, State& at, std::vector<double>& reactions) {
        (void)system;
        (void)t;
        (void)at;
        (void)reactions;
        throw std::logic_error(name() + " does not interpolate");
    }

    /// Kinetic energy in the measure in which this integrator's balance is sharpest, J; 1/2 v . M v where it starts.
    virtual double kinetic_energy(const SemiDiscrete& system, const State& state) const = 0;
    /// Forces of supports on the constrained degrees of freedom, N, shape (constraints). Found when asked for where the
    /// scheme itself has no use for them.
    /// @param state  the last accepted one
    virtual std::span<const double> reactions(const SemiDiscrete& system, const State& state) = 0;

    /// load() takes the place of start() when a run goes on from a checkpoint: the run then has the same bits as one
    /// that was never interrupted.
    virtual IntegratorMemory save() const = 0;
    /// Drops what save() leaves out (the past of a multistep method, a matrix that serves for several steps). Called
    /// where a checkpoint is saved, so that the run goes on from there as a resumed one does.
    virtual void forget(const SemiDiscrete& system, State& state) {
        (void)system;
        (void)state;
    }
    virtual void load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) = 0;

protected:
    /// @throws Interrupted
    void tell(const StepProgress& progress) const {
        if (watcher_ && !watcher_(progress)) throw Interrupted();
    }

private:
    std::function<bool(const StepProgress&)> watcher_;
};

}  // namespace gneiss
