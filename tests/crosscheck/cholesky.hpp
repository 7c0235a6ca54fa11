#pragma once
// gneiss's CHOLMOD as the direct solver of the cross-check.

#include "elasticity.hpp"

namespace gneiss::crosscheck {

/// @throws RecoverableError where a matrix is singular or not positive definite: too few supports, as a rule
MakeSolver cholesky();

}  // namespace gneiss::crosscheck
