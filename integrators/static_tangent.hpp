#pragma once
// The linear systems of Newton's method in statics, K x = b with K = -df/du on the free degrees of freedom: with an
// assembled matrix and any solver of linear/, or without a matrix.

#include <memory>
#include <span>

#include "integrators/sundials_objects.hpp"
#include "linear/free_matrix.hpp"
#include "linear/linear_solver.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// In the order of the calls: linearise(), subtract_fixed() where wanted, factorise(), and then solve() and multiply()
/// as often as wanted.
class StaticTangent {
public:
    StaticTangent(const StaticTangent&) = delete;
    StaticTangent& operator=(const StaticTangent&) = delete;
    virtual ~StaticTangent() = default;

    const FreeMatrix& free() const { return free_; }
    std::size_t n() const { return free_.n(); }

    /// Takes K at a trial state.
    virtual void linearise(const State& accepted, const Trial& trial) = 0;
    /// right -= K_fc x_c: what given changes of the fixed unknowns leave for the free equations.
    virtual void subtract_fixed(std::span<const double> x_fixed, std::span<double> right) = 0;
    /// @throws SingularMatrix
    virtual void factorise() = 0;
    /// From here on a matrix that is singular is held by this factor, 1/s2, times the mass: where bodies hang free
    /// until contact reaches them. Iterations end where forces balance, whatever the matrix.
    void brace(double factor) { brace_ = factor; }
    /// Whether the matrix last factorised had to be.
    bool braced() const { return braced_; }
    /// See LinearSolver::forget().
    virtual void forget() {}
    /// @param[out] x  shape (n); may be b itself
    /// @throws RecoverableError
    virtual void solve(std::span<const double> b, std::span<double> x) = 0;
    /// y = K x
    virtual void multiply(std::span<const double> x, std::span<double> y) = 0;

    /// Whether K is known to have a negative eigenvalue.
    virtual bool indefinite() const { return false; }
    virtual std::size_t iterations() const = 0;            ///< of linear solvers so far
    virtual std::size_t evaluations() const { return 0; }  ///< of forces so far
    virtual double bytes() const = 0;                      ///< of memory, factors expected

    // The same as SUNDIALS takes it; set-up is factorise(). Exceptions wait in guard().
    SUNMatrix matrix() const { return matrix_.get(); }
    SUNLinearSolver linear_solver() const { return linear_solver_.get(); }
    void set_up() {
        guard_.forget();
        factorise();
    }
    CallbackGuard& guard() { return guard_; }

protected:
    StaticTangent(FreeMatrix free, SUNContext context);

    FreeMatrix free_;
    double brace_ = 0;  ///< 1/s2; 0: singular matrices are refused
    bool braced_ = false;

private:
    OwnedMatrix matrix_;
    OwnedLinearSolver linear_solver_;
    CallbackGuard guard_;
};

/// @throws InputError if the system has no tangent, or the solver does not go with it
std::unique_ptr<StaticTangent> make_assembled_tangent(const SemiDiscrete& system, const LinearSolverOptions& options,
                                                      SUNContext context);
/// Adds what does not go without a matrix.
void check_matrix_free(const LinearSolverOptions& options, std::vector<Problem>& problems);
/// Products with K are differences of forces, good to seven digits or so, the preconditioner is the diagonal: no memory
/// beyond a few vectors, and a force evaluation for each iteration.
/// @throws InputError for other solvers than pcg and gmres, other preconditioners than the diagonal, and as above
std::unique_ptr<StaticTangent> make_matrix_free_tangent(const SemiDiscrete& system, const LinearSolverOptions& options,
                                                        SUNContext context);

}  // namespace gneiss
