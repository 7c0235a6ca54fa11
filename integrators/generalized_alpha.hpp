#pragma once
// Generalized-alpha  [Chung and Hulbert, J. Appl. Mech. 60 (1993) 371], with Newmark's method and HHT-alpha as
// settings. With w(x) = (1 - x) (..)(n+1) + x (..)(n) the equations of motion hold at a stage inside the step,
//
//     M a(alpha_m) + C v(alpha_f) = f(t(alpha_f), u(alpha_f), v(alpha_f)),   each (..)(alpha) = w(alpha)
//     u(n+1) = u + dt v + dt^2 ((1/2 - beta) a + beta a(n+1)),   v(n+1) = v + dt ((1 - gamma) a + gamma a(n+1))
//
// All forces, loads among them, are taken at the stage's time and in the stage's state, never blended from two
// evaluations. Laws with memory take the exact update from the last accepted state to the stage, and to the end once
// the step is accepted. Newton's method with exact tangents; a factorised matrix is kept while it makes progress.

#include <string>
#include <vector>

#include "base/scheme_defaults.hpp"
#include "integrators/interface_balance.hpp"
#include "integrators/prescribed_motion.hpp"
#include "integrators/problem_scales.hpp"
#include "integrators/stage_newton.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class GeneralizedAlpha final : public Integrator {
public:
    /// The four numbers of a scheme.
    struct Scheme {
        double alpha_m = 0, alpha_f = 0, beta = scheme_defaults::beta, gamma = scheme_defaults::gamma;

        /// Order 2, undamped at low frequencies.
        /// @param rho_inf  spectral radius at infinite frequency, [0, 1]
        static Scheme chung_hulbert(double rho_inf);
        /// Order 2 for gamma = 1/2; unconditionally stable for gamma >= 1/2, beta >= (gamma + 1/2)^2/4.
        static Scheme newmark(double beta, double gamma);
        /// Hilber, Hughes and Taylor, Earthq. Eng. Struct. Dyn. 5 (1977) 283, with their -alpha here positive: [0,
        /// 1/3].
        static Scheme hht(double alpha);

        /// c in u(n+1) - u(t + dt) = c dt^3 u''' + ...: a(n+1) is the acceleration at t + dt (1 + alpha_m - alpha_f),
        /// to first order, and dt u''' is its change along the step.
        double error_constant() const { return beta + 0.5 * (alpha_m - alpha_f) - 1.0 / 6; }

        friend bool operator==(const Scheme&, const Scheme&) = default;
    };
    struct Options {
        std::string name = "generalized_alpha";
        Scheme scheme = Scheme::chung_hulbert(scheme_defaults::rho_inf);
        double dt = 0;       ///< step, s; with rtol: the first one, 0: one over the highest natural frequency
        double rtol = 0;     ///< local error of displacement over its scale, root mean square, [0, 0.1]; 0: fixed steps
        double longest = 0;  ///< longest step with rtol, s; 0: no limit
        ProblemScales::Given scales;
        double interface_tolerance = scheme_defaults::interface_tolerance;  ///< InterfaceBalance, (0, 1]
        double tolerance = scheme_defaults::tolerance;  ///< Newton: out of balance over the largest force, (0, 0.01]
        int most_iterations = scheme_defaults::newton_iterations;  ///< of Newton's method in a step, >= 1
        LinearSolverOptions solver;                                ///< of the linear systems

        StageNewton::Options newton() const { return {tolerance, most_iterations, solver}; }
        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };

    explicit GeneralizedAlpha(const Options& options);

    std::string name() const override { return options_.name; }
    /// @throws InputError if the system has no tangent
    void start(const SemiDiscrete& system, State& state, StartReason why) override;
    StepReport advance(const SemiDiscrete& system, State& state, double t_stop) override;
    double kinetic_energy(const SemiDiscrete& system, const State& state) const override;
    std::span<const double> reactions(const SemiDiscrete&, const State&) override { return reactions_; }
    WorkCounts work() const override {
        WorkCounts counts = newton_.work();
        counts.interactions = interfaces_.evaluations();
        return counts;
    }
    double matrix_bytes() const override;
    IntegratorMemory save() const override;
    void load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) override;
    /// The matrix that later steps would start with.
    void forget(const SemiDiscrete& system, State& state) override;

    const StageNewton::Counts& counts() const { return newton_.counts(); }

private:
    void allocate(const SemiDiscrete& system);
    /// The state at t + dt into next_. @throws RecoverableError
    void solve(const SemiDiscrete& system, const State& state, double dt);
    void predict(const SemiDiscrete& system, const State& state, double dt);
    /// next_ and stage_ from the accelerations a_next_.
    void place(const State& state, double dt);
    /// Forces, and what they leave, at the end of a step that is solved.
    void arrive(const SemiDiscrete& system, const State& state);
    /// InterfaceBalance::excess() of a step that has arrived.
    double excess(const SemiDiscrete& system, const State& state, double dt);
    /// Local error over its tolerance. By the forces at both ends: the stage at which forces are in balance may be
    /// short of a contact that the end of the step is deep in.
    double error(double dt) const;
    /// The next step after one of length dt <= limit, from its error.
    void choose_next_step(double dt, double limit, double error);
    void finish_step(const SemiDiscrete& system, const State& state);

    Options options_;
    StageNewton newton_;
    PrescribedMotion motion_;
    ProblemScales scales_;
    InterfaceBalance interfaces_{options_.interface_tolerance};
    double dt_ = 0;     ///< next step, s: the longest that it may be
    double omega_ = 0;  ///< upper bound of the natural frequencies at the start of the run, rad/s
    State next_, stage_;
    std::vector<double> a_, a_next_;  ///< accelerations, prescribed ones included
    std::vector<double> f_;
    std::vector<double> joined_, joined_next_, impulse_;  ///< M a of joints and contact alone, N; their impulse, N s
    std::vector<double> at_end_, at_end_next_, scratch_;  ///< M^-1 (f - C v) at the ends of a step; of adaptive ones
    std::vector<double> reactions_;
    mutable std::vector<double> partial_;
};

}  // namespace gneiss
