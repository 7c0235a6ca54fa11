#include "mesh/check.hpp"

#include <limits>

#include "mesh/generators.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Found {
    std::vector<std::string> errors, warnings;
};

Found found_in(MeshDraft draft) {
    add_mid_sides(draft);
    draft.where = "bad.msh";
    Found found;
    for (const Problem& problem : check(draft, found.warnings)) {
        EXPECT_EQ(problem.where, "bad.msh");
        found.errors.push_back(problem.message);
    }
    return found;
}

/// A draft of three-noded triangles; labels are 101, 102, … for nodes and 1001, 1002, … for elements.
MeshDraft triangles(std::vector<std::array<double, 2>> nodes, const std::vector<std::array<int, 3>>& corners) {
    MeshDraft draft;
    draft.region_names = {"solid"};
    for (const auto& [x, y] : nodes) draft.add_node(x, y);
    for (const auto& [a, b, c] : corners) draft.add_triangle(a, b, c);
    for (std::int64_t& label : draft.node_labels) label += 100;
    for (std::int64_t& label : draft.element_labels) label += 1000;
    return draft;
}

const std::vector<std::array<double, 2>> unit_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(Check, SoundMesh_HasNothingToSay) {
    const Found found = found_in(triangles(unit_square, {{0, 1, 2}, {0, 2, 3}}));
    EXPECT_THAT(found.errors, IsEmpty());
    EXPECT_THAT(found.warnings, IsEmpty());
}

TEST(Check, Nothing_IsAnError) { EXPECT_THAT(found_in({}).errors, ElementsAre("no triangles: the mesh is empty")); }

TEST(Check, ZeroArea_IsReportedByLabel) {
    auto nodes = unit_square;
    nodes.push_back({0.5, 0});
    EXPECT_THAT(found_in(triangles(nodes, {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}})).errors,
                ElementsAre("zero area, of the whole or of one of its four sub-triangles: element 1003"));
}

TEST(Check, ZeroAreaFarFromTheOrigin_IsSeenThroughRoundOff) {
    auto nodes = unit_square;
    nodes.push_back({0.3, 0.3 + 1e-10});
    for (auto& [x, y] : nodes) {
        x += 1e5;
        y += 1e5;
    }
    EXPECT_THAT(found_in(triangles(nodes, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}})).errors,
                ::testing::Contains("zero area, of the whole or of one of its four sub-triangles: element 1003"));
}

TEST(Check, NodeUsedTwice_IsReportedByLabel) {
    EXPECT_THAT(found_in(triangles(unit_square, {{0, 1, 2}, {0, 2, 2}})).errors,
                ::testing::Contains("a node used twice: element 1002"));
}

TEST(Check, MidSideThatFoldsASubTriangle_IsReportedByLabel) {
    MeshDraft draft = triangles(unit_square, {{0, 1, 2}, {0, 2, 3}});
    add_mid_sides(draft);
    draft.nodes[draft.elements[0][1]] = {0.5, 0.8};
    EXPECT_THAT(found_in(draft).errors,
                ElementsAre("folded, a mid-side node turns a sub-triangle inside out: element 1001"));
}

TEST(Check, Duplicates_AreReportedByLabel) {
    EXPECT_THAT(found_in(triangles(unit_square, {{0, 1, 2}, {0, 2, 3}, {1, 2, 0}})).errors,
                ElementsAre("duplicated, on the same three corners: elements 1001 and 1003",
                            "more than two at one side: elements 1001, 1002 and 1003",
                            "overlapping, two on the same side of their common edge: elements 1001 and 1003"));
}

TEST(Check, ThreeElementsAtOneEdge_AreReportedByLabel) {
    auto nodes = unit_square;
    nodes.push_back({-1, 2});
    EXPECT_THAT(found_in(triangles(nodes, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}})).errors,
                ElementsAre("more than two at one side: elements 1001, 1002 and 1003"));
}

TEST(Check, OverlappingNeighbours_AreReportedByLabel) {
    auto nodes = unit_square;
    nodes.push_back({0.2, 1.5});
    EXPECT_THAT(found_in(triangles(nodes, {{0, 1, 2}, {0, 1, 4}})).errors,
                ElementsAre("overlapping, two on the same side of their common edge: elements 1001 and 1002"));
}

TEST(Check, NeighboursWithDifferentMidSides_AreReportedByLabel) {
    MeshDraft draft = triangles(unit_square, {{0, 1, 2}, {0, 2, 3}});
    add_mid_sides(draft);
    draft.elements[1][1] = draft.add_node(0.5, 0.5);
    const Found found = found_in(draft);
    EXPECT_THAT(found.errors,
                ElementsAre("the corners of a side shared with a neighbour, but not the mid-side node between "
                            "them: elements 1001 and 1002"));
    EXPECT_THAT(found.warnings,
                ElementsAre("in one place but not the same, so that nothing is joined there: nodes 107 and 110"));
}

