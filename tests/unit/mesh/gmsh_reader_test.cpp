#include "mesh/gmsh_reader.hpp"

#include <cmath>

#include "mesh/regions.hpp"
#include "tests/unit/mesh/gmsh_file.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Two triangles of three nodes in a square of side 2, the left one on surface 1 "rock", the right one on surface 2,
/// group 5 without a name; the left side is curve 1 "wall", the lower left corner point 1 "foot". Node 9 belongs to
/// nothing.
///   13---12
///   | 21/|
///   |  / |
///   | /22|
///   10---11
constexpr const char* square_msh = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
0 7 "foot"
1 3 "wall"
2 4 "rock"
$EndPhysicalNames
$Entities
1 1 2 0
1 0 0 0 1 7
1 0 0 0 0 2 0 1 3 0
1 0 0 0 2 2 0 1 4 0
2 0 0 0 2 2 0 1 5 0
$EndEntities
$Nodes
1 5 9 13
2 1 0 5
9
10
11
12
13
5 5 0
0 0 0
2 0 0
2 2 0
0 2 0
$EndNodes
$Elements
4 4 1 22
0 1 15 1
1 10
1 1 1 1
2 10 13
2 1 2 1
21 10 12 13
2 2 2 1
22 10 11 12
$EndElements
)";

/// One triangle of six nodes, corners 1 2 3, then the mid-sides 4 (bent down), 5, 6.
constexpr const char* bent_msh = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 1 1 0
1 0 0 0 0 2 0 1 8 0
1 0 0 0 2 2 0 0 0
$EndEntities
$Nodes
1 6 1 6
2 1 0 6
1
2
3
4
5
6
0 0 0
2 0 0
0 2 0
1 -0.25 0
1 1 0
0 1 0
$EndNodes
$Elements
2 2 1 2
1 1 8 1
1 1 2 4
2 1 9 1
2 1 2 3 4 5 6
$EndElements
)";

std::string element_data(const std::string& name, const std::string& rows, int n_rows, int n_components = 1) {
    return "$ElementData\n1\n\"" + name + "\"\n1\n0.0\n3\n0\n" + std::to_string(n_components) + "\n" +
           std::to_string(n_rows) + "\n" + rows + "$EndElementData\n";
}

TEST_F(GmshFile, Msh_ThreeNodedTriangles_BecomeComposites) {
    const Mesh mesh = read("square.msh", square_msh);
    ASSERT_EQ(mesh.n_elements(), 2u);
    EXPECT_EQ(mesh.n_nodes(), 9u);
    EXPECT_NEAR(total_area(mesh), 4, round_off);
    EXPECT_NEAR(smallest_signed_area(mesh), 0.5, round_off);
    EXPECT_THAT(mesh.element_labels, ::testing::UnorderedElementsAre(21, 22));
}

TEST_F(GmshFile, Msh_PhysicalGroups_NameRegionsBoundariesAndPoints) {
    const Mesh mesh = read("square.msh", square_msh);
    for (std::size_t e = 0; e < 2; ++e)
        EXPECT_EQ(mesh.region_names.at(static_cast<std::size_t>(mesh.region[e])),
                  mesh.element_labels[e] == 21 ? "rock" : "5");
    EXPECT_NEAR(length(mesh, "wall"), 2, round_off);
    for (const BoundaryEdge& edge : mesh.boundaries.at("wall")) EXPECT_EQ(normal(mesh, edge)[0], -1);
    EXPECT_EQ(mesh.node_sets.at("wall").size(), 3u);
    ASSERT_EQ(mesh.node_sets.at("foot").size(), 1u);
    EXPECT_EQ(mesh.node_labels[mesh.node_sets.at("foot")[0]], 10);
    EXPECT_NEAR(length(mesh, "boundary"), 8, round_off);
}

TEST_F(GmshFile, Msh_UnusedNode_IsLeftOutAndReported) {
    const Mesh mesh = read("square.msh", square_msh);
    EXPECT_THAT(report.warnings, ElementsAre("left out, they belong to no element: node 9"));
    EXPECT_THAT(mesh.node_labels, ::testing::Not(Contains(9)));
}

