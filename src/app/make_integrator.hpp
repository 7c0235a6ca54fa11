#pragma once
// An integrator by the name that a deck gives it.

#include <memory>

#include "model/options.hpp"
#include "system/integrator.hpp"

namespace gneiss {

/// @param contact  whether bodies may be held by contact alone
/// @throws InputError with every option out of its range, or without effect beside the others
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, bool contact = false);

/// Whether it is explicit and takes its step from the stability bound where none is given.
bool has_critical_step(const IntegratorOptions& options);

/// @throws InputError if the linear solver cannot take the system's tangents
void check_linear_solver(const IntegratorOptions& options, const SemiDiscrete& system);

}  // namespace gneiss
