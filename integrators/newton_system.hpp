#pragma once
// The Newton systems (I - gamma dF/dy) x = b of y = (u, v, z), solved in the n free displacements.
//
// With K = -df/du at given z, D = C - df/dv, G = dg/dv, elimination of du and dz leaves
//
//     (M + gamma D + gamma^2 (K - df/dz G)) dv = M b_v - gamma K b_u + gamma df/dz b_z
//     du = b_u + gamma dv,    dz = b_z + gamma G dv
//
// K - df/dz G is the tangent with dz/du folded in, assembled element by element. dg/du and dg/dz are left out: of a
// rate equation z' = M(z) e' they are a strain increment's part of what is kept, which costs Newton's method no
// iteration; where z decays by itself it converges by gamma dg/dz an iteration. What it converges to is the same. (A
// law whose z decays faster than the steps would need dg/dz here.) What would fill the matrix stands beside it, as
// dyads of K. df/dz and G act by differences of forces and rates, exact because f is affine in z and g in v.

#include <memory>
#include <string>
#include <vector>

#include "integrators/first_order_form.hpp"
#include "integrators/sundials_objects.hpp"
#include "linear/bordered_solver.hpp"
#include "linear/free_matrix.hpp"

namespace gneiss {

class NewtonSystem {
public:
    struct Counts {
        std::size_t linearisations = 0, factorisations = 0, solves = 0;
        std::size_t evaluations = 0;  ///< of forces, for differences
    };

    /// @param solver  of the linear systems
    /// @throws InputError if the system has no tangent
    NewtonSystem(const SemiDiscrete& system, FirstOrderForm& form, const LinearSolverOptions& solver,
                 SUNContext context);
    NewtonSystem(const NewtonSystem&) = delete;
    NewtonSystem& operator=(const NewtonSystem&) = delete;

    SUNMatrix matrix() const { return matrix_.get(); }
    SUNLinearSolver linear_solver() const { return linear_solver_.get(); }

    /// Assembles the tangents at y. They serve for any gamma until the next call.
    void linearise(const State& accepted, double t, std::span<const double> y);
    /// What the next set-up factorises and solves for.
    /// @param gamma        s
    /// @param right_scale  b is this times what SUNDIALS hands over: gamma for systems (I/gamma - dF/dy) x = b
    void set(double gamma, double right_scale) { gamma_ = gamma, right_scale_ = right_scale; }

    // What SUNDIALS asks of linear_solver().
    void set_up();
    void solve(std::span<const double> b, std::span<double> x);

    /// A solver that starts anew must not depend on earlier matrices.
    void forget() { solver_.forget(); }

    const Counts& counts() const { return counts_; }
    CallbackGuard& guard() { return guard_; }
    /// Of matrices and factors, as far as the pattern tells.
    double bytes() const;

private:
    void take_tangent(const Trial& trial, const Tangent::Factors& factors, std::vector<double>& to);
    /// right += gamma df/dz b_z.
    void add_internal_forces(std::span<const double> b_z);
    /// x_z = b_z + gamma G dv.
    void internal_changes(std::span<const double> b_z, std::span<const double> dv, std::span<double> x_z);

    const SemiDiscrete& system_;
    FirstOrderForm& form_;
    FreeMatrix free_;
    BorderedSolver solver_;
    std::vector<double> mass_;                               ///< of the free degrees of freedom, kg
    std::vector<std::size_t> diagonal_;                      ///< place of each free diagonal entry
    bool damped_;                                            ///< D is not zero
    State at_;                                               ///< where the system is linearised
    std::vector<double> full_;                               ///< values over all degrees of freedom
    std::vector<double> folded_, given_, damping_, values_;  ///< K - df/dz G, K, D, and what is factorised
    LowRank beside_;                                         ///< beside the first two
    std::vector<double> right_, f_, f_zero_, v_, z_, rate_, rate_zero_;
    double gamma_ = 0, right_scale_ = 1;
    Counts counts_;
    CallbackGuard guard_;
    OwnedMatrix matrix_;
    OwnedLinearSolver linear_solver_;
};

}  // namespace gneiss
