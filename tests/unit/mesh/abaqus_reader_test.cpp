#include "mesh/abaqus_reader.hpp"

#include "mesh/abaqus_keywords.hpp"
#include "mesh/regions.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

/// Two triangles in a square of side 2 as Gmsh writes them: elements of curves and surfaces, then groups of them.
///   4----3
///   |12 /|
///   |  / |
///   | /11|
///   1----2
const std::string square_inp = R"(*Heading
 square.inp
*NODE
1, 0, 0, 0
2, 2, 0, 0
3, 2, 2, 0
4, 0, 2, 0
******* E L E M E N T S *************
*ELEMENT, type=T3D2, ELSET=Line2
1, 2, 3
*ELEMENT, type=CPS3, ELSET=Surface1
11, 1, 2, 3
*ELEMENT, type=CPE3, ELSET=Surface2
12, 1, 3, 4
*ELSET,ELSET=right
1, 
*ELSET,ELSET=rock
11, 12, 
*NSET,NSET=foot
1, 2, 
)";

class AbaqusFile : public ::testing::Test {
protected:
    Mesh read(const std::string& text) {
        folder.write("case.inp", text);
        MeshOptions options;
        options.source = MeshOptions::Source::file;
        options.file = "case.inp";
        report = {};
        return make_mesh(options, true, folder.path(), &report);
    }
    std::string error_of(const std::string& text) {
        return input_error_of([&] { read(text); });
    }
    std::string file() const { return (folder.path() / "case.inp").string(); }

