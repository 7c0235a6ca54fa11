#pragma once
// Solvers of sparse linear systems behind one interface: analyse a pattern once, factorise and solve often.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "base/scheme_defaults.hpp"

namespace gneiss {

/// Where a square matrix has entries: compressed rows with ascending columns. Refers to arrays of somebody else.
struct SparsePattern {
    std::span<const std::int64_t> row_starts;  ///< shape (n + 1)
    std::span<const std::int64_t> columns;     ///< shape (n_nonzero)

    std::size_t n() const { return row_starts.size() - 1; }
    std::size_t n_nonzero() const { return columns.size(); }
};

/// y = A x.
void multiply(const SparsePattern& pattern, std::span<const double> values, std::span<const double> x,
              std::span<double> y);

/// Ratio of the smallest to the largest pivot below which a matrix counts as singular: of sixteen digits two are left.
inline constexpr double smallest_pivot_ratio = 1e-14;

/// The matrix has no inverse, or none that can be told from round-off.
class SingularMatrix : public RecoverableError {
public:
    using RecoverableError::RecoverableError;
};

/// The matrix has an eigenvalue that is zero or negative, where the solver needs them all positive.
class NotPositiveDefinite : public SingularMatrix {
public:
    using SingularMatrix::SingularMatrix;
};

/// What to say of such a ratio.
std::string singular_text(double pivot_ratio);

class LinearSolver {
public:
    virtual ~LinearSolver() = default;
    virtual std::string name() const = 0;

    /// Orders the unknowns for all matrices of this pattern. The pattern's arrays have to stay until the next call.
    virtual void analyse(const SparsePattern& pattern) = 0;
    /// @param values  entries in the order of the pattern; iterative solvers need them until the next call
    /// @throws SingularMatrix, NotPositiveDefinite
    virtual void factorise(std::span<const double> values) = 0;
    /// Solves A x = b with the last factorisation.
    /// @param[out] x  shape (n); may be b itself
    /// @throws RecoverableError  iterative solvers, where they do not get to their tolerance
    virtual void solve(std::span<const double> b, std::span<double> x) = 0;
    /// What later factorisations take over from earlier ones, pivots say, is forgotten.
    virtual void forget() {}
    /// Memory of the last factorisation, bytes.
    virtual std::size_t factor_bytes() const = 0;
    /// The same of a factorisation to come, from the pattern analysed; 0: cannot be told.
    virtual double expected_factor_bytes() const { return 0; }
    /// Of an iterative solver, in all solves so far.
    virtual std::size_t iterations() const { return 0; }
    /// Whether the last matrix factorised is known to have a negative eigenvalue: CHOLMOD tells all, KLU and UMFPACK an
    /// odd number of them, iterative solvers none.
    virtual bool indefinite() const { return false; }
};

/// L L^T of symmetric positive definite matrices, by CHOLMOD: supernodes and BLAS where they pay.
/// The lower triangle is read alone.
std::unique_ptr<LinearSolver> make_cholmod();
/// L U with partial pivoting in the manner of circuit simulators, by KLU: few operations, no BLAS. Keeps its pivots
/// while they serve.
std::unique_ptr<LinearSolver> make_klu();
/// L U with partial pivoting by fronts and BLAS, by UMFPACK.
std::unique_ptr<LinearSolver> make_umfpack();

/// What is asked of a solver; a name is enough.
struct LinearSolverOptions {
    std::string solver = scheme_defaults::solver;  ///< see make_linear_solver()
    std::string preconditioner =
        scheme_defaults::preconditioner;  ///< of pcg and gmres: "incomplete" (factorisation) or "diagonal"
    double tolerance = scheme_defaults::linear_tolerance;  ///< of pcg and gmres: residual over right side, (0, 0.1]
    std::size_t most_iterations = scheme_defaults::linear_iterations;  ///< of pcg and gmres in one solve, >= 1

    LinearSolverOptions() = default;
    LinearSolverOptions(std::string name) : solver(std::move(name)) {}  // NOLINT
    LinearSolverOptions(const char* name) : solver(name) {}             // NOLINT

    bool iterative() const { return solver == "pcg" || solver == "gmres"; }
    /// Adds what is wrong, under "integrator.".
    void check(std::vector<Problem>& problems) const;
    /// Adds what does not go with matrices that are symmetric or not.
    void check_symmetry(bool symmetric, std::vector<Problem>& problems) const;

    friend bool operator==(const LinearSolverOptions&, const LinearSolverOptions&) = default;
};

/// Conjugate gradients, by SUNDIALS, preconditioned with the diagonal or with L L^T of the matrix's own sparsity.
std::unique_ptr<LinearSolver> make_pcg(const LinearSolverOptions& options);
/// GMRES, by SUNDIALS, preconditioned with the diagonal or with an incomplete L U.
std::unique_ptr<LinearSolver> make_gmres(const LinearSolverOptions& options);

/// By name: "cholmod", "klu", "umfpack", direct; "pcg" and "gmres", iterative; or "automatic": CHOLMOD for symmetric
/// matrices, UMFPACK for those that turn out not to be positive definite, and for all others.
/// @throws InputError for other options, and for "cholmod" and "pcg" if the matrices are not symmetric
std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverOptions& options, bool symmetric);

}  // namespace gneiss
