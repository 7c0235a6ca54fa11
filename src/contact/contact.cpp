#include "contact/contact.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/errors.hpp"
#include "base/index.hpp"
#include "base/parallel.hpp"
#include "mesh/geometry.hpp"

namespace gneiss {
void Contact::Options::validate() const {
    std::vector<Problem> problems;
    const auto require = [&](bool good, const char* what, double value, const char* range) {
        if (!good)
            problems.push_back({std::string("contact.") + what, fmt::format("given {}, must be {}", value, range)});
    };
    require(thickness > 0, "thickness", thickness, "> 0 m");
    require(friction >= 0 && std::isfinite(friction), "friction", friction, ">= 0");
    require(restitution > 0 && restitution <= 1, "restitution", restitution, "in (0, 1]");
    require(tangential_factor > 0 && std::isfinite(tangential_factor), "tangential_factor", tangential_factor, "> 0");
    require(skin > 0 && std::isfinite(skin), "skin", skin, "> 0 m");
    if (!problems.empty()) throw InputError(problems);
}

Contact::Contact(const PartedMesh& start, std::span<const double> layers, double cap, const Options& options)
    : options_(options),
      remembers_(options.friction > 0 || options.restitution < 1 || options.comes_apart),
      bodies_(start, layers, cap) {
    options_.validate();
    take_constants();
    search(std::vector<double>(2 * bodies_.n_nodes(), 0.0));
}

void Contact::initial_history(std::span<double> history) const {
    if (!remembers_) return;
    std::ranges::fill(history, 0.0);
    Memory(history, bodies_.points().size()).free_all();
}

void Contact::search(std::span<const double> u) const {
    const auto reference = bodies_.reference();
    x_.resize(reference.size());
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = reference[i] + u[i];
    search_.search({x_, bodies_.triangles(), &bodies_.points()}, options_.skin);
    ++n_searches_;
    candidates_.assign(search_.candidates(), bodies_.triangles());
    searched_.assign(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(x_.size()));
}

void Contact::take_constants() {
    targets_.clear();
    for (std::size_t t = 0; t < bodies_.triangles().size(); ++t) {
        const TrianglePotential& potential = bodies_.potential(t);
        targets_.push_back({potential.nodal, potential.bubble, potential.reach,
                            bodies_.compliance(bodies_.body_of_node(bodies_.triangles()[t][0]))});
    }
    points_.clear();
    const ContactorPoints& points = bodies_.points();
    for (std::size_t p = 0; p < points.size(); ++p)
        points_.push_back({points.weight_b[p], options_.thickness * points.length[p],
                           bodies_.compliance(bodies_.body_of_node(points.a[p]))});
}

/// The pair alone, against a spring of stiffness k without friction.
ContactResponse<double, double> Contact::alone(const ContactCandidate& pair, double k) const {
    const auto nodes = nodes_of(pair);
    const auto pick = [](std::span<const double> values, std::int32_t node) {
        return Vec2<double>{values[2 * index(node)], values[2 * index(node) + 1]};
    };
    const TargetConstants& constants = targets_[index(pair.triangle)];
    ContactTarget<double> target{{}, constants.nodal, constants.bubble, constants.reach};
    std::array<Vec2<double>, 3> x;
    for (std::size_t i = 0; i < 3; ++i) {
        x[i] = pick(x_, nodes[2 + i]);
        target.reference[i] = pick(bodies_.reference(), nodes[2 + i]);
    }
    return contact_response(pick(point_x_, pair.point), x, target, ContactLaw<double>{k, k, 0.0, 1.0},
                            ContactHistory<double>{});
}

double Contact::largest_motion(std::span<const double> u, std::span<const double> since) const {
    double largest = 0;  // squared
    for (std::size_t i = 0; i < since.size(); i += 2) {
        const double dx = u[i] - since[i], dy = u[i + 1] - since[i + 1];
        const double way = dx * dx + dy * dy;
        largest = way <= largest ? largest : way;  // NaN stays
    }
    return std::sqrt(largest);
}

void Contact::search_if_stale(std::span<const double> u) const {
    if (!(largest_motion(u, searched_) <= 0.5 * options_.skin)) search(u);
}

bool Contact::look(const State& accepted) {
    if (!coupled_) return false;
    const auto u = bonded(accepted.u);
    const bool follows = looked_u_.size() == searched_.size();  // the mesh has not come apart since
    const double way = largest_motion(u, follows ? looked_u_ : searched_);
    const double dt = accepted.t - looked_at_.value_or(accepted.t);
    looked_u_.assign(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(searched_.size()));
    looked_at_ = accepted.t;
    // The next step may be as long as any of the last ones, and go a little further.
    constexpr double forgotten = 0.05;  // a step
    longest_dt_ = std::max((1 - forgotten) * longest_dt_, dt);
    const double next = dt > 0 ? way * (longest_dt_ / dt) : way;
    return largest_motion(u, searched_) + 2 * next > 0.5 * options_.skin && search_at(u);
}

bool Contact::renew(const State& accepted) {
    const auto u = bonded(accepted.u);
    looked_u_.assign(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(searched_.size()));
    looked_at_ = accepted.t;
    longest_dt_ = 0;
    return search_at(u);
}

/// @return whether the candidates have changed
bool Contact::search_at(std::span<const double> u) {
    const std::vector<ContactCandidate> before = candidates_.pairs;
    search(u);
    return before != candidates_.pairs;
}

void Contact::follow(const Parting& parting, const State& accepted, std::vector<double>& history,
                     PathEnergies& energies) {
    const std::span<const double> u_before =
        bodies_.displacements(std::span(accepted.u).first(2 * bodies_.n_mesh_nodes()), u_);
    const double before = stored(u_before, history);
    const ContactorPoints old_points = bodies_.points();
    const std::size_t n_old = old_points.size();
    std::vector<double> depths(contact_slots * n_old, 0.0);  // of the points in their slots
    for (std::size_t hit = 0; remembers_ && hit < hits_.size(); ++hit) {
        if (known_[hit] == 0) continue;
        const ContactCandidate& pair = candidates_.pairs[index(hits_[hit])];
        const std::size_t point = index(pair.point), slot = index(slots_[hit]);
        depths[contact_slots * point + slot] =
            alone(pair, 1.0).depth - AcceptedMemory(history, n_old).at(point, slot).rest;
    }
    bodies_.follow(parting);
    const std::span<const double> u = bonded(accepted.u);
    take_constants();
    search(u);
    if (remembers_) {
        const ContactorPoints& points = bodies_.points();
        std::vector<double> now(Memory::size(points.size()), 0.0);
        const Memory memory(now, points.size());
        const AcceptedMemory old(history, n_old);
        memory.free_all();
        memory.friction() = old.friction();
        memory.restitution() = old.restitution();
        const std::vector<FormerPoint> former = former_points(old_points, points);
        for (std::size_t p = 0; p < points.size(); ++p)
            for (std::size_t slot = 0; slot < contact_slots && former[p].point >= 0; ++slot)
                if (const std::size_t q = index(former[p].point); old.triangle(q, slot) >= 0)
                    memory.set(p, slot, old.triangle(q, slot), old.at(q, slot));
        history = settled(u, keep_forces(u, depths, former, now));
    }
    energies.splitting += stored(u, history) - before;
}

/// Every point in touch goes on with the force that it had: what it is deeper than that takes is its rest depth; where
/// edges of a crack have made it answer for more length, less depth and slip will do. The anchor follows where bonded
/// nodes have jumped from the mean of many to that of fewer.
std::vector<double> Contact::keep_forces(std::span<const double> u, const std::vector<double>& depths,
                                         std::span<const FormerPoint> former, const std::vector<double>& history) {
    find_hits(u);
    match(history);
    std::vector<double> kept_history = history;
    const AcceptedMemory old(history, points_.size());
    const Memory memory(kept_history, points_.size());
    memory.free_all();  // what has lost its body has lost its spring, which stored() will not find any more
    for (std::size_t hit = 0; hit < hits_.size(); ++hit) {
        if (slots_[hit] < 0) continue;
        const ContactCandidate& pair = candidates_.pairs[index(hits_[hit])];
        const std::size_t point = index(pair.point), slot = index(slots_[hit]);
        const auto now = alone(pair, 1.0);
        ContactHistory<double> kept = now.next;
        kept.deepest = 0;
        double depth = 0;
        if (known_[hit] != 0) {
            const double share = former[point].share;
            kept = old.at(point, slot);
            kept.slip = share * kept.slip;
            kept.slip_limit *= share;
            kept.deepest *= share;
            kept.anchor = now.next.anchor - kept.slip;
            depth = share * std::max(0.0, depths[contact_slots * index(former[point].point) + slot]);
        }
        kept.rest = std::max(0.0, now.depth - depth);
        memory.set(point, slot, pair.triangle, kept);
    }
    return kept_history;
}

/// The history that an evaluation at rest leaves: what springs lose on new tangents, or to less friction, is lost here,
/// and not once more in the next step.
std::vector<double> Contact::settled(std::span<const double> u, const std::vector<double>& history) {
    std::vector<double> after = history;
    Memory(after, points_.size()).free_all();
    find_hits(u);
    match(history);
    respond(history, after);
    return after;
}

std::array<std::int32_t, nodes_per_candidate> Contact::nodes_of(const ContactCandidate& pair) const {
    const auto& [i, j, k] = bodies_.triangles()[index(pair.triangle)];
    return {bodies_.points().a[index(pair.point)], bodies_.points().b[index(pair.point)], i, j, k};
}

void Contact::held_by(const ContactCandidate& pair, std::vector<Held>& nodes) const {
    nodes.clear();
    const auto bonded_nodes = nodes_of(pair);
    for (std::size_t local = 0; local < nodes_per_candidate; ++local) {
        for (const std::int32_t node : bodies_.held(bonded_nodes[local]))
            nodes.push_back({node, local, bodies_.share(node)});
    }
}

std::vector<std::array<std::int32_t, 2>> Contact::couplings() const {
    std::vector<std::array<std::int32_t, 2>> all;
    std::vector<Held> nodes;
    coupled_ = true;
    first_coupling_.clear();
    for (const ContactCandidate& pair : candidates_.pairs) {
        first_coupling_.push_back(all.size());
        held_by(pair, nodes);
        for (const Held& a : nodes)
            for (const Held& b : nodes) all.push_back({a.node, b.node});
    }
    return all;
}

// A pair in touch has the stiffness k (g w)(g w)^T, w = (1 - s, s, -lambda_0, -lambda_1, -lambda_2), and because the
// magnitudes of w add up to 2, Cauchy's inequality bounds it by the diagonal matrix 2 k |g|^2 |w_j|. A central
// difference evaluates its bound every so many steps: it must hold for contacts that begin before the next time. So
// every contactor point counts as if it pressed with the stiffest partner, always, and a boundary node, as a target, as
// if a surface of points lay along its edges, which gives it as much again; or what is in touch now, where that is
// more: corners that gather in one triangle, several bodies in one. Left out: |g| above 1 in triangles compressed
// later, and the change of g with the displacements, of relative size depth over element; both within the usual safety
// factor.
void Contact::bound_stiffness(std::span<const double> u) const {
    const ContactorPoints& points = bodies_.points();
    const std::size_t n = bodies_.n_nodes();
    const double h = options_.thickness, least = bodies_.least_compliance();
    const double factor =
        1 / (options_.restitution * options_.restitution) + (options_.friction > 0 ? options_.tangential_factor : 0.0);
    bound_.assign(n, 0.0);
    target_bound_.assign(n, 0.0);
    find_hits(u);
    for (const std::int32_t hit : hits_) {
        const ContactCandidate& pair = candidates_.pairs[index(hit)];
        const auto nodes = nodes_of(pair);
        const double w = points.weight_b[index(pair.point)], k = stiffness_of(pair);
        const auto response = alone(pair, k);
        if (response.depth == 0) continue;
        const double g = std::sqrt(dot(response.force, response.force)) / (k * response.depth);
        const double most = 2 * factor * k * g * g;
        bound_[index(nodes[0])] += most * (1 - w);
        bound_[index(nodes[1])] += most * w;
        for (std::size_t j = 0; j < 3; ++j) target_bound_[index(nodes[2 + j])] += most * response.lambda[j];
    }
    std::vector<double> always(n, 0.0);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double most = 2 * factor * points_[p].area / (points_[p].layer + least);
        always[index(points.a[p])] += most * (1 - points.weight_b[p]);
        always[index(points.b[p])] += most * points.weight_b[p];
    }
    for (std::size_t node = 0; node < n; ++node) {
        const double length = bodies_.boundary_length()[node];
        const double as_target =
            length > 0 ? 2 * factor * h * length /
                             (bodies_.compliance(bodies_.body_of_node(static_cast<std::int32_t>(node))) + least)
                       : 0.0;
        bound_[node] = std::max(bound_[node], always[node]) + std::max(target_bound_[node], as_target);
    }
}

