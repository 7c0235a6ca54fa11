#include "mesh/make_mesh.hpp"

#include "mesh/generators.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

MeshOptions made_plate() {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    options.side = 4;
    options.radius = 1;
    options.size = {0.3, 0.6};
    return options;
}

TEST(MakeMesh, Cst_StandsOnTheNodesOfTheComposites) {
    const Mesh composites = make_mesh(made_plate(), true, "."), cst = make_mesh(made_plate(), false, ".");
    EXPECT_EQ(cst.kind, ElementKind::cst);
    EXPECT_EQ(cst.nodes, composites.nodes);
    EXPECT_EQ(cst.node_labels, composites.node_labels);
    EXPECT_EQ(cst.node_sets, composites.node_sets);
    ASSERT_EQ(cst.n_elements(), 4 * composites.n_elements());
    EXPECT_NEAR(total_area(cst), total_area(composites), round_off * 16);
}

TEST(MakeMesh, Cst_AreTheSubTrianglesInOrderCounterClockwise) {
    const Mesh composites = make_mesh(made_plate(), true, "."), cst = make_mesh(made_plate(), false, ".");
    EXPECT_GT(smallest_signed_area(cst), 0);
    for (std::size_t e = 0; e < composites.n_elements(); ++e)
        for (std::size_t s = 0; s < 4; ++s) {
            const auto [a, b, c] = triangle_nodes(composites, e, static_cast<int>(s));
            EXPECT_THAT((std::vector<int>(cst.element(4 * e + s), cst.element(4 * e + s) + 3)), ElementsAre(b, a, c));
            EXPECT_EQ(cst.element_labels[4 * e + s], composites.element_labels[e]);
            EXPECT_EQ(cst.region[4 * e + s], composites.region[e]);
        }
}

TEST(MakeMesh, Cst_BoundaryEdgesBelongToTheirSubTriangle) {
    const Mesh composites = make_mesh(made_plate(), true, "."), cst = make_mesh(made_plate(), false, ".");
    expect_sound_boundaries(cst);
    for (const auto& [name, edges] : composites.boundaries) {
        ASSERT_EQ(cst.boundaries.at(name).size(), edges.size());
        for (std::size_t i = 0; i < edges.size(); ++i) {
            EXPECT_EQ(cst.boundaries.at(name)[i].a, edges[i].a);
            EXPECT_EQ(cst.boundaries.at(name)[i].b, edges[i].b);
            EXPECT_EQ(cst.boundaries.at(name)[i].element / 4, edges[i].element);
        }
    }
}

TEST(MakeMesh, SplitData_IsRepeated) {
    Mesh composites = make_mesh(MeshOptions{}, true, ".");
    composites.element_data["angle"] = {0.25, 0.5};
    EXPECT_THAT(split_composites(composites).element_data.at("angle"),
                ElementsAre(0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 0.5));
}

TEST(MakeMesh, BadOptions_ThrowAllProblems) {
    MeshOptions options;
    options.width = -1;
    options.height = -2;
    EXPECT_EQ(input_error_of([&] { make_mesh(options, true, "."); }),
              "mesh: width = -1 must be a finite length > 0 m\nmesh: height = -2 must be a finite length > 0 m");
}

TEST(MakeMesh, InnerLine_HasNodesAndSides) {
    MeshOptions options;
    options.cells = {2, 1};
    MeshDraft draft = rectangle(options);
    // The column of nodes between the two cells, and on along the bottom.
    draft.lines["fault"] = {{1, MeshDraft::no_node, 4}, {0, MeshDraft::no_node, 1}};
    draft.lines["joint"] = {{1, MeshDraft::no_node, 4}};
    add_mid_sides(draft);
    MeshReport report;
    const Mesh mesh = finish(draft, true, report);
    EXPECT_EQ(mesh.node_sets.at("fault").size(), 5u);
    EXPECT_EQ(mesh.boundaries.at("fault").size(), 2u);
    EXPECT_EQ(mesh.node_sets.at("joint").size(), 3u);
    EXPECT_EQ(mesh.boundaries.count("joint"), 0u);
    EXPECT_EQ(mesh.inner_lines.at("fault").size(), 1u);
    EXPECT_EQ(mesh.inner_lines.at("joint").size(), 1u);
    EXPECT_EQ(mesh.inner_lines.count("bottom"), 0u);
    EXPECT_EQ(split_composites(mesh).inner_lines.at("joint").size(), 2u);
    EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("curve \"fault\" runs inside the solid in part:")));
}

TEST(MakeMesh, UserNameBoundary_IsKept) {
    MeshDraft draft = rectangle(MeshOptions{});
    draft.lines["boundary"] = draft.lines.at("left");
    MeshReport report;
    EXPECT_EQ(finish(draft, true, report).boundaries.at("boundary").size(), 2u);
}

TEST(MakeMesh, ClockwiseLines_AreTurned) {
    MeshDraft draft = rectangle(MeshOptions{});
    for (auto& [from, mid, to] : draft.lines.at("left")) std::swap(from, to);
    MeshReport report;
    const Mesh mesh = finish(draft, true, report);
    for (const BoundaryEdge& edge : mesh.boundaries.at("left")) EXPECT_EQ(normal(mesh, edge)[0], -1);
}

TEST(MakeMesh, AllElementsClockwise_AreTurned) {
    MeshDraft draft = rectangle(MeshOptions{});
    for (auto& element : draft.elements) std::reverse(element.begin() + 1, element.end());
    MeshReport report;
    const Mesh mesh = finish(draft, true, report);
    EXPECT_GT(smallest_signed_area(mesh), 0);
    EXPECT_NEAR(total_area(mesh), 1, round_off);
}

TEST(MakeMesh, MidSideThatFoldsASubTriangle_IsMovedToAStraightSide) {
    MeshDraft draft;
    for (const auto& [x, y] : std::vector<Point2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}) draft.add_node(x, y);
    draft.add_triangle(0, 1, 2);
    draft.add_triangle(0, 3, 2);  // clockwise
    draft.region_names = {"rock"};
    add_mid_sides(draft);
    draft.nodes[static_cast<std::size_t>(draft.elements[0][1])] = {0.5, 0.8};
    draft.nodes[static_cast<std::size_t>(draft.elements[1][1])] = {-0.1, 0.5};  // curved and sound
    MeshReport report;
    const Mesh mesh = finish(std::move(draft), true, report);
    EXPECT_GT(smallest_signed_area(mesh), 0);
    EXPECT_THAT(report.warnings,
                ElementsAre("sides made straight, since their mid-side nodes turned a sub-triangle inside "
                            "out: element 1"));
    EXPECT_THAT(mesh.nodes, ::testing::Contains(Point2{0.5, 0}));
    EXPECT_THAT(mesh.nodes, ::testing::Contains(Point2{-0.1, 0.5}));
}

}  // namespace
}  // namespace gneiss
