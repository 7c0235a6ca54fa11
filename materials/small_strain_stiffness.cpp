#include "materials/small_strain_stiffness.hpp"

namespace gneiss {

Eigen::Matrix2d normal_stiffness(const MunjizaConstants& c) {
    return Eigen::Matrix2d{{c.M_v + c.M_alpha, c.M_v}, {c.M_v, c.M_v + c.M_beta}};
}

Eigen::Matrix3d small_strain_stiffness(const MunjizaConstants& c) {
    return Eigen::Matrix3d{{c.M_v + c.M_alpha, c.M_v, 0}, {c.M_v, c.M_v + c.M_beta, 0}, {0, 0, c.M_psi / 2}};
}

}  // namespace gneiss
