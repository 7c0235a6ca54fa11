#pragma once
// What SUNDIALS works with, owned by C++: contexts, vectors over our arrays, and shells behind which matrices and
// linear solvers of ours stand.

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linear/linear_solver.hpp"
#include "linear/sundials_api.hpp"

namespace gneiss {

struct VectorDeleter {
    void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
using OwnedVector = std::unique_ptr<_generic_N_Vector, VectorDeleter>;

inline OwnedVector new_vector(std::size_t n, SUNContext context) {
    OwnedVector vector(N_VNew_Serial(static_cast<sunindextype>(n), context));
    if (!vector) throw std::bad_alloc();
    return vector;
}

struct MatrixDeleter {
    void operator()(SUNMatrix matrix) const { SUNMatFreeEmpty(matrix); }
};
using OwnedMatrix = std::unique_ptr<_generic_SUNMatrix, MatrixDeleter>;

/// A matrix that SUNDIALS hands on and looks at no further.
/// @param owner  its content, which has to outlive it
inline OwnedMatrix new_matrix(void* owner, SUNContext context) {
    OwnedMatrix matrix(SUNMatNewEmpty(context));
    if (!matrix) throw std::bad_alloc();
    matrix->content = owner;
    matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
    matrix->ops->zero = [](SUNMatrix) { return 0; };
    return matrix;
}

struct LinearSolverDeleter {
    void operator()(SUNLinearSolver solver) const { SUNLinSolFreeEmpty(solver); }
};
using OwnedLinearSolver = std::unique_ptr<_generic_SUNLinearSolver, LinearSolverDeleter>;

/// A direct solver.
/// @param owner  set_up() and solve(b, x) are called on it; their exceptions wait in its guard(); has to outlive it
template <class Owner>
OwnedLinearSolver new_linear_solver(Owner* owner, SUNContext context) {
    OwnedLinearSolver solver(SUNLinSolNewEmpty(context));
    if (!solver) throw std::bad_alloc();
    solver->content = owner;
    solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
    solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
    solver->ops->initialize = [](SUNLinearSolver) { return 0; };
    solver->ops->setup = [](SUNLinearSolver self, SUNMatrix) {
        auto& of = *static_cast<Owner*>(self->content);
        return of.guard()([&] { of.set_up(); });
    };
    solver->ops->solve = [](SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
        auto& of = *static_cast<Owner*>(self->content);
        return of.guard()([&] { of.solve(values_of(b), values_of(x)); });
    };
    return solver;
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

}  // namespace gneiss
