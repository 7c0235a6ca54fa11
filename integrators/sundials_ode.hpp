#pragma once
// What CVODE, ARKODE and IDA have in common: the system as y' = F(t, y), tolerances by kind, Newton systems in the
// displacements, one accepted step at a time, energies along it, and starting anew at events and checkpoints.
//
// Loads that jump end a step at the jump (a stop time); the solver then starts anew, at order 1 where it is a multistep
// method. It does the same at checkpoints, so that a run that is resumed agrees with one that is not, bit by bit.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/scheme_defaults.hpp"
#include "integrators/first_order_form.hpp"
#include "integrators/newton_system.hpp"
#include "integrators/problem_scales.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class SundialsOde : public Integrator {
public:
    struct Options {
        double rtol = scheme_defaults::rtol;  ///< local error over the scale of its kind, root mean square, (0, 0.1]
        ProblemScales::Given scales;          ///< magnitudes to measure errors against; 0: from the problem
        double longest = 0;                   ///< longest step, s; 0: no limit
        LinearSolverOptions solver;           ///< of the linear systems

        /// Adds what is wrong, under "integrator.".
        void check(std::vector<Problem>& problems) const;

        friend bool operator==(const Options&, const Options&) = default;
    };
    struct Counts {
        std::size_t steps = 0, rejected = 0;
        std::size_t rates = 0;              ///< evaluations of all forces by the scheme
        std::size_t starts = 0;             ///< those in states that starts begin from
        std::size_t balance = 0;            ///< those for energies and reactions alone
        std::size_t interaction_rates = 0;  ///< of interactions alone
        std::size_t linearisations = 0, factorisations = 0, solves = 0;

        void add(const NewtonSystem::Counts& more) {
            linearisations += more.linearisations;
            factorisations += more.factorisations;
            solves += more.solves;
            rates += more.evaluations;
        }
    };

    void start(const SemiDiscrete& system, State& state, StartReason why) final;
    StepReport advance(const SemiDiscrete& system, State& state, double t_stop) final;
    bool interpolates() const override { return true; }
    void state_within(const SemiDiscrete& system, double t, State& at, std::vector<double>& reactions) final;
    double kinetic_energy(const SemiDiscrete& system, const State& state) const final;
    std::span<const double> reactions(const SemiDiscrete& system, const State& state) final;
    WorkCounts work() const final;
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
    /// What a user should know of the step's length before the first one; empty: nothing.
    /// @param bound  where the run starts
    virtual std::string doubt(const FrequencyBound& bound) const {
        (void)bound;
        return {};
    }

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
    /// From here to the end of the step interactions remember what follow_interactions() has seen: their rates are
    /// those of a path.
    void begin_path();
    /// y at a later time on the path; SUNDIALS' return values.
    int follow_interactions(double t, N_Vector y);
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
    /// Whether dense output asks for the rates at t, and nobody else will. Those at the end of a step are not: ARKODE
    /// from 6.7 on leaves them to whoever asks first, and begins the next step with them.
    bool of_dense_output_alone(double t) const;
    /// Counts an evaluation of a part of F(t, y) that a scheme asks for.
    void count(double t, std::span<const double> y, FirstOrderForm::Part part);
    void finish_step(const SemiDiscrete& system, const State& state);
    /// Forces of supports, N, shape (constraints).
    struct Reactions {
        std::vector<double> forces;
        bool known = false;  ///< found in the state that they belong to
    };
    /// History at the end of a step, or within it, and reactions there.
    void update_history(const SemiDiscrete& system, const State& from, State& to, Reactions& reactions);
    /// Those in a state whose y is y(), if the scheme has left the forces there.
    void take_reactions(const SemiDiscrete& system, const State& at, Reactions& reactions);
    /// Evaluates forces in a state for reactions alone, unless they are known.
    void find_reactions(const SemiDiscrete& system, const State& accepted, const State& at, Reactions& reactions);
    /// u, v, z at a time within the last step.
    void find_within(const SemiDiscrete& system, double t, State& at);
    void add_path_energies(const SemiDiscrete& system, const State& from, Reactions& before, State& to,
                           Reactions& after);

    Options options_;
    bool needs_newton_;
    SilentContext context_;
    FirstOrderForm form_;
    std::unique_ptr<NewtonSystem> newton_;
    ProblemScales scales_;
    OwnedVector y_, middle_y_;
    const SemiDiscrete* system_ = nullptr;  ///< while a call is under way
    const State* accepted_ = nullptr;
    State next_, middle_;
    /// The accepted state with what interactions remember of the path since; empty where nothing is followed.
    std::optional<State> path_;
    State on_path_;
    double omega_ = 0;  ///< upper bound of the natural frequencies at the start of the run, rad/s
    std::vector<double> f_, z_;
    Reactions before_, middle_reactions_, after_;  ///< where the last step began, in its middle, where it ended
    bool start_counted_ = false;                   ///< F where the scheme started, or its first step has ended
    bool in_dense_output_ = false;
    CallbackGuard guard_;
    Counts counts_;
    std::size_t failed_before_ = 0;
    double correction_before_ = 0;  ///< norm, in Newton's method
    std::string doubt_;             ///< to be told with the first step
    mutable std::vector<double> partial_;
};

}  // namespace gneiss
