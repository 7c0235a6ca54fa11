// Linear triangles of deal.II against our CST: the same displacements, whatever the solid, its loads and its supports.

#include <fmt/format.h>

#include <cmath>

#include "crosscheck/crosscheck_testing.hpp"
#include "support/one_thread.hpp"
#include "verification/run_static.hpp"

namespace gneiss::crosscheck {
namespace {

/// The equilibrium at t_end by gneiss.
State equilibrium(const CaseOptions& options) {
    gneiss::test::SolidDescription what;
    what.solid = options.solid;
    what.materials = options.materials;
    what.loads = options.loads;
    what.boundaries = options.boundaries;
    const gneiss::test::Solid solid = gneiss::test::make_solid(make_mesh(options.mesh, options.solid.compt, {}), what);
    return gneiss::test::equilibria(*solid.system, {options.run.t_end}, {{.tolerance = 1e-10}}).back();
}

/// Largest difference of a displacement over the largest displacement.
double difference(const std::string& deck) {
    const State ours = equilibrium(parse_deck(deck, "deck"));
    const Solution theirs = test::solve_deck(deck, Element::p1).solution;
    double off = 0, size = 0;
    for (std::size_t node = 0; node < theirs.displacement.size(); ++node)
        for (std::size_t i = 0; i < 2; ++i) {
            size = std::max(size, std::abs(ours.u[2 * node + i]));
            off = std::max(off, std::abs(ours.u[2 * node + i] - theirs.displacement[node][i]));
        }
    EXPECT_GT(size, 0);
    return off / size;
}

/// Strains of 1e-10 leave as much to geometry, round-off times the condition a few times more: 1e-9 measured.
constexpr double same = 1e-8;

const std::string corner_force = R"toml(
load = [{ on = "top_right", type = "nodal_force", value = [1, -1], amplitude = { type = "ramp", end = 1 } }]
boundary = [{ on = "left", type = "fixed" }, { on = "bottom", type = "fixed" }]
run = { t_end = 1 }
)toml";

TEST(LinearTriangles, SquareUnderACornerForce_AreCst) {
    for (const auto& [plane, nu] : {std::pair("stress", 0.25), std::pair("strain", 0.4999)})
        for (const char* pattern : {"uniform_right", "alternating", "crossed"}) {
            const std::string deck =
                fmt::format(
                    "mesh = {{ generator = \"rectangle\", width = 1, height = 1, cells = [12, 12], pattern = "
                    "\"{}\" }}\nsolid = {{ element = \"cst\", plane = \"{}\" }}\n"
                    "material = [{{ density = 1000, constants = {{ E = 1e10, nu = {} }} }}]\n",
                    pattern, plane, nu) +
                corner_force;
            EXPECT_LE(difference(deck), same) << plane << pattern;
        }
}

TEST(LinearTriangles, AnisotropicPlateWithAHoleUnderEveryLoad_AreCst) {
    const std::string deck = R"toml(
mesh = { generator = "plate_with_hole", side = 4, radius = 0.5, size = [0.2, 0.5] }
solid = { element = "cst", plane = "strain", thickness = 0.3 }
load = [
    { on = "hole", type = "pressure", value = "0.1 + 0.05*x", amplitude = { type = "ramp", end = 2 } },
    { on = "top", type = "traction", value = ["0.1*x", "0.3 - 0.1*x*x"], amplitude = { type = "expression", expression = "t*(1 + 0.1*x)" } },
    { type = "body_force", value = [0.02, "-0.1*y"], amplitude = { type = "ramp", end = 0.5 } },
    { on = "top_right", type = "nodal_force", value = [0.05, 0.02], amplitude = { type = "ramp", end = 1 } },
]
boundary = [
    { on = "bottom", type = "fixed" },
    { on = "left", type = "displacement", value = ["1e-11*(y + 2)", "free"], amplitude = { type = "ramp", end = 2 } },
]
run = { t_end = 1 }
[[material]]
density = 1000
axes = { angle = "0.4 + 0.3*x - y" }
constants = { E_alpha = 3e9, E_beta = 1e9, nu_alpha_beta = 0.3, nu_p_alpha = 0.2, G = 0.7e9 }
)toml";
    EXPECT_LE(difference(deck), same);
}

}  // namespace
}  // namespace gneiss::crosscheck
