#include <algorithm>
#include <numbers>

#include "mesh/generators.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using std::numbers::pi;
using Layout = MeshOptions::Layout;

MeshOptions plate(Layout layout) {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    options.layout = layout;
    options.side = 8;
    options.radius = 1;
    options.size = {0.1, 0.5};
    return options;
}

class PlateWithHole : public ::testing::TestWithParam<Layout> {
protected:
    MeshReport report;
    MeshOptions options = plate(GetParam());
    Mesh mesh = make_mesh(options, true, ".", &report);
};

TEST_P(PlateWithHole, Hole_HasItsNodesOnTheCircle) {
    ASSERT_GE(mesh.node_sets.at("hole").size(), 60u);
    for (std::int32_t n : mesh.node_sets.at("hole"))
        EXPECT_NEAR(std::hypot(mesh.nodes[n][0], mesh.nodes[n][1]), 1, round_off);
    for (const BoundaryEdge& edge : mesh.boundaries.at("hole")) {
        const Point2 middle = midpoint(mesh.nodes[edge.a], mesh.nodes[edge.b]);
        const Point2 n = normal(mesh, edge);
        EXPECT_LT(n[0] * middle[0] + n[1] * middle[1], 0) << "out of the solid is into the hole";
    }
    expect_sound_boundaries(mesh);
}

TEST_P(PlateWithHole, StraightSides_CutTheCircle) {
    options.curved = false;
    const Mesh straight = make_mesh(options, true, ".");
    ASSERT_EQ(straight.n_nodes(), mesh.n_nodes());
    for (std::size_t e = 0; e < straight.n_elements(); ++e)
        for (const auto& [from, mid, to] : composite_sides) {
            const std::int32_t* nodes = straight.element(e);
            const Point2 middle = midpoint(straight.nodes[nodes[from]], straight.nodes[nodes[to]]);
            EXPECT_NEAR(distance(straight.nodes[nodes[mid]], middle), 0, round_off);
        }
    // Chords of edges twice as long: the hole of straight-sided composites is the smaller polygon.
    EXPECT_LT(length(straight, "hole"), length(mesh, "hole") - 1e-4);
}

TEST_P(PlateWithHole, Area_IsTheSquareLessTheInscribedPolygon) {
    double polygon = 0;
    for (const BoundaryEdge& edge : mesh.boundaries.at("hole"))
        polygon -= triangle_area({0, 0}, mesh.nodes[edge.a], mesh.nodes[edge.b]);
    EXPECT_NEAR(total_area(mesh), 64 - polygon, round_off * 64);
    // Inscribed polygon of sub-edges s: the area falls short of the circle by about pi s^2/6.
    EXPECT_NEAR(polygon, pi, 0.05 * 0.05);
    EXPECT_GT(smallest_signed_area(mesh), 0);
}

TEST_P(PlateWithHole, Outline_HasLengthsNormalsAndCorners) {
    for (const char* side : {"left", "right", "bottom", "top"}) EXPECT_NEAR(length(mesh, side), 8, round_off) << side;
    EXPECT_NEAR(length(mesh, "outer"), 32, round_off * 32);
    EXPECT_NEAR(length(mesh, "boundary"), 32 + length(mesh, "hole"), round_off * 32);
    for (const BoundaryEdge& edge : mesh.boundaries.at("right")) EXPECT_NEAR(normal(mesh, edge)[0], 1, round_off);
    for (const BoundaryEdge& edge : mesh.boundaries.at("top")) EXPECT_NEAR(normal(mesh, edge)[1], 1, round_off);
    const Point2 corner = mesh.nodes[mesh.node_sets.at("bottom_right").at(0)];
    EXPECT_NEAR(distance(corner, {4, -4}), 0, round_off);
    for (const char* name : {"bottom_left", "top_right", "top_left"}) EXPECT_EQ(mesh.node_sets.at(name).size(), 1u);
    EXPECT_THAT(report.warnings, ::testing::IsEmpty());
}

TEST_P(PlateWithHole, Edges_GrowFromHoleToOutline) {
    // Composite edges are two sub-edges. The division rounds to whole numbers; Gmsh keeps sizes on the average only.
    constexpr double spread = 1.6;
    const auto longest_sub_edge = [&](const std::string& name) {
        double longest = 0;
        for (const BoundaryEdge& edge : mesh.boundaries.at(name)) longest = std::max(longest, length(mesh, edge));
        return longest;
    };
    EXPECT_LT(longest_sub_edge("hole"), spread * 0.05);
    EXPECT_LT(longest_sub_edge("outer"), spread * 0.25);
    const MeshSize size = mesh_size(mesh);
    EXPECT_GT(size.smallest_edge, 0.05 / 2);
    EXPECT_LT(size.largest_edge, GetParam() == Layout::structured ? 0.5 : spread * 0.25);
}

