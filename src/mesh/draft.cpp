#include "mesh/draft.hpp"

#include <algorithm>
#include <unordered_map>

#include "mesh/composite.hpp"
#include "mesh/geometry.hpp"
#include "mesh/regions.hpp"

namespace gneiss {
namespace {

std::uint64_t side_key(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax(a, b);
    return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
}

std::int64_t next_label(const std::vector<std::int64_t>& labels) {
    return labels.empty() ? 1 : *std::max_element(labels.begin(), labels.end()) + 1;
}

/// Moves the mid-side nodes of an element halfway between its corners.
void straighten(MeshDraft& draft, const std::array<std::int32_t, 6>& element) {
    for (const auto& [from, mid, to] : composite_sides)
        draft.nodes[element[mid]] = midpoint(draft.nodes[element[from]], draft.nodes[element[to]]);
}

}  // namespace

std::int32_t MeshDraft::add_node(double x, double y) {
    nodes.push_back({x, y});
    node_labels.push_back(node_labels.empty() ? 1 : node_labels.back() + 1);
    return static_cast<std::int32_t>(nodes.size() - 1);
}

void MeshDraft::add_triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
    elements.push_back({a, no_node, b, no_node, c, no_node});
    element_labels.push_back(element_labels.empty() ? 1 : element_labels.back() + 1);
    region.push_back(0);
}

std::int32_t MeshDraft::region_of(const std::vector<std::string>& groups) {
    const std::string name = name_of_overlap(groups);
    auto at = std::find(region_names.begin(), region_names.end(), name);
    if (at == region_names.end()) at = region_names.insert(at, name);
    return static_cast<std::int32_t>(at - region_names.begin());
}

void add_mid_sides(MeshDraft& draft) {
    std::unordered_map<std::uint64_t, std::int32_t> mid_of_side;
    mid_of_side.reserve(draft.elements.size() * 2);
    for (const auto& element : draft.elements)
        for (const auto& [from, mid, to] : composite_sides)
            if (element[mid] != MeshDraft::no_node)
                mid_of_side.emplace(side_key(element[from], element[to]), element[mid]);

    std::int64_t label = next_label(draft.node_labels);
    const auto fill = [&](std::int32_t a, std::int32_t& mid, std::int32_t b) {
        if (mid != MeshDraft::no_node) return;
        const auto [entry, is_new] = mid_of_side.emplace(side_key(a, b), static_cast<std::int32_t>(draft.nodes.size()));
        if (is_new) {
            draft.nodes.push_back(midpoint(draft.nodes[a], draft.nodes[b]));
            draft.node_labels.push_back(label++);
        }
        mid = entry->second;
    };
    for (auto& element : draft.elements)
        for (const auto& [from, mid, to] : composite_sides) fill(element[from], element[mid], element[to]);
    for (auto& [name, sides] : draft.lines)
        for (auto& [from, mid, to] : sides) fill(from, mid, to);
}

void straighten_sides(MeshDraft& draft) {
    for (const auto& element : draft.elements) straighten(draft, element);
}

std::vector<std::int64_t> straighten_folded(MeshDraft& draft) {
    const auto is_folded = [&](const std::array<std::int32_t, 6>& element) {
        return std::ranges::any_of(composite_sub_triangles, [&](const SubTriangle& abc) {
            const auto [i, j, k] = counter_clockwise(abc);
            return triangle_area(draft.nodes[element[i]], draft.nodes[element[j]], draft.nodes[element[k]]) < 0;
        });
    };
    const auto corners_run_well = [&](const std::array<std::int32_t, 6>& element) {
        return triangle_area(draft.nodes[element[0]], draft.nodes[element[2]], draft.nodes[element[4]]) > 0;
    };
    std::vector<std::int64_t> labels;
    // a neighbour may fold over the side that has moved: again, until none does, at the latest where all are straight
    for (bool again = true; again;) {
        again = false;
        for (std::size_t e = 0; e < draft.elements.size(); ++e) {
            const auto& element = draft.elements[e];
            if (!corners_run_well(element) || !is_folded(element)) continue;
            straighten(draft, element);
            again = again || !is_folded(element);  // one without an area to speak of may stay so, by round-off
            labels.push_back(draft.element_labels[e]);
        }
    }
    return labels;
}

void orient(MeshDraft& draft) {
    for (auto& element : draft.elements)
        if (triangle_area(draft.nodes[element[0]], draft.nodes[element[2]], draft.nodes[element[4]]) < 0)
            std::reverse(element.begin() + 1, element.end());
}

}  // namespace gneiss
