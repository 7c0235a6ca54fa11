// VERIFICATION 8: a slender cantilever under a dead force at its tip, deflected by most of its length: the elastica.

#include <gtest/gtest.h>

#include <cmath>

#include "support/one_thread.hpp"
#include "verification/run_static.hpp"

namespace gneiss {
namespace {

using Pattern = MeshOptions::Pattern;

constexpr double E = 1e9, length = 1;
/// Shear and stretch of the axis add 0.6/25^2 and more to the elastica's deflection: 0.1 % at small loads, 0.3 % at
/// large.
constexpr double slenderness = 25;
constexpr std::array<double, 3> elastica{0.30172, 0.71379, 0.81061};  // delta_y / L at P L^2 / E I = 1, 5, 10
constexpr double one_per_cent = 0.01;

/// The same ratios of the beam.
/// @param rows  of square cells across its height
std::vector<double> deflections(bool compt, StressMap map, int rows) {
    const double height = length / slenderness, inertia = height * height * height / 12;
    test::SolidDescription what;
    what.solid.plane = Plane::stress;
    MaterialOptions material;
    material.density = 1;
    material.constants = isotropic_plane_stress(E, 0);
    material.stress_map = map;
    what.materials = {material};
    BoundaryOptions clamp;
    clamp.on = "left";
    clamp.value = {Formula(0.0), Formula(0.0)};
    what.boundaries = {clamp};
    LoadOptions tip;
    tip.on = "right";
    tip.value = {0.0, 10 * E * inertia / (length * length) / height};
    tip.amplitude = test::ramp_to_one();
    what.loads = {tip};
    const test::Solid beam = test::make_solid(
        test::rectangle(compt, length, height, {static_cast<int>(slenderness) * rows, rows}, Pattern::crossed), what);
    std::vector<double> found;
    for (const State& state : test::equilibria(*beam.system, {0.1, 0.5, 1.0}, {{.step = 0.1}}))
        found.push_back(test::displacement_at(beam.mesh, state, {length, 0.5 * height})[1] / length);
    return found;
}

TEST(Cantilever, LargeDeflections_AreThoseOfTheElastica) {
    const std::vector<double> coarse = deflections(true, StressMap::conjugate, 3),
                              fine = deflections(true, StressMap::conjugate, 6);
    for (std::size_t k = 0; k < elastica.size(); ++k) EXPECT_NEAR(fine[k] / elastica[k], 1, one_per_cent) << k;
    // where the beam's own thickness matters least, the error of the elements falls with the square of their size
    EXPECT_LT(std::abs(fine[0] / elastica[0] - 1), std::abs(coarse[0] / elastica[0] - 1) / 3.5);
}

TEST(Cantilever, OtherStressMapAndCst_DeflectAlike) {
    const std::vector<double> conjugate = deflections(true, StressMap::conjugate, 2),
                              direct = deflections(true, StressMap::direct, 2),
                              cst = deflections(false, StressMap::conjugate, 2);
    for (std::size_t k = 0; k < elastica.size(); ++k) {
        EXPECT_NEAR(direct[k] / conjugate[k], 1, 1e-3) << k;  // strains of some per cent, and of either sign
        EXPECT_NEAR(cst[k] / conjugate[k], 1, 1e-9) << k;     // M_v = 0: one element [FORMULATION 2]
    }
}

}  // namespace
}  // namespace gneiss
