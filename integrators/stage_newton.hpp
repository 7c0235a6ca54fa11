#pragma once
// The nonlinear system of an implicit stage, M a(stage) + C v - f(t, u, v) = 0 with u and v affine in the accelerations
// that are sought, by Newton's method with exact tangents. A factorised matrix is kept while it makes progress.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "linear/bordered_solver.hpp"
#include "linear/free_matrix.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class StageNewton {
public:
    struct Options {
        double tolerance = 1e-9;          ///< force out of balance over the largest force, (0, 0.01]
        int most_iterations = 20;         ///< >= 1
        LinearSolverOptions solver = {};  ///< of the linear systems

        /// Adds what is wrong, under "integrator.".
        void check(std::vector<Problem>& problems) const;
    };
    struct Counts {
        std::size_t evaluations = 0, iterations = 0, factorisations = 0;
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

    /// No matrix is kept from here on.
    void drop_matrix() { factorised_dt_ = 0; }
    void forget();

    Counts& counts() { return counts_; }
    WorkCounts work() const { return {counts_.factorisations, counts_.factorisations, counts_.iterations}; }
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
};

}  // namespace gneiss
