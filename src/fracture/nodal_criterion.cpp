#include "fracture/nodal_criterion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/index.hpp"
#include "base/parallel.hpp"

namespace gneiss {
namespace {

bool by_node(const CornerForce& a, const CornerForce& b) { return a.node < b.node; }

/// Candidates that one thread looks at at a time: some tens of microseconds.
constexpr std::ptrdiff_t range = 256;

}  // namespace

void NodalCriterion::find_candidates(const State& state) {
    ++look_;
    const std::size_t n_nodes = parts_.mesh.n_nodes();
    looked_at_.resize(n_nodes, -1);
    open_fan_.resize(n_nodes, 0);
    held_.resize(n_nodes, 0);
    candidates_.clear();
    const auto n = static_cast<std::size_t>(parts_.mesh.nodes_per_element());
    for_each_element_beyond(state, [&](std::int32_t element) {
        for (const std::int32_t node : std::span(parts_.mesh.element(index(element)), n)) {
            if (std::exchange(looked_at_[index(node)], look_) == look_) continue;
            fans_.require(node, response_);
            const FanTable::View fan = fans_.at(node);
            if (fan.interfaces.empty()) continue;
            candidates_.push_back(node);
            open_fan_[index(node)] = !fan.closed();
            for (const FanTable::Corner& corner : fan.corners) response_.want(corner.pack);
        }
    });
}

void NodalCriterion::find_corner_forces(const State& state) {
    corner_forces_.clear();
    if (std::ranges::none_of(candidates_, [&](std::int32_t node) { return open_fan_[index(node)] != 0; })) return;
    parts_.solid.corner_forces(state, corner_forces_);
    std::erase_if(corner_forces_, [&](const CornerForce& force) { return open_fan_[index(force.node)] == 0; });
    parts_.joints.corner_forces(state, parts_.solid.history_of(parts_.joints, state), open_fan_, corner_forces_);
    std::ranges::stable_sort(corner_forces_, by_node);
}

void NodalCriterion::add_openings(std::int32_t node, const NodeRupture& rupture, CrackOpenings& openings) const {
    Fan fan;
    find_fan(parts_.mesh, parts_.inner, node, fan);
    for (const std::size_t k : rupture.opening) {
        const Fan::Interface& at = fan.interfaces[k];
        openings.ends.push_back(at.at);
        openings.starts.push_back({at.at.side, at.part, at.end, rupture.traction[k]});
    }
}

void NodalCriterion::look_at_node(const State& state, std::int32_t node, Found& found) const {
    const FanTable::View fan = fans_.at(node);
    found.corners.clear();
    for (const FanTable::Corner& corner : fan.corners)
        found.corners.push_back({response_.force_at(corner.force), corner.mass});
    const std::uint8_t held = held_[index(node)];
    if (fan.closed() && held == 0)
        if (const double bound = bound_of_closed_fan(found.corners, fan.per_force_squared); bound < 1) {
            found.utilisation = std::max(found.utilisation, bound);
            return;
        }
    found.interfaces.clear();
    for (const FanTable::Interface& at : fan.interfaces) {
        const std::size_t a = 2 * index(at.a), b = 2 * index(at.b);
        const Vec2<double> now{at.edge.x + (state.u[b] - state.u[a]), at.edge.y + (state.u[b + 1] - state.u[a + 1])};
        const Vec2<double> along = (1 / std::sqrt(dot(now, now))) * now, normal{along.y, -along.x};
        const auto [xx, yy, xy] = response_.mean_stress_at(at.left, at.right);
        found.interfaces.push_back({at.weight,
                                    normal,
                                    along,
                                    at.sense,
                                    {xx * normal.x + xy * normal.y, xy * normal.x + yy * normal.y},
                                    at.properties,
                                    at.per_area});
    }
    if (!fan.closed()) {
        const CornerForce of_node{0, node, {0, 0}};
        const auto [first, last] = std::equal_range(corner_forces_.begin(), corner_forces_.end(), of_node, by_node);
        for (auto force = first; force != last; ++force)
            for (std::size_t k = 0; k < fan.corners.size(); ++k)
                if (fan.corners[k].element == force->element) found.corners[k].force += force->force;
    }
    find_rupture(found.corners, found.interfaces, {(held & 1) != 0, (held & 2) != 0}, found.rupture);
    found.utilisation = std::max(found.utilisation, found.rupture.utilisation);
    if (!found.rupture.opening.empty()) add_openings(node, found.rupture, found.openings);
}

auto NodalCriterion::look(const State& state) -> std::span<Found> {
    find_candidates(state);
    response_.find_wanted();
    find_corner_forces(state);
    const auto constraints = parts_.solid.constraints();
    for (const Constraint& constraint : constraints)
        held_[constraint.dof / 2] |= static_cast<std::uint8_t>(1U << constraint.dof % 2);
    const std::size_t n_ranges = (candidates_.size() + range - 1) / range;
    if (found_.size() < n_ranges) found_.resize(n_ranges);
    parallel_ranges(
        candidates_.size(),
        [&](std::size_t first, std::size_t last) {
            Found& found = found_[first / range];
            found.openings.ends.clear();
            found.openings.starts.clear();
            found.utilisation = 0;
            for (std::size_t i = first; i < last; ++i) look_at_node(state, candidates_[i], found);
        },
        range);
    for (const Constraint& constraint : constraints) held_[constraint.dof / 2] = 0;
    for (const std::int32_t node : candidates_) open_fan_[index(node)] = 0;
    return std::span(found_).first(n_ranges);
}

CrackOpenings NodalCriterion::find(const State& state) {
    CrackOpenings all;
    for (const Found& found : look(state)) {
        all.ends.insert(all.ends.end(), found.openings.ends.begin(), found.openings.ends.end());
        all.starts.insert(all.starts.end(), found.openings.starts.begin(), found.openings.starts.end());
    }
    std::ranges::sort(all.ends);
    all.ends.erase(std::unique(all.ends.begin(), all.ends.end()), all.ends.end());
    return all;
}

double NodalCriterion::find_utilisation(const State& state) {
    double largest = 0;
    for (const Found& found : look(state)) largest = std::max(largest, found.utilisation);
    return largest;
}

}  // namespace gneiss