// The nodes that a bonded one holds share its bound by their masses: its displacement is their mean with these weights,
// and the square of a mean is at most the mean of squares. So the bound over the mass is that of the bonded node.
double Contact::omega_squared(const Trial& trial, std::span<const double>, std::span<const double> lumped_mass) const {
    bound_stiffness(bonded(trial.u));
    double largest = 0;
    for (std::size_t node = 0; node < bound_.size(); ++node) {
        double mass = 0;
        for (const std::int32_t one : bodies_.held(static_cast<std::int32_t>(node)))
            mass += lumped_mass[2 * index(one)];
        largest = std::max(largest, bound_[node] / mass);
    }
    return largest;
}

void Contact::add_stiffness_bound(const Trial& trial, std::span<const double>, std::span<double> bound) const {
    bound_stiffness(bonded(trial.u));
    std::vector<double> both(2 * bound_.size());
    for (std::size_t node = 0; node < bound_.size(); ++node) both[2 * node] = both[2 * node + 1] = bound_[node];
    bodies_.spread(both, bound);
}

void Contact::add_stored(const Trial& accepted, std::span<const double> history, StoredEnergies& energies) const {
    energies.contact += stored(bonded(accepted.u), history);
}

void Contact::add_dissipated(std::span<const double> from, std::span<const double> to, PathEnergies& energies) const {
    if (!remembers_) return;
    const AcceptedMemory before(from, bodies_.points().size()), after(to, bodies_.points().size());
    energies.friction += after.friction() - before.friction();
    energies.contact += after.restitution() - before.restitution();
}

