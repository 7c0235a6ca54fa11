#pragma once
// Energy that a step makes, or loses, where parts of the solid meet: at joints and contact.
//
// A step changes momentum by the impulses of all forces, M (v1 - v0) = sum of J, and with it the kinetic energy by the
// sum of J.(v0 + v1)/2, exactly, whatever the scheme. What joints and contact gain, stored and dissipated, psi, is
// known from their laws, which follow the straight way from state to state. Hence
//
//     made = J.(v0 + v1)/2 + psi1 - psi0,   J and psi of joints and contact,
//
// is their share of what the step adds to the energy balance. Where their forces change smoothly it is of order dt^3.
// Kinks are another matter: a joint that has failed and closes or opens, a gap that closes. In steps far above 1/omega
// of the penalty
//   - generalized-alpha balances forces at a stage. Where the stage touches, the end of the step is beyond it by up to
//     rho_inf times the way that was left to the kink, and holds the energy of a penalty spring that nobody has
//     compressed; friction under that pressure, and damage, are booked on top.
//   - Newmark's method keeps the acceleration at the start of a step for half of it: a body that was stopped within one
//     step, v to -v, is pushed once more as it leaves, to -3 v.
// A mass between two stiff stops has 5e5 times its energy after 40 bounces (interface_balance_test.cpp). A step that
// misses by too much is to be taken again, shorter: at a kink it misses by at most its square.
//
// This holds for schemes whose steps are not bound by the penalty and do not follow the kink by an error estimate. It
// does not look at energy that elements make or lose (the damping of a scheme goes on there), and is of no use in
// statics, where no energy is carried from step to step: what an equilibrium loses to the next one is kinetic energy
// that nobody computes.

#include <span>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class InterfaceBalance {
public:
    /// @param tolerance  most that a step may make or lose, over the largest energy of the run so far, (0, 1]; 1: any
    /// step will do
    explicit InterfaceBalance(double tolerance) : tolerance_(tolerance) {}
    /// Adds what is wrong with a tolerance, under "integrator.".
    static void check(double tolerance, std::vector<Problem>& problems);

    void bind(const SemiDiscrete& system);
    /// Whether there may be joints or contact: the members below are not to be called otherwise.
    bool active() const { return active_; }
    /// Takes up a state where the integrator starts. What it holds as the largest energy stays.
    /// @param omega  upper bound of the natural frequencies, rad/s
    void start(const SemiDiscrete& system, const State& state, double omega);

    /// Forces of joints and contact at a trial, N.
    /// @param[out] f  overwritten, shape (n_dof)
    void force(const SemiDiscrete& system, const State& accepted, const Trial& trial, std::span<double> f);
    /// J.(v0 + v1)/2 of a step or sub-step, J. Supports move as they are told: their share is (J/dt).(u1 - u0).
    /// @param impulse  J, N s, shape (n_dof)
    double work(const SemiDiscrete& system, std::span<const double> impulse, const State& from, const State& to) const;
    /// |made| of a step from the state taken up last, over what it may be: above 1 the step is to be taken again. 0 for
    /// a step that resolves the fastest vibration by far.
    /// @param work  of all of its sub-steps, J
    /// @param to    its end, with history and path
    double excess(const SemiDiscrete& system, double work, const State& from, const State& to);
    /// What a report says of a step that is taken again.
    std::string reason(double excess) const;
    /// Takes up the end of the step that excess() was last asked about.
    void accept() {
        largest_ = largest_next_;
        stored_ = stored_next_;
    }

    /// The largest energy so far, J: what a checkpoint has to keep.
    double largest() const { return largest_; }
    void set_largest(double largest) { largest_ = largest; }
    std::size_t evaluations() const { return evaluations_; }

private:
    double tolerance_;
    bool active_ = false;
    double largest_ = 0, largest_next_ = 0, stored_ = 0, stored_next_ = 0;  ///< J
    double resolved_ = 0;                                                   ///< steps up to this are not judged, s
    std::size_t evaluations_ = 0;
    mutable std::vector<double> partial_;
};

}  // namespace gneiss