    TemporaryFolder folder;
    MeshReport report;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

TEST_F(AbaqusFile, SetsOfElementsAndNodes_AreRegionsBoundariesAndPoints) {
    const Mesh mesh = read(square_inp);
    ASSERT_EQ(mesh.n_elements(), 2u);
    EXPECT_NEAR(total_area(mesh), 4, round_off);
    EXPECT_THAT(names_of_regions(mesh), UnorderedElementsAre("Surface1", "Surface2", "rock"));
    EXPECT_EQ(regions_named(mesh, "rock").size(), 2u);
    for (std::size_t e = 0; e < 2; ++e)
        EXPECT_EQ(mesh.region[e] == regions_named(mesh, "Surface1").at(0), mesh.element_labels[e] == 11);
    EXPECT_NEAR(length(mesh, "right"), 2, round_off);
    EXPECT_EQ(normal(mesh, mesh.boundaries.at("right")[0])[0], 1);
    EXPECT_EQ(mesh.node_sets.at("foot").size(), 2u);
    expect_sound_boundaries(mesh);
    EXPECT_THAT(report.warnings, IsEmpty());
}

TEST_F(AbaqusFile, SixNodedTriangles_KeepTheirMidSides) {
    const Mesh mesh = read(R"(*NODE
1, 0.
2, 2.
3, 0., 2.D0
4, 1., -0.25
5, 1., 1.
6, 0., 1.
*ELEMENT, TYPE=CPE6M, ELSET=all
1, 1, 2, 3,
4, 5, 6
*ELEMENT, TYPE=B22, ELSET=floor
2, 1, 4, 2
*ELEMENT, TYPE=T3D3, ELSET=as Gmsh has it
3, 1, 2, 4
)");
    const std::vector<Point2> around{{0, 0}, {1, -0.25}, {2, 0}, {1, 1}, {0, 2}, {0, 1}};
    ASSERT_EQ(mesh.n_elements(), 1u);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(mesh.nodes[mesh.element(0)[i]], around[i]) << i;
    EXPECT_EQ(mesh.boundaries.at("floor").size(), 2u);
    EXPECT_EQ(mesh.boundaries.at("as Gmsh has it").size(), 2u);
}

TEST_F(AbaqusFile, PartsInstancesAndSurfaces_AsTheProgramWritesThem) {
    const Mesh mesh = read(R"(*Heading
** Job name: two blocks
*Part, name=Block
*Node
      1,           0.,           0.
      2,           2.,           0.
      3,           2.,           2.
      4,           0.,           2.
*Element, type=CPS3
1, 1, 2, 3
2, 1, 3, 4
*Elset, elset=ALL, generate
 1,  2,  1
*Nset, nset=foot
 1, 2
*Solid Section, elset=All, material=steel
1.,
*End Part
*Assembly, name=Assembly
*Instance, name=Lower, part=Block
*End Instance
*Instance, name=Upper, part=Block
          0.,           3.,           0.
*End Instance
*Node
      1,           9.,           9.,           0.
*Nset, nset=pin, instance=Lower
 1,
*Nset, nset=both
 Lower.2, Upper.2
*Elset, elset=_Top_S2, internal, instance=Upper
 2,
*Surface, type=ELEMENT, name=Top
_Top_S2, S2
*End Assembly
*Material, name=steel
*Elastic
2e11, 0.3
*Step, name=Load
*Static
*Elset, elset=later
1,
*End Step
)");
    ASSERT_EQ(mesh.n_elements(), 4u);
    EXPECT_NEAR(total_area(mesh), 8, round_off);
    EXPECT_THAT(mesh.region_names, ElementsAre("ALL"));
    ASSERT_EQ(mesh.boundaries.at("Top").size(), 2u);
    EXPECT_NEAR(length(mesh, "Top"), 2, round_off);
    for (const std::int32_t n : mesh.node_sets.at("Top")) EXPECT_EQ(mesh.nodes[n][1], 5);
    EXPECT_EQ(mesh.node_sets.at("foot").size(), 4u) << "of both instances";
    ASSERT_EQ(mesh.node_sets.at("pin").size(), 1u);
    EXPECT_EQ(mesh.nodes[mesh.node_sets.at("pin")[0]], (Point2{0, 0}));
    EXPECT_EQ(mesh.node_sets.at("both").size(), 2u);
    EXPECT_EQ(mesh.node_sets.count("_Top_S2"), 0u);
    EXPECT_EQ(mesh.boundaries.count("later"), 0u);
}

TEST_F(AbaqusFile, NamesAndKeywords_MeanTheSameInAnyCase) {
    std::string text = replaced(square_inp, "*ELSET,ELSET=right\n1, \n", "*elset, elset=right\nLINE2\n");
    EXPECT_NEAR(length(read(text), "right"), 2, round_off);
}

TEST_F(AbaqusFile, IncludedFiles_AreRead) {
    const std::size_t at = square_inp.find("*ELEMENT");
    folder.write("nodes.inp", square_inp.substr(0, at));
    EXPECT_EQ(read("*INCLUDE, INPUT=nodes.inp\n" + square_inp.substr(at)).n_elements(), 2u);
    folder.write("nodes.txt", "1, 0, 0\n2, 2, 0\n3, 2, 2\n4, 0, 2\n");
    EXPECT_EQ(read("*NODE, INPUT=nodes.txt\n" + square_inp.substr(at)).n_elements(), 2u);
}

TEST_F(AbaqusFile, ClockwiseTriangle_IsTurned) {
    EXPECT_GT(smallest_signed_area(read(replaced(square_inp, "12, 1, 3, 4", "12, 4, 3, 1"))), 0);
}

TEST_F(AbaqusFile, NodesBesideTheMesh_AreLeftOutOfSets) {
    const Mesh mesh =
        read(replaced(replaced(square_inp, "4, 0, 2, 0\n", "4, 0, 2, 0\n99, 5, 5, 0\n"), "1, 2, \n", "1, 99\n"));
    EXPECT_EQ(mesh.node_sets.at("foot").size(), 1u);
    EXPECT_THAT(report.warnings, ::testing::Contains("set \"foot\": node 99 belong to no triangle and are left out"));
}

TEST_F(AbaqusFile, MeshWithinAnInstanceOfAnEmptyPart_IsRead) {
    const Mesh mesh =
        read("*Part, name=Block\n*End Part\n*Assembly, name=Assembly\n*Instance, name=Block-1, part=Block\n" +
             square_inp.substr(square_inp.find("*NODE")) + "*End Instance\n*End Assembly\n");
    EXPECT_NEAR(total_area(mesh), 4, round_off);
    EXPECT_THAT(names_of_regions(mesh), UnorderedElementsAre("Surface1", "Surface2", "rock"));
}

TEST_F(AbaqusFile, LinesThatAllEndInAComma_AreANodeOrAnElementEach) {
    const Mesh mesh = read(R"(*NODE
1, 0, 0,
2, 2, 0,
3, 2, 2,
4, 0, 2,
*ELEMENT, TYPE=CPS3, ELSET=all
11, 1, 2, 3,
12, 1, 3, 4,
)");
    EXPECT_EQ(mesh.n_elements(), 2u);
    EXPECT_NEAR(total_area(mesh), 4, round_off);
    EXPECT_THAT(report.warnings, IsEmpty());
}

TEST_F(AbaqusFile, ShellOfSixNodes_IsATriangle) {
    const Mesh mesh = read(
        "*NODE\n1, 0, 0\n2, 2, 0\n3, 0, 2\n4, 1, 0\n5, 1, 1\n6, 0, 1\n"
        "*ELEMENT, TYPE=S6\n1, 1, 2, 3, 4, 5, 6\n");
    EXPECT_NEAR(total_area(mesh), 2, round_off);
}

TEST_F(AbaqusFile, ReferenceNodeOffThePlane_IsLeftOut) {
    const Mesh mesh = read(replaced(square_inp, "4, 0, 2, 0\n", "4, 0, 2, 0\n99, 1, 1, 5\n"));
    EXPECT_EQ(mesh.n_elements(), 2u);
    EXPECT_THAT(report.warnings, ElementsAre("left out, they belong to no element: node 99"));
}

TEST_F(AbaqusFile, EndingInCapitals_IsRead) {
    folder.write("CASE.INP", square_inp);
    MeshOptions options;
    options.source = MeshOptions::Source::file;
    options.file = "CASE.INP";
    EXPECT_EQ(make_mesh(options, true, folder.path()).n_elements(), 2u);
}

TEST_F(AbaqusFile, WhatIsWrong_IsReportedWithItsLine) {
    EXPECT_EQ(error_of("*HEADING\n*INCLUDE, INPUT=nodes.inp\n"),
              file() + ":2: names " + (folder.path() / "nodes.inp").string() + ", which cannot be opened for reading");

    EXPECT_EQ(error_of(replaced(square_inp, "type=CPE3", "type=CPE4")),
              file() +
                  ":13: *ELEMENT: type CPE4: only plane triangles are read, CPS3, CPE3, CPS6 and CPE6, and trusses "
                  "and beams along their sides");
    EXPECT_EQ(error_of(replaced(square_inp, "12, 1, 3, 4", "12, 1, 3, 44")),
              file() + ": elements name nodes that are not there: node 44");
    EXPECT_EQ(error_of(replaced(square_inp, "12, 1, 3, 4", "12, 1, 3")),
              file() + ":14: *ELEMENT: \"12, 1, 3\" is not an element and its 3 nodes");
    EXPECT_EQ(error_of(replaced(square_inp, "11, 12, \n", "11, rocks\n")),
              file() + ":17: *ELSET: \"rocks\" is neither a number nor a set");
    EXPECT_EQ(error_of(replaced(square_inp, "3, 2, 2, 0", "3, 2, 2, x")),
              file() + ":6: *NODE: \"3, 2, 2, x\" is not a node and its coordinates, three at most");
    EXPECT_EQ(error_of(replaced(square_inp, "3, 2, 2, 0", "3, 2, 2, 1")),
              file() + ": the mesh must lie in a plane z = constant: node 3 does not");
    EXPECT_EQ(error_of(square_inp + "*NGEN\n1, 2\n"),
              file() + ":21: *NGEN: is not read: write the nodes and elements out");
    EXPECT_EQ(error_of("1, 2\n"), file() + ": is no input file of Abaqus: it does not begin with a keyword");
    EXPECT_EQ(error_of("*HEADING\n"), file() + ": no triangles: the mesh is empty");
}

TEST_F(AbaqusFile, CommaBehindACompleteLine_EndsIt) {
    const std::string more = R"(*NODE
5, 4, 0,
6, 4, 2, 0,
*ELEMENT, TYPE=CPS3, ELSET=more
21, 2, 5, 6,
** 22 goes on below
22, 2,
6,
3,
)";
    std::string text = replaced(square_inp, "11, 1, 2, 3\n", "11, 1, 2, 3,\n12, 1, 3, 4,\n");
    text = replaced(text, "*ELEMENT, type=CPE3, ELSET=Surface2\n12, 1, 3, 4\n", more);
    text = replaced(text, "11, 12, \n", "11, 12, \n*ELSET, ELSET=each, GENERATE\n11, 12,\n21, 22, 1,\n");
    const Mesh mesh = read(text);
    EXPECT_EQ(mesh.n_elements(), 4u);
    EXPECT_NEAR(total_area(mesh), 8, round_off);
    const std::vector<std::int32_t> each = regions_named(mesh, "each");
    for (const std::int32_t region : mesh.region) EXPECT_THAT(each, ::testing::Contains(region));
}

