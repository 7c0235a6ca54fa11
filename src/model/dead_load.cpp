#include "model/dead_load.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "mesh/composite.hpp"
#include "mesh/geometry.hpp"

namespace gneiss {
namespace {

Vec2<double> position(const Mesh& mesh, std::int32_t node) {
    const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
    return {x[0], x[1]};
}

Vec2<double> evaluate(const Field& field, const Vec2<double>& x) { return {field[0](x.x, x.y), field[1](x.x, x.y)}; }

}  // namespace

DeadLoad::DeadLoad(std::string name, std::vector<LoadShare> shares, Amplitude amplitude)
    : name_(std::move(name)), amplitude_(std::move(amplitude)) {
    std::ranges::copy_if(shares, std::back_inserter(on_edges_), [](const LoadShare& s) { return s.element >= 0; });
    const bool by_place = amplitude_.depends_on_position();
    const auto key = [by_place](const LoadShare& s) {
        return by_place ? std::tuple(s.node, s.at.x, s.at.y) : std::tuple(s.node, 0.0, 0.0);
    };
    std::stable_sort(shares.begin(), shares.end(),
                     [&](const LoadShare& p, const LoadShare& q) { return key(p) < key(q); });
    for (const LoadShare& share : shares) {
        if (!shares_.empty() && key(shares_.back()) == key(share)) {
            shares_.back().force += share.force;
        } else {
            shares_.push_back(share);
        }
    }
}

void DeadLoad::add_force(const Trial& trial, std::span<double> f) const {
    const Amplitude::Instant amplitude = amplitude_.at(trial.t, trial.last_event);
    for (const LoadShare& share : shares_) {
        const double a = amplitude(share.at.x, share.at.y);
        const std::size_t x = 2 * static_cast<std::size_t>(share.node);
        f[x] += a * share.force.x;
        f[x + 1] += a * share.force.y;
    }
}

void DeadLoad::corner_forces(const Trial& trial, std::vector<CornerForce>& forces) const {
    const Amplitude::Instant amplitude = amplitude_.at(trial.t, trial.last_event);
    for (const LoadShare& share : on_edges_)
        forces.push_back({share.element, share.node, amplitude(share.at.x, share.at.y) * share.force});
}

void DeadLoad::add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const {
    const Amplitude::Instant before = amplitude_.at(from.t, from.last_event);
    const Amplitude::Instant after = amplitude_.at(to.t, to.last_event);
    double work = 0;
    for (const LoadShare& share : shares_) {
        const double mean = 0.5 * (before(share.at.x, share.at.y) + after(share.at.x, share.at.y));
        const std::size_t x = 2 * static_cast<std::size_t>(share.node);
        work += mean * (share.force.x * (to.u[x] - from.u[x]) + share.force.y * (to.u[x + 1] - from.u[x + 1]));
    }
    energies.external_work += work;
}

std::vector<LoadShare> nodal_force_shares(const Mesh& mesh, const std::vector<std::int32_t>& nodes,
                                          const Field& value) {
    // copies of a node that has parted share the force of the one that they were
    std::map<std::pair<double, double>, double> n_at;
    for (const std::int32_t node : nodes) {
        const Vec2<double> x = position(mesh, node);
        n_at[{x.x, x.y}] += 1;
    }
    std::vector<LoadShare> shares;
    for (const std::int32_t node : nodes) {
        const Vec2<double> x = position(mesh, node);
        shares.push_back({node, (1 / n_at[{x.x, x.y}]) * evaluate(value, x), x});
    }
    return shares;
}

std::vector<LoadShare> traction_shares(const Mesh& mesh, const std::vector<BoundaryEdge>& edges, const Field& value,
                                       double thickness) {
    std::vector<LoadShare> shares;
    for (const BoundaryEdge& edge : edges) {
        const Vec2<double> a = position(mesh, edge.a), b = position(mesh, edge.b);
        const Vec2<double> t_a = evaluate(value, a), t_b = evaluate(value, b);
        const double sixth = thickness * std::hypot(b.x - a.x, b.y - a.y) / 6;
        shares.push_back({edge.a, 2 * sixth * t_a, a, edge.element});
        shares.push_back({edge.a, sixth * t_b, b, edge.element});
        shares.push_back({edge.b, sixth * t_a, a, edge.element});
        shares.push_back({edge.b, 2 * sixth * t_b, b, edge.element});
    }
    return shares;
}

std::vector<LoadShare> body_force_shares(const Mesh& mesh, const std::vector<std::int32_t>& elements,
                                         const Field& value, double thickness) {
    std::vector<LoadShare> shares;
    const auto share_out = [&](const std::int32_t* nodes, const std::array<int, 3>& corners) {
        const auto point = [&](int corner) { return mesh.nodes[static_cast<std::size_t>(nodes[corner])]; };
        const double third = thickness * triangle_area(point(corners[0]), point(corners[1]), point(corners[2])) / 3;
        for (int corner : corners) {
            const Vec2<double> x = position(mesh, nodes[corner]);
            shares.push_back({nodes[corner], third * evaluate(value, x), x});
        }
    };
    for (std::int32_t e : elements) {
        const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(e));
        if (mesh.kind == ElementKind::cst) {
            share_out(nodes, {0, 1, 2});
        } else {
            for (const SubTriangle& abc : composite_sub_triangles) share_out(nodes, counter_clockwise(abc));
        }
    }
    return shares;
}

}  // namespace gneiss
