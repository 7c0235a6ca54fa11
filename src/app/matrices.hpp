#pragma once
// `gneiss matrices`: the linearised system as files, for studies of eigenvalues, condition and the like elsewhere.

#include "app/run_case.hpp"

namespace gneiss {

/// Writes stiffness.mtx (-df/du, dz/du folded in), damping.mtx (C - df/dv) and mass.mtx (lumped), Matrix Market format
/// over all degrees of freedom, and system.json: nodes, elements, constrained degrees of freedom, displacement and
/// forces of the state in which this was taken: the start of the deck, events of t = 0 included, or a checkpoint.
/// @param arguments  quiet is without effect
/// @throws InputError, RecoverableError, IoError
void write_matrices(const RunArguments& arguments);

}  // namespace gneiss
