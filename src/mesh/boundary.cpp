#include "mesh/boundary.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace gneiss {

std::vector<BoundaryEdge> contour(const Mesh& mesh) {
    // The nodes of an element, CST or composite, are its outline in walking order.
    const int n = mesh.nodes_per_element();
    std::vector<BoundaryEdge> edges;
    edges.reserve(mesh.connectivity.size());
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (int i = 0; i < n; ++i)
            edges.push_back({mesh.element(e)[i], mesh.element(e)[(i + 1) % n], static_cast<std::int32_t>(e)});
    const auto ends = [](const BoundaryEdge& edge) { return std::minmax({edge.a, edge.b}); };
    std::sort(edges.begin(), edges.end(),
              [&](const BoundaryEdge& p, const BoundaryEdge& q) { return ends(p) < ends(q); });
    std::vector<BoundaryEdge> free;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t next = i + 1;
        while (next < edges.size() && ends(edges[next]) == ends(edges[i])) ++next;
        if (next == i + 1) free.push_back(edges[i]);
        i = next;
    }
    return in_walking_order(free);
}

std::vector<BoundaryEdge> in_walking_order(const std::vector<BoundaryEdge>& edges) {
    std::multimap<std::int32_t, BoundaryEdge> from;  // by first node; several where the contour touches itself
    std::map<std::int32_t, int> balance;             // edges that leave a node less those that arrive
    for (const BoundaryEdge& edge : edges) {
        from.emplace(edge.a, edge);
        ++balance[edge.a];
        --balance[edge.b];
    }
    std::vector<BoundaryEdge> ordered;
    const auto walk_from = [&](std::int32_t node) {
        for (auto next = from.find(node); next != from.end(); next = from.find(ordered.back().b)) {
            ordered.push_back(next->second);
            from.erase(next);
        }
    };
    for (const auto& [node, excess] : balance)
        for (int i = 0; i < excess; ++i) walk_from(node);
    while (!from.empty()) walk_from(from.begin()->first);
    return ordered;
}

std::vector<std::int32_t> nodes_of(const std::vector<BoundaryEdge>& edges) {
    std::vector<std::int32_t> nodes;
    for (const BoundaryEdge& edge : edges) {
        nodes.push_back(edge.a);
        nodes.push_back(edge.b);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

}  // namespace gneiss