TEST_F(GmshFile, Msh_SixNodedTriangle_KeepsItsMidSides) {
    const Mesh mesh = read("bent.msh", bent_msh);
    ASSERT_EQ(mesh.n_elements(), 1u);
    const std::vector<Point2> around{{0, 0}, {1, -0.25}, {2, 0}, {1, 1}, {0, 2}, {0, 1}};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(mesh.nodes[mesh.element(0)[i]], around[i]) << i;
    EXPECT_THAT(mesh.region_names, ElementsAre("solid"));
    EXPECT_EQ(mesh.boundaries.at("8").size(), 2u);
    EXPECT_EQ(read("bent.msh", bent_msh, false).nodes[1], (Point2{1, 0}));
    EXPECT_EQ(read("bent.msh", bent_msh, true, false).n_elements(), 4u);
}

TEST_F(GmshFile, Msh_AllClockwise_IsTurned) {
    const Mesh mesh = read("bent.msh", replaced(bent_msh, "2 1 2 3 4 5 6", "2 1 3 2 6 5 4"));
    EXPECT_GT(smallest_signed_area(mesh), 0);
}

TEST_F(GmshFile, Msh_SomeClockwise_AreTurned) {
    const Mesh mesh = read("square.msh", replaced(square_msh, "21 10 12 13", "21 10 13 12"));
    EXPECT_GT(smallest_signed_area(mesh), 0);
    EXPECT_NEAR(total_area(mesh), 4, round_off);
    expect_sound_boundaries(mesh);
    EXPECT_NEAR(normal(mesh, mesh.boundaries.at("wall")[0])[0], -1, round_off);
}

TEST_F(GmshFile, Msh_TrianglesOnTopOfEachOther_AreRefusedByNumber) {
    // node 12 moved to the other side of the diagonal's end: both triangles then lie above side 10-12
    EXPECT_THAT(error_of("square.msh",
                         replaced(square_msh, "2 0 0\n2 2 0\n0 2 0\n$EndNodes", "0.5 1.5 0\n2 2 0\n0 2 0\n$EndNodes")),
                HasSubstr("overlapping, two on the same side of their common edge: elements 21 and 22"));
}

TEST_F(GmshFile, Msh_ZeroArea_IsRefusedByNumber) {
    EXPECT_THAT(error_of("square.msh", replaced(square_msh, "0 2 0\n$EndNodes", "1 1 0\n$EndNodes")),
                HasSubstr("zero area, of the whole or of one of its four sub-triangles: element 21"));
}

TEST_F(GmshFile, Msh_ElementData_FollowTheirElements) {
    const Mesh mesh = read("square.msh", square_msh + element_data("angle", "22 0.75\n21 -0.5\n", 2) +
                                             element_data("depth", "21 1\n22 2\n", 2));
    for (std::size_t e = 0; e < 2; ++e) {
        EXPECT_EQ(mesh.element_data.at("angle")[e], mesh.element_labels[e] == 21 ? -0.5 : 0.75);
        EXPECT_EQ(mesh.element_data.at("depth")[e], mesh.element_labels[e] == 21 ? 1 : 2);
    }
    const Mesh cst = read("square.msh", square_msh + element_data("angle", "22 0.75\n21 -0.5\n", 2), true, false);
    EXPECT_EQ(cst.element_data.at("angle").size(), 8u);
}

