#pragma once
// What SUNDIALS works with, owned by C++: contexts, vectors over our arrays, and a matrix and a linear solver of ours
// behind its interfaces.

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <sundials/sundials_context.hpp>
#include <utility>
#include <vector>

#include "linear/linear_solver.hpp"

namespace gneiss {

inline std::span<double> values_of(N_Vector vector) {
    return {N_VGetArrayPointer(vector), static_cast<std::size_t>(N_VGetLength(vector))};
}

struct VectorDeleter {
    void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
using OwnedVector = std::unique_ptr<_generic_N_Vector, VectorDeleter>;

inline OwnedVector new_vector(std::size_t n, SUNContext context) {
    OwnedVector vector(N_VNew_Serial(static_cast<sunindextype>(n), context));
    if (!vector) throw std::bad_alloc();
    return vector;
}

struct NonlinearSolverDeleter {
    void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
using OwnedNonlinearSolver = std::unique_ptr<_generic_SUNNonlinearSolver, NonlinearSolverDeleter>;

/// Carries exceptions of our functions past the C code that calls them.
class CallbackGuard {
public:
    /// What SUNDIALS is to know of an exception of body(): 1, try again elsewhere; -1, give up.
    template <class Body>
    int operator()(Body body) {
        try {
            body();
            return 0;
        } catch (const RecoverableError& error) {
            failure_ = error.what();
            return 1;
        } catch (...) {
            unrecoverable_ = std::current_exception();
            return -1;
        }
    }
    /// What the last recoverable failure said; empty if there was none.
    const std::string& failure() const { return failure_; }
    void forget() { failure_.clear(); }
    /// Throws what no other step would cure, once SUNDIALS has returned.
    void rethrow() {
        if (const auto error = std::exchange(unrecoverable_, nullptr)) std::rethrow_exception(error);
    }

private:
    std::string failure_;
    std::exception_ptr unrecoverable_;
};

/// A matrix in compressed rows as a SUNMatrix: SUNDIALS hands it on, and multiplies with it.
class SundialsMatrix {
public:
    /// @param pattern  its arrays have to outlive this
    /// @param values   begin with those of the pattern; have to outlive this
    SundialsMatrix(const SparsePattern& pattern, std::span<double> values, SUNContext context);
    SundialsMatrix(const SundialsMatrix&) = delete;
    SundialsMatrix& operator=(const SundialsMatrix&) = delete;
    ~SundialsMatrix() { SUNMatFreeEmpty(matrix_); }

    SUNMatrix get() const { return matrix_; }
    std::span<double> values() const { return values_; }

private:
    SparsePattern pattern_;
    std::span<double> values_;
    SUNMatrix matrix_;
};

/// A LinearSolver as a SUNLinearSolver: set up with a SundialsMatrix's values.
class SundialsSolver {
public:
    SundialsSolver(LinearSolver& solver, SundialsMatrix& matrix, SUNContext context);
    SundialsSolver(const SundialsSolver&) = delete;
    SundialsSolver& operator=(const SundialsSolver&) = delete;
    ~SundialsSolver() { SUNLinSolFreeEmpty(linear_solver_); }

    SUNLinearSolver get() const { return linear_solver_; }
    /// Why the last factorisation or solve failed; empty if it did not.
    const std::string& failure() const { return guard_.failure(); }
    /// Throws what no other matrix would cure, once SUNDIALS has returned.
    void rethrow_unrecoverable() { guard_.rethrow(); }

private:
    static int setup(SUNLinearSolver self, SUNMatrix);
    static int solve(SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, realtype);

    LinearSolver& solver_;
    SundialsMatrix& matrix_;
    SUNLinearSolver linear_solver_;
    CallbackGuard guard_;
};

}  // namespace gneiss
