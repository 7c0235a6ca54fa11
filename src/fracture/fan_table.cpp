#include "fracture/fan_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/index.hpp"

namespace gneiss {

void FanTable::require(std::int32_t node, ElementResponse& response) {
    if (ranges_.size() < mesh_.n_nodes()) ranges_.resize(mesh_.n_nodes());
    if (ranges_[index(node)].n_corners > 0) return;
    find_fan(mesh_, inner_, node, fan_);
    ranges_[index(node)] = {corners_.size(), interfaces_.size(), static_cast<std::uint32_t>(fan_.corners.size()),
                            static_cast<std::uint32_t>(fan_.interfaces.size())};
    for (const Fan::Corner& corner : fan_.corners)
        corners_.push_back({response.mass(corner.element, corner.node), corner.element,
                            static_cast<std::uint32_t>(response.force_place(corner.element, corner.node)),
                            static_cast<std::uint32_t>(response.pack_of(corner.element))});
    for (const Fan::Interface& at : fan_.interfaces) {
        const InnerSide& side = inner_.sides()[index(at.at.side)];
        const auto local = side_nodes(mesh_.kind, side.left.side);
        const std::size_t n_parts = local.size() - 1;
        const std::int32_t* nodes = mesh_.element(index(side.left.element));
        const std::int32_t a = nodes[local[at.part]], b = nodes[local[at.part + 1]];
        const auto& from = mesh_.nodes[index(a)];
        const auto& to = mesh_.nodes[index(b)];
        const Vec2<double> edge{to[0] - from[0], to[1] - from[1]};
        const double weight = 0.5 * thickness_ * std::sqrt(dot(edge, edge)), sense = at.left_to_right ? 1.0 : -1.0;
        const CohesionProperties<double>& p = properties_[n_parts * index(at.at.side) + at.part];
        interfaces_.push_back({a, b, edge, weight, sense, sense / weight, response.stress_place(side.left, at.part),
                               response.stress_place(side.right, n_parts - 1 - at.part), &p});
        const double reach = weight * std::min(p.tensile_strength, p.cohesion);
        per_force_squared_.push_back(1 / (reach * reach));
    }
}

void FanTable::forget(std::span<const std::int32_t> elements) {
    if (ranges_.empty()) return;
    ranges_.resize(mesh_.n_nodes());
    const auto n = static_cast<std::size_t>(mesh_.nodes_per_element());
    for (const std::int32_t element : elements)
        for (const std::int32_t node : std::span(mesh_.element(index(element)), n))
            n_forgotten_ += std::exchange(ranges_[index(node)], {}).n_corners;
    if (2 * n_forgotten_ < corners_.size()) return;
    // more gaps than fans: begin anew
    ranges_.assign(mesh_.n_nodes(), {});
    corners_.clear();
    interfaces_.clear();
    per_force_squared_.clear();
    n_forgotten_ = 0;
}

}  // namespace gneiss
