// What a deck becomes, and what is refused.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "base/errors.hpp"
#include "crosscheck/crosscheck_testing.hpp"
#include "crosscheck/refined_mesh.hpp"
#include "mesh/geometry.hpp"
#include "mesh/make_mesh.hpp"
#include "mesh/measure.hpp"

namespace gneiss::crosscheck {
namespace {

using test::rock;
using test::solve_deck;
using testing::HasSubstr;

std::string message_of(const std::string& deck, Element element) {
    try {
        elastic_case(parse_deck(deck, "deck"), element, 0);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Case, LoadThatEndsAtAMidSide_HasHalvesOfSides) {
    const std::string deck = R"toml(
mesh = { generator = "rectangle", width = 1, height = 1, cells = [2, 2], parts = [{ name = "part", of = "top", from = [0.25, 1], to = [1, 1] }] }
solid = { plane = "strain" }
run = { t_end = 1 }
load = [{ on = "part", type = "traction", value = [8, -4] }]
)toml" + rock;
    for (const Element element : {Element::p1, Element::p2})
        for (const int refine : {0, 1}) {
            const Elasticity problem = elastic_case(parse_deck(deck, "deck"), element, refine).problem;
            ASSERT_EQ(problem.tractions.size(), 1u);
            double length = 0;
            for (const auto& [a, b] : problem.tractions[0].sides)
                length +=
                    distance(problem.nodes[static_cast<std::size_t>(a)], problem.nodes[static_cast<std::size_t>(b)]);
            EXPECT_DOUBLE_EQ(element == Element::p1 ? length : 0.5 * length, 0.75);
        }
}

TEST(Case, WhatIsNoLinearElasticity_IsRefused_AllAtOnce) {
    const std::string message = message_of(R"toml(
mesh = { generator = "rectangle", width = 1, height = 1, cells = [1, 1] }
solid = { plane = "strain" }
initial = [{ velocity = [1, 0] }]
load = [{ on = "nowhere", type = "traction", value = [1, 0] }]
run = { t_end = 1 }
output = { probes = [{ name = "far", at = [7, 7] }] }
[[material]]
form = "hypo"
density = 1000
constants = { E = 1e9, nu = 0.25 }
viscosity = { shear = 1 }
stiffening = { k = 1, p_ref = 1e6, n = 0.5 }
in_situ_stress = [1e5, 0, 0]
[[boundary]]
on = "left"
type = "velocity"
value = [1, 0]
[[boundary]]
on = "right"
type = "absorbing"
)toml",
                                           Element::p2);
    for (const char* part :
         {"[[material]] 1: viscosity", "[[material]] 1: stiffening", "[[material]] 1: in_situ_stress",
          "[[boundary]] 1: type = \"velocity\"", "[[boundary]] 2: type = \"absorbing\"", "[[initial]]", "[[load]] 1",
          "nowhere", "output.probes `far`"})
        EXPECT_THAT(message, HasSubstr(part));
}

const std::string square =
    "mesh = { generator = \"rectangle\", width = 1, height = 1, cells = [2, 2] }\n"
    "solid = { plane = \"strain\" }\nrun = { t_end = 1 }\n";

TEST(Case, OtherLaws_AreRefused) {
    const std::string neo_hookean =
        "material = [{ law = \"neo_hookean\", density = 1000, constants = { E = 1e9, nu = 0.3 } }]\n";
    EXPECT_THAT(message_of(square + neo_hookean, Element::p1), HasSubstr("[[material]] 1: law: only munjiza"));
}

TEST(Case, TaylorHoodWithoutStiffnessOfVolumeOrEdges_IsRefused_OthersTakeIt) {
    for (const char* constants :
         {"E = 1e9, nu = 0", "M_v = 3e9, M_alpha = -0.1e9, M_beta = 2e9, M_psi = 1e9", "E = 1e9, nu = -0.2"}) {
        const std::string deck =
            square + fmt::format("material = [{{ density = 1, constants = {{ {} }} }}]\n", constants);
        EXPECT_THAT(message_of(deck, Element::taylor_hood), HasSubstr("needs all four Munjiza constants > 0"));
        EXPECT_EQ(message_of(deck, Element::p2), "");
    }
}

TEST(Case, TooFewSupports_ComputationFails_AndAsksForThem) {
    for (const Element element : test::every_element) try {
            solve_deck(
                square + rock + "boundary = [{ on = \"left\", type = \"displacement\", value = [0, \"free\"] }]\n",
                element);
            ADD_FAILURE();
        } catch (const RecoverableError& error) {
            EXPECT_THAT(error.what(), HasSubstr("enough supports?"));
        }
}

TEST(Case, LoadsAndSupports_AreThoseOfTheEnd_JumpsThereHaveNotHappened) {
    const std::string deck = square + rock + R"toml(
load = [
  { on = "top_right", type = "nodal_force", value = [2, 0], amplitude = { type = "ramp", end = 4 } },
  { on = "top_left", type = "nodal_force", value = [2, 0], amplitude = { type = "heaviside", start = 1 } },
  { on = "top_left", type = "nodal_force", value = [0, 3], amplitude = { type = "heaviside", start = 0.9 } } ]
boundary = [{ on = "bottom", type = "displacement", value = ["x", "free"], amplitude = { type = "ramp", end = 2 } }]
)toml";
    for (const int refine : {0, 2}) {
        const Elasticity problem = elastic_case(parse_deck(deck, "deck"), Element::p2, refine).problem;
        Vector sum{0, 0};
        for (const NodalForce& load : problem.nodal_forces)
            for (std::size_t i = 0; i < 2; ++i) sum[i] += load.force[i];
        EXPECT_EQ(sum, (Vector{0.5, 3}));
        EXPECT_EQ(problem.prescribed.size(), 4u * (1u << refine) + 1);  // every node of the bottom
        for (const Prescribed& p : problem.prescribed) EXPECT_EQ(p.value, 0.5 * problem.nodes[p.dof / 2][0]);
    }
}

