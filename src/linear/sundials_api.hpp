#pragma once
// SUNDIALS 6.4 and 7.x behind the same names. cmake/SundialsFeatures.cmake asks the headers at hand what they have:
//
//     GNEISS_SUNDIALS_HAS_SET_ERR_FILE     each solver is silenced by a function of its own (6), or
//     GNEISS_SUNDIALS_HAS_ERR_HANDLERS     all of them by their context (7)
//     GNEISS_SUNDIALS_HAS_COMMON_ARKODE    one set of functions for all of ARKODE's steppers (7.1)
//
// Otherwise code uses what both have: sunrealtype, sunbooleantype, and 0 for success.

#include <cstdio>  // FILE, which headers of 6.4 use without it

#include <nvector/nvector_serial.h>

#include <cstddef>
#include <span>
#include <sundials/sundials_context.hpp>

/// Nothing is printed by a solver: GNEISS_SUNDIALS_SILENCE(CVode, memory). Its context has to be a SilentContext.
#if GNEISS_SUNDIALS_HAS_SET_ERR_FILE
#define GNEISS_SUNDIALS_SILENCE(solver, memory) solver##SetErrFile(memory, nullptr)
#else
#define GNEISS_SUNDIALS_SILENCE(solver, memory) static_cast<void>(memory)
#endif

/// A function that all steppers of ARKODE have: GNEISS_ARKODE(MRIStep, Evolve) is MRIStepEvolve or ARKodeEvolve.
#if GNEISS_SUNDIALS_HAS_COMMON_ARKODE
#define GNEISS_ARKODE(stepper, function) ARKode##function
#else
#define GNEISS_ARKODE(stepper, function) stepper##function
#endif

namespace gneiss {

/// Where objects of SUNDIALS live that print nothing: what went wrong is told by return values.
class SilentContext : public sundials::Context {
public:
    SilentContext() {
#if GNEISS_SUNDIALS_HAS_ERR_HANDLERS
        SUNContext_ClearErrHandlers(*this);
        // warnings would go to stdout: a logger of 7.1 whose file is "" prints all the same
        SUNContext_SetLogger(*this, nullptr);
#endif
    }
};

inline std::span<double> values_of(N_Vector vector) {
    return {N_VGetArrayPointer(vector), static_cast<std::size_t>(N_VGetLength(vector))};
}

}  // namespace gneiss
