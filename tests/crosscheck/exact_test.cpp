// Solutions that are in every space, or in that of the quadratic elements: they come out to round-off.

#include <fmt/format.h>

#include <cmath>

#include "crosscheck/crosscheck_testing.hpp"
#include "mesh/make_mesh.hpp"
#include "mesh/measure.hpp"

namespace gneiss::crosscheck {
namespace {

using test::every_element;
using test::rock;
using test::solve_deck;
using test::Solved;

/// Round-off, times a condition of some thousands.
constexpr double round_off = 1e-11;

/// Largest difference from a displacement field over its largest value, at the nodes.
double difference(const Solved& solved, const std::function<Vector(const Vector&)>& exact) {
    double off = 0, size = 0;
    for (std::size_t node = 0; node < solved.what.nodes.size(); ++node) {
        const Vector u = exact(solved.what.nodes[node]);
        for (std::size_t i = 0; i < 2; ++i) {
            off = std::max(off, std::abs(u[i] - solved.solution.displacement[node][i]));
            size = std::max(size, std::abs(u[i]));
        }
    }
    return off / size;
}

std::string plate(bool curved) {
    return fmt::format(
        "mesh = {{ generator = \"plate_with_hole\", side = 4, radius = 0.5, size = [0.3, 0.7], seed = 3, "
        "curved = {} }}\nsolid = {{ plane = \"strain\" }}\nrun = {{ t_end = 1 }}\n",
        curved);
}

TEST(Patch, LinearDisplacementOnTheBoundary_HoldsInside_WithItsStress) {
    const double angle = 0.3, c = std::cos(angle), s = std::sin(angle);
    const double exx = 2e-3, eyy = -1e-3, exy = 1.5e-3;
    // strains on the material axes, stresses there by FORMULATION 9, turned back
    const double eaa = c * c * exx + s * s * eyy + 2 * c * s * exy, ebb = s * s * exx + c * c * eyy - 2 * c * s * exy,
                 eab = c * s * (eyy - exx) + (c * c - s * s) * exy;
    const double saa = 1.2e9 * eaa + 0.4e9 * ebb, sbb = 0.4e9 * eaa + 2.0e9 * ebb, sab = 0.9e9 * eab;
    const std::array<double, 3> cauchy{c * c * saa + s * s * sbb - 2 * c * s * sab,
                                       s * s * saa + c * c * sbb + 2 * c * s * sab,
                                       c * s * (saa - sbb) + (c * c - s * s) * sab};
    const double pressure = -0.4e9 * (exx + eyy);

    std::string deck = plate(true) + rock;
    deck.replace(deck.find("density"), 0, "axes = { angle = 0.3 }, ");
    for (const char* side : {"outer", "hole"})
        deck += fmt::format(
            "[[boundary]]\non = \"{}\"\ntype = \"displacement\"\nvalue = [\"2e-3*x + 1e-3*y\", \"2e-3*x - 1e-3*y\"]\n",
            side);
    for (const Element element : every_element)
        for (const int refine : {0, 1}) {
            const Solved solved = solve_deck(deck, element, refine);
            EXPECT_FALSE(solved.what.composites_are_cells);  // the hole is round
            EXPECT_LE(difference(solved,
                                 [](const Vector& x) {
                                     return Vector{2e-3 * x[0] + 1e-3 * x[1], 2e-3 * x[0] - 1e-3 * x[1]};
                                 }),
                      round_off);
            ASSERT_EQ(solved.solution.stress_at.size(), solved.what.n_sub_triangles);
            for (const PointStress& point : solved.solution.stress_at) {
                for (std::size_t i = 0; i < 3; ++i) ASSERT_NEAR(point.cauchy[i], cauchy[i], round_off * 1e8);
                ASSERT_NEAR(point.pressure, pressure, round_off * 1e8);
            }
        }
}

/// Held so that it cannot move as a rigid body, and nothing more.
const std::string just_held = R"toml(
[[boundary]]
on = "bottom_left"
type = "fixed"
[[boundary]]
on = "bottom_right"
type = "displacement"
value = ["free", 0]
)toml";

TEST(Patch, TractionsOrPressureOnAllSides_StressIsWhatTheySay) {
    const std::string tractions = R"toml(
[[load]]
on = "top"
type = "traction"
value = [2e5, -3e5]
[[load]]
on = "bottom"
type = "traction"
value = [-2e5, 3e5]
[[load]]
on = "right"
type = "traction"
value = [1e5, 2e5]
[[load]]
on = "left"
type = "traction"
value = [-1e5, -2e5]
)toml";
    const std::string pressures =
        "[[load]]\non = \"outer\"\ntype = \"pressure\"\nvalue = 4e5\namplitude = { type = \"ramp\", end = 2 }\n";
    const std::string square =
        "mesh = { generator = \"rectangle\", width = 2, height = 1, cells = [4, 3], pattern = \"crossed\" }\n"
        "solid = { plane = \"stress\", thickness = 0.2 }\nrun = { t_end = 1 }\n";
    for (const Element element : every_element)
        for (const int refine : {0, 1}) {
            const Solved pulled = solve_deck(square + rock + tractions + just_held, element, refine);
            for (const PointStress& point : pulled.solution.stress_at) {
                ASSERT_NEAR(point.cauchy[0], 1e5, round_off * 1e6);
                ASSERT_NEAR(point.cauchy[1], -3e5, round_off * 1e6);
                ASSERT_NEAR(point.cauchy[2], 2e5, round_off * 1e6);
            }
            // energy density by the inverse of FORMULATION 9's stiffness, on the volume of 0.4 m3
            const double det = 1.2e9 * 2.0e9 - 0.4e9 * 0.4e9;
            const double exx = (2.0e9 * 1e5 + 0.4e9 * 3e5) / det, eyy = (-1.2e9 * 3e5 - 0.4e9 * 1e5) / det;
            const double energy = 0.4 * 0.5 * (1e5 * exx - 3e5 * eyy + 2e5 * 2e5 / 0.45e9);
            EXPECT_NEAR(pulled.solution.strain_energy, energy, 1e-10 * energy);
            EXPECT_NEAR(pulled.solution.compliance, 2 * energy, 1e-10 * energy);
            const Solved pressed = solve_deck(square + rock + pressures + just_held, element, refine);
            for (const PointStress& point : pressed.solution.stress_at) {
                ASSERT_NEAR(point.cauchy[0], -2e5, round_off * 1e6);
                ASSERT_NEAR(point.cauchy[1], -2e5, round_off * 1e6);
                ASSERT_NEAR(point.cauchy[2], 0, round_off * 1e6);
            }
        }
}

