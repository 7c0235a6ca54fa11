// The elements around a node in the order in which their bonded sides lead from one to the next.

#include "fracture/fan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/small_solids.hpp"

namespace gneiss {
namespace {

class Fans : public testing::TestWithParam<bool> {
protected:
    Mesh mesh = [] {
        Mesh made = test::rectangle(GetParam(), 2, 1, {4, 2});
        test::distort(made, 0.25, 0.2, 3);
        return made;
    }();
    InnerSides inner{mesh};

    Fan at(std::int32_t node) const {
        Fan fan;
        find_fan(mesh, inner, node, fan);
        return fan;
    }
    bool is_mid_side(const Fan& fan) const { return mesh.kind == ElementKind::compt && fan.corners[0].node % 2 == 1; }
    /// Ends of a sub-edge of a side's left element.
    std::array<std::int32_t, 2> sub_edge(const Fan::Interface& at) const {
        const ElementSide& left = inner.sides()[static_cast<std::size_t>(at.at.side)].left;
        const auto local = side_nodes(mesh.kind, left.side);
        const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(left.element));
        return {nodes[local[at.part]], nodes[local[at.part + 1]]};
    }
    double direction(std::int32_t node, std::int32_t to) const {
        const auto &a = mesh.nodes[static_cast<std::size_t>(node)], &b = mesh.nodes[static_cast<std::size_t>(to)];
        return std::atan2(b[1] - a[1], b[0] - a[0]);
    }
};

INSTANTIATE_TEST_SUITE_P(Elements, Fans, testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(Fans, HaveEveryElementOnce_AndInterfacesBetweenNeighbours) {
    int closed = 0, open = 0;
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh.n_nodes()); ++node) {
        const Fan fan = at(node);
        std::vector<std::int32_t> elements;
        for (const Fan::Corner& corner : fan.corners) {
            elements.push_back(corner.element);
            EXPECT_EQ(mesh.element(static_cast<std::size_t>(corner.element))[corner.node], node);
        }
        std::ranges::sort(elements);
        EXPECT_TRUE(std::ranges::equal(elements, inner.elements_at(node))) << node;
        const bool is_closed = fan.interfaces.size() == fan.corners.size();
        ASSERT_TRUE(is_closed || fan.interfaces.size() + 1 == fan.corners.size());
        ++(is_closed ? closed : open);
        double turned = 0;
        for (std::size_t j = 0; j < fan.interfaces.size(); ++j) {
            const Fan::Interface& between = fan.interfaces[j];
            const InnerSide& side = inner.sides()[static_cast<std::size_t>(between.at.side)];
            const std::int32_t from = fan.corners[j].element, to = fan.corners[(j + 1) % fan.corners.size()].element;
            EXPECT_EQ(between.left_to_right ? side.left.element : side.right.element, from);
            EXPECT_EQ(between.left_to_right ? side.right.element : side.left.element, to);
            const auto ends = sub_edge(between);
            EXPECT_EQ(ends[between.end], node);
            const auto local = side_nodes(mesh.kind, side.left.side);
            EXPECT_EQ(mesh.element(static_cast<std::size_t>(
                          side.left.element))[local[static_cast<std::size_t>(between.at.place)]],
                      node);
            const auto next = sub_edge(fan.interfaces[(j + 1) % fan.interfaces.size()]);
            double step = direction(node, next[next[0] == node ? 1 : 0]) - direction(node, ends[1 - between.end]);
            if (step <= 0) step += 2 * std::numbers::pi;
            turned += step;
        }
        // counter-clockwise, once around
        if (is_closed) {
            EXPECT_NEAR(turned, 2 * std::numbers::pi, 1e-12);
        }
    }
    EXPECT_GT(closed, 2);
    EXPECT_GT(open, 8);
}

TEST_P(Fans, OpenedAtANode_EndThere) {
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh.n_nodes()); ++node) {
        const Fan whole = at(node);
        if (whole.interfaces.size() != whole.corners.size() || is_mid_side(whole)) continue;
        const std::vector ends{whole.interfaces[0].at, whole.interfaces[2].at};
        const auto copies = inner.open(ends);
        ASSERT_EQ(copies.size(), 1u);
        EXPECT_EQ(copies[0].original, node);
        const Fan one = at(node), other = at(copies[0].copy);
        EXPECT_EQ(one.corners.size() + other.corners.size(), whole.corners.size());
        EXPECT_EQ(one.interfaces.size() + 1, one.corners.size());
        EXPECT_EQ(other.interfaces.size() + 1, other.corners.size());
        return;
    }
    FAIL() << "no node inside";
}

TEST_P(Fans, SideOpenedAtOneEnd_HoldsAtTheOther) {
    for (std::int32_t s = 0; s < static_cast<std::int32_t>(inner.sides().size()); ++s) {
        const ElementSide& left = inner.sides()[static_cast<std::size_t>(s)].left;
        const auto local = side_nodes(mesh.kind, left.side);
        const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(left.element));
        const std::int32_t first = nodes[local.front()], last = nodes[local.back()];
        const Fan at_first = at(first);
        if (at_first.interfaces.size() == at_first.corners.size()) continue;  // a node inside does not part
        const std::vector ends{SideNode{s, 0}};
        EXPECT_EQ(inner.open(ends).size(), 1u);
        EXPECT_TRUE(inner.is_open(s));
        EXPECT_TRUE(inner.is_open(SideNode{s, 0}));
        EXPECT_FALSE(inner.is_open(SideNode{s, static_cast<std::int32_t>(local.size()) - 1}));
        // the right element has the last node still
        const auto right = static_cast<std::size_t>(inner.sides()[static_cast<std::size_t>(s)].right.element);
        const std::span of_right(mesh.element(right), static_cast<std::size_t>(mesh.nodes_per_element()));
        EXPECT_NE(std::ranges::find(of_right, last), of_right.end());
        return;
    }
    FAIL() << "no side ends at the contour";
}

}  // namespace
}  // namespace gneiss