TEST(Check, CornerThatIsAMidSideElsewhere_IsReportedByLabel) {
    // One large triangle below, two small ones above, standing on its mid-side node.
    MeshDraft draft =
        triangles({{0, 0}, {2, 0}, {1, -1}, {1, 0}, {0.5, 1}, {1.5, 1}}, {{0, 2, 1}, {0, 3, 4}, {3, 1, 5}, {3, 5, 4}});
    draft.elements[0][5] = 3;
    EXPECT_THAT(found_in(draft).errors,
                ::testing::Contains("a corner of one element and a mid-side node of another: node 104"));
}

TEST(Check, Hinge_IsAnError) {
    auto nodes = unit_square;
    nodes.push_back({2, 1});
    nodes.push_back({2, 2});
    EXPECT_THAT(
        found_in(triangles(nodes, {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}})).errors,
        ElementsAre("pieces that hang together in a node alone (separate bodies need nodes of their own): node 103"));
}

TEST(Check, SeparateBodies_AreAWarning) {
    auto nodes = unit_square;
    for (const auto& [x, y] : unit_square) nodes.push_back({x + 2, y});
    const Found found = found_in(triangles(nodes, {{0, 1, 2}, {4, 5, 6}, {0, 2, 3}, {4, 6, 7}}));
    EXPECT_THAT(found.errors, IsEmpty());
    EXPECT_THAT(found.warnings, ElementsAre("the mesh is in 2 separate pieces, one each with elements 1001 and 1002"));
}

TEST(Check, BodiesSideBySide_HaveCoincidentNodes) {
    auto nodes = unit_square;
    // Off by far less than the tolerance of 1e-6, across x = 1, where the search parts its bands.
    for (const auto& [x, y] : unit_square) nodes.push_back({x + 1 - 1e-9, y + 1e-9});
    const Found found = found_in(triangles(nodes, {{0, 1, 2}, {4, 5, 6}, {0, 2, 3}, {4, 6, 7}}));
    EXPECT_THAT(found.errors, IsEmpty());
    EXPECT_THAT(
        found.warnings,
        ElementsAre("the mesh is in 2 separate pieces, one each with elements 1001 and 1002",
                    "in one place but not the same, so that nothing is joined there: nodes 102, 103, 105, 108, 110 "
                    "and 118"));
}

TEST(Check, UnusedNodes_AreAWarningUnlessConstructionPoints) {
    auto nodes = unit_square;
    nodes.push_back({7, 7});
    MeshDraft draft = triangles(nodes, {{0, 1, 2}, {0, 2, 3}});
    EXPECT_THAT(found_in(draft).warnings, ElementsAre("left out, they belong to no element: node 105"));
    draft.report_unused_nodes = false;
    EXPECT_THAT(found_in(draft).warnings, IsEmpty());
}

TEST(Check, NamesOnNothing_AreReported) {
    auto nodes = unit_square;
    nodes.push_back({7, 7});
    MeshDraft draft = triangles(nodes, {{0, 1, 2}, {0, 2, 3}});
    draft.report_unused_nodes = false;
    draft.points["sensor"] = {1, 4};
    draft.points["left"] = {0};
    draft.lines["left"] = {{3, MeshDraft::no_node, 0}};
    draft.lines["diagonal"] = {{1, MeshDraft::no_node, 3}};
    EXPECT_THAT(found_in(draft).errors,
                ElementsAre("curve \"diagonal\" does not run along sides of elements: nodes 102 and 104",
                            "points \"sensor\" name what belongs to no element: node 105"));
}

TEST(Check, CoordinatesThatAreNoNumbers_AreReportedByLabel) {
    auto nodes = unit_square;
    nodes[1][0] = std::numeric_limits<double>::quiet_NaN();
    nodes[3][1] = std::numeric_limits<double>::infinity();
    MeshDraft draft = triangles(nodes, {{0, 1, 2}, {0, 2, 3}});
    EXPECT_THAT(found_in(draft).errors,
                ::testing::Contains(::testing::StartsWith("coordinates that are not finite numbers: nodes 102, 104")));
}

TEST(Check, SeveralFaults_AreReportedAtOnce) {
    auto nodes = unit_square;
    nodes.insert(nodes.end(), {{2, 1}, {2, 2}, {0.5, 0}});
    const Found found = found_in(triangles(nodes, {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}, {0, 6, 1}}));
    EXPECT_EQ(found.errors.size(), 2u);
}

TEST(Numbered, Lists_AreSortedUniqueAndCapped) {
    EXPECT_EQ(numbered("node", {7}), "node 7");
    EXPECT_EQ(numbered("node", {7, 7}), "node 7");
    EXPECT_EQ(numbered("node", {8, 3, 5}), "nodes 3, 5 and 8");
    std::vector<std::int64_t> many(47);
    std::iota(many.begin(), many.end(), 1);
    EXPECT_EQ(numbered("element", many), "elements 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 and 37 more");
}

}  // namespace
}  // namespace gneiss
