#pragma once
// The explicit scheme of Noh and Bathe  [Computers and Structures 129 (2013) 178], two sub-steps of p dt and
// (1 - p) dt, which damps frequencies near its limit and leaves lower ones alone. With s = 1 - p,
//
//     u1 = u + p dt v + (p dt)^2/2 a,      v1 = v + p dt (a + a1)/2
//     u2 = u1 + s dt v1 + (s dt)^2/2 a1,   v2 = v1 + s dt (q0 a + (1/2 + q1) a1 + q2 a2)
//     q1 = (1 - 2p)/(2 p s),   q2 = 1/2 - p q1,   q0 = 1/2 - q1 - q2
//
// Order 2, with damping too. Undamped, the amplification has the trace 2 - W + W^2 p^2 s/2 and the determinant
// 1 - W^2 s^2 (2p - 1)/4, W = (omega dt)^2: an eigenvalue 1 at W = 4/(s (3p - 1)) is the stability limit, 3.745 in
// omega dt for p = 0.54 (two leapfrog steps: 4), as long as none comes to -1, which it does not for p <= 0.7.
//
// The paper takes all damping at the velocities v + p dt a and v1 + s dt a1. So do we for forces that depend on v,
// which alone limit the step at c dt = 2p/(4p - 2p^2 - 1); C, local to a node, is solved for and limits nothing.

#include "base/scheme_defaults.hpp"
#include "integrators/explicit_sub_steps.hpp"

namespace gneiss {

class NohBathe final : public ExplicitSubSteps {
public:
    struct Options {
        StableStep::Options step;
        double split = scheme_defaults::split;  ///< p, [0.5, 0.7]; 0.5: two leapfrog steps, no dissipation

        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };

    explicit NohBathe(const Options& options);

    std::string name() const override { return "noh_bathe"; }

    static StabilityLimit stability_limit(double split);

private:
    void take(const SemiDiscrete& system, const State& state, double dt, double t_end) override;

    double split_;
    Weights second_;  ///< of the second sub-step
};

}  // namespace gneiss
