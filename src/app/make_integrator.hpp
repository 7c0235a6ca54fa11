#pragma once
// An integrator by the name that a deck gives it.

#include <memory>

#include "model/options.hpp"
#include "system/integrator.hpp"

namespace gneiss {

/// @throws InputError with every option out of its range
std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options);

}  // namespace gneiss