INSTANTIATE_TEST_SUITE_P(Layouts, PlateWithHole, ::testing::Values(Layout::free, Layout::structured));

/// Part of the nodes within 0.45 sides of the centre that a rotation about it brings onto a node.
double self_image(const Mesh& mesh, double angle) {
    constexpr double same_place = 1e-3;  // a hundredth of the smallest edge
    const auto by_x = [](const Point2& p, const Point2& q) { return p[0] < q[0]; };
    std::vector<Point2> nodes = mesh.nodes;
    std::sort(nodes.begin(), nodes.end(), by_x);
    std::size_t n_inside = 0, n_mapped = 0;
    for (const Point2& x : nodes) {
        if (std::hypot(x[0], x[1]) > 0.45 * 8) continue;
        ++n_inside;
        const Point2 turned{std::cos(angle) * x[0] - std::sin(angle) * x[1],
                            std::sin(angle) * x[0] + std::cos(angle) * x[1]};
        const auto begin = std::lower_bound(nodes.begin(), nodes.end(), Point2{turned[0] - same_place, 0}, by_x);
        const auto end = std::upper_bound(begin, nodes.end(), Point2{turned[0] + same_place, 0}, by_x);
        n_mapped += std::any_of(begin, end, [&](const Point2& y) { return distance(turned, y) < same_place; });
    }
    return static_cast<double>(n_mapped) / static_cast<double>(n_inside);
}

TEST(PlateWithHoleLayout, Free_HasNoSymmetryUnder45And90Degrees) {
    // Discs of 1e-3 around 4000 nodes cover 0.04 % of the area; chance brings a node onto another no more often than 1
    // %.
    constexpr double chance = 0.01;
    for (int seed : {0, 1, -7}) {
        MeshOptions options = plate(Layout::free);
        options.seed = seed;
        const Mesh mesh = make_mesh(options, true, ".");
        EXPECT_LT(self_image(mesh, pi / 4), chance) << seed;
        EXPECT_LT(self_image(mesh, pi / 2), chance) << seed;
    }
}

TEST(PlateWithHoleLayout, Structured_HasTheSymmetryOfTheSquare) {
    EXPECT_EQ(self_image(make_mesh(plate(Layout::structured), true, "."), pi / 2), 1);
}

TEST(PlateWithHoleLayout, Free_DependsOnTheSeedAlone) {
    MeshOptions options = plate(Layout::free);
    const Mesh first = make_mesh(options, true, "."), again = make_mesh(options, true, ".");
    EXPECT_EQ(first.nodes, again.nodes);
    EXPECT_EQ(first.connectivity, again.connectivity);
    options.seed = 1;
    EXPECT_NE(make_mesh(options, true, ".").nodes, first.nodes);
}

TEST(PlateWithHoleLayout, Structured_DividesAsTheSizesAsk) {
    MeshOptions options = plate(Layout::structured);
    const PlateDivision division = plate_division(options);
    EXPECT_EQ(division.around, 64);  // 2 pi/0.1 = 62.8 at the hole, 32/0.5 = 64 at the outline
    EXPECT_EQ(division.rings, 13);   // 3/0.4 ln 5 = 12.07
    options.size = {0.25, 0.25};
    EXPECT_EQ(plate_division(options).around, 128);
    EXPECT_EQ(plate_division(options).rings, 12);
    EXPECT_EQ(make_mesh(options, true, ".").n_elements(), 2u * 128 * 12);
}

TEST(PlateWithHoleLayout, Structured_RingsGrowGeometrically) {
    const Mesh mesh = make_mesh(plate(Layout::structured), true, ".");
    std::vector<double> x;  // of the nodes on the axis to the right: corners and mid-sides in turn
    for (const Point2& node : mesh.nodes)
        if (node[0] > 0 && std::abs(node[1]) < round_off) x.push_back(node[0]);
    std::sort(x.begin(), x.end());
    ASSERT_EQ(x.size(), 2u * 13 + 1);
    // 13 edges in the ratio q fill 3 m while the local size grows from 0.1 to 0.5 m: q^13 = 5, first (q^13 - 1)/(q - 1)
    // = 3.
    const double growth = std::pow(5, 1.0 / 13);
    EXPECT_NEAR(x[2] - x[0], 3 * (growth - 1) / 4, round_off);
    for (std::size_t i = 4; i < x.size(); i += 2)
        EXPECT_NEAR((x[i] - x[i - 2]) / (x[i - 2] - x[i - 4]), growth, round_off * 100);
}

TEST(PlateWithHoleLayout, CoarseHole_StaysSound) {
    for (Layout layout : {Layout::free, Layout::structured}) {
        MeshOptions options = plate(layout);
        options.size = {2, 4};
        const Mesh mesh = make_mesh(options, true, ".");
        EXPECT_GT(smallest_signed_area(mesh), 0);
    }
}

}  // namespace
}  // namespace gneiss
