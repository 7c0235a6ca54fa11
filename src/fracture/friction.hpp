#pragma once
// Coulomb friction on a crack, in parallel with cohesion: an elastic slider  [FORMULATION 7].
//
//   tau = k (s - s_slider),   |tau| <= L = mu <-sigma>

#include "fracture/parts.hpp"

namespace gneiss {

/// The slider after a step.
template <class T>
struct SliderStep {
    T traction;    ///< Pa
    T slider;      ///< m, where its spring is without load
    T dissipated;  ///< J/m2, >= 0, in this step
};

/// The exact answer for a step in which slip and limit run straight, the limit from `limit0` to `limit1`. The spring
/// starts below the limit by gap = L0 - |tau0|; without sliding it would end above by excess = |tau0 + k ds| - L1.
/// Sliding therefore begins at the part gap/(gap + excess) of the step, goes on at a constant rate over excess/k, and
/// dissipates the mean of the limit over it.
/// @param k       Pa/m
/// @param limit0  Pa, >= 0, at the start; limit1 at the end
/// @param slip0   m, at the start; slip1 at the end
/// @param slider0 m, at the start
template <class T, class V, class S>
SliderStep<T> slide(const V& k, const S& limit0, const T& limit1, const S& slip0, const S& slider0, const T& slip1) {
    const T trial = k * (slip1 - T(slider0));
    const T excess = magnitude(trial) - limit1;
    const auto slides = plain(excess) > 0.0;
    const T gap = positive_part(T(T(limit0) - with_sign_of(trial, T(k * (slip0 - slider0)))));
    const T onset = T(limit0) + (limit1 - T(limit0)) * gap / choose(slides, T(gap + excess), T(1.0));
    const T moved = excess / T(k);
    return {choose(slides, with_sign_of(trial, limit1), trial),
            choose(slides, T(T(slider0) + with_sign_of(trial, moved)), T(slider0)),
            choose(slides, T(0.5 * (onset + limit1) * moved), T(0.0))};
}

}  // namespace gneiss