TEST_F(GmshFile, Msh_ElementDataThatCannotBeTaken_AreWarnedOfAndHaveNoNumbers) {
    const Mesh mesh =
        read("square.msh", square_msh + element_data("angle", "22 0.75\n", 1) +
                               element_data("axis", "21 1 0 0\n22 1 0 0\n", 2, 3) +
                               element_data("tensor", "21 1 0 0 0 1 0 0 0 1\n22 1 0 0 0 1 0 0 0 1\n", 2, 9) +
                               element_data("depth", "21 1\n22 2\n", 2) + element_data("depth", "21 1\n22 2\n", 2));
    EXPECT_THAT(report.warnings, ::testing::IsSupersetOf({"element data \"angle\" have no number for element 21",
                                                          "element data \"axis\" have 3 components: only one is read",
                                                          "element data \"tensor\" have 9 components: only one is read",
                                                          "element data \"depth\" are given twice: neither is taken"}));
    for (std::size_t e = 0; e < 2; ++e) {
        EXPECT_EQ(std::isnan(mesh.element_data.at("angle")[e]), mesh.element_labels[e] == 21);
        for (const char* name : {"axis", "tensor", "depth"}) EXPECT_TRUE(std::isnan(mesh.element_data.at(name)[e]));
    }
}

TEST_F(GmshFile, Msh_NodeData_AreLeftOutWithAWarning) {
    std::string data = element_data("head", "10 1\n11 1\n12 1\n13 1\n", 4);
    data = replaced(replaced(data, "$ElementData", "$NodeData"), "$EndElementData", "$EndNodeData");
    const Mesh mesh = read("square.msh", square_msh + data);
    EXPECT_THAT(mesh.element_data, IsEmpty());
    EXPECT_THAT(report.warnings, Contains("NodeData \"head\" is not read: only ElementData is"));
}

TEST_F(GmshFile, Msh_Quadrangle_IsRefusedByNumber) {
    const std::string quad = replaced(replaced(square_msh, "2 1 2 1\n21 10 12 13\n", "2 1 3 1\n21 10 11 12 13\n"),
                                      "2 2 2 1\n22 10 11 12\n", "");
    EXPECT_THAT(error_of("quad.msh", replaced(quad, "4 4 1 22", "3 3 1 22")),
                HasSubstr("only triangles of 3 or 6 nodes are read: element 21 is a Quadrilateral 4 (1 such)"));
}

TEST_F(GmshFile, Msh_OffThePlane_IsRefusedByNumber) {
    EXPECT_THAT(error_of("square.msh", replaced(square_msh, "2 2 0\n0 2 0\n$End", "2 2 0.5\n0 2 0\n$End")),
                HasSubstr("the mesh must lie in a plane z = constant: node 12 does not (1 such)"));
}

TEST_F(GmshFile, Msh_NodeOfNoElementOffThePlane_IsLeftOut) {
    const Mesh mesh = read("square.msh", replaced(square_msh, "5 5 0\n", "5 5 3\n"));
    EXPECT_EQ(mesh.n_elements(), 2u);
    EXPECT_THAT(report.warnings, ElementsAre("left out, they belong to no element: node 9"));
}

TEST_F(GmshFile, Msh_NamesOfWhatBelongsToNoElement_AreLeftOut) {
    const std::string text = replaced(square_msh, "1 10\n", "1 9\n");
    const Mesh mesh = read("square.msh", replaced(text, "2 10 13\n", "2 10 9\n"));
    EXPECT_EQ(mesh.n_elements(), 2u);
    EXPECT_FALSE(mesh.node_sets.contains("foot"));
    EXPECT_FALSE(mesh.boundaries.contains("wall"));
    EXPECT_THAT(
        report.warnings,
        ElementsAre("curve \"wall\": what leads to node 9, of no element, is left out, and nothing of this name stays",
                    "points \"foot\": node 9, of no element, left out, and nothing of this name stays",
                    "left out, they belong to no element: node 9"));
}

TEST_F(GmshFile, Msh2_NodeZero_IsRefused) {
    EXPECT_EQ(error_of("zero.msh",
                       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n0 0 0 0\n1 2 0 0\n2 0 2 0\n$EndNodes\n"
                       "$Elements\n1\n1 2 2 7 1 0 1 2\n$EndElements\n"),
              in_folder("zero.msh") +
                  ": two nodes have the number 1: nodes are numbered from 1 (Gmsh takes a node 0 for node 1)");
}