TEST_F(AbaqusFile, TooManyOrTooFewEntries_AreRefusedWithTheirLine) {
    const auto with = [&](const std::string& what, const std::string& by) {
        return error_of(replaced(square_inp, what, by));
    };
    EXPECT_EQ(with("11, 1, 2, 3\n", "11, 1, 2, 3, 12, 1, 3, 4\n"),
              file() + ":12: *ELEMENT: \"11, 1, 2, 3, 12, 1, 3, 4\" is not an element and its 3 nodes");
    EXPECT_EQ(with("11, 1, 2, 3\n", "11, 1, 2,\n3, 4\n"),
              file() + ":12: *ELEMENT: \"11, 1, 2, 3, 4\" is not an element and its 3 nodes");
    EXPECT_EQ(with("12, 1, 3, 4\n", "12, 1, 3,\n"),
              file() + ":14: *ELEMENT: \"12, 1, 3\" is not an element and its 3 nodes");
    EXPECT_EQ(with("3, 2, 2, 0\n", "3, 2, 2, 0, 4\n"),
              file() + ":6: *NODE: \"3, 2, 2, 0, 4\" is not a node and its coordinates, three at most");
    EXPECT_EQ(with("3, 2, 2, 0\n", "3,\n"),
              file() + ":6: *NODE: \"3\" is not a node and its coordinates, three at most");
    const std::string generate = "*NSET, NSET=all, GENERATE\n";
    for (const char* line : {"1, 4, 1, 5", "1", "4, 1", "1, 4, 0"})
        EXPECT_EQ(error_of(square_inp + generate + line + ",\n"),
                  file() + ":22: *NSET: \"" + line + "\" is not a first number, a last one not below it, and a step");
    EXPECT_EQ(error_of(square_inp + "*SURFACE, NAME=top\n12, S2, 11, S1\n"),
              file() + ":22: *SURFACE: \"12, S2, 11, S1\" is not an element, or a set of them, and a face");
    folder.write("nodes.txt", "1, 0, 0\n2, 2, 0, 0, 0\n");
    EXPECT_EQ(error_of("*NODE, INPUT=nodes.txt\n"),
              (folder.path() / "nodes.txt").string() +
                  ":2: *NODE: \"2, 2, 0, 0, 0\" is not a node and its coordinates, three at most");
}

