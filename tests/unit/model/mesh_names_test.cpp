#include "model/mesh_names.hpp"

#include <gmock/gmock.h>

#include "base/errors.hpp"
#include "unit/model/tiny_mesh.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

template <class Action>
std::string message_of(Action&& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(MeshNames, Found_EachKind_GivesItsContents) {
    const Mesh mesh = test::rectangle_mesh();
    EXPECT_THAT(boundary_named(mesh, "outer"), SizeIs(4));
    EXPECT_THAT(nodes_named(mesh, "corner"), ElementsAre(2));
    EXPECT_THAT(nodes_named(mesh, "left"), ElementsAre(0, 3));
    EXPECT_THAT(elements_named(mesh, "clay"), ElementsAre(1));
    EXPECT_THAT(region_or_nodes_named(mesh, "clay"), ElementsAre(0, 2, 3));
    EXPECT_THAT(region_or_nodes_named(mesh, "top"), ElementsAre(2, 3));
}

TEST(MeshNames, Unknown_MisspeltBoundary_ListsBoundariesAndSuggests) {
    const Mesh mesh = test::rectangle_mesh();
    EXPECT_EQ(message_of([&] { boundary_named(mesh, "otuer"); }),
              "on = \"otuer\": the mesh has no boundary of this name; there are: \"bottom\", \"left\", \"outer\", "
              "\"right\", \"top\"; did you mean \"outer\"?");
    EXPECT_EQ(message_of([&] { boundary_named(mesh, "outr"); }),
              "on = \"outr\": the mesh has no boundary of this name; there are: \"bottom\", \"left\", \"outer\", "
              "\"right\", \"top\"; did you mean \"outer\"?");
}

TEST(MeshNames, Unknown_NameOfAnotherKind_SaysWhatItIs) {
    const Mesh mesh = test::rectangle_mesh();
    EXPECT_EQ(message_of([&] { elements_named(mesh, "left"); }),
              "on = \"left\": this is a boundary, needed: region; there are: \"rock\", \"clay\"");
    EXPECT_THAT(message_of([&] { boundary_named(mesh, "corner"); }),
                testing::StartsWith("on = \"corner\": these are nodes, needed: boundary;"));
    EXPECT_THAT(message_of([&] { nodes_named(mesh, "rock"); }),
                testing::StartsWith("on = \"rock\": this is a region, needed: boundary or nodes;"));
}

TEST(MeshNames, LineInsideTheSolid_IsFoundAndNoBoundary) {
    Mesh mesh = test::rectangle_mesh();
    mesh.inner_lines["fault"] = {{0, 1}};
    mesh.node_sets["fault"] = {0, 2};
    EXPECT_THAT(inner_line_named(mesh, "fault"), SizeIs(1));
    EXPECT_THAT(message_of([&] { boundary_named(mesh, "fault"); }),
                testing::StartsWith("on = \"fault\": this is a line inside the solid, needed: boundary;"));
    EXPECT_EQ(message_of([&] { inner_line_named(mesh, "left"); }),
              "on = \"left\": this is a boundary, needed: line inside the solid; there are: \"fault\"");
}

TEST(MeshNames, Unknown_MeshWithoutNames_SaysSo) {
    const Mesh mesh;
    EXPECT_EQ(message_of([&] { boundary_named(mesh, "left"); }),
              "on = \"left\": the mesh has no boundary of this name; there are none");
}

TEST(MeshNames, Unknown_RegionOrNodes_ListsBoth) {
    EXPECT_EQ(message_of([] { region_or_nodes_named(test::rectangle_mesh(), "rokc"); }),
              "on = \"rokc\": the mesh has no region, boundary or nodes of this name; there are: \"rock\", \"clay\", "
              "\"bottom\", \"corner\", \"left\", \"outer\", \"right\", \"top\"; did you mean \"rock\"?");
}

TEST(MeshNames, RegionAndNodesOfOneName_AreTheRegionUnlessTheyLieBesideIt) {
    Mesh mesh = test::rectangle_mesh();
    mesh.node_sets["rock"] = {0, 1};  // its rim, say: names of a mesh file are per dimension
    EXPECT_THAT(region_or_nodes_named(mesh, "rock"), ElementsAre(0, 1, 2));
    mesh.node_sets["rock"] = {0, 3};
    EXPECT_EQ(message_of([&] { region_or_nodes_named(mesh, "rock"); }),
              "on = \"rock\": both a region and a set of nodes have this name");
}

TEST(MeshNames, GroupsThatOverlap_StandForAllOfTheirRegions) {
    Mesh mesh = test::rectangle_mesh();
    mesh.region_names = {"rock & source", "source"};
    EXPECT_THAT(elements_named(mesh, "rock"), ElementsAre(0));
    EXPECT_THAT(elements_named(mesh, "source"), ElementsAre(0, 1));
    EXPECT_EQ(message_of([&] { elements_named(mesh, "clay"); }),
              "on = \"clay\": the mesh has no region of this name; there are: \"rock\", \"source\"");
}

}  // namespace
}  // namespace gneiss
