// Numbering for locality: elements along a Hilbert curve, nodes by first touch.

#include <algorithm>
#include <limits>
#include <numeric>

#include "mesh/draft.hpp"
#include "mesh/geometry.hpp"
#include "mesh/hilbert.hpp"

namespace gneiss {
namespace {

/// A grid of 2^20 cells along each side tells apart elements a millionth of the mesh's extent from each other.
constexpr int hilbert_levels = 20;

Point2 corner_centroid(const MeshDraft& draft, const std::array<std::int32_t, 6>& element) {
    Point2 sum{0, 0};
    for (int corner : {0, 2, 4})
        for (int i : {0, 1}) sum[i] += draft.nodes[element[corner]][i];
    return {sum[0] / 3, sum[1] / 3};
}

std::vector<std::size_t> hilbert_order(const MeshDraft& draft) {
    const std::size_t n = draft.elements.size();
    std::vector<Point2> centroids(n);
    Point2 low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    double extent = 0;
    for (std::size_t e = 0; e < n; ++e) {
        centroids[e] = corner_centroid(draft, draft.elements[e]);
        for (int i : {0, 1}) low[i] = std::min(low[i], centroids[e][i]);
    }
    for (const Point2& c : centroids) extent = std::max({extent, c[0] - low[0], c[1] - low[1]});

    const double scale = extent > 0 ? ((1 << hilbert_levels) - 1) / extent : 0;
    std::vector<std::uint64_t> index(n);
    for (std::size_t e = 0; e < n; ++e)
        index[e] = hilbert_index(static_cast<std::uint32_t>((centroids[e][0] - low[0]) * scale),
                                 static_cast<std::uint32_t>((centroids[e][1] - low[1]) * scale), hilbert_levels);
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return index[i] < index[j]; });
    return order;
}

template <class T>
std::vector<T> permuted(const std::vector<T>& values, const std::vector<std::size_t>& order) {
    std::vector<T> result;
    result.reserve(order.size());
    for (std::size_t i : order) result.push_back(values[i]);
    return result;
}

}  // namespace

void renumber(MeshDraft& draft) {
    const std::vector<std::size_t> order = hilbert_order(draft);
    draft.elements = permuted(draft.elements, order);
    draft.element_labels = permuted(draft.element_labels, order);
    draft.region = permuted(draft.region, order);
    for (auto& [name, values] : draft.element_data) values = permuted(values, order);

    std::vector<std::int32_t> new_number(draft.nodes.size(), MeshDraft::no_node);
    std::vector<std::size_t> old_number;
    for (auto& element : draft.elements)
        for (std::int32_t& node : element) {
            if (new_number[node] == MeshDraft::no_node) {
                new_number[node] = static_cast<std::int32_t>(old_number.size());
                old_number.push_back(static_cast<std::size_t>(node));
            }
            node = new_number[node];
        }
    draft.nodes = permuted(draft.nodes, old_number);
    draft.node_labels = permuted(draft.node_labels, old_number);
    for (auto& [name, sides] : draft.lines)
        for (auto& side : sides)
            for (std::int32_t& node : side) node = new_number[node];
    for (auto& [name, nodes] : draft.points)
        for (std::int32_t& node : nodes) node = new_number[node];
}

}  // namespace gneiss
