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

}  // namespace gneiss
