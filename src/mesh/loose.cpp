#include "mesh/loose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/check.hpp"

namespace gneiss {
namespace {

/// Whether each node is a corner or a mid-side of an element.
std::vector<char> uses_of(const MeshDraft& draft) {
    std::vector<char> used(draft.nodes.size(), 0);
    for (const auto& element : draft.elements)
        for (const std::int32_t node : element)
            if (node != MeshDraft::no_node) used[static_cast<std::size_t>(node)] = 1;
    return used;
}

}  // namespace

std::vector<std::int64_t> off_plane(const MeshDraft& draft, const std::vector<double>& heights) {
    const std::vector<char> used = uses_of(draft);
    double extent = 0;
    std::vector<std::size_t> nodes;
    for (std::size_t n = 0; n < used.size(); ++n) {
        if (used[n] == 0) continue;
        nodes.push_back(n);
        extent = std::max({extent, std::abs(draft.nodes[n][0]), std::abs(draft.nodes[n][1]), std::abs(heights[n])});
    }
    constexpr double flatness = 1e-9;  // of the largest coordinate: text files keep 16 digits, older ones fewer
    std::vector<std::int64_t> off;
    for (const std::size_t n : nodes)
        if (!(std::abs(heights[n] - heights[nodes[0]]) <= flatness * extent)) off.push_back(draft.node_labels[n]);
    return off;
}

void drop_loose_names(MeshDraft& draft) {
    const std::vector<char> used = uses_of(draft);
    const auto is_loose = [&](std::int32_t node) { return used[static_cast<std::size_t>(node)] == 0; };
    const auto label = [&](std::int32_t node) { return draft.node_labels[static_cast<std::size_t>(node)]; };
    for (auto& [name, sides] : draft.lines) {
        std::vector<std::int64_t> ends;
        std::erase_if(sides, [&](const auto& side) {
            for (const std::int32_t end : {side.front(), side.back()})
                if (is_loose(end)) ends.push_back(label(end));
            return is_loose(side.front()) || is_loose(side.back());
        });
        if (!ends.empty())
            draft.warnings.push_back(fmt::format("curve \"{}\": what leads to {}, of no element, is left out{}", name,
                                                 numbered("node", std::move(ends)),
                                                 sides.empty() ? ", and nothing of this name stays" : ""));
    }
    for (auto& [name, nodes] : draft.points) {
        std::vector<std::int64_t> lost;
        for (const std::int32_t node : nodes)
            if (is_loose(node)) lost.push_back(label(node));
        std::erase_if(nodes, is_loose);
        if (!lost.empty())
            draft.warnings.push_back(fmt::format("points \"{}\": {}, of no element, left out{}", name,
                                                 numbered("node", std::move(lost)),
                                                 nodes.empty() ? ", and nothing of this name stays" : ""));
    }
    std::erase_if(draft.lines, [](const auto& line) { return line.second.empty(); });
    std::erase_if(draft.points, [](const auto& points) { return points.second.empty(); });
}

}  // namespace gneiss
