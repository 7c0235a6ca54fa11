#pragma once
// Equilibrium under slowly growing loads: f(t, u, 0) = 0 on the free degrees of freedom at a sequence of load times t.
//
// A load step solves K du = f(t + dt, u) with the prescribed displacements of t + dt put in as they are (so that the
// first iterate of a linear solid is the solution), and goes on from there by Newton's method with a line search
// (KINSOL) and exact tangents. A step that does not converge is halved, one that converges fast is followed by a longer
// one. Laws with memory take the exact update of the step.

#include <memory>
#include <string>
#include <vector>

#include "integrators/sundials_objects.hpp"
#include "linear/free_matrix.hpp"
#include "system/integrator.hpp"

namespace gneiss {

class QuasiStatic final : public Integrator {
public:
    struct Options {
        double tolerance = 1e-9;   ///< largest force out of balance over the largest of the step's forces, (0, 0.01]
        double step = 0;           ///< first load step, s; 0: up to the next stop
        double longest = 0;        ///< longest load step, s; 0: no limit
        double shortest = 1e-6;    ///< load step at which to give up, part of the first one, (0, 1)
        int most_iterations = 20;  ///< of Newton's method in a load step, >= 1
        std::string solver = "automatic";  ///< see make_linear_solver()

        /// @throws InputError
        void validate() const;
    };
    struct Counts {
        std::size_t evaluations = 0;     ///< of forces
        std::size_t iterations = 0;      ///< of Newton's method
        std::size_t factorisations = 0;  ///< one for the first iterate of a step, one for each iteration
    };

    explicit QuasiStatic(const Options& options);
    ~QuasiStatic() override;

    std::string name() const override { return "quasi_static"; }
    /// @throws InputError if the system has no tangent
    void start(const SemiDiscrete& system, State& state, StartReason why) override;
    StepReport advance(const SemiDiscrete& system, State& state, double t_stop) override;
    /// Nothing moves: zero.
    double kinetic_energy(const SemiDiscrete&, const State&) const override { return 0; }
    std::span<const double> reactions() const override { return reactions_; }
    IntegratorMemory save() const override;
    void load(const SemiDiscrete& system, State& state, const IntegratorMemory& memory) override;

    const Counts& counts() const { return counts_; }

private:
    struct Problem;  ///< what KINSOL is told of a load step

    void allocate(const SemiDiscrete& system);
    /// Equilibrium at next_.t. @throws RecoverableError
    void solve(const SemiDiscrete& system, const State& state);
    void set_prescribed(const SemiDiscrete& system, const State& state);
    /// next_.u on the free degrees of freedom from the tangent at the last state.
    void predict(const SemiDiscrete& system, const State& state);

    Options options_;
    Counts counts_;
    State next_;
    double dt_ = 0, first_dt_ = 0;  ///< next load step, first one, s
    std::vector<double> f_, values_, prescribed_, change_, right_, reactions_;

    std::unique_ptr<FreeMatrix> free_;
    std::unique_ptr<LinearSolver> solver_;
    sundials::Context context_;
    std::unique_ptr<SundialsMatrix> matrix_;
    std::unique_ptr<SundialsSolver> linear_;
    OwnedVector unknowns_, unknown_scale_, force_scale_;
    std::unique_ptr<void, void (*)(void*)> kinsol_;
};

}  // namespace gneiss