TEST_F(GmshFile, Msh2_PartitionsThatGmshCannotFollow_AreAWarning) {
    const Mesh mesh = read("square.msh", R"($MeshFormat
2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 2 0 0
3 2 2 0
4 0 2 0
$EndNodes
$Elements
3
0 1 3 1 1 1 2 3
1 2 3 2 7 1 1 2 3
2 2 3 2 7 2 1 3 4
$EndElements
)");
    EXPECT_NEAR(total_area(mesh), 4, round_off);
    EXPECT_THAT(report.warnings, Contains("Gmsh: All elements are not partitioned"));
}

TEST_F(GmshFile, Msh_SurfaceInNoGroup_IsRegionSolid) {
    const Mesh mesh = read("square.msh", replaced(square_msh, "2 0 0 0 2 2 0 1 5 0", "2 0 0 0 2 2 0 0 0"));
    EXPECT_THAT(mesh.region_names, ::testing::UnorderedElementsAre("rock", "solid"));
    EXPECT_THAT(report.warnings,
                Contains("1 triangles on surface 2, in no physical group while others are in some: they "
                         "are region \"solid\""));
}

TEST_F(GmshFile, Msh_SurfaceInTwoGroups_IsARegionOfItsOwnThatHasBothNames) {
    const Mesh mesh = read("square.msh", replaced(square_msh, "2 0 0 0 2 2 0 1 5 0", "2 0 0 0 2 2 0 2 5 4 0"));
    EXPECT_THAT(mesh.region_names, ::testing::UnorderedElementsAre("rock", "5 & rock"));
    EXPECT_EQ(regions_named(mesh, "rock").size(), 2u);
    ASSERT_EQ(regions_named(mesh, "5").size(), 1u);
    for (std::size_t e = 0; e < 2; ++e)
        EXPECT_EQ(mesh.region[e] == regions_named(mesh, "5")[0], mesh.element_labels[e] == 22);
    EXPECT_THAT(names_of_regions(mesh), ::testing::UnorderedElementsAre("rock", "5"));
}

/// The square in version 2.2: type, number of tags, group, geometrical tag, nodes.
std::string version_2(const std::string& elements, int n) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"rock\"\n2 2 \"source\"\n$EndPhysicalNames\n"
           "$Nodes\n4\n10 0 0 0\n11 2 0 0\n12 2 2 0\n13 0 2 0\n$EndNodes\n$Elements\n" +
           std::to_string(n) + "\n" + elements + "$EndElements\n";
}

TEST_F(GmshFile, Msh2_ElementsOnceForEachOfTheirGroups_AreOne) {
    const Mesh mesh = read("two.msh", version_2("1 2 2 1 1 10 12 13\n2 2 2 1 2 10 11 12\n3 2 2 2 2 10 11 12\n", 3));
    ASSERT_EQ(mesh.n_elements(), 2u);
    EXPECT_NEAR(total_area(mesh), 4, round_off);
    EXPECT_THAT(mesh.region_names, ::testing::UnorderedElementsAre("rock", "rock & source"));
}

TEST_F(GmshFile, Msh2_GroupsThatShareAGeometricalTag_AreRefused) {
    EXPECT_THAT(error_of("two.msh", version_2("1 2 2 1 0 10 12 13\n2 2 2 2 0 10 11 12\n", 2)),
                HasSubstr("elements of groups \"rock\", \"source\" share the geometrical tag"));
    EXPECT_EQ(read("one.msh", version_2("1 2 2 1 0 10 12 13\n2 2 2 1 0 10 11 12\n", 2)).n_elements(), 2u);
}

TEST_F(GmshFile, Msh_CurveAndPointsOfOneName_AreBoth) {
    const Mesh mesh = read("square.msh", replaced(square_msh, "0 7 \"foot\"", "0 7 \"wall\""));
    EXPECT_NEAR(length(mesh, "wall"), 2, round_off);
    EXPECT_EQ(mesh.node_sets.at("wall").size(), 3u);
    EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("node 9"))) << "the point is one of the curve";
}