TEST(AbaqusKeywords, Parameters_GoOnBehindACommaAtTheEnd_AndDataTellTheirLines) {
    const TemporaryFolder folder;
    folder.write("a.inp",
                 "** comment\n*solid  section, elset=\"All of it\",\n material=steel\n1, 2,\n** between\n3\n4\n");
    const std::vector<AbaqusKeyword> keywords = abaqus_keywords(folder.path() / "a.inp");
    ASSERT_EQ(keywords.size(), 1u);
    EXPECT_EQ(keywords[0].name, "SOLID SECTION");
    EXPECT_EQ(keywords[0].value("ELSET"), "All of it");
    EXPECT_EQ(keywords[0].value("MATERIAL"), "steel");
    ASSERT_EQ(keywords[0].data.size(), 3u);
    EXPECT_THAT(keywords[0].data[0].entries, ElementsAre("1", "2"));
    EXPECT_TRUE(keywords[0].data[0].ends_in_comma);
    EXPECT_THAT(keywords[0].data[1].entries, ElementsAre("3"));
    EXPECT_FALSE(keywords[0].data[1].ends_in_comma);
    EXPECT_EQ(keywords[0].data[1].where(), (folder.path() / "a.inp").string() + ":6");
}

}  // namespace
}  // namespace gneiss
