#pragma once
// The energy ledger of laws without a stored energy: stress power, accumulated per initial volume, J/m3.

#include "materials/point.hpp"

namespace gneiss {

/// Integrates P : dF by the trapezoidal rule between accepted states, order 2 in the step. Its one internal variable is
/// the last of the law's z; its history is the last of the law's history: P alpha, P beta (Pa), H alpha, H beta.
struct WorkMeter {
    static constexpr std::size_t n_internal = 1, n_history = 8;

    template <class T, class V, std::size_t n_z, std::size_t n_h>
    static void update(const PointKinematics<T>& point, const PointStress<T>& stress, const T& q,
                       const PointMemory<V, n_z, n_h>& accepted, PointMemory<T, n_z, n_h>& updated) {
        const Vec2<T> p_alpha = stress.p_alpha + q * cofactor_alpha(point);
        const Vec2<T> p_beta = stress.p_beta + q * cofactor_beta(point);
        const V* before = accepted.history.data() + (n_h - n_history);
        const Vec2<T> p_alpha_sum = p_alpha + Vec2<T>{T(before[0]), T(before[1])};
        const Vec2<T> p_beta_sum = p_beta + Vec2<T>{T(before[2]), T(before[3])};
        const Vec2<T> d_alpha = point.h_alpha - Vec2<T>{T(before[4]), T(before[5])};
        const Vec2<T> d_beta = point.h_beta - Vec2<T>{T(before[6]), T(before[7])};
        updated.z[n_z - 1] = T(accepted.z[n_z - 1]) + 0.5 * (dot(p_alpha_sum, d_alpha) + dot(p_beta_sum, d_beta));
        T* after = updated.history.data() + (n_h - n_history);
        const Vec2<T> record[4] = {p_alpha, p_beta, point.h_alpha, point.h_beta};
        for (int k = 0; k < 4; ++k) {
            after[2 * k] = record[k].x;
            after[2 * k + 1] = record[k].y;
        }
    }

    /// P : F', W/m3.
    template <class T>
    static T power(const PointKinematics<T>& point, const PointRates<T>& rates, const PointStress<T>& stress,
                   const T& q) {
        return dot(stress.p_alpha + q * cofactor_alpha(point), rates.alpha) +
               dot(stress.p_beta + q * cofactor_beta(point), rates.beta);
    }
};

}  // namespace gneiss
