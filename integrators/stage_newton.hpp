#pragma once
// The nonlinear system of an implicit stage, M a(stage) + C v - f(t, u, v) = 0 with u and v affine in the accelerations
// that are sought, by Newton's method with exact tangents. A factorised matrix is kept while it makes progress.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/scheme_defaults.hpp"
#include "linear/bordered_solver.hpp"
#include "linear/free_matrix.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class StageNewton {
public:
    struct Options {
        double tolerance = scheme_defaults::tolerance;  ///< force out of balance over the largest force, (0, 0.01]
        int most_iterations = scheme_defaults::newton_iterations;  ///< >= 1
        LinearSolverOptions solver = {};                           ///< of the linear systems

        /// Adds what is wrong, under "integrator.".
        void check(std::vector<Problem>& problems) const;

        friend bool operator==(const Options&, const Options&) = default;
    };
    struct Counts {
        std::size_t evaluations = 0;  ///< of all forces, by the scheme
        std::size_t starts = 0;       ///< those in states that starts begin from
        std::size_t balance = 0;      ///< those for energies and reactions alone
        std::size_t iterations = 0, factorisations = 0;
    };
    /// What a scheme says of a stage; u and v of supports are there already.
    struct Stage {
        const State& at;              ///< t, last_event, u, v: where forces are taken
        const State& end;             ///< u and v at the end of the step, or of the sub-step
        double dt;                    ///< its length, s
        double matrix_dt;             ///< what the matrix depends on, s: where it differs there is a new one
        Tangent::Factors factors;     ///< of the matrix: derivatives with the accelerations sought
        double displacement;          ///< du(end) with them, s2
        std::function<void()> place;  ///< finds u and v of the free degrees of freedom from them
        std::function<double(std::size_t dof)> acceleration;  ///< of the stage
    };

    /// @param name  of the scheme, for messages
    StageNewton(const Options& options, std::string name) : options_(options), name_(std::move(name)) {}

    /// @throws InputError if the system has no tangent
    void bind(const SemiDiscrete& system);
    /// Degrees of freedom that are not prescribed, ascending.
    std::span<const std::size_t> free() const { return free_->free(); }

    /// @param accepted  where the step, or the sub-step, begins
    /// @param[in,out] a  accelerations sought, a guess before
    /// @throws RecoverableError
    void solve(const SemiDiscrete& system, const State& accepted, const Stage& stage, std::span<double> a);
    /// All forces at the stage that solve() has found, N, shape (n_dof), without C v; empty where its last iteration
    /// has moved on, by round-off, from where it had evaluated them.
    std::span<const double> forces() const { return solved_f_; }

    /// No matrix is kept from here on.
    void drop_matrix() { factorised_dt_ = 0; }
    void forget();

    Counts& counts() { return counts_; }
    WorkCounts work() const {
        return {.jacobians = counts_.factorisations,
                .factorisations = counts_.factorisations,
                .iterations = counts_.iterations,
                .balance = counts_.balance,
                .starts = counts_.starts};
    }
    const Counts& counts() const { return counts_; }
    /// Of matrices and factors, as far as the pattern tells.
    double bytes() const;

private:
    /// M a + C v - f at the stage into residual_; returns the largest of its forces.
    double evaluate(const SemiDiscrete& system, const State& accepted, const Stage& stage);
    void factorise(const SemiDiscrete& system, const State& accepted, const Stage& stage);

    Options options_;
    std::string name_;
    Counts counts_;
    std::unique_ptr<FreeMatrix> free_;
    std::unique_ptr<BorderedSolver> solver_;
    double factorised_dt_ = 0;  ///< Stage::matrix_dt of the matrix at hand; 0: none
    std::vector<double> f_, residual_, change_, full_values_, values_;
    std::vector<double> solved_f_;
};

}  // namespace gneiss
