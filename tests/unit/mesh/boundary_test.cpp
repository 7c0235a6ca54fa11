#include "mesh/boundary.hpp"

#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {

static bool operator==(const BoundaryEdge& p, const BoundaryEdge& q) {
    return p.a == q.a && p.b == q.b && p.element == q.element;
}

namespace {

using namespace gneiss::testing;
using ::testing::ElementsAre;

std::vector<std::int32_t> first_nodes(const std::vector<BoundaryEdge>& edges) {
    std::vector<std::int32_t> nodes;
    for (const BoundaryEdge& edge : edges) nodes.push_back(edge.a);
    return nodes;
}

TEST(WalkingOrder, OpenChain_StartsWhereNothingArrives) {
    EXPECT_THAT(first_nodes(in_walking_order({{1, 2, 0}, {7, 1, 0}, {2, 5, 0}})), ElementsAre(7, 1, 2));
}

TEST(WalkingOrder, ClosedChain_StartsAtItsLowestNode) {
    EXPECT_THAT(first_nodes(in_walking_order({{9, 3, 0}, {3, 4, 0}, {4, 9, 0}})), ElementsAre(3, 4, 9));
}

TEST(WalkingOrder, SeveralChains_FollowEachOther) {
    EXPECT_THAT(first_nodes(in_walking_order({{5, 6, 0}, {0, 1, 0}, {6, 5, 0}, {1, 2, 0}})), ElementsAre(0, 1, 5, 6));
}

TEST(WalkingOrder, ContourThatTouchesItself_KeepsEveryEdge) {
    // Two loops through node 0.
    const std::vector<BoundaryEdge> edges{{0, 1, 0}, {1, 2, 0}, {2, 0, 0}, {0, 3, 1}, {3, 4, 1}, {4, 0, 1}};
    const std::vector<BoundaryEdge> ordered = in_walking_order(edges);
    EXPECT_TRUE(std::is_permutation(ordered.begin(), ordered.end(), edges.begin(), edges.end()));
    for (std::size_t i = 1; i < ordered.size(); ++i) EXPECT_EQ(ordered[i - 1].b, ordered[i].a);
}

TEST(Contour, OneComposite_IsItsSixSubEdges) {
    Mesh mesh;
    mesh.nodes = {{0, 0}, {1, 0}, {2, 0}, {1, 1}, {0, 2}, {0, 1}};
    mesh.connectivity = {0, 1, 2, 3, 4, 5};
    EXPECT_THAT(first_nodes(contour(mesh)), ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(nodes_of(contour(mesh)), ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(Contour, CstAndComposites_AreTheSame) {
    MeshOptions options;
    options.cells = {4, 3};
    const std::vector<BoundaryEdge> composites = contour(make_mesh(options, true, "."));
    const std::vector<BoundaryEdge> cst = contour(make_mesh(options, false, "."));
    EXPECT_EQ(composites.size(), 28u);
    EXPECT_EQ(first_nodes(cst), first_nodes(composites));
}

}  // namespace
}  // namespace gneiss
