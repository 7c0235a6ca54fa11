#pragma once
// The stiffness that Munjiza constants mean at small strain, as matrices. Apart from the constants, because Eigen is
// long to compile and no run needs it.

#include <Eigen/Core>

#include "materials/elastic_constants.hpp"

namespace gneiss {

/// Small-strain stiffness of the normal components on orthogonal axes, Pa, shape (2, 2):
/// (sigma_alpha, sigma_beta) from (eps_alpha, eps_beta).
Eigen::Matrix2d normal_stiffness(const MunjizaConstants& constants);

/// Small-strain stiffness on orthogonal axes, Pa, shape (3, 3): (sigma_alpha, sigma_beta, sigma_alpha_beta) from
/// (eps_alpha, eps_beta, 2 eps_alpha_beta). The shear entry is M_psi / 2 = G.
Eigen::Matrix3d small_strain_stiffness(const MunjizaConstants& constants);

}  // namespace gneiss
