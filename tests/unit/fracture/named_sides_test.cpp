// Cracks and interfaces: which sides they are, and what holds there.

#include "fracture/named_sides.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "mesh/boundary.hpp"
#include "mesh/boundary_parts.hpp"
#include "mesh/make_mesh.hpp"

namespace gneiss {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// 2 m x 1 m in cells of a quarter metre; the right half is a region of its own.
Mesh halves(bool compt) {
    MeshOptions options;
    options.width = 2;
    options.height = 1;
    options.cells = {8, 4};
    options.lines = {{"across", {0.5, 0.5}, {1.5, 0.5}}, {"beyond", {1.25, 0.5}, {2, 0.5}}, {"up", {1, 0}, {1, 0.5}}};
    Mesh mesh = make_mesh(options, compt, ".");
    mesh.region_names = {"left_half", "right_half", "nowhere"};
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        double x = 0;
        for (int k = 0; k < mesh.nodes_per_element(); ++k)
            x += mesh.nodes[static_cast<std::size_t>(mesh.element(e)[k])][0] / mesh.nodes_per_element();
        mesh.region[e] = x > 1;
    }
    return mesh;
}

InterfaceOptions on(const std::string& line) {
    InterfaceOptions interface;
    interface.on = line;
    return interface;
}
InterfaceOptions between(const std::string& one, const std::string& other) {
    InterfaceOptions interface;
    interface.between = {one, other};
    return interface;
}

class NamedSidesOf : public ::testing::TestWithParam<bool> {
protected:
    Mesh mesh = halves(GetParam());
    InnerSides inner{mesh};
    std::size_t per_cell = GetParam() ? 1 : 2;  ///< sides