std::vector<ContactOverlap> Contact::overlaps(std::span<const double> u, double tolerance) const {
    std::vector<ContactOverlap> all;
    find_hits(bonded(u));
    for (const std::int32_t hit : hits_) {
        const ContactCandidate& pair = candidates_.pairs[index(hit)];
        const auto nodes = nodes_of(pair);
        const Vec2<double> p{point_x_[2 * index(pair.point)], point_x_[2 * index(pair.point) + 1]};
        const auto response = alone(pair, 1.0);
        if (response.depth > tolerance)
            all.push_back({bodies_.node_label(nodes[0]),
                           bodies_.node_label(nodes[1]),
                           bodies_.element_label(pair.triangle),
                           {p.x, p.y},
                           response.depth});
    }
    return all;
}

Gaps Contact::gaps(std::span<const double> u) const {
    find_hits(bonded(u));
    Gaps gaps;
    auto hit = hits_.begin();
    for (std::size_t candidate = 0; candidate < candidates_.pairs.size(); ++candidate) {
        const bool inside = hit != hits_.end() && index(*hit) == candidate;
        if (inside) ++hit;
        const ContactCandidate& pair = candidates_.pairs[candidate];
        const auto nodes = nodes_of(pair);
        const std::int32_t one = bodies_.body_of_node(nodes[0]), other = bodies_.body_of_node(nodes[2]);
        if (one == other) continue;
        const auto at = [](const std::vector<double>& x, std::int32_t i) {
            return Point2{x[2 * index(i)], x[2 * index(i) + 1]};
        };
        const double gap = inside ? -alone(pair, 1.0).depth
                                  : distance_to_triangle(at(point_x_, pair.point), at(x_, nodes[2]), at(x_, nodes[3]),
                                                         at(x_, nodes[4]));
        const auto [found, first] = gaps.try_emplace(std::minmax(one, other), gap);
        if (!first) found->second = std::min(found->second, gap);
    }
    return gaps;
}