TEST_F(GmshFile, Msh_CurveAndPointBesideItOfOneName_AreWarnedOf) {
    std::string text = replaced(square_msh, "0 7 \"foot\"", "0 7 \"wall\"");
    const Mesh mesh = read("square.msh", replaced(text, "0 1 15 1\n1 10\n", "0 1 15 1\n1 11\n"));
    EXPECT_NEAR(length(mesh, "wall"), 2, round_off);
    EXPECT_EQ(mesh.node_sets.at("wall").size(), 4u);
    EXPECT_THAT(report.warnings, Contains("\"wall\" names a curve and points beside it: tractions act on the curve, "
                                          "conditions on nodes on both"));
}

TEST_F(GmshFile, Msh_WithoutCurves_SidesOfARectangleHaveNames) {
    const std::string bare = replaced(replaced(replaced(square_msh, "4 4 1 22", "3 3 1 22"), "1 1 1 1\n2 10 13\n", ""),
                                      "1 0 0 0 0 2 0 1 3 0", "1 0 0 0 0 2 0 0 0");
    const Mesh mesh = read("square.msh", bare);
    for (const char* name : {"left", "right", "bottom", "top"}) EXPECT_NEAR(length(mesh, name), 2, round_off) << name;
    EXPECT_EQ(normal(mesh, mesh.boundaries.at("left")[0])[0], -1);
    EXPECT_EQ(normal(mesh, mesh.boundaries.at("top")[0])[1], 1);
    expect_sound_boundaries(mesh);
    // not where a curve has a name, nor where the contour is no rectangle
    EXPECT_EQ(read("square.msh", square_msh).boundaries.count("left"), 0u);
    EXPECT_EQ(read("square.msh", replaced(bare, "2 2 0\n0 2 0\n$End", "2 2 0\n0 1.5 0\n$End")).boundaries.count("left"),
              0u);
}

TEST_F(GmshFile, Msh_NoTriangles_IsRefused) {
    const std::string text =
        replaced(replaced(replaced(square_msh, "2 1 2 1\n21 10 12 13\n", ""), "2 2 2 1\n22 10 11 12\n", ""), "4 4 1 22",
                 "2 2 1 22");
    EXPECT_THAT(error_of("empty.msh", text), HasSubstr("no triangles: the mesh is empty"));
}

TEST_F(GmshFile, Msh_Damaged_IsRefusedWithItsName) {
    EXPECT_EQ(error_of("junk.msh", "hello\n"),
              in_folder("junk.msh") + ": is no mesh of Gmsh: the file does not begin with $MeshFormat");
    EXPECT_EQ(error_of("void.msh", ""), in_folder("void.msh") + ": is empty");
    EXPECT_THAT(error_of("fluent.msh", "(0 \"GAMBIT to Fluent File\")\n(2 2)\n"),
                HasSubstr(in_folder("fluent.msh") + ": is a mesh of ANSYS Fluent, not of Gmsh: "));
    EXPECT_THAT(error_of("lost.msh", replaced(square_msh, "21 10 12 13", "21 10 12 77")),
                HasSubstr(in_folder("lost.msh") + ": "));
}

TEST_F(GmshFile, Msh_CutAnywhere_IsRefusedWithItsName) {
    const std::string whole(square_msh);
    // Without the last line break, or the end mark behind complete elements, nothing is lost.
    const std::size_t complete = whole.find("\n$EndElements");
    for (std::size_t n = 1; n < complete; n += 7) {
        SCOPED_TRACE(n);
        EXPECT_THAT(error_of("cut.msh", whole.substr(0, n)), HasSubstr(in_folder("cut.msh") + ": "));
    }
}

TEST_F(GmshFile, Missing_IsRefusedWithItsName) {
    MeshOptions options;
    options.source = MeshOptions::Source::file;
    options.file = "nowhere.msh";
    EXPECT_EQ(input_error_of([&] { make_mesh(options, true, folder.path()); }),
              in_folder("nowhere.msh") + ": there is no such file");
}

}  // namespace
}  // namespace gneiss
