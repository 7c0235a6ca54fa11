#pragma once
// Every material law under contract, with what theory says about it.

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "materials/munjiza_hyperelastic.hpp"
#include "materials/munjiza_hypoelastic.hpp"
#include "materials/neo_hookean.hpp"

namespace gneiss {

/// What a closed cycle of strain costs.
enum class Cycle {
    free,            ///< nothing: the work is the difference of a stored energy, or of a function like one
    third_order,     ///< work of third order in the strain: stresses are a function of strain, but not a gradient
    path_dependent,  ///< whatever the state-dependent moduli create or lose
};

/// Size of all stiffnesses below, Pa: the scale of every tolerance on stresses.
inline constexpr double modulus = 1e9;

/// No two constants alike, Pa; close to (22), (23) of Lei et al. 2016.
inline constexpr MunjizaConstants anisotropic{0.3e9, 0.8e9, 1.6e9, 0.9e9};
/// Moduli change by a factor of 2 or 3 over the deformations under test; p_ref in Pa.
inline constexpr Stiffening stiffening_rock{2.0, 5e7, 0.5};

template <bool direct>
struct Hyperelastic {
    using Law = MunjizaHyperelastic<direct>;
    static constexpr Cycle cycle = direct ? Cycle::third_order : Cycle::free;
    static Law law() { return {anisotropic}; }
    /// (sigma_alpha, sigma_beta, sigma_alpha_beta) from (eps_alpha, eps_beta, 2 eps_alpha_beta), Pa  [FORMULATION 9].
    static Eigen::Matrix3d stiffness() { return Eigen::Matrix3d{{1.1e9, 0.3e9, 0}, {0.3e9, 1.9e9, 0}, {0, 0, 0.45e9}}; }
};

template <bool direct>
struct Hypoelastic {
    using Law = MunjizaHypoelastic<direct>;
    static constexpr Cycle cycle = direct ? Cycle::third_order : Cycle::free;
    static Law law() { return {anisotropic, {}}; }
    static Eigen::Matrix3d stiffness() { return Hyperelastic<direct>::stiffness(); }
};

template <bool direct>
struct StiffeningHypoelastic {
    using Law = MunjizaHypoelastic<direct>;
    static constexpr Cycle cycle = Cycle::path_dependent;
    static Law law() { return {anisotropic, stiffening_rock}; }
    static Eigen::Matrix3d stiffness() { return Hyperelastic<direct>::stiffness(); }
};

template <bool plane_stress>
struct NeoHooke {
    using Law = NeoHookean<plane_stress>;
    static constexpr Cycle cycle = Cycle::free;
    static constexpr double mu = 0.4e9, lambda = 0.7e9;
    static Law law() { return {mu, lambda}; }
    static Eigen::Matrix3d stiffness() {
        // plane stress by eliminating sigma_z = lambda (eps_x + eps_y) + (lambda + 2 mu) eps_z = 0
        const double l = plane_stress ? lambda - lambda * lambda / (lambda + 2 * mu) : lambda;
        return Eigen::Matrix3d{{l + 2 * mu, l, 0}, {l, l + 2 * mu, 0}, {0, 0, mu}};
    }
};

/// To add a law: one struct like those above, one line here.
using Laws = testing::Types<Hyperelastic<false>, Hyperelastic<true>,                    //
                            Hypoelastic<false>, Hypoelastic<true>,                      //
                            StiffeningHypoelastic<false>, StiffeningHypoelastic<true>,  //
                            NeoHooke<false>, NeoHooke<true>>;

/// body.template operator()<Case>() for every law above.
template <class Body, class... Cases>
void for_each(testing::Types<Cases...>, Body body) {
    (body.template operator()<Cases>(), ...);
}
template <class Body>
void for_each_law(Body body) {
    for_each(Laws{}, body);
}

}  // namespace gneiss
