#include "refined_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "mesh/boundary.hpp"
#include "mesh/composite.hpp"
#include "mesh/geometry.hpp"

namespace gneiss::crosscheck {
namespace {

/// The node in the middle of two; made when it is first asked for.
class MidNodes {
public:
    explicit MidNodes(std::vector<Point2>& nodes) : nodes_(nodes) {}

    std::int32_t operator()(std::int32_t a, std::int32_t b) {
        const auto [low, high] = std::minmax(a, b);
        const std::uint64_t key = static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
        const auto [entry, is_new] = of_edge_.emplace(key, static_cast<std::int32_t>(nodes_.size()));
        if (is_new)
            nodes_.push_back(midpoint(nodes_[static_cast<std::size_t>(a)], nodes_[static_cast<std::size_t>(b)]));
        return entry->second;
    }

private:
    std::vector<Point2>& nodes_;
    std::unordered_map<std::uint64_t, std::int32_t> of_edge_;
};

template <class Value>
std::vector<Value> four_times(const std::vector<Value>& values) {
    std::vector<Value> repeated;
    repeated.reserve(4 * values.size());
    for (const Value& value : values) repeated.insert(repeated.end(), sub_triangles_per_composite, value);
    return repeated;
}

/// Which sub-triangle of its composite an edge of the boundary belongs to.
std::int32_t owner(const Mesh& mesh, const BoundaryEdge& edge) {
    const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(edge.element));
    const auto has = [&](const SubTriangle& abc, std::int32_t node) {
        return std::ranges::any_of(abc, [&](int local) { return nodes[local] == node; });
    };
    const auto found = std::ranges::find_if(
        composite_sub_triangles, [&](const SubTriangle& abc) { return has(abc, edge.a) && has(abc, edge.b); });
    return sub_triangles_per_composite * edge.element +
           static_cast<std::int32_t>(found - composite_sub_triangles.begin());
}

}  // namespace

Mesh refined(const Mesh& composites) {
    Mesh mesh = composites;
    MidNodes middle(mesh.nodes);
    mesh.connectivity.clear();
    mesh.connectivity.reserve(4 * composites.connectivity.size());
    for (std::size_t e = 0; e < composites.n_elements(); ++e)
        for (const SubTriangle& abc : composite_sub_triangles) {
            const auto [i, j, k] = counter_clockwise(abc);
            const std::int32_t *n = composites.element(e), a = n[i], b = n[j], c = n[k];
            mesh.connectivity.insert(mesh.connectivity.end(), {a, middle(a, b), b, middle(b, c), c, middle(c, a)});
        }
    mesh.region = four_times(composites.region);
    mesh.element_labels = four_times(composites.element_labels);
    for (auto& [name, values] : mesh.element_data) values = four_times(values);
    mesh.node_labels.resize(mesh.nodes.size());
    std::iota(mesh.node_labels.begin(), mesh.node_labels.end(), 1);

    for (auto& [name, edges] : mesh.boundaries) {
        std::vector<BoundaryEdge> halves;
        for (const BoundaryEdge& edge : composites.boundaries.at(name)) {
            const std::int32_t mid = middle(edge.a, edge.b), element = owner(composites, edge);
            halves.push_back({edge.a, mid, element});
            halves.push_back({mid, edge.b, element});
        }
        edges = std::move(halves);
        std::vector<std::int32_t>& nodes = mesh.node_sets[name];
        std::vector<std::int32_t> all;
        std::ranges::set_union(nodes, nodes_of(edges), std::back_inserter(all));
        nodes = std::move(all);
    }
    return mesh;
}

}  // namespace gneiss::crosscheck
