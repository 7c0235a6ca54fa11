#pragma once
// Stress across the plane in plane strain  [FORMULATION 3]: what the laws of the plane leave open, for output alone.

#include "materials/elastic_constants.hpp"
#include "materials/point.hpp"

namespace gneiss {

/// What (18) leaves out: at small strain sigma_zz = M_v e_v + M_z e_alpha, with M_z = C_alpha_z - M_v =
/// M_alpha - E_alpha/(1 + nu_p_alpha), Pa. beta needs no such constant, since C_beta_z = C_beta_alpha = M_v by
/// symmetry about beta; of isotropic constants M_z is zero.
inline double transversely_isotropic_across(const TransverselyIsotropic& given) {
    return transversely_isotropic_plane_strain(given).M_alpha - given.E_alpha / (1 + given.nu_p_alpha);
}

/// Cauchy stress of either stress map from m_z = M_z e_alpha, Pa: that stress already (`direct`), or work-conjugate to
/// the logarithm of the thickness (`conjugate`). The volume's part, q of the composite, is not in it.
template <bool direct, class T>
T across_map(const PointKinematics<T>& point, const T& m_z) {
    return direct ? m_z : T(m_z / point.jacobian());
}

}  // namespace gneiss
