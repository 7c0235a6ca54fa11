#include "mesh/measure.hpp"

#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;

TEST(Measure, BentComposite_SumsItsSubTriangles) {
    Mesh mesh;
    mesh.nodes = {{0, 0}, {1, -0.5}, {2, 0}, {1, 1}, {0, 2}, {0, 1}};
    mesh.connectivity = {0, 1, 2, 3, 4, 5};
    // The straight triangle of area 2 and centroid (2/3, 2/3), and below it one of area 1/2 at (1, -1/6).
    EXPECT_DOUBLE_EQ(element_areas(mesh).at(0), 2.5);
    EXPECT_NEAR(element_centroids(mesh).at(0)[0], (2 * 2.0 / 3 + 0.5) / 2.5, round_off);
    EXPECT_NEAR(element_centroids(mesh).at(0)[1], (2 * 2.0 / 3 - 0.5 / 6) / 2.5, round_off);
}

TEST(Measure, Cst_HasItsOwnCentroidAndArea) {
    Mesh mesh;
    mesh.kind = ElementKind::cst;
    mesh.nodes = {{0, 0}, {3, 0}, {0, 3}};
    mesh.connectivity = {0, 1, 2};
    EXPECT_DOUBLE_EQ(element_areas(mesh).at(0), 4.5);
    EXPECT_NEAR(element_centroids(mesh).at(0)[0], 1, round_off);
    EXPECT_NEAR(element_centroids(mesh).at(0)[1], 1, round_off);
}

TEST(LargestCoordinate, OfAnySign) {
    Mesh mesh;
    mesh.nodes = {{1, -2}, {-3, 0.5}};
    EXPECT_EQ(largest_coordinate(mesh), 3);
}

TEST(MeshSize, Rectangle_CountsAndMeasuresSubEdges) {
    MeshOptions options;
    options.width = 4;
    options.height = 3;
    for (bool compt : {true, false}) {
        const MeshSize size = mesh_size(make_mesh(options, compt, "."));
        EXPECT_EQ(size.n_nodes, 9u);
        EXPECT_EQ(size.n_elements, compt ? 2u : 8u);
        EXPECT_DOUBLE_EQ(size.smallest_edge, 1.5);
        EXPECT_DOUBLE_EQ(size.largest_edge, 2.5);
        EXPECT_DOUBLE_EQ(size.area, 12);
    }
}

}  // namespace
}  // namespace gneiss
