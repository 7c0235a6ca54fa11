#pragma once
// The implicit scheme of Bathe  [Computers and Structures 85 (2007) 437] with the spectral radius at infinite frequency
// as its parameter  [Noh and Bathe, Computers and Structures 212 (2019) 299]: a sub-step of g dt by the trapezoidal
// rule, then
//
//     v2 = v + dt (q0 a + q1 a1 + q2 a2),   u2 = u + dt (q0 v + q1 v1 + q2 v2)
//     q1 = (1 + rho_inf)/(4 - 2g (1 - rho_inf)),   q2 = 1/2 - g q1,   q0 = 1 - q1 - q2
//
// with M a + C v = f at the end of either. rho_inf = 0 makes the second one the three-point backward Euler formula of
// 2007. The split g = 2/(2 + (2 + 2 rho_inf)^(1/2)) makes both take one matrix, g/2 = q2. Order 2, unconditionally
// stable for linear problems. Every sub-step is accepted by laws with memory before the next one begins.

#include <array>
#include <string>
#include <vector>

#include "base/scheme_defaults.hpp"
#include "integrators/interface_balance.hpp"
#include "integrators/prescribed_motion.hpp"
#include "integrators/stage_newton.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class Bathe final : public Integrator {
public:
    struct Options {
        double rho_inf = scheme_defaults::rho_inf;  ///< spectral radius at infinite frequency, [0, 1]
        double dt = 0;                              ///< step, s, > 0
        StageNewton::Options newton = {};
        double interface_tolerance = scheme_defaults::interface_tolerance;  ///< InterfaceBalance, (0, 1]

        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };

    explicit Bathe(const Options& options);

    std::string name() const override { return "bathe"; }
    /// @throws InputError if the system has no tangent
    void start(const SemiDiscrete& system, State& state, StartReason why) override;
    StepReport advance(const SemiDiscrete& system, State& state, double t_stop) override;
    double kinetic_energy(const SemiDiscrete& system, const State& state) const override;
    std::span<const double> reactions(const SemiDiscrete&, const State&) override { return reactions_; }
    double matrix_bytes() const override { return newton_.bytes(); }
    IntegratorMemory save() const override;
    void load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) override;
    /// The matrix that later steps would start with.
    void forget(const SemiDiscrete& system, State& state) override;

    WorkCounts work() const override {
        WorkCounts counts = newton_.work();
        counts.interactions = interfaces_.evaluations();
        return counts;
    }
    const StageNewton::Counts& counts() const { return newton_.counts(); }

private:
    void allocate(const SemiDiscrete& system);
    /// The state at t_end into next_. @throws RecoverableError
    void take(const SemiDiscrete& system, const State& state, double dt, double t_end);
    /// Solves for `to` at its time, with v = v_known + w a, u = u_known + w v for the known parts in known_.
    /// @param[in,out] a  of its end; a guess before
    void solve(const SemiDiscrete& system, const State& from, State& to, double w, std::vector<double>& a);
    /// z, history, energies and reactions of a sub-step that has been solved.
    void accept(const SemiDiscrete& system, const State& from, State& to);

    /// InterfaceBalance::excess() of a step that has been taken.
    double excess(const SemiDiscrete& system, const State& state, double dt);

    Options options_;
    double split_, q0_, q1_, q2_;
    StageNewton newton_;
    PrescribedMotion motion_;
    InterfaceBalance interfaces_{options_.interface_tolerance};
    double dt_ = 0;     ///< longest that the next step may be, s
    double omega_ = 0;  ///< upper bound of the natural frequencies at the start of the run, rad/s
    State next_, middle_;
    std::vector<double> a_, a_middle_, a_next_;  ///< accelerations, prescribed ones included
    std::vector<double> known_u_, known_v_, f_;
    std::vector<double> joined_, joined_middle_, joined_next_, impulse_;  ///< of joints and contact alone, N, N s
    std::vector<double> reactions_, reactions_new_, reactions_before_;
    mutable std::vector<double> partial_;
};

}  // namespace gneiss
