#pragma once
// Solids of several bodies that touch.

#include <cmath>
#include <utility>
#include <vector>

#include "contact/make_contact.hpp"
#include "support/small_solids.hpp"

namespace gneiss::test {

/// One mesh of two; regions and boundaries of the second have a "2" behind their names.
inline Mesh together(Mesh one, const Mesh& two) {
    const auto shift = static_cast<std::int32_t>(one.n_nodes());
    const auto elements = static_cast<std::int32_t>(one.n_elements());
    const auto regions = static_cast<std::int32_t>(one.region_names.size());
    one.nodes.insert(one.nodes.end(), two.nodes.begin(), two.nodes.end());
    for (const std::int32_t node : two.connectivity) one.connectivity.push_back(node + shift);
    for (const std::int32_t region : two.region) one.region.push_back(region + regions);
    for (const std::string& name : two.region_names) one.region_names.push_back(name + "2");
    for (const auto& [name, edges] : two.boundaries)
        for (const BoundaryEdge& edge : edges)
            one.boundaries[name + "2"].push_back({edge.a + shift, edge.b + shift, edge.element + elements});
    for (const auto& [name, nodes] : two.node_sets)
        for (const std::int32_t node : nodes) one.node_sets[name + "2"].push_back(node + shift);
    for (std::size_t node = one.node_labels.size(); node < one.nodes.size(); ++node)
        one.node_labels.push_back(static_cast<std::int64_t>(node) + 1);
    for (const std::int64_t label : two.element_labels) one.element_labels.push_back(label + elements);
    return one;
}

inline Mesh moved(Mesh mesh, double x, double y, double angle = 0) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (auto& node : mesh.nodes) node = {c * node[0] - s * node[1] + x, s * node[0] + c * node[1] + y};
    return mesh;
}

/// With contact of its bodies.
inline Solid touching_solid(Mesh mesh, const ContactOptions& contact, const SolidDescription& what = {},
                            const Contact** made = nullptr) {
    const Mesh copy = mesh;
    return make_solid(std::move(mesh), what, [&](SolidSystem::Parts& parts) {
        auto interaction = make_contact({copy}, parts.blocks, what.solid, contact, false);
        if (made != nullptr) *made = interaction.get();
        parts.interactions.push_back(std::move(interaction));
    });
}

}  // namespace gneiss::test
