// VERIFICATION 8: a slender cantilever under a dead force at its tip, deflected by most of its length: the elastica.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/one_thread.hpp"
#include "verification/run_static.hpp"

namespace gneiss {
namespace {

using Pattern = MeshOptions::Pattern;

constexpr double E = 1e9, length = 1;
constexpr double slenderness = 25;
constexpr std::array<double, 3> elastica{0.30172, 0.71379, 0.81061};  // delta_y / L at P L^2 / E I = 1, 5, 10
constexpr double one_per_cent = 0.01, locked = 0.3;

struct Beam {
    bool compt = true;
    int rows = 1;  ///< of square cells across its height
    Plane plane = Plane::stress;
    double nu = 0;
    StressMap map = StressMap::conjugate;
    Pattern pattern = Pattern::crossed;
};

/// The same ratios of the beam.
std::vector<double> deflections(const Beam& beam) {
    const double height = length / slenderness, inertia = height * height * height / 12;
    const bool strain = beam.plane == Plane::strain;
    const double modulus = strain ? E / (1 - beam.nu * beam.nu) : E;
    test::SolidDescription what;
    what.solid.plane = beam.plane;
    MaterialOptions material;
    material.density = 1;
    material.constants = strain ? isotropic_plane_strain(E, beam.nu) : isotropic_plane_stress(E, beam.nu);
    material.stress_map = beam.map;
    what.materials = {material};
    Mesh mesh = test::rectangle(beam.compt, length, height, {static_cast<int>(slenderness) * beam.rows, beam.rows},
                                beam.pattern);
    BoundaryOptions clamp;
    clamp.on = "left";
    clamp.value = {Formula(0.0), Formula(0.0)};
    what.boundaries = {clamp};
    if (beam.nu >
        0) {  // a root that cannot contract is stiffer than any beam's: 0.7 % of the deflection at nu = 0.4999
        what.boundaries[0].value[1] = std::nullopt;
        for (std::size_t node = 0; node < mesh.n_nodes(); ++node)
            if (std::hypot(mesh.nodes[node][0], mesh.nodes[node][1] - 0.5 * height) < 1e-9 * length)
                mesh.node_sets["middle of the root"] = {static_cast<std::int32_t>(node)};
        clamp.on = "middle of the root";
        clamp.value = {std::nullopt, Formula(0.0)};
        what.boundaries.push_back(clamp);
    }
    LoadOptions tip;
    tip.on = "right";
    tip.value = {0.0, 10 * modulus * inertia / (length * length) / height};
    tip.amplitude = test::ramp_to_one();
    what.loads = {tip};
    const test::Solid solid = test::make_solid(std::move(mesh), what);
    std::vector<double> found;
    for (const State& state : test::equilibria(*solid.system, {0.1, 0.5, 1.0}, {{.step = 0.1}}))
        found.push_back(test::displacement_at(solid.mesh, state, {length, 0.5 * height})[1] / length);
    return found;
}

TEST(Cantilever, LargeDeflections_AreThoseOfTheElastica) {
    const std::vector<double> coarse = deflections({.rows = 3}), fine = deflections({.rows = 6});
    for (std::size_t k = 0; k < elastica.size(); ++k) EXPECT_NEAR(fine[k] / elastica[k], 1, one_per_cent) << k;
    // where the beam's own thickness matters least, the error of the elements falls with the square of their size
    EXPECT_LT(std::abs(fine[0] / elastica[0] - 1), std::abs(coarse[0] / elastica[0] - 1) / 3.5);
    // Extrapolated to elements of no size, what is left is shear, P L/(5/6 G h) with G = E/2; then stretch of the axis
    // and finite strains, of the order of the square of the strain at the surface, h/2L = 2 %.
    const double limit = (4 * fine[0] - coarse[0]) / 3, shear = 1 / (5 * slenderness * slenderness);
    EXPECT_NEAR(limit / elastica[0], 1 + shear / elastica[0], 4e-4);
}

TEST(Cantilever, OtherStressMapAndCst_DeflectAlike) {
    const std::vector<double> conjugate = deflections({.rows = 2}),
                              direct = deflections({.rows = 2, .map = StressMap::direct}),
                              cst = deflections({.compt = false, .rows = 2});
    for (std::size_t k = 0; k < elastica.size(); ++k) {
        EXPECT_NEAR(direct[k] / conjugate[k], 1, 1e-3) << k;  // strains of some per cent, and of either sign
        EXPECT_NEAR(cst[k] / conjugate[k], 1, 1e-9) << k;     // M_v = 0: one element [FORMULATION 2]
    }
}

/// The mesh in which CST locks altogether, and the elastica of E/(1 - nu^2).
TEST(Cantilever, NearlyIncompressible_OnlyComptIsTheElastica) {
    Beam beam{.rows = 6, .plane = Plane::strain, .nu = 0.4999, .pattern = Pattern::uniform_right};
    const std::vector<double> compt = deflections(beam);
    beam.compt = false;
    const std::vector<double> cst = deflections(beam);
    for (std::size_t k = 0; k < elastica.size(); ++k) {
        EXPECT_NEAR(compt[k] / elastica[k], 1, one_per_cent) << k;
        EXPECT_LT(cst[k] / elastica[k], locked) << k;
    }
}

}  // namespace
}  // namespace gneiss
