#pragma once
// The state at t = 0.

#include <vector>

#include "mesh/mesh.hpp"
#include "model/options.hpp"

namespace gneiss {

/// Initial velocity, m/s, shape (2 n_nodes), zero where no entry speaks. A node may be named by several entries only if
/// they give it the same velocity: an order that silently decides would hide a mistake.
/// @throws InputError with every problem of every entry, `where` being "[[initial]] 2" (counted from 1): unknown names,
/// faulty formulas, values that are not finite, entries that give one node different velocities
std::vector<double> initial_velocity(const Mesh& mesh, const std::vector<InitialOptions>& options);

}  // namespace gneiss
