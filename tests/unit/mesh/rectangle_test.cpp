#include <map>

#include "mesh/generators.hpp"
#include "mesh/locate.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using Pattern = MeshOptions::Pattern;

MeshOptions three_by_two(Pattern pattern) {
    MeshOptions options;
    options.width = 3;
    options.height = 1;
    options.origin = {-1, 2};
    options.cells = {3, 2};
    options.pattern = pattern;
    return options;
}

class Rectangle : public ::testing::TestWithParam<Pattern> {
protected:
    MeshReport report;
    Mesh mesh = make_mesh(three_by_two(GetParam()), true, ".", &report);
    bool crossed() const { return GetParam() == Pattern::crossed; }
};

TEST_P(Rectangle, Counts_FollowFromTheCells) {
    EXPECT_EQ(mesh.kind, ElementKind::compt);
    EXPECT_EQ(mesh.n_elements(), crossed() ? 24u : 12u);
    // Corners and mid-sides: Euler, nodes = vertices + edges.
    const std::size_t vertices = crossed() ? 12 + 6 : 12;
    const std::size_t edges = 9 + 8 + (crossed() ? 4 * 6 : 6);
    EXPECT_EQ(mesh.n_nodes(), vertices + edges);
    EXPECT_EQ(mesh.region, std::vector<std::int32_t>(mesh.n_elements(), 0));
    EXPECT_THAT(mesh.region_names, ::testing::ElementsAre("solid"));
    EXPECT_THAT(report.warnings, ::testing::IsEmpty());
}

TEST_P(Rectangle, Areas_FillIt) {
    EXPECT_NEAR(total_area(mesh), 3, round_off);
    const double composite = 3.0 / static_cast<double>(mesh.n_elements());
    EXPECT_NEAR(smallest_signed_area(mesh), composite / 4, round_off);
    for (double area : element_areas(mesh)) EXPECT_NEAR(area, composite, round_off);
}

TEST_P(Rectangle, Boundaries_HaveLengthsAndOutwardNormals) {
    const std::map<std::string, std::pair<double, Point2>> sides{
        {"left", {1, {-1, 0}}}, {"right", {1, {1, 0}}}, {"bottom", {3, {0, -1}}}, {"top", {3, {0, 1}}}};
    for (const auto& [name, expected] : sides) {
        EXPECT_NEAR(length(mesh, name), expected.first, round_off) << name;
        for (const BoundaryEdge& edge : mesh.boundaries.at(name))
            for (int i : {0, 1}) EXPECT_NEAR(normal(mesh, edge)[i], expected.second[i], round_off) << name;
        EXPECT_EQ(mesh.node_sets.at(name).size(), mesh.boundaries.at(name).size() + 1) << name;
    }
    EXPECT_NEAR(length(mesh, "outer"), 8, round_off);
    EXPECT_NEAR(length(mesh, "boundary"), 8, round_off);
    EXPECT_EQ(mesh.node_sets.at("outer"), mesh.node_sets.at("boundary"));
    expect_sound_boundaries(mesh);
}

TEST_P(Rectangle, Boundaries_ChainInWalkingOrder) {
    for (const auto& [name, edges] : mesh.boundaries)
        for (std::size_t i = 1; i < edges.size(); ++i) EXPECT_EQ(edges[i - 1].b, edges[i].a) << name << " " << i;
}

TEST_P(Rectangle, CornerPoints_AreWhereTheirNamesSay) {
    const std::map<std::string, Point2> corners{
        {"bottom_left", {-1, 2}}, {"bottom_right", {2, 2}}, {"top_right", {2, 3}}, {"top_left", {-1, 3}}};
    for (const auto& [name, x] : corners) {
        ASSERT_EQ(mesh.node_sets.at(name).size(), 1u);
        EXPECT_EQ(mesh.nodes[mesh.node_sets.at(name)[0]], x) << name;
    }
}

