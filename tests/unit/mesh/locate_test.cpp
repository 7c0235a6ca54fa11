#include "mesh/locate.hpp"

#include <numbers>

#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using ::testing::HasSubstr;

Point2 position(const Mesh& mesh, const MeshPoint& point) {
    Point2 x{0, 0};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 2; ++k) x[k] += point.weights[i] * mesh.nodes[point.nodes[i]][k];
    return x;
}

MeshOptions located_plate() {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    options.side = 6;
    options.radius = 1;
    options.size = {0.3, 0.6};
    return options;
}

class Locate : public ::testing::TestWithParam<bool> {
protected:
    Mesh mesh = make_mesh(located_plate(), GetParam(), ".");

    void expect_sound(const MeshPoint& point) const {
        EXPECT_EQ(point.nodes, triangle_nodes(mesh, static_cast<std::size_t>(point.element), point.sub_triangle));
        double sum = 0;
        for (double weight : point.weights) {
            EXPECT_GE(weight, 0);
            EXPECT_LE(weight, 1 + round_off);
            sum += weight;
        }
        EXPECT_NEAR(sum, 1, round_off);
    }
};

TEST_P(Locate, PointInside_IsTheMeanOfItsNodes) {
    for (const Point2& x : {Point2{1.7, 0.3}, {-2.9, 2.1}, {0.1, -1.5}, {2.0, -2.0}}) {
        const MeshPoint point = locate(mesh, x);
        expect_sound(point);
        EXPECT_NEAR(distance(position(mesh, point), x), 0, round_off);
    }
}

TEST_P(Locate, Node_HasAllTheWeight) {
    for (std::size_t n = 0; n < mesh.n_nodes(); n += 17) {
        const MeshPoint point = locate(mesh, mesh.nodes[n]);
        expect_sound(point);
        EXPECT_NEAR(distance(position(mesh, point), mesh.nodes[n]), 0, round_off);
        EXPECT_NEAR(*std::max_element(point.weights.begin(), point.weights.end()), 1, round_off);
    }
}

TEST_P(Locate, PointJustInTheHole_MovesOntoTheSolid) {
    // Chords of 0.15 m cut 0.003 m into the hole; these points lie beyond all of them.
    for (int i = 0; i < 24; ++i) {
        const double angle = std::numbers::pi * i / 12 + 0.05, r = 1 - 0.005;
        const Point2 x{r * std::cos(angle), r * std::sin(angle)};
        const MeshPoint point = locate(mesh, x);
        expect_sound(point);
        EXPECT_LT(distance(position(mesh, point), x), 0.006);
    }
}

TEST_P(Locate, OuterCornerWithinReach_IsTheCorner) {
    const MeshPoint point = locate(mesh, {3.01, 3.01});
    expect_sound(point);
    EXPECT_NEAR(distance(position(mesh, point), {3, 3}), 0, round_off);
}

TEST_P(Locate, PointOutside_IsRefusedWithItsDistance) {
    EXPECT_THAT(input_error_of([&] {
                    locate(mesh, {4, 0});
                }),
                HasSubstr("the point (4, 0) m lies 1 m outside the solid"));
    EXPECT_THAT(input_error_of([&] { locate(mesh, {0, 0}); }), HasSubstr("outside the solid"));
    EXPECT_THAT(input_error_of([&] { locate(mesh, {std::nan(""), 0}); }), HasSubstr("outside the solid"));
}

TEST_P(Locate, SharedEdge_GoesToTheFirstElement) {
    const BoundaryEdge& edge = mesh.boundaries.at("right").front();
    const MeshPoint point = locate(mesh, midpoint(mesh.nodes[edge.a], mesh.nodes[edge.b]));
    EXPECT_EQ(point.element, edge.element);
    const std::int32_t inner = mesh.element(mesh.n_elements() - 1)[0];
    const MeshPoint at_node = locate(mesh, mesh.nodes[inner]);
    std::size_t first = 0;
    while (std::count(mesh.element(first), mesh.element(first) + mesh.nodes_per_element(), inner) == 0) ++first;
    EXPECT_EQ(static_cast<std::size_t>(at_node.element), first);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Locate, ::testing::Bool(),
                         [](const auto& suite) { return suite.param ? "compt" : "cst"; });

}  // namespace
}  // namespace gneiss
