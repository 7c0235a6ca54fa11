// Scripts of Gmsh (.geo): meshed with their parameters, mistakes told with their lines.

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

/// Quarter of a ring between radii 1 and 2, with construction point 1.
constexpr const char* ring_geo = R"(DefineConstant[ lc = {0.5, Name "Parameters/size"} ];
Point(1) = {0, 0, 0, lc};
Point(2) = {1, 0, 0, lc};
Point(3) = {2, 0, 0, lc};
Point(4) = {0, 2, 0, lc};
Point(5) = {0, 1, 0, lc};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Surface("ring") = {1};
Physical Curve("inner") = {4};
Physical Curve(17) = {2};
Physical Point("tip") = {3};
)";

TEST_F(GmshFile, Geo_IsMeshedWithCurvedComposites) {
    const Mesh mesh = read("ring.geo", ring_geo);
    EXPECT_THAT(mesh.region_names, ElementsAre("ring"));
    constexpr double gmsh_accuracy = 1e-8;  // Gmsh's geometry tolerance
    for (std::int32_t n : mesh.node_sets.at("inner"))
        EXPECT_NEAR(std::hypot(mesh.nodes[n][0], mesh.nodes[n][1]), 1, gmsh_accuracy);
    for (std::int32_t n : mesh.node_sets.at("17"))
        EXPECT_NEAR(std::hypot(mesh.nodes[n][0], mesh.nodes[n][1]), 2, gmsh_accuracy);
    EXPECT_EQ(mesh.nodes[mesh.node_sets.at("tip").at(0)], (Point2{2, 0}));
    expect_sound_boundaries(mesh);
    EXPECT_THAT(report.warnings, IsEmpty());
    const Mesh straight = read("ring.geo", ring_geo, false);
    EXPECT_LT(length(straight, "17"), length(mesh, "17"));
}

TEST_F(GmshFile, Geo_Parameters_AreDefinedBeforeItIsRead) {
    const std::size_t coarse = read("ring.geo", ring_geo).n_elements();
    parameters = {{"lc", 0.1}};
    EXPECT_GT(read("ring.geo", ring_geo).n_elements(), 10 * coarse);
    // Nothing of it stays behind.
    parameters = {};
    EXPECT_EQ(read("ring.geo", ring_geo).n_elements(), coarse);
}

TEST_F(GmshFile, Geo_UselessParameters_AreRefused) {
    parameters = {{"cl", 0.1}, {"not a name", 1}};
    EXPECT_EQ(error_of("ring.geo", ring_geo),
              in_folder("ring.geo") + ": parameter \"cl\" does not occur in the file\n" + in_folder("ring.geo") +
                  ": parameter \"not a name\" is not a name that Gmsh can read");
    parameters = {{"lc", 0.1}};
    const std::string fixed = replaced(ring_geo, "DefineConstant[ lc = {0.5, Name \"Parameters/size\"} ]", "lc = 0.5");
    EXPECT_THAT(error_of("ring.geo", fixed),
                HasSubstr("parameter lc is overwritten by the file: define it there by DefineConstant[ lc = ... ]"));
}

TEST_F(GmshFile, Geo_Faulty_IsRefusedWithLine) {
    EXPECT_THAT(error_of("bad.geo", "lc = 0.1;\nPoint(1) = {0, 0, 0, lc};\nfoo bar;\n"),
                ::testing::AllOf(HasSubstr("bad.geo: Gmsh: "), HasSubstr("line 3: Unknown variable 'bar'")));
    EXPECT_THAT(error_of("open.geo", replaced(ring_geo, "{1, 2, 3, 4}", "{1, 2, 3}")), HasSubstr("open.geo: "));
    EXPECT_THAT(error_of("points.geo", "Point(1) = {0, 0, 0, 1};\n"), HasSubstr("points.geo: "));
    // Gmsh meshes the curve that it could not make, again and again
    EXPECT_THAT(error_of("line.geo", "Point(1) = {0, 0, 0};\nLine(1) = {1, 7};\n"),
                ::testing::AllOf(HasSubstr("Unknown control point 7"),
                                 ::testing::ContainsRegex("less than 2 control points \\([0-9]+ times\\)$")));
}

TEST_F(GmshFile, Geo_Exit_IsRefusedButNotInCommentsAndNames) {
    EXPECT_THAT(error_of("exit.geo", std::string(ring_geo) + "Exit;\n"),
                HasSubstr("the statement Exit would end Gmsh before the mesh is taken over"));
    // a comment that begins within a string is none, a quotation mark within a comment begins no string
    EXPECT_THAT(error_of("exit.geo", std::string(ring_geo) + "Printf(\"a // b /*\"); // \"\nExit;\n"),
                HasSubstr("the statement Exit"));
    EXPECT_GT(
        read("ring.geo", std::string("// Exit;\n/* Exit; */\n/*/ Exit; */") + ring_geo + "// Exit\n").n_elements(), 0u);
    EXPECT_EQ(read("ring.geo", replaced(ring_geo, "\"inner\"", "\"Exit\"")).boundaries.count("Exit"), 1u);
}

