#pragma once
// Equilibria under growing loads by Newton's method: f(t, u, 0) = 0 on the free degrees of freedom.
//
// A load step solves K du = f(t + dt, u) with the prescribed displacements of t + dt put in as they are (so that the
// first iterate of a linear solid is the solution), and goes on from there by Newton's method with a line search
// (KINSOL) and exact tangents. A step that converges fast is followed by a longer one.

#include <memory>
#include <string>
#include <vector>

#include "integrators/load_stepping.hpp"
#include "integrators/static_tangent.hpp"
#include "integrators/sundials_objects.hpp"

namespace gneiss {

class QuasiStatic final : public LoadStepping {
public:
    struct Options : LoadStepping::Options {
        LinearSolverOptions solver = {};  ///< of the linear systems
        bool matrix_free = false;         ///< pcg and gmres: products with the tangent by differences of forces
        bool contact = false;             ///< bodies may hang free until contact reaches them: StaticTangent::brace()

        friend bool operator==(const Options&, const Options&) = default;
    };

    /// @throws InputError
    explicit QuasiStatic(const Options& options);
    ~QuasiStatic() override;

    std::string name() const override { return "quasi_static"; }
    double matrix_bytes() const override;

private:
    struct Problem;  ///< what KINSOL is told of a load step
    struct Tally;

    static const Options& checked(const Options& options);
    /// @throws InputError if the system has no tangent
    void allocate(const SemiDiscrete& system) override;
    bool solve(const SemiDiscrete& system, const State& state) override;
    /// Newton's method from the unknowns at hand, forces measured by largest_force_.
    /// @param[in,out] iterations  those taken are added
    /// @return false if round-off is all that is left, so that more would not help
    /// @throws RecoverableError
    bool iterate(const SemiDiscrete& system, const State& state, long& iterations);
    /// The unknowns from the tangent at the last state.
    void predict(const SemiDiscrete& system, const State& state);

    LinearSolverOptions solver_options_;
    bool matrix_free_, contact_;
    bool indefinite_ = false;  ///< the tangent of the last equilibrium
    std::vector<double> right_;

    SilentContext context_;
    std::unique_ptr<StaticTangent> tangent_;
    OwnedVector unknowns_, unknown_scale_, force_scale_;
    std::unique_ptr<void, void (*)(void*)> kinsol_;
};

}  // namespace gneiss