std::vector<ContactPlace> Contact::places(std::span<const double> u) const {
    find_hits(bonded(u));
    constexpr double inside = 1e-6;  // before the edge, not before one of its ends
    std::vector<ContactPlace> all;
    const auto at = [&](std::int32_t node) { return Vec2<double>{x_[2 * index(node)], x_[2 * index(node) + 1]}; };
    for (const ContactCandidate& pair : candidates_.pairs) {
        const auto& triangle = bodies_.triangles()[index(pair.triangle)];
        const Vec2<double> p{point_x_[2 * index(pair.point)], point_x_[2 * index(pair.point) + 1]};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t from = triangle[(k + 1) % 3], to = triangle[(k + 2) % 3];
            const std::array<double, 3>& potential = targets_[index(pair.triangle)].nodal;
            if (potential[(k + 1) % 3] > 0 || potential[(k + 2) % 3] > 0) continue;  // no edge of the boundary
            const Vec2<double> edge = at(to) - at(from), arm = p - at(from);
            const double length = std::sqrt(dot(edge, edge)), along = dot(edge, arm) / (length * length);
            const Vec2<double> normal{edge.y / length, -edge.x / length};
            const double gap = dot(normal, arm);
            if (along < inside || along > 1 - inside || std::abs(gap) > options_.skin) continue;
            all.push_back(
                {bodies_.held(bodies_.points().a[index(pair.point)])[0], bodies_.held(from)[0], {p.x, p.y}, normal});
        }
    }
    return all;
}

}  // namespace gneiss
