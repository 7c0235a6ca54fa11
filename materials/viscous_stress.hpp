#pragma once
// Optional viscous stress beside any law: sigma = 2 eta (d - tr d/2 I) + zeta (s_v'/s_v) I, d the rate of deformation.
// The second term acts on the composite's volume, so that it does not lock. Bulk viscosity inflates measured fracture
// energies: the default is none.

#include "materials/point.hpp"

namespace gneiss {

struct ViscousStress {
    double shear = 0;  ///< eta, Pa s, >= 0
    double bulk = 0;   ///< zeta, Pa s, >= 0

    bool active() const { return shear > 0 || bulk > 0; }

    /// P alpha and P beta of the viscous stress, Pa; q is left zero: the volume's rate is the composite's already.
    template <class T, class K>
    PointStress<T> stress(const PointKinematics<K>& point, const PointRates<T>& rates) const {
        const Vec2<K> a = point.alpha(), b = point.beta();
        const T inverse = T(K(1.0) / point.jacobian());
        const Vec2<T> alpha{T(a.x), T(a.y)}, beta{T(b.x), T(b.y)};
        // velocity gradient L = F' F^-1
        const T l_xx = (rates.alpha.x * beta.y - rates.beta.x * alpha.y) * inverse;
        const T l_xy = (rates.beta.x * alpha.x - rates.alpha.x * beta.x) * inverse;
        const T l_yx = (rates.alpha.y * beta.y - rates.beta.y * alpha.y) * inverse;
        const T l_yy = (rates.beta.y * alpha.x - rates.alpha.y * beta.x) * inverse;
        const T deviator = shear * (l_xx - l_yy), mean = bulk * rates.volume, sigma_xy = shear * (l_xy + l_yx);
        const T sigma_xx = mean + deviator, sigma_yy = mean - deviator;
        // P = det F sigma F^-T = sigma cof F
        const Vec2<T> cof_alpha = -turned(beta), cof_beta = turned(alpha);
        return {{sigma_xx * cof_alpha.x + sigma_xy * cof_alpha.y, sigma_xy * cof_alpha.x + sigma_yy * cof_alpha.y},
                {sigma_xx * cof_beta.x + sigma_xy * cof_beta.y, sigma_xy * cof_beta.x + sigma_yy * cof_beta.y},
                T(0.0)};
    }
};

}  // namespace gneiss
