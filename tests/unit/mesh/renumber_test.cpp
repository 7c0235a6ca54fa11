#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "mesh/draft.hpp"
#include "mesh/generators.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

/// Cache lines of node data (two doubles, four nodes in 64 bytes) that 64 elements in a row touch, on the average: the
/// traffic of a gather. 64 composites of a compact patch have about 64 * 2 + boundary nodes.
double cache_lines_per_window(const MeshDraft& draft) {
    constexpr std::size_t window = 64;
    constexpr std::int32_t nodes_per_line = 4;
    std::size_t n_lines = 0, n_windows = 0;
    for (std::size_t e = 0; e + window <= draft.elements.size(); e += window, ++n_windows) {
        std::set<std::int32_t> lines;
        for (std::size_t i = e; i < e + window; ++i)
            for (std::int32_t node : draft.elements[i]) lines.insert(node / nodes_per_line);
        n_lines += lines.size();
    }
    return static_cast<double>(n_lines) / static_cast<double>(n_windows);
}

/// Bandwidth on the average: how far apart in memory the nodes of one element lie.
double mean_span(const MeshDraft& draft) {
    double sum = 0;
    for (const auto& element : draft.elements) {
        const auto [low, high] = std::minmax_element(element.begin(), element.end());
        sum += *high - *low;
    }
    return sum / static_cast<double>(draft.elements.size());
}

MeshDraft big_rectangle() {
    MeshOptions options;
    options.cells = {60, 40};
    options.pattern = MeshOptions::Pattern::crossed;
    MeshDraft draft = rectangle(options);
    draft.element_data["label"].assign(draft.element_labels.begin(), draft.element_labels.end());
    return draft;
}

/// The same with elements in random order.
MeshDraft shuffled() {
    MeshDraft draft = big_rectangle();
    std::mt19937 random(42);
    std::vector<std::size_t> order(draft.elements.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    const MeshDraft source = draft;
    for (std::size_t i = 0; i < order.size(); ++i) {
        draft.elements[i] = source.elements[order[i]];
        draft.element_labels[i] = source.element_labels[order[i]];
        draft.element_data["label"][i] = source.element_data.at("label")[order[i]];
    }
    return draft;
}

using NodeAtLabel = std::map<std::int64_t, std::array<double, 2>>;

NodeAtLabel positions(const MeshDraft& draft) {
    NodeAtLabel result;
    for (std::size_t n = 0; n < draft.nodes.size(); ++n) result[draft.node_labels[n]] = draft.nodes[n];
    return result;
}

std::map<std::int64_t, std::vector<std::int64_t>> elements_by_label(const MeshDraft& draft) {
    std::map<std::int64_t, std::vector<std::int64_t>> result;
    for (std::size_t e = 0; e < draft.elements.size(); ++e)
        for (std::int32_t node : draft.elements[e]) result[draft.element_labels[e]].push_back(draft.node_labels[node]);
    return result;
}

// First touch packs the nodes of 64 neighbours, about 64 * 2 and half of those on their seam, 150 in all, into little
// more than 150/4 lines.
constexpr double local_cache_lines = 60;

TEST(Renumber, RandomOrder_BecomesLocal) {
    MeshDraft draft = shuffled();
    const double lines_before = cache_lines_per_window(draft), span_before = mean_span(draft);
    renumber(draft);
    EXPECT_LT(cache_lines_per_window(draft), local_cache_lines);
    EXPECT_LT(cache_lines_per_window(draft), 0.25 * lines_before);
    EXPECT_LT(mean_span(draft), 0.1 * span_before);
}

TEST(Renumber, RowByRow_BecomesMoreLocal) {
    MeshDraft draft = big_rectangle();
    const double lines_before = cache_lines_per_window(draft), span_before = mean_span(draft);
    renumber(draft);
    EXPECT_LT(cache_lines_per_window(draft), local_cache_lines);
    EXPECT_LT(cache_lines_per_window(draft), lines_before);
    EXPECT_LT(mean_span(draft), 0.5 * span_before);
}

TEST(Renumber, Geometry_StaysWithItsLabels) {
    const MeshDraft before = shuffled();
    MeshDraft after = before;
    renumber(after);
    EXPECT_EQ(positions(after), positions(before));
    EXPECT_EQ(elements_by_label(after), elements_by_label(before));
    for (std::size_t e = 0; e < after.elements.size(); ++e)
        EXPECT_EQ(after.element_data.at("label")[e], static_cast<double>(after.element_labels[e]));
    ASSERT_EQ(after.lines.size(), before.lines.size());
    for (const auto& [name, sides] : before.lines)
        for (std::size_t i = 0; i < sides.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_EQ(after.nodes[after.lines.at(name)[i][k]], before.nodes[sides[i][k]]);
    for (const auto& [name, nodes] : before.points)
        EXPECT_EQ(after.nodes[after.points.at(name)[0]], before.nodes[nodes[0]]);
}

TEST(Renumber, Nodes_AreNumberedByFirstTouch) {
    MeshDraft draft = shuffled();
    renumber(draft);
    std::int32_t next = 0;
    for (const auto& element : draft.elements)
        for (std::int32_t node : element) {
            ASSERT_LE(node, next);
            if (node == next) ++next;
        }
    EXPECT_EQ(static_cast<std::size_t>(next), draft.nodes.size());
}

TEST(Renumber, UnusedNodes_AreDropped) {
    MeshDraft draft = rectangle(MeshOptions{});
    const std::size_t n_used = draft.nodes.size();
    draft.add_node(7, 7);
    renumber(draft);
    EXPECT_EQ(draft.nodes.size(), n_used);
}

TEST(AddMidSides, MixedElements_ShareTheNodeThatIsThere) {
    MeshDraft draft;
    for (const auto& [x, y] :
         {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}, {1.1, 1.1}, {2.0, 1.0}, {1.0, 0.0}})
        draft.add_node(x, y);
    draft.region_names = {"solid"};
    draft.add_triangle(0, 2, 3);
    draft.add_triangle(0, 1, 2);
    draft.elements[1] = {0, 6, 1, 5, 2, 4};  // six-noded, with a bent diagonal
    draft.lines["diagonal"] = {{0, MeshDraft::no_node, 2}};
    add_mid_sides(draft);
    EXPECT_EQ(draft.elements[0][1], 4);
    EXPECT_EQ(draft.lines["diagonal"][0][1], 4);
    EXPECT_EQ(draft.nodes.size(), 9u);
    EXPECT_EQ(draft.node_labels.back(), 9);
    straighten_sides(draft);
    EXPECT_EQ(draft.nodes[4], (std::array<double, 2>{1, 1}));
}

}  // namespace
}  // namespace gneiss
