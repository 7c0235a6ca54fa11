#include "mesh/boundary_parts.hpp"

#include "base/errors.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// The unit square, sub-edges of 1/8 m.
MeshOptions square_with_parts(std::vector<BoundaryPart> parts) {
    MeshOptions options;
    options.cells = {4, 4};
    options.parts = std::move(parts);
    return options;
}

std::string error_of(const MeshOptions& options) {
    return input_error_of([&] { make_mesh(options, true, "."); });
}

TEST(BoundaryParts, CornerOfASquare_HasTheEdgesOfBothSides) {
    for (const bool compt : {true, false}) {
        const Mesh mesh = make_mesh(square_with_parts({{"loaded", "outer", {0.75, 0.75}, {1, 1}}}), compt, ".");
        const std::vector<BoundaryEdge>& part = mesh.boundaries.at("loaded");
        ASSERT_EQ(part.size(), 4u);
        for (std::size_t i = 0; i < part.size(); ++i) {
            const Point2 &a = mesh.nodes[part[i].a], &b = mesh.nodes[part[i].b];
            EXPECT_TRUE((a[0] == 1 && b[0] == 1) || (a[1] == 1 && b[1] == 1)) << i;
            EXPECT_GE(std::min({a[0], a[1], b[0], b[1]}), 0.75);
            if (i > 0) {
                EXPECT_EQ(part[i - 1].b, part[i].a);
            }
        }
        EXPECT_EQ(mesh.node_sets.at("loaded").size(), 5u);
        EXPECT_EQ(mesh.boundaries.at("outer").size(), 32u) << "the whole stays as it is";
    }
}

TEST(BoundaryParts, WholeAndPartOfAPart_AreParts) {
    const Mesh mesh = make_mesh(
        square_with_parts({{"roof", "top", {-1, -1}, {2, 2}}, {"half", "roof", {0, 1}, {0.5, 1}}}), true, ".");
    EXPECT_EQ(mesh.boundaries.at("roof").size(), 8u);
    EXPECT_EQ(mesh.boundaries.at("half").size(), 4u);
}

TEST(BoundaryParts, RimsThatDifferByRoundOff_AreMet) {
    MeshOptions options = square_with_parts({{"loaded", "top", {0.1 + 0.2, 0.1}, {0.6, 0.1}}});
    options.width = 0.6;
    options.height = 0.1;
    EXPECT_EQ(make_mesh(options, true, ".").boundaries.at("loaded").size(), 4u);
}

TEST(BoundaryParts, EverythingThatIsWrong_IsSaidAtOnce) {
    const std::string message = error_of(square_with_parts({{"a", "tpo", {0, 0}, {1, 1}},
                                                            {"left", "top", {0, 0}, {1, 1}},
                                                            {"solid", "top", {0, 0}, {1, 1}},
                                                            {"b", "top", {0, 0}, {1, 0.5}},
                                                            {"c", "top", {0.3, 1}, {1, 1}},
                                                            {"d", "top", {0.26, 1}, {0.3, 1}}}));
    EXPECT_THAT(message, AllOf(HasSubstr("mesh.parts `a`: of = \"tpo\": the mesh has no boundary of this name"),
                               HasSubstr("did you mean `top`?"), HasSubstr("mesh.parts `left`: the mesh has something"),
                               HasSubstr("mesh.parts `solid`: the mesh has something"),
                               HasSubstr("mesh.parts `b`: no edge of \"top\" lies in the box"),
                               HasSubstr("mesh.parts `c`: the edge from (0.375, 1) to (0.25, 1) m is cut by the box"),
                               HasSubstr("mesh.parts `d`: the edge from (0.375, 1) to (0.25, 1) m is cut by the box")));
}

TEST(BoundaryParts, BoxUpsideDownOrNotANumber_IsRefused) {
    for (const Point2 to : {Point2{-1, 1}, Point2{1, -1}, Point2{std::nan(""), 1}, Point2{1, HUGE_VAL}})
        EXPECT_THAT(error_of(square_with_parts({{"a", "top", {0, 0}, to}})),
                    HasSubstr("mesh.parts `a`: from = [0, 0] must lie below and to the left of to = ["));
}

}  // namespace
}  // namespace gneiss
