#include "fracture/nodal_criterion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gneiss {
namespace {

std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number); }

bool by_node(const CornerForce& a, const CornerForce& b) { return a.node < b.node; }

}  // namespace

FanInterface NodalCriterion::interface_of(const State& state, const Fan::Interface& at) {
    const Mesh& mesh = parts_.mesh;
    const ElementSide& left = parts_.inner.sides()[index(at.at.side)].left;
    const auto local = side_nodes(mesh.kind, left.side);
    const std::int32_t* nodes = mesh.element(index(left.element));
    const std::size_t a = index(nodes[local[at.part]]), b = index(nodes[local[at.part + 1]]);
    const Vec2<double> edge{mesh.nodes[b][0] - mesh.nodes[a][0], mesh.nodes[b][1] - mesh.nodes[a][1]};
    const Vec2<double> now{edge.x + (state.u[2 * b] - state.u[2 * a]),
                           edge.y + (state.u[2 * b + 1] - state.u[2 * a + 1])};
    const double length = std::sqrt(dot(now, now));
    const Vec2<double> along = (1 / length) * now, normal{along.y, -along.x};
    const auto [xx, yy, xy] = response_.mean_stress(at.at.side, at.part);
    return {0.5 * parts_.thickness * std::sqrt(dot(edge, edge)),
            normal,
            along,
            at.left_to_right ? 1.0 : -1.0,
            {xx * normal.x + xy * normal.y, xy * normal.x + yy * normal.y},
            &parts_.properties[(local.size() - 1) * index(at.at.side) + at.part]};
}

void NodalCriterion::find_corner_forces(const State& state) {
    corner_forces_.clear();
    parts_.solid.corner_forces(state, corner_forces_);
    parts_.joints.corner_forces(state, parts_.solid.history_of(parts_.joints, state), corner_forces_);
    std::ranges::stable_sort(corner_forces_, by_node);
    has_corner_forces_ = true;
}

template <class Visit>
void NodalCriterion::for_each_node(const State& state, Visit visit) {
    ++look_;
    has_corner_forces_ = false;
    candidates_.clear();
    looked_at_.resize(parts_.mesh.n_nodes(), -1);
    const auto n = static_cast<std::size_t>(parts_.mesh.nodes_per_element());
    for_each_element_beyond(state, [&](std::int32_t element) {
        for (const std::int32_t node : std::span(parts_.mesh.element(index(element)), n))
            if (std::exchange(looked_at_[index(node)], look_) != look_) candidates_.push_back(node);
    });
    const auto constraints = parts_.solid.constraints();
    for (const std::int32_t node : candidates_) {
        find_fan(parts_.mesh, parts_.inner, node, fan_);
        if (fan_.interfaces.empty()) continue;
        corners_.clear();
        interfaces_.clear();
        for (const Fan::Corner& corner : fan_.corners)
            corners_.push_back(
                {response_.force(corner.element, corner.node), response_.mass(corner.element, corner.node)});
        for (const Fan::Interface& at : fan_.interfaces) interfaces_.push_back(interface_of(state, at));
        if (interfaces_.size() < corners_.size()) {
            if (!has_corner_forces_) find_corner_forces(state);
            const CornerForce of_node{0, node, {0, 0}};
            const auto [first, last] = std::equal_range(corner_forces_.begin(), corner_forces_.end(), of_node, by_node);
            for (auto force = first; force != last; ++force)
                for (std::size_t k = 0; k < corners_.size(); ++k)
                    if (fan_.corners[k].element == force->element) corners_[k].force += force->force;
        }
        std::array<bool, 2> held{};
        for (std::size_t c = 0; c < 2; ++c)
            held[c] = std::ranges::binary_search(constraints, 2 * index(node) + c, {}, &Constraint::dof);
        find_rupture(corners_, interfaces_, held, rupture_);
        visit(fan_, rupture_);
    }
}

CrackOpenings NodalCriterion::find(const State& state) {
    CrackOpenings found;
    for_each_node(state, [&](const Fan& fan, const NodeRupture& rupture) {
        for (const std::size_t k : rupture.opening) {
            const Fan::Interface& at = fan.interfaces[k];
            found.ends.push_back(at.at);
            found.starts.push_back({at.at.side, at.part, at.end, rupture.traction[k]});
        }
    });
    std::ranges::sort(found.ends);
    found.ends.erase(std::unique(found.ends.begin(), found.ends.end()), found.ends.end());
    return found;
}

double NodalCriterion::find_utilisation(const State& state) {
    double largest = 0;
    for_each_node(state,
                  [&](const Fan&, const NodeRupture& rupture) { largest = std::max(largest, rupture.utilisation); });
    return largest;
}

}  // namespace gneiss
