#pragma once
// What implicit and static schemes ask of a system first: its tangent, and which degrees of freedom are free.

#include <string>
#include <vector>

#include "linear/free_matrix.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// @param scheme  for the message, "ida" say
/// @throws InputError if the system has no tangent
const Tangent& tangent_of(const SemiDiscrete& system, const std::string& scheme);

/// Degrees of freedom with prescribed motion, ascending.
std::vector<std::size_t> constrained_dofs(const SemiDiscrete& system);

/// The free part of a tangent's matrix.
FreeMatrix free_part(const SemiDiscrete& system, const Tangent& tangent);

}  // namespace gneiss
