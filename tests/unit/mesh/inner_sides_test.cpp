// Sides along which elements touch, and what opening them does to a mesh.

#include "mesh/inner_sides.hpp"

#include <random>
#include <set>

#include "mesh/boundary.hpp"
#include "mesh_testing.hpp"

namespace gneiss {
namespace {

Mesh square(bool compt, int cells) {
    MeshOptions options;
    options.source = MeshOptions::Source::rectangle;
    options.width = options.height = 1;
    options.cells = {cells, cells};
    options.pattern = MeshOptions::Pattern::crossed;
    return make_mesh(options, compt, {});
}

class InnerSidesOf : public ::testing::TestWithParam<bool> {
protected:
    Mesh mesh = square(GetParam(), 3);
    const Mesh before = mesh;

    std::vector<std::int32_t> all(const InnerSides& sides) const {
        std::vector<std::int32_t> numbers(sides.sides().size());
        std::iota(numbers.begin(), numbers.end(), 0);
        return numbers;
    }
    /// The elements keep their shape: every node stands where it stood.
    void expect_same_places() const {
        for (std::size_t k = 0; k < mesh.connectivity.size(); ++k)
            EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.connectivity[k])],
                      before.nodes[static_cast<std::size_t>(before.connectivity[k])]);
    }
};

INSTANTIATE_TEST_SUITE_P(Elements, InnerSidesOf, ::testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(InnerSidesOf, Numbers_FollowEuler) {
    const InnerSides sides(mesh);
    const std::size_t on_contour = contour(mesh).size() / (GetParam() ? 2 : 1);
    EXPECT_EQ(2 * sides.sides().size() + on_contour, 3 * mesh.n_elements());
    for (std::size_t s = 0; s < sides.sides().size(); ++s) {
        const auto& [left, right] = sides.sides()[s];
        EXPECT_LT(left.element, right.element);
        EXPECT_EQ(sides.number(left), static_cast<std::int32_t>(s));
        EXPECT_EQ(sides.number(right), static_cast<std::int32_t>(s));
        // the same nodes, walked the other way
        const auto of_left = side_nodes(mesh.kind, left.side), of_right = side_nodes(mesh.kind, right.side);
        for (std::size_t k = 0; k < of_left.size(); ++k)
            EXPECT_EQ(mesh.element(static_cast<std::size_t>(left.element))[of_left[k]],
                      mesh.element(static_cast<std::size_t>(right.element))[of_right[of_left.size() - 1 - k]]);
    }
}

TEST_P(InnerSidesOf, AllOpen_EveryElementHasNodesOfItsOwn) {
    InnerSides sides(mesh);
    const auto copies = sides.open(all(sides));
    EXPECT_EQ(mesh.n_nodes(), mesh.connectivity.size());
    EXPECT_EQ(copies.size(), mesh.n_nodes() - before.n_nodes());
    const std::set<std::int32_t> used(mesh.connectivity.begin(), mesh.connectivity.end());
    EXPECT_EQ(used.size(), mesh.n_nodes());
    EXPECT_EQ(mesh.node_labels.size(), mesh.n_nodes());
    for (const NodeCopy& copy : copies)
        EXPECT_EQ(mesh.node_labels[static_cast<std::size_t>(copy.copy)],
                  mesh.node_labels[static_cast<std::size_t>(copy.original)]);
    expect_same_places();
}

TEST_P(InnerSidesOf, OneSideInside_PartsNothingButItsMiddle) {
    InnerSides sides(mesh);
    // a side with both ends inside: around each of them the elements still hold together
    for (std::size_t s = 0; s < sides.sides().size(); ++s) {
        const ElementSide& side = sides.sides()[s].left;
        const auto local = side_nodes(mesh.kind, side.side);
        const auto inside = [&](int k) {
            const auto& [x, y] =
                mesh.nodes[static_cast<std::size_t>(mesh.element(static_cast<std::size_t>(side.element))[k])];
            return x > 0.01 && x < 0.99 && y > 0.01 && y < 0.99;
        };
        if (!inside(local.front()) || !inside(local.back())) continue;
        const std::vector<std::int32_t> one{static_cast<std::int32_t>(s)};
        EXPECT_EQ(sides.open(one).size(), GetParam() ? 1u : 0u);
        EXPECT_TRUE(sides.is_open(one[0]));
        EXPECT_TRUE(sides.open(one).empty()) << "it is open already";
        expect_same_places();
        return;
    }
    FAIL() << "no such side";
}

TEST_P(InnerSidesOf, CutThrough_LeavesTwoParts_WithTheirBoundaries) {
    InnerSides sides(mesh);
    std::vector<std::int32_t> cut;
    for (std::size_t s = 0; s < sides.sides().size(); ++s) {
        const ElementSide& side = sides.sides()[s].left;
        bool on_line = true;
        for (const int k : side_nodes(mesh.kind, side.side)) {
            const auto node = static_cast<std::size_t>(mesh.element(static_cast<std::size_t>(side.element))[k]);
            on_line = on_line && std::abs(mesh.nodes[node][0] - 1.0 / 3) < testing::round_off;
        }
        if (on_line) cut.push_back(static_cast<std::int32_t>(s));
    }
    ASSERT_EQ(cut.size(), GetParam() ? 3u : 6u) << "a composite is four CST";
    const auto copies = sides.open(cut);
    EXPECT_EQ(copies.size(), 7u);
    std::set<std::int32_t> left, right;
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        double x = 0;
        for (int k = 0; k < mesh.nodes_per_element(); ++k)
            x += mesh.nodes[static_cast<std::size_t>(mesh.element(e)[k])][0] / mesh.nodes_per_element();
        (x < 1.0 / 3 ? left : right).insert(mesh.element(e), mesh.element(e) + mesh.nodes_per_element());
    }
    for (const std::int32_t node : left) EXPECT_FALSE(right.contains(node));
    // boundaries are still edges of their elements, and their node sets hold all of their nodes
    for (const auto& [name, edges] : mesh.boundaries) {
        ASSERT_EQ(edges.size(), before.boundaries.at(name).size());
        for (const BoundaryEdge& edge : edges) {
            const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(edge.element));
            for (const std::int32_t end : {edge.a, edge.b}) {
                EXPECT_NE(std::find(nodes, nodes + mesh.nodes_per_element(), end), nodes + mesh.nodes_per_element());
                EXPECT_TRUE(std::ranges::binary_search(mesh.node_sets.at(name), end));
            }
        }
        EXPECT_TRUE(std::ranges::is_sorted(mesh.node_sets.at(name)));
    }
    EXPECT_EQ(mesh.node_sets.at("bottom").size(), before.node_sets.at("bottom").size() + 1);
    expect_same_places();
}