TEST_F(GmshFile, Geo_WithoutLastLineBreak_IsReadToItsEnd) {
    std::string text = ring_geo;
    text.pop_back();
    EXPECT_EQ(read("ring.geo", text).node_sets.count("tip"), 1u) << "the last line names this point";
    // statements that find other files by where the script lies still do
    folder.write("size.geo", "lc = 0.25;\n");
    const std::size_t coarse = read("ring.geo", ring_geo).n_elements();
    const std::string including = "Include \"size.geo\";\n" + text.substr(text.find("Point(1)"));
    EXPECT_GT(read("ring.geo", including).n_elements(), coarse);
    EXPECT_THAT(error_of("bad.geo", "lc = 0.1;\nPoint(1) = {0, 0, 0, lc};\nfoo bar;"),
                HasSubstr(in_folder("bad.geo") + "', line 3: "))
        << "by the name of the file";
    std::size_t n_files = 0;
    for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder.path())) ++n_files;
    EXPECT_EQ(n_files, 3u) << "no copy stays behind";
}

TEST_F(GmshFile, Geo_IncludedFileWithoutLastLineBreak_IsRefused) {
    folder.write("size.geo", "lc = 0.25;");
    EXPECT_EQ(error_of("ring.geo", std::string("Include \"size.geo\";\n") + ring_geo),
              in_folder("size.geo") +
                  ": the last line does not end in a line break: Gmsh would skip it where the file is "
                  "included");
}

TEST_F(GmshFile, Geo_ErrorsThatLeaveTheGeometryAlone_AreWarnings) {
    const std::size_t plain = read("ring.geo", ring_geo).n_elements();
    EXPECT_EQ(read("ring.geo", std::string(ring_geo) + "Mesh.NoSuchOption = 1;\n").n_elements(), plain);
    EXPECT_THAT(report.warnings, ElementsAre("Gmsh: Unknown number option 'Mesh.NoSuchOption'"));
    EXPECT_GT(read("ring.geo", std::string(ring_geo) + "Transfinite Curve{1} = 3; Transfinite Curve{3} = 4; "
                                                       "Transfinite Surface{1};\n")
                  .n_elements(),
              0u);
    EXPECT_THAT(report.warnings, Contains(HasSubstr("cannot be meshed using the transfinite algo")));
    // one surface alone has nothing to be cut by; a statement that failed is still an error
    const std::string lone = "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {0, 0, 0, 2, 1};\nCoherence;\n";
    EXPECT_NEAR(total_area(read("lone.geo", lone)), 2, 1e-8);
    EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("Boolean fragments")));  // "failed" or, from 4.13, "skipped"
    EXPECT_THAT(error_of("lone.geo", lone + "Curve{77} In Surface{1};\n"), HasSubstr("lone.geo: Gmsh: "));
}

TEST_F(GmshFile, Geo_Mirrored_IsTurned) {
    const Mesh mesh = read("mirror.geo",
                           "Point(1)={0,0,0,0.5};Point(2)={1,0,0,0.5};Point(3)={1,1,0,0.5};Point(4)={0,1,0,0.5};\n"
                           "Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};\n"
                           "Curve Loop(1)={1,2,3,4};Plane Surface(1)={1};\n"
                           "Symmetry{1,0,0,0}{Duplicata{Surface{1};}}\n");
    EXPECT_NEAR(total_area(mesh), 2, 1e-8);
    EXPECT_GT(smallest_signed_area(mesh), 0);
    EXPECT_NEAR(length(mesh, "bottom"), 2, 1e-8);
}

TEST_F(GmshFile, Geo_ExtrudedDownwards_IsTurned) {
    const Mesh mesh = read("down.geo",
                           "Point(1)={0,0,0,0.5};Point(2)={1,0,0,0.5};Line(1)={1,2};\n"
                           "Extrude{0,-1,0}{Curve{1};Layers{2};}\nMesh.ElementOrder=2;\n");
    EXPECT_NEAR(total_area(mesh), 1, 1e-8);
    EXPECT_GT(smallest_signed_area(mesh), 0);
}

TEST_F(GmshFile, Geo_ViewsOfAScript_AreNotData) {
    const Mesh mesh = read("ring.geo", std::string(ring_geo) + "View \"sizes\" { ST(0,0,0,1,0,0,1,1,0){1,2,3}; };\n");
    EXPECT_THAT(mesh.element_data, IsEmpty());
    EXPECT_THAT(report.warnings, IsEmpty());
}

TEST_F(GmshFile, Geo_ParameterInAComment_DoesNotOccur) {
    parameters = {{"size_of_it", 1}};
    EXPECT_THAT(error_of("ring.geo", std::string(ring_geo) + "// size_of_it\n"),
                HasSubstr("does not occur in the file"));
}

