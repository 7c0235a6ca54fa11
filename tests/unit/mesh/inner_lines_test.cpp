// Lines of sides inside a solid that get a name by where they are.

#include "mesh/inner_lines.hpp"

#include <cmath>

#include "mesh/inner_sides.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// The unit square in 4 x 4 cells with both diagonals, sub-edges of 1/8 m.
MeshOptions square_with_lines(std::vector<InnerLine> lines) {
    MeshOptions options;
    options.cells = {4, 4};
    options.pattern = MeshOptions::Pattern::crossed;
    options.lines = std::move(lines);
    return options;
}

std::string error_of(std::vector<InnerLine> lines) {
    return input_error_of([&] { make_mesh(square_with_lines(std::move(lines)), true, "."); });
}

double length_of(const Mesh& mesh, const std::vector<ElementSide>& sides) {
    double length = 0;
    for (const auto& [element, side] : sides) {
        const auto local = side_nodes(mesh.kind, side);
        const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(element));
        const Point2 &a = mesh.nodes[nodes[local.front()]], &b = mesh.nodes[nodes[local.back()]];
        length += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
    return length;
}

class InnerLinesOf : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Elements, InnerLinesOf, ::testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(InnerLinesOf, StraightAndSlanted_AreCoveredFromEndToEnd) {
    const Mesh mesh = make_mesh(square_with_lines({{"across", {0, 0.5}, {0.5, 0.5}}, {"rising", {1, 1}, {0.25, 0.25}}}),
                                GetParam(), ".");
    for (const auto& [name, length, n_composites] :
         {std::tuple("across", 0.5, 2u), std::tuple("rising", 0.75 * std::sqrt(2.0), 6u)}) {
        const auto& sides = mesh.inner_lines.at(name);
        EXPECT_EQ(sides.size(), (GetParam() ? 1 : 2) * n_composites) << name;
        EXPECT_NEAR(length_of(mesh, sides), length, round_off) << name;
        EXPECT_EQ(mesh.node_sets.at(name).size(), 2 * n_composites + 1) << name;
    }
}

TEST_P(InnerLinesOf, OpenedLine_PartsTheSolidAlongIt) {
    Mesh mesh = make_mesh(square_with_lines({{"notch", {0, 0.5}, {0.5, 0.5}}}), GetParam(), ".");
    InnerSides inner(mesh);
    std::vector<std::int32_t> sides;
    for (const ElementSide& side : mesh.inner_lines.at("notch")) {
        sides.push_back(inner.number(side));
        EXPECT_EQ(inner.sides()[static_cast<std::size_t>(sides.back())].left.element, side.element);
    }
    // five nodes on the line, the one at its inner end stays whole
    EXPECT_EQ(inner.open(sides).size(), 4u);
    EXPECT_EQ(mesh.node_sets.at("notch").size(), 9u);
    EXPECT_NEAR(length_of(mesh, mesh.inner_lines.at("notch")), 0.5, round_off) << "elements keep their numbers";
}

TEST_P(InnerLinesOf, Composites_EndAtCornersAlone) {
    // 1/8 m ends at a mid-side node: a side of a CST, none of a composite
    const std::vector<InnerLine> lines{{"short", {0, 0.5}, {0.125, 0.5}}};
    if (GetParam())
        EXPECT_THAT(error_of(lines),
                    AllOf(HasSubstr("mesh.lines `short`: the line is 0.125 m long"), HasSubstr("cover 0 m")));
    else
        EXPECT_EQ(make_mesh(square_with_lines(lines), false, ".").inner_lines.at("short").size(), 1u);
}

TEST(InnerLines, LineWithAGap_SaysWhereAndHowMuch) {
    EXPECT_THAT(
        error_of({{"bent", {0, 0.5}, {1.25, 0.5}}}),
        AllOf(HasSubstr("the line is 1.25 m long"), HasSubstr("cover 1 m of it"), HasSubstr("begins at (1, 0.5) m")));
    EXPECT_THAT(error_of({{"outside", {0, 0}, {1, 0}}}), HasSubstr("cover 0 m of it")) << "the contour is not inside";
    EXPECT_THAT(error_of({{"slanted", {0, 0.25}, {1, 0.5}}}), HasSubstr("begins at (0, 0.25) m"));
}

TEST(InnerLines, TakenNamesAndPoints_AreRefused) {
    EXPECT_EQ(error_of({{"left", {0, 0.5}, {1, 0.5}}}),
              "mesh.lines `left`: the mesh has something of this name already");
    EXPECT_THAT(error_of({{"a", {0, 0.5}, {1, 0.5}}, {"a", {0.5, 0}, {0.5, 1}}}), HasSubstr("of this name already"));
    EXPECT_THAT(error_of({{"point", {0.5, 0.5}, {0.5, 0.5}}}), HasSubstr("must be a line of some length"));
    EXPECT_THAT(error_of({{"nan", {0.5, std::nan("")}, {0.5, 0.5}}}), HasSubstr("must be a line of some length"));
}

}  // namespace
}  // namespace gneiss
