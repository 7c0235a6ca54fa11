#include "fracture/fragments.hpp"

#include <gtest/gtest.h>

#include "support/small_solids.hpp"

namespace gneiss {
namespace {

class FragmentsOf : public testing::TestWithParam<bool> {
protected:
    test::Solid solid = test::make_solid(test::rectangle(GetParam(), 2, 1, {4, 2}), {});
    InnerSides inner{solid.mesh};
    State state = solid.system->initial_state();

    Fragments find(const std::function<bool(std::int32_t)>& broken) {
        const Fragments found = find_fragments(solid.mesh, inner, broken, solid.system->elements(), state);
        EXPECT_EQ(count_fragments(solid.mesh.n_elements(), inner, broken), found.all.size());
        return found;
    }
    /// Whether a side lies on x = 0.5.
    bool on_the_cut(std::int32_t side) const {
        const ElementSide& left = inner.sides()[static_cast<std::size_t>(side)].left;
        const std::int32_t* nodes = solid.mesh.element(static_cast<std::size_t>(left.element));
        for (const int local : side_nodes(solid.mesh.kind, left.side))
            if (std::abs(solid.mesh.nodes[static_cast<std::size_t>(nodes[local])][0] - 0.5) > 1e-12) return false;
        return true;
    }
};

INSTANTIATE_TEST_SUITE_P(Elements, FragmentsOf, testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

constexpr double round_off = 1e-13;  // sums of a hundred masses of order 1 to 1000

TEST_P(FragmentsOf, WholeSolid_IsOne) {
    for (std::size_t i = 0; i < state.v.size(); i += 2) state.v[i] = 3;
    const Fragments found = find([](std::int32_t) { return false; });
    ASSERT_EQ(found.all.size(), 1u);
    EXPECT_EQ(found.all[0].n_elements, solid.mesh.n_elements());
    EXPECT_NEAR(found.all[0].mass, 2000, 2000 * round_off);  // 2 m2 of 1000 kg/m3
    EXPECT_NEAR(found.all[0].centre.x, 1, round_off);
    EXPECT_NEAR(found.all[0].centre.y, 0.5, round_off);
    EXPECT_NEAR(found.all[0].velocity.x, 3, 3 * round_off);
}

TEST_P(FragmentsOf, CutFromTopToBottom_AreTwo) {
    // u = (x, 0): the centres move by their own x
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) state.u[2 * node] = solid.mesh.nodes[node][0];
    const Fragments found = find([&](std::int32_t side) { return on_the_cut(side); });
    ASSERT_EQ(found.all.size(), 2u);
    const bool first_is_left = found.all[0].mass < found.all[1].mass;
    const Fragment &left = found.all[first_is_left ? 0 : 1], &right = found.all[first_is_left ? 1 : 0];
    EXPECT_NEAR(left.mass, 500, 500 * round_off);
    EXPECT_NEAR(right.mass, 1500, 1500 * round_off);
    EXPECT_NEAR(left.centre.x, 2 * 0.25, round_off);
    EXPECT_NEAR(right.centre.x, 2 * 1.25, 2 * round_off);
    for (std::size_t e = 0; e < solid.mesh.n_elements(); ++e) {
        double x = 0;
        for (int k = 0; k < solid.mesh.nodes_per_element(); ++k)
            x += solid.mesh.nodes[static_cast<std::size_t>(solid.mesh.element(e)[k])][0] /
                 solid.mesh.nodes_per_element();
        EXPECT_EQ(found.of_element[e], (x < 0.5) == first_is_left ? 0 : 1);
    }
}

TEST_P(FragmentsOf, CutThatEndsInside_IsStillOne) {
    std::int32_t last = -1;
    for (std::int32_t s = 0; s < static_cast<std::int32_t>(inner.sides().size()); ++s)
        if (on_the_cut(s)) last = s;
    ASSERT_GE(last, 0);
    EXPECT_EQ(find([&](std::int32_t side) { return on_the_cut(side) && side != last; }).all.size(), 1u);
}

TEST_P(FragmentsOf, EverySideBroken_AreTheElements) {
    EXPECT_EQ(find([](std::int32_t) { return true; }).all.size(), solid.mesh.n_elements());
}

}  // namespace
}  // namespace gneiss