/// How many nodes a mesh should have: corners of elements are one where a bonded side joins them.
std::size_t expected_nodes(const Mesh& mesh, const InnerSides& sides) {
    const auto n = static_cast<std::size_t>(mesh.nodes_per_element());
    std::vector<std::size_t> root(mesh.connectivity.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](std::size_t k) {
        while (root[k] != k) k = root[k];
        return k;
    };
    std::size_t classes = root.size();
    for (std::size_t s = 0; s < sides.sides().size(); ++s) {
        if (sides.is_open(static_cast<std::int32_t>(s))) continue;
        const auto& [left, right] = sides.sides()[s];
        const auto of_left = side_nodes(mesh.kind, left.side), of_right = side_nodes(mesh.kind, right.side);
        for (std::size_t k = 0; k < of_left.size(); ++k) {
            const std::size_t a =
                find(n * static_cast<std::size_t>(left.element) + static_cast<std::size_t>(of_left[k]));
            const std::size_t b = find(n * static_cast<std::size_t>(right.element) +
                                       static_cast<std::size_t>(of_right[of_right.size() - 1 - k]));
            if (a == b) continue;
            root[a] = b;
            --classes;
        }
    }
    return classes;
}

TEST_P(InnerSidesOf, OneByOneInAnyOrder_ElementsHoldTogetherAsTheirBondsDo) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        mesh = before;
        InnerSides sides(mesh);
        std::vector<std::int32_t> order = all(sides);
        std::mt19937 random(seed);
        std::ranges::shuffle(order, random);
        for (const std::int32_t side : order) {
            sides.open(std::span(&side, 1));
            ASSERT_EQ(mesh.n_nodes(), expected_nodes(mesh, sides));
        }
        EXPECT_EQ(mesh.n_nodes(), mesh.connectivity.size());
        expect_same_places();
    }
}

}  // namespace
}  // namespace gneiss
