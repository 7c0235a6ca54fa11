#pragma once
// What CVODE, ARKODE and IDA have in common: the system as y' = F(t, y), tolerances by kind, Newton systems in the
// displacements, one accepted step at a time, energies along it, and starting anew at events and checkpoints.
//
// Loads that jump end a step at the jump (a stop time); the solver then starts anew, at order 1 where it is a multistep
// method. It does the same at checkpoints, so that a run that is resumed agrees with one that is not, bit by bit.

#include <memory>
#include <string>
#include <vector>

#include "integrators/first_order_form.hpp"
#include "integrators/newton_system.hpp"
#include "integrators/problem_scales.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class SundialsOde : public Integrator {
public:
    struct Options {
        double rtol = 1e-6;           ///< local error over the scale of its kind, root mean square, (0, 0.1]
        ProblemScales::Given scales;  ///< magnitudes to measure errors against; 0: from the problem
        double longest = 0;           ///< longest step, s; 0: no limit
        LinearSolverOptions solver;   ///< of the linear systems

        /// Adds what is wrong, under "integrator.".
        void check(std::vector<Problem>& problems) const;
    };
    struct Counts {
        std::size_t steps = 0, rates = 0, rejected = 0;
        std::size_t interaction_rates = 0;  ///< of interactions alone, which `rates` leaves out
        std::size_t linearisations = 0, factorisations = 0, solves = 0;

        void add(const NewtonSystem::Counts& more) {
            linearisations += more.linearisations;
            factorisations += more.factorisations;
            solves += more.solves;
        }
    };

    void start(const SemiDiscrete& system, State& state, StartReason why) final;
    StepReport advance(const SemiDiscrete& system, State& state, double t_stop) final;
    bool interpolates() const override { return true; }
    void state_within(const SemiDiscrete& system, double t, State& at, std::vector<double>& reactions) final;
    double kinetic_energy(const SemiDiscrete& system, const State& state) const final;
    std::span<const double> reactions() const final { return reactions_; }
    WorkCounts work() const final {
        const Counts all = counts();
        return {all.linearisations, all.factorisations, all.solves, all.interaction_rates};
    }
    double matrix_bytes() const final { return newton_ ? newton_->bytes() : 0; }
    IntegratorMemory save() const final;
    void load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) final;
    /// Starts anew.
    void forget(const SemiDiscrete& system, State& state) final;

    /// Since the run was started.
    Counts counts() const;

protected:
    SundialsOde(const Options& options, bool needs_newton);

    // ---- what each solver answers, SUNDIALS' flags as they are
    /// Frees the solver, before what it refers to.
    virtual void destroy() = 0;
    /// Makes the solver for y() at t.
    virtual void create(double t) = 0;
    /// Its past is forgotten; y() has jumped or not.
    virtual void restart(double t) = 0;
    /// One step into y().
    /// @param dt  of a fixed step, s; 0: chosen by the solver
    /// @param[out] t  time reached
    virtual int step(double dt, double t_stop, double& t) = 0;
    /// The solution at a time within the last step, into `at`.
    virtual int dense(double t, N_Vector at) = 0;
    virtual double last_step() = 0;
    /// Failed trials of the solver since it was created or restarted.
    virtual std::size_t failed_trials() = 0;
    virtual std::string flag_name(int flag) = 0;
    /// Length of the fixed step, s; 0: the solver chooses.
    virtual double fixed_step() const { return 0; }

    // ---- what they build on
    /// Of Newton's method in a step: more than SUNDIALS' own 3 or 4, for what NewtonSystem leaves out.
    static constexpr int most_iterations = 10;
    const Options& options() const { return options_; }
    SUNContext context() { return context_; }
    N_Vector y() { return y_.get(); }
    NewtonSystem& newton() { return *newton_; }
    CallbackGuard& guard() { return guard_; }
    /// Throws on a flag other than success.
    void check(int flag, const char* call);
    /// F(t, y) and its parts, for callbacks: SUNDIALS' return values.
    int rate(double t, N_Vector y, FirstOrderForm::Part part, N_Vector dydt);
    /// Linearises at y unless what there is may serve (`reuse`), for systems of this gamma.
    int linear_system(double t, N_Vector y, bool reuse, double gamma, double right_scale);
    OwnedNonlinearSolver new_newton_iteration();
    /// Sets a test of convergence that measures the rate in each system anew. SUNDIALS' own lets it shrink over the
    /// systems that share a matrix, to next to nothing where the problem is linear; a step that then changes passes
    /// with an error far above the tolerance. To be called once the solver has been handed over, which sets SUNDIALS'
    /// test.
    void trust_no_earlier_rate(SUNNonlinearSolver solver);
    /// One over the tolerances of y, as SUNDIALS' functions for error weights.
    int error_weights(N_Vector weights) const;

private:
    void allocate(const SemiDiscrete& system);
    void begin(const SemiDiscrete& system, const State& state);
    void finish_step(const SemiDiscrete& system, const State& state);
    /// f_ at a state within a step, its history and the forces of its supports.
    void evaluate(const SemiDiscrete& system, const State& from, State& to, std::vector<double>& reactions);
    void add_path_energies(const SemiDiscrete& system, const State& from, std::span<const double> before, State& to,
                           std::span<const double> after);

    Options options_;
    bool needs_newton_;
    sundials::Context context_;
    FirstOrderForm form_;
    std::unique_ptr<NewtonSystem> newton_;
    ProblemScales scales_;
    OwnedVector y_, middle_y_;
    const SemiDiscrete* system_ = nullptr;  ///< while a call is under way
    const State* accepted_ = nullptr;
    State next_, middle_;
    double omega_ = 0;  ///< upper bound of the natural frequencies at the start of the run, rad/s
    std::vector<double> f_, z_;
    std::vector<double> reactions_before_, reactions_middle_, reactions_;
    CallbackGuard guard_;
    Counts counts_;
    std::size_t failed_before_ = 0;
    double correction_before_ = 0;  ///< norm, in Newton's method
    mutable std::vector<double> partial_;
};

}  // namespace gneiss