TEST_P(Rectangle, Labels_NumberFromOne) {
    std::vector<std::int64_t> nodes = mesh.node_labels, elements = mesh.element_labels;
    std::sort(nodes.begin(), nodes.end());
    std::sort(elements.begin(), elements.end());
    for (std::size_t n = 0; n < nodes.size(); ++n) EXPECT_EQ(nodes[n], static_cast<std::int64_t>(n + 1));
    for (std::size_t e = 0; e < elements.size(); ++e) EXPECT_EQ(elements[e], static_cast<std::int64_t>(e + 1));
}

/// Whether the middle of cell (i, j) lies on an edge between composites that rises to the right there: the nodes on it.
bool diagonal_rises(const Mesh& mesh, int i, int j) {
    // A quarter of the way up the rising diagonal lies inside a composite unless it is an edge.
    const Point2 quarter{-1 + i + 0.25 + 1e-3, 2 + 0.5 * (j + 0.25 - 1e-3)},
        other{-1 + i + 0.25 - 1e-3, 2 + 0.5 * (j + 0.25 + 1e-3)};
    return locate(mesh, quarter).element != locate(mesh, other).element;
}

TEST_P(Rectangle, Diagonals_FollowThePattern) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 2; ++j) {
            const bool rises = diagonal_rises(mesh, i, j);
            switch (GetParam()) {
                case Pattern::uniform_right:
                case Pattern::crossed:
                    EXPECT_TRUE(rises);
                    break;
                case Pattern::uniform_left:
                    EXPECT_FALSE(rises);
                    break;
                case Pattern::alternating:
                    EXPECT_EQ(rises, (i + j) % 2 == 0);
                    break;
            }
        }
}

TEST_P(Rectangle, QuadrilateralOfTheSameCorners_IsTheSameMesh) {
    MeshOptions options = three_by_two(GetParam());
    options.source = MeshOptions::Source::quadrilateral;
    options.corners = {{{-1, 2}, {2, 2}, {2, 3}, {-1, 3}}};
    const Mesh other = make_mesh(options, true, ".");
    EXPECT_EQ(other.connectivity, mesh.connectivity);
    EXPECT_EQ(other.node_sets, mesh.node_sets);
    for (std::size_t n = 0; n < mesh.n_nodes(); ++n)
        for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(other.nodes[n][i], mesh.nodes[n][i], round_off);
}

TEST_P(Rectangle, CooksTrapezoid_HasItsCornersSidesAndArea) {
    MeshOptions options;
    options.source = MeshOptions::Source::quadrilateral;
    options.corners = {{{0, 0}, {48, 44}, {48, 60}, {0, 44}}};
    options.cells = {4, 6};
    options.pattern = GetParam();
    const Mesh cook = make_mesh(options, true, ".");
    EXPECT_NEAR(total_area(cook), 48 * (44 + 16) / 2.0, round_off * 1440);
    EXPECT_GT(smallest_signed_area(cook), 0);
    for (std::size_t e = 0; e < cook.n_elements(); ++e) EXPECT_TRUE(has_straight_sides(cook, e));
    EXPECT_NEAR(length(cook, "left"), 44, round_off * 44);
    EXPECT_NEAR(length(cook, "right"), 16, round_off * 44);
    EXPECT_NEAR(length(cook, "bottom"), std::hypot(48, 44), round_off * 66);
    EXPECT_NEAR(length(cook, "top"), std::hypot(48, 16), round_off * 66);
    for (const auto& [name, corner] : {std::pair("bottom_left", 0), std::pair("bottom_right", 1),
                                       std::pair("top_right", 2), std::pair("top_left", 3)})
        EXPECT_EQ(cook.nodes[static_cast<std::size_t>(cook.node_sets.at(name)[0])],
                  options.corners[static_cast<std::size_t>(corner)]);
    expect_sound_boundaries(cook);
}

INSTANTIATE_TEST_SUITE_P(Patterns, Rectangle,
                         ::testing::Values(Pattern::uniform_right, Pattern::uniform_left, Pattern::alternating,
                                           Pattern::crossed));

}  // namespace
}  // namespace gneiss