    std::string error_of(const std::vector<CrackOptions>& cracks, const std::vector<InterfaceOptions>& interfaces,
                         const std::optional<std::vector<std::string>>& where = {}) {
        try {
            named_sides(mesh, inner, cracks, interfaces, where);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};
INSTANTIATE_TEST_SUITE_P(Elements, NamedSidesOf, ::testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(NamedSidesOf, LinesAndRegions_AreFound) {
    const NamedSides named = named_sides(mesh, inner, {{"across"}}, {between("right_half", "left_half")});
    EXPECT_EQ(named.cracked.size(), 4 * per_cell);
    EXPECT_TRUE(std::ranges::is_sorted(named.cracked));
    EXPECT_EQ(named.interface_of.size(), 4 * per_cell);
    for (const auto& [side, interface] : named.interface_of) {
        EXPECT_EQ(interface, 0u);
        const InnerSide& found = inner.sides()[static_cast<std::size_t>(side)];
        EXPECT_NE(mesh.region[static_cast<std::size_t>(found.left.element)],
                  mesh.region[static_cast<std::size_t>(found.right.element)]);
    }
}

TEST_P(NamedSidesOf, SeveralRegionsOrAny_AreFoundWhereTwoOfThemMeet) {
    // thirds, side by side: two boundaries of four cells each
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        double x = 0;
        for (int k = 0; k < mesh.nodes_per_element(); ++k)
            x += mesh.nodes[static_cast<std::size_t>(mesh.element(e)[k])][0] / mesh.nodes_per_element();
        mesh.region[e] = x < 0.5 ? 0 : x < 1.5 ? 1 : 2;
    }
    InterfaceOptions all = between("left_half", "right_half"), any;
    EXPECT_EQ(named_sides(mesh, inner, {}, {all}).interface_of.size(), 4 * per_cell);
    all.between.emplace_back("nowhere");
    EXPECT_EQ(named_sides(mesh, inner, {}, {all}).interface_of.size(), 8 * per_cell);
    any.between_any = true;
    EXPECT_EQ(named_sides(mesh, inner, {}, {any}).interface_of.size(), 8 * per_cell);
    mesh.region_names = {"rock & a", "rock & b", "rock & b & c"};  // c is part of b: no boundary of b runs around it
    EXPECT_EQ(named_sides(mesh, inner, {}, {any}).interface_of.size(), 4 * per_cell);
    EXPECT_EQ(named_sides(mesh, inner, {}, {between("a", "b")}).interface_of.size(), 4 * per_cell);
    EXPECT_THAT(error_of({}, {between("rock", "b")}), HasSubstr("these regions have no side in common"));
    mesh.region_names = {"rock", "rock & b", "rock & b & c"};
    EXPECT_THAT(error_of({}, {any}), HasSubstr("between = \"any\": no two regions of the mesh have a side in common"));
}

TEST_P(NamedSidesOf, WhereCracksMayBe_AllOtherSidesStayBonded) {
    const std::size_t n = inner.sides().size();
    EXPECT_TRUE(named_sides(mesh, inner, {}, {}).bonded.empty()) << "not given: all sides may crack";
    const auto n_bonded = [&](const std::vector<CrackOptions>& cracks, const std::vector<InterfaceOptions>& interfaces,
                              const std::vector<std::string>& where) {
        return named_sides(mesh, inner, cracks, interfaces, where).bonded.size();
    };
    EXPECT_EQ(n_bonded({}, {}, {"across"}), n - 4 * per_cell);
    EXPECT_EQ(n_bonded({}, {on("up")}, {}), n - 2 * per_cell) << "interfaces alone";
    EXPECT_EQ(n_bonded({{"across"}}, {on("up")}, {}), n - 6 * per_cell) << "a crack is open already";
    EXPECT_EQ(n_bonded({}, {}, {"left_half", "right_half"}), 0u);
    EXPECT_EQ(n_bonded({}, {}, {"left_half"}) + n_bonded({}, {}, {"right_half"}), n + 4 * per_cell)
        << "sides between both are in neither";
    const NamedSides named = named_sides(mesh, inner, {}, {}, {{"left_half", "beyond"}});
    EXPECT_TRUE(std::ranges::is_sorted(named.bonded));
    for (const std::int32_t side : named.bonded) {
        const InnerSide& found = inner.sides()[static_cast<std::size_t>(side)];
        EXPECT_EQ(std::max(mesh.region[static_cast<std::size_t>(found.left.element)],
                           mesh.region[static_cast<std::size_t>(found.right.element)]),
                  1);
    }
    EXPECT_THAT(
        error_of({}, {}, {{"acros"}}),
        AllOf(HasSubstr("[fracture] on: the mesh has no region and no line inside the solid of the name \"acros\""),
              HasSubstr("did you mean `across`?")));
    EXPECT_THAT(error_of({}, {}, std::vector<std::string>{}), HasSubstr("no side may crack"));
}

TEST_P(NamedSidesOf, SideClaimedTwice_NamesBoth) {
    EXPECT_THAT(error_of({{"across"}}, {on("beyond")}),
                AllOf(HasSubstr("[[interface]] 1"), HasSubstr("[[crack]] 1 on = \"across\"")));
    EXPECT_THAT(error_of({}, {on("up"), between("left_half", "right_half")}),
                AllOf(HasSubstr("[[interface]] 2: "), HasSubstr("to [[interface]] 1 on = \"up\"")));
    EXPECT_THAT(error_of({{"across"}, {"across"}}, {}), HasSubstr("[[crack]] 2"));
}

TEST_P(NamedSidesOf, CrackAtABoundary_PartsItsNodes) {
    // the mouth of `up`, at (1, 0), is inside `bottom` and the end of `half`
    const std::size_t before = mesh.node_sets.at("bottom").size(), of_left = mesh.node_sets.at("left").size();
    BoundaryPart half{"half", "bottom", {0, 0}, {1, 0}};
    name_parts(mesh, {half});
    const std::size_t of_half = mesh.node_sets.at("half").size();
    open_cracks(mesh, inner, named_sides(mesh, inner, {{"up"}}, {}).cracked);
    EXPECT_EQ(mesh.node_sets.at("bottom").size(), before + 1);
    EXPECT_EQ(mesh.node_sets.at("left").size(), of_left);
    EXPECT_EQ(mesh.node_sets.at("half").size(), of_half) << "the node across the crack is not part of it";
    EXPECT_EQ(mesh.node_sets.at("half"), nodes_of(mesh.boundaries.at("half")));
    EXPECT_EQ(mesh.node_sets.at("up").size(), 2 * 5 - 1) << "both faces, and the tip";
}

TEST_P(NamedSidesOf, WrongNames_AreAllReported) {
    const std::string error =
        error_of({{"acros"}, {"left"}}, {between("left_half", "nowhere"), between("left_half", "rigth_half")});
    EXPECT_THAT(
        error, AllOf(HasSubstr("[[crack]] 1: on = \"acros\": the mesh has no line inside the solid"),
                     HasSubstr("did you mean \"across\"?"), HasSubstr("[[crack]] 2: on = \"left\": this is a boundary"),
                     HasSubstr("these regions have no side in common"), HasSubstr("did you mean \"right_half\"?")));
}

}  // namespace
}  // namespace gneiss