TEST(Case, StressPlaces_AreTheCentroidsOfTheDecksSubTriangles) {
    for (const bool curved : {false, true}) {
        const std::string deck = fmt::format(
            "mesh = {{ generator = \"plate_with_hole\", side = 4, radius = 1, size = [0.5, 1], curved = {} }}\n"
            "solid = {{ plane = \"strain\" }}\nrun = {{ t_end = 1 }}\n{}",
            curved, rock);
        const auto expected = element_centroids(make_mesh(parse_deck(deck, "deck").mesh, false, {}));
        for (const Element element : test::every_element)
            for (const int refine : {0, 1, 2}) {
                const ElasticCase what = elastic_case(parse_deck(deck, "deck"), element, refine);
                EXPECT_EQ(what.composites_are_cells, element != Element::p1 && !curved);
                const Elasticity& problem = what.problem;
                ASSERT_EQ(problem.stress_at.size(), expected.size());
                const std::size_t stride = problem.nodes_per_cell();
                for (std::size_t t = 0; t < expected.size(); ++t) {
                    const Place& place = problem.stress_at[t];
                    const auto corner = [&](std::size_t k) {
                        const std::size_t at = stride * static_cast<std::size_t>(place.cell) + k * (stride / 3);
                        return problem.nodes[static_cast<std::size_t>(problem.cells[at])];
                    };
                    for (std::size_t i = 0; i < 2; ++i)
                        ASSERT_NEAR((1 - place.unit[0] - place.unit[1]) * corner(0)[i] + place.unit[0] * corner(1)[i] +
                                        place.unit[1] * corner(2)[i],
                                    expected[t][i], 1e-14 * 4);
                }
            }
    }
}

TEST(RefinedMesh, Plate_KeepsNodesAreaNamesAndContour) {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    options.side = 4;
    options.radius = 1;
    options.size = {0.5, 1};
    const Mesh coarse = make_mesh(options, true, {}), fine = refined(coarse);
    EXPECT_EQ(fine.n_elements(), 4 * coarse.n_elements());
    EXPECT_TRUE(std::equal(coarse.nodes.begin(), coarse.nodes.end(), fine.nodes.begin()));
    EXPECT_NEAR(mesh_size(fine).area, mesh_size(coarse).area, 1e-13 * 16);
    // one new node on every edge of the sub-triangles: of 3 per sub-triangle the inner ones count for two
    EXPECT_EQ(2 * (fine.n_nodes() - coarse.n_nodes()),
              12 * coarse.n_elements() + coarse.boundaries.at("boundary").size());
    for (std::size_t e = 0; e < fine.n_elements(); ++e) EXPECT_TRUE(has_straight_sides(fine, e));
    for (const auto& [name, edges] : coarse.boundaries) {
        const auto& halves = fine.boundaries.at(name);
        EXPECT_EQ(halves.size(), 2 * edges.size()) << name;
        EXPECT_EQ(fine.node_sets.at(name).size(), coarse.node_sets.at(name).size() + edges.size()) << name;
        for (const BoundaryEdge& edge : halves) {  // the solid on the left: nodes of their element, in its sense
            const std::int32_t* nodes = fine.element(static_cast<std::size_t>(edge.element));
            const auto a = std::find(nodes, nodes + 6, edge.a) - nodes;
            ASSERT_LT(a, 6);
            EXPECT_EQ(nodes[(a + 1) % 6], edge.b);
        }
    }
    EXPECT_EQ(fine.node_sets.at("top_right"), coarse.node_sets.at("top_right"));
}

}  // namespace
}  // namespace gneiss::crosscheck