TEST(Compliance, PartOfABoundaryThatEndsAtAMidSideNode_IsTheWorkOfItsTraction) {
    // displacements given all around are linear inside as well; the part is one and a half sides of composites long
    const std::string deck = R"toml(
mesh = { generator = "rectangle", width = 2, height = 1, cells = [4, 2], parts = [{ name = "patch", of = "top", from = [1.25, 0.5], to = [2, 1.5] }] }
solid = { plane = "strain", thickness = 0.5 }
load = [{ on = "patch", type = "traction", value = ["1e5*x", -2e5] }]
boundary = [{ on = "outer", type = "displacement", value = ["0.3*x + 0.1*y", "-0.2*x"] }]
run = { t_end = 1 }
)toml" + rock;
    // 0.5 m int_1.25^2 (1e5 x (0.3 x + 0.1) + 2e5 0.2 x) dx
    const double work = 0.5 * 1e5 * (0.1 * (8 - 1.25 * 1.25 * 1.25) + 0.25 * (4 - 1.25 * 1.25));
    for (const Element element : every_element)
        for (const int refine : {0, 1})
            EXPECT_NEAR(solve_deck(deck, element, refine).solution.compliance, work, round_off * 1e5);
}

TEST(QuadraticTriangles, WeightOfAColumn_IsExactAtNodesAndBetween) {
    // nu = 0 in plane stress: u_y = b/E (H y - y^2/2); of taylor_hood the constants must be above zero: p2 alone
    const std::string deck = R"toml(
mesh = { generator = "rectangle", width = 1, height = 2, cells = [2, 3] }
solid = { plane = "stress" }
material = [{ density = 1000, constants = { E = 1e9, nu = 0 } }]
load = [{ type = "body_force", value = [0, -2e4] }]
boundary = [{ on = "bottom", type = "displacement", value = ["free", 0] }, { on = "left", type = "displacement", value = [0, "free"] }]
run = { t_end = 1 }
output = { probes = [{ name = "between", at = [0.37, 0.81] }] }
)toml";
    const auto exact = [](const Vector& x) { return Vector{0, -2e4 / 1e9 * (2 * x[1] - 0.5 * x[1] * x[1])}; };
    for (const int refine : {0, 1}) {
        const Solved solved = solve_deck(deck, Element::p2, refine);
        EXPECT_TRUE(solved.what.composites_are_cells);
        EXPECT_LE(difference(solved, exact), round_off);
        ASSERT_EQ(solved.what.probe_names, std::vector<std::string>{"between"});
        EXPECT_NEAR(solved.solution.displacement_at[0][1], exact({0.37, 0.81})[1], round_off * 4e-5);
        // stress at the centroids of the sub-triangles: linear in y
        const Mesh mesh = make_mesh(parse_deck(deck, "deck").mesh, false, {});
        const auto places = element_centroids(mesh);
        ASSERT_EQ(places.size(), solved.solution.stress_at.size());
        for (std::size_t t = 0; t < places.size(); ++t)
            ASSERT_NEAR(solved.solution.stress_at[t].cauchy[1], -2e4 * (2 - places[t][1]), round_off * 1e6);
    }
}

}  // namespace
}  // namespace gneiss::crosscheck
