#include "mesh/mesh_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "mesh/make_mesh.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

auto says(const char* text) { return Field(&Problem::message, HasSubstr(text)); }

MeshOptions plate_options() {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    options.side = 4;
    options.radius = 1;
    options.size = {0.2, 0.4};
    return options;
}

TEST(MeshOptions, Defaults_AreValid) { EXPECT_THAT(validate(MeshOptions{}), IsEmpty()); }

TEST(MeshOptions, BadRectangle_ReportsEveryProblem) {
    MeshOptions options;
    options.width = -1;
    options.height = std::numeric_limits<double>::quiet_NaN();
    options.origin = {0, std::numeric_limits<double>::infinity()};
    options.cells = {0, 3};
    EXPECT_THAT(validate(options), ElementsAre(says("width = -1 must be"), says("height = nan must be"),
                                               says("origin = inf must be finite"), says("cells = 0 must be >= 1")));
}

TEST(MeshOptions, QuadrilateralThatIsNotConvexOrRunsClockwise_IsRefused) {
    MeshOptions options;
    options.source = MeshOptions::Source::quadrilateral;
    EXPECT_THAT(validate(options), IsEmpty());
    options.corners = {{{0, 0}, {48, 44}, {48, 60}, {0, 44}}};
    EXPECT_THAT(validate(options), IsEmpty());
    options.cells = {0, 3};
    std::reverse(options.corners.begin(), options.corners.end());
    EXPECT_THAT(validate(options), ElementsAre(says("corners[0] = [0, 44] does not turn left"), says("cells = 0")));
    options.cells = {1, 1};
    options.corners = {{{0, 0}, {4, 0}, {1, 1}, {0, 4}}};
    EXPECT_THAT(validate(options), ElementsAre(says("corners[2] = [1, 1] does not turn left")));
    options.corners = {{{0, 0}, {1, 0}, {1, 1}, {0, std::numeric_limits<double>::quiet_NaN()}}};
    EXPECT_THAT(validate(options), ElementsAre(says("does not turn left")));
    options.corners = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};  // crosses itself
    EXPECT_THAT(validate(options), ElementsAre(says("does not turn left")));
}

TEST(MeshOptions, BadPlate_ReportsEveryProblem) {
    MeshOptions options = plate_options();
    options.side = 2;
    options.size = {0, std::numeric_limits<double>::quiet_NaN()};
    EXPECT_THAT(validate(options),
                ElementsAre(says("size[0] = 0 must be"), says("size[1] = nan must be"),
                            says("side = 2 m must exceed the diameter of the hole, 2 radius = 2 m")));
}

TEST(MeshOptions, PlateWithoutNumbers_AsksForAll) {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    EXPECT_THAT(validate(options), ElementsAre(says("side"), says("radius"), says("size[0]"), says("size[1]")));
}

TEST(MeshOptions, BadFile_ReportsEveryProblem) {
    MeshOptions options;
    options.source = MeshOptions::Source::file;
    EXPECT_THAT(validate(options), ElementsAre(says("file is missing")));
    options.file = "plate.vtk";
    options.parameters = {{"lc", std::numeric_limits<double>::infinity()}};
    EXPECT_THAT(validate(options), ElementsAre(says("\"plate.vtk\" must end in .msh, .geo or .inp"),
                                               says("parameters.lc = inf must be finite")));
    options.file = "plate.msh";
    options.parameters = {{"lc", 0.1}};
    EXPECT_THAT(validate(options), ElementsAre(says("parameters belong to a .geo file")));
}

TEST(MeshOptions, OtherSource_LeavesItsOptionsAlone) {
    MeshOptions options = plate_options();
    options.width = -1;
    options.file = "plate.vtk";
    EXPECT_THAT(validate(options), IsEmpty());
}

TEST(MeshOptions, AbsurdlyManyElements_AreRefusedBeforeMeshing) {
    MeshOptions options = plate_options();
    options.size = {1e-7, 1e-7};
    for (auto layout : {MeshOptions::Layout::free, MeshOptions::Layout::structured}) {
        options.layout = layout;
        EXPECT_THAT(validate(options), ElementsAre(says("composites; at most")));
    }
    MeshOptions cells;
    cells.cells = {2'000'000'000, 2'000'000'000};
    EXPECT_THAT(validate(cells), ElementsAre(says("composites; at most")));
}

TEST(MeshOptions, ExpectedComposites_MatchTheMesh) {
    // Gmsh's triangles are not quite equilateral.
    constexpr double free_mesh_tolerance = 0.2;
    MeshOptions options = plate_options();
    options.layout = MeshOptions::Layout::structured;
    EXPECT_EQ(expected_composites(options), static_cast<double>(make_mesh(options, true, ".").n_elements()));
    options.layout = MeshOptions::Layout::free;
    const auto n_free = static_cast<double>(make_mesh(options, true, ".").n_elements());
    EXPECT_NEAR(expected_composites(options) / n_free, 1, free_mesh_tolerance);
    MeshOptions crossed;
    crossed.cells = {3, 2};
    crossed.pattern = MeshOptions::Pattern::crossed;
    EXPECT_EQ(expected_composites(crossed), 24);
    crossed.source = MeshOptions::Source::quadrilateral;
    EXPECT_EQ(expected_composites(crossed), 24);
}

}  // namespace
}  // namespace gneiss