// The first two are refused before Gmsh meshes them: version 4.13 does not come back.
TEST_F(GmshFile, Geo_CrossedOutline_IsRefusedWithThePlace) {
    const std::string square =
        "Point(1) = {0,0,0,0.3}; Point(2) = {1,0,0,0.3}; Point(3) = {1,1,0,0.3}; Point(4) = {0,1,0,0.3};\n";
    EXPECT_THAT(error_of("crossed.geo", square + "Line(1) = {1,3}; Line(2) = {3,2}; Line(3) = {2,4}; Line(4) = {4,1};\n"
                                                 "Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};\n"),
                HasSubstr("crossed.geo: surface 1: lines 1 and 3 cross at (0.5, 0.5) m"));
    const std::string surface = square +
                                "Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};\n"
                                "Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};\n"
                                "Point(5) = {0.2,0.3,0,0.3}; Point(6) = {1.3,0.3,0,0.3}; Point(7) = {0.2,0.7,0,0.3}; "
                                "Point(8) = {0.8,0.2,0,0.3};\n"
                                "Line(5) = {5,6}; Line(6) = {7,8};\n";
    EXPECT_THAT(error_of("sticking_out.geo", surface + "Line{5} In Surface{1};\n"),
                HasSubstr("surface 1: lines 2 and 5 cross at (1, 0.3) m"));
    // cracks may cross each other
    EXPECT_GT(
        read("crossing_cracks.geo", surface + "Point(9) = {0.9,0.3,0,0.3}; Line(7) = {5,9}; Line{6,7} In Surface{1};\n")
            .n_elements(),
        0u);
}

TEST_F(GmshFile, Geo_ShortLineAcrossALongOne_IsACrossing) {
    // a line of a metre leaves a block of a kilometre half a metre from its corner
    EXPECT_THAT(
        error_of(
            "notch.geo",
            "Point(1) = {0,0,0,50}; Point(2) = {1000,0,0,50}; Point(3) = {1000,1000,0,50}; Point(4) = {0,1000,0,50};\n"
            "Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};\n"
            "Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};\n"
            "Point(5) = {0.5,0.5,0,1}; Point(6) = {0.5,-0.5,0,1}; Line(5) = {5,6}; Line{5} In Surface{1};\n"),
        HasSubstr("surface 1: lines 1 and 5 cross at (0.5, 0) m without a common point: split them there"));
}

TEST_F(GmshFile, Geo_ChainOfPoints_IsNotTakenForItsChord) {
    // line 4 goes around an end of line 5, which its chord would cross
    EXPECT_GT(read("chain.geo",
                   "Point(1) = {0,0,0,0.3}; Point(2) = {1,0,0,0.3}; Point(3) = {1,1,0,0.3}; Point(4) = {0,1,0,0.3};\n"
                   "Point(5) = {-1,0.8,0,0.3}; Point(6) = {-1,0.2,0,0.3}; Point(7) = {-0.5,0.5,0,0.3}; Point(8) = "
                   "{0.5,0.5,0,0.3};\n"
                   "Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,5,6,1}; Line(5) = {7,8};\n"
                   "Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1}; Line{5} In Surface{1};\n")
                  .n_elements(),
              0u);
}

TEST_F(GmshFile, Geo_LineThatEndsOnTheOutline_IsNoCrossing) {
    EXPECT_GT(
        read("touching.geo",
             "Point(1) = {0,0,0,0.3}; Point(2) = {1,0,0,0.3}; Point(3) = {1,1,0,0.3}; Point(4) = {0,1,0,0.3};\n"
             "Point(5) = {0.1 + 0.2,0,0,0.3}; Point(6) = {0.5,0.6,0,0.3};\n"
             "Line(1) = {1,5}; Line(2) = {5,2}; Line(3) = {2,3}; Line(4) = {3,4}; Line(5) = {4,1}; Line(6) = {5,6};\n"
             "Curve Loop(1) = {1,2,3,4,5}; Plane Surface(1) = {1}; Line{6} In Surface{1};\n")
            .n_elements(),
        0u);
}

TEST_F(GmshFile, Geo_EmbeddedLine_IsAnInnerLine) {
    const Mesh mesh =
        read("fault.geo", std::string(ring_geo) +
                              "Point(8) = {1.2, 0.3, 0, lc}; Point(9) = {1.5, 0.6, 0, lc};\n"
                              "Line(9) = {8, 9}; Line{9} In Surface{1}; Physical Curve(\"fault\") = {9};\n");
    EXPECT_GE(mesh.node_sets.at("fault").size(), 3u);
    EXPECT_EQ(mesh.boundaries.count("fault"), 0u);
    EXPECT_EQ(mesh.node_sets.at("fault").size(), 2 * mesh.inner_lines.at("fault").size() + 1) << "corners, mid-sides";
    EXPECT_THAT(report.warnings, ::testing::IsEmpty());
}

TEST_F(GmshFile, Geo_Recombined_IsRefused) {
    EXPECT_THAT(error_of("quads.geo", std::string(ring_geo) + "Recombine Surface {1};\n"),
                HasSubstr("only triangles of 3 or 6 nodes are read: element"));
}

TEST_F(GmshFile, Geo_MeshedByItself_IsTakenAsItIs) {
    const std::size_t plain = read("ring.geo", ring_geo).n_elements();
    EXPECT_EQ(read("own.geo", std::string(ring_geo) + "Mesh 2;\n").n_elements(), plain);
}

}  // namespace
}  // namespace gneiss
