#include "contact/penetration_potential.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gneiss {
namespace {

/// Growth of the cap per metre of edge. Along the edges of a sound mesh one walks less than twice the straight
/// distance, so that the cap grows more slowly than the distance to anything: what lies within the cap of a node is
/// found by walking where it is within the caps on the way.
constexpr double cap_growth = 0.5;

}  // namespace

PenetrationPotential::PenetrationPotential(std::vector<Point2> nodes,
                                           std::vector<std::array<std::int32_t, 3>> triangles, double cap)
    : nodes_(std::move(nodes)), triangles_(std::move(triangles)), visited_(triangles_.size(), 0) {
    assert(cap > 0);
    first_around_.assign(nodes_.size() + 1, 0);
    for (const auto& triangle : triangles_)
        for (const std::int32_t node : triangle) ++first_around_[static_cast<std::size_t>(node) + 1];
    for (std::size_t n = 0; n < nodes_.size(); ++n) first_around_[n + 1] += first_around_[n];
    around_.resize(3 * triangles_.size());
    std::vector<std::int32_t> next(first_around_.begin(), first_around_.end() - 1);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (const std::int32_t node : triangles_[t])
            around_[static_cast<std::size_t>(next[static_cast<std::size_t>(node)]++)] = static_cast<std::int32_t>(t);
    cap_by_local_size(cap);
    values_ = caps_;
    potentials_.resize(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) potentials_[t] = potential(t);
}

std::span<const std::int32_t> PenetrationPotential::triangles_around(std::int32_t node) const {
    const auto first = first_around_.begin() + node;
    return {around_.data() + *first, static_cast<std::size_t>(*(first + 1) - *first)};
}

void PenetrationPotential::cap_by_local_size(double cap) {
    caps_.assign(nodes_.size(), 0);
    for (const auto& [i, j, k] : triangles_) {
        const double area =
            std::abs(triangle_area(nodes_[static_cast<std::size_t>(i)], nodes_[static_cast<std::size_t>(j)],
                                   nodes_[static_cast<std::size_t>(k)]));
        const double size = std::sqrt(4 * area / std::sqrt(3.0));
        for (const std::int32_t node : {i, j, k})
            caps_[static_cast<std::size_t>(node)] += cap * size / static_cast<double>(triangles_around(node).size());
    }
    // The unique largest field below that grows slowly enough: sweeps until nothing moves.
    for (bool moved = true; moved;) {
        moved = false;
        for (const auto& triangle : triangles_)
            for (const std::int32_t i : triangle)
                for (const std::int32_t j : triangle) {
                    const auto from = static_cast<std::size_t>(i), to = static_cast<std::size_t>(j);
                    const double most = caps_[from] + cap_growth * distance(nodes_[from], nodes_[to]);
                    if (caps_[to] > most) {
                        caps_[to] = most;
                        moved = true;
                    }
                }
    }
}

void PenetrationPotential::add_boundary(std::span<const std::array<std::int32_t, 2>> edges) {
    lowered_.clear();
    for (const auto& edge : edges)
        for (const std::int32_t node : edge) lower(node, 0);
    for (const auto& edge : edges) lower_near(edge);

    // A crest is a matter of neighbours: two rings of triangles around a lowered node may change.
    changed_.clear();
    ++walk_;
    for (const std::int32_t node : lowered_)
        for (const std::int32_t t : triangles_around(node))
            for (const std::int32_t neighbour : triangles_[static_cast<std::size_t>(t)])
                for (const std::int32_t next : triangles_around(neighbour))
                    if (visit(next)) queue_.push_back(next);
    for (const std::int32_t t : queue_) {
        TrianglePotential& old = potentials_[static_cast<std::size_t>(t)];
        const TrianglePotential now = potential(static_cast<std::size_t>(t));
        if (now.nodal != old.nodal || now.bubble != old.bubble) changed_.push_back(t);
        old = now;
    }
    queue_.clear();
    std::sort(changed_.begin(), changed_.end());
}

bool PenetrationPotential::visit(std::int32_t triangle) {
    std::uint32_t& seen = visited_[static_cast<std::size_t>(triangle)];
    if (seen == walk_) return false;
    seen = walk_;
    return true;
}

void PenetrationPotential::lower(std::int32_t node, double value) {
    double& old = values_[static_cast<std::size_t>(node)];
    if (!(value < old)) return;
    old = value;
    lowered_.push_back(node);
}

void PenetrationPotential::lower_near(const std::array<std::int32_t, 2>& edge) {
    // The straight line from a node to the nearest point of its boundary stays inside the body, and along it this edge
    // is nearer than any other. So the triangles on the way have nodes whose distance to the edge exceeds their own
    // potential by two diameters at most: one from the line to the node for either.
    const Point2 &a = nodes_[static_cast<std::size_t>(edge[0])], &b = nodes_[static_cast<std::size_t>(edge[1])];
    ++walk_;
    queue_.clear();
    for (const std::int32_t end : edge)
        for (const std::int32_t t : triangles_around(end))
            if (visit(t)) queue_.push_back(t);
    for (std::size_t next = 0; next < queue_.size(); ++next) {
        const auto& triangle = triangles_[static_cast<std::size_t>(queue_[next])];
        const auto corner = [&](std::size_t i) { return nodes_[static_cast<std::size_t>(triangle[i])]; };
        const double diameter =
            std::max({distance(corner(0), corner(1)), distance(corner(1), corner(2)), distance(corner(2), corner(0))});
        bool near = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const double to_edge = distance_to_edge(corner(i), a, b);
            lower(triangle[i], to_edge);
            near |= to_edge <= at_node(triangle[i]) + 2 * diameter;
        }
        if (!near) continue;
        for (const std::int32_t node : triangle)
            for (const std::int32_t t : triangles_around(node))
                if (visit(t)) queue_.push_back(t);
    }
    queue_.clear();
}

bool PenetrationPotential::is_crest(std::int32_t node) const {
    const double value = at_node(node);
    if (value >= caps_[static_cast<std::size_t>(node)]) return true;
    for (const std::int32_t t : triangles_around(node))
        for (const std::int32_t neighbour : triangles_[static_cast<std::size_t>(t)])
            if (at_node(neighbour) > value) return false;
    return true;
}

TrianglePotential PenetrationPotential::potential(std::size_t t) const {
    const auto& triangle = triangles_[t];
    TrianglePotential result;
    std::size_t top = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        result.nodal[i] = at_node(triangle[i]);
        if (result.nodal[i] > result.nodal[top]) top = i;
    }
    if (result.nodal[top] == 0) {
        const Point2 &p = nodes_[static_cast<std::size_t>(triangle[0])],
                     &q = nodes_[static_cast<std::size_t>(triangle[1])],
                     &r = nodes_[static_cast<std::size_t>(triangle[2])];
        const double inradius =
            2 * std::abs(triangle_area(p, q, r)) / (distance(p, q) + distance(q, r) + distance(r, p));
        result.bubble = 3 * inradius;
        result.reach = trusted_depth * inradius;
    } else if (is_crest(triangle[top])) {
        result.reach = trusted_depth * result.nodal[top];
    }
    return result;
}

}  // namespace gneiss
