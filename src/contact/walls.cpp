#include "contact/walls.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/dual.hpp"
#include "base/errors.hpp"
#include "base/index.hpp"

namespace gneiss {
namespace {

/// What a point remembers of one wall: in touch (1 or 0), anchor (m, along the tangent, from the wall's moving point),
/// elastic slip (m), its limit (m), deepest penetration (m).
constexpr std::size_t n_members = 5;

/// Of all walls, in front: force on the bodies (N) of each wall, x and y.
constexpr std::size_t n_per_wall = 2;

}  // namespace

/// Energies of one point in one wall, J, and what accepting would leave.
struct Walls::Response {
    double stored, slid, lost;
    std::array<double, n_members> next;
};

Walls::Walls(const Contact& contact, std::vector<Wall> walls)
    : contact_(contact),
      walls_(std::move(walls)),
      points_(contact.bodies().mesh_points()),
      restitution_(contact.options().restitution),
      tangential_factor_(contact.options().tangential_factor),
      thickness_(contact.options().thickness) {}

std::size_t Walls::n_history() const { return place(walls_.size(), 0); }

std::size_t Walls::place(std::size_t wall, std::size_t point) const {
    return Sums::n + walls_.size() * n_per_wall + (wall * points_.size() + point) * n_members;
}

void Walls::initial_history(std::span<double> history) const {
    std::ranges::fill(history, 0.0);
    if (closer_.empty()) return;
    const std::vector<double> at_rest(2 * contact_.bodies().n_mesh_nodes(), 0.0);
    for (std::size_t w = 0; w < walls_.size(); ++w)
        for (std::size_t point = 0; point < points_.size(); ++point) {
            const double depth = closer(w, point), slip = drawn_[w * points_.size() + point];
            if (depth == 0) continue;
            const double along = dot(position(point, at_rest) - walls_[w].point, turned(walls_[w].normal));
            const std::array<double, n_members> start{1.0, along - slip, slip,
                                                      walls_[w].friction / tangential_factor_ * depth, depth};
            std::ranges::copy(start, history.begin() + static_cast<std::ptrdiff_t>(place(w, point)));
        }
}

void Walls::preload(std::span<const std::array<double, 3>> stress) {
    closer_.assign(walls_.size() * points_.size(), 0.0);
    drawn_ = closer_;
    const ContactBodies& bodies = contact_.bodies();
    const std::vector<double> at_rest(2 * bodies.n_mesh_nodes(), 0.0);
    const double near = overlap_tolerance * bodies.shortest_edge();
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const Wall& wall = walls_[w];
        std::vector<Vec2<double>> force(points_.size(), Vec2<double>{0, 0});  // of the wall, N
        for (std::size_t edge = 0; edge < points_.of_edge.size(); ++edge) {
            const auto& on_edge = points_.of_edge[edge];
            const auto away = [&](std::int32_t point) {
                return std::abs(dot(position(index(point), at_rest) - wall.point, wall.normal));
            };
            if (std::ranges::any_of(on_edge, [&](std::int32_t point) { return away(point) > near; })) continue;
            const auto& [xx, yy, xy] = stress[index(bodies.element_of_edge(edge))];
            const Vec2<double> traction{-(xx * wall.normal.x + xy * wall.normal.y),
                                        -(xy * wall.normal.x + yy * wall.normal.y)};
            const double middle = thickness_ * points_.length[index(on_edge[2])];
            for (std::size_t k = 0; k < 3; ++k)  // Simpson's weights
                force[index(on_edge[k])] += (k == 2 ? middle : 0.25 * middle) * traction;
        }
        for (std::size_t point = 0; point < points_.size(); ++point) {
            const double k = stiffness_of(point), press = dot(force[point], wall.normal);
            if (!(press > 0)) continue;
            const double most = wall.friction * press, shear = dot(force[point], turned(wall.normal));
            closer_[w * points_.size() + point] = press / k;
            drawn_[w * points_.size() + point] = -std::clamp(shear, -most, most) / (tangential_factor_ * k);
        }
    }
}

double Walls::stiffness_of(std::size_t point) const {
    const ContactBodies& bodies = contact_.bodies();
    return 2 * thickness_ * points_.length[point] / bodies.compliance(bodies.body_of_mesh_node(points_.a[point]));
}

Vec2<double> Walls::position(std::size_t point, std::span<const double> u) const {
    const auto reference = contact_.bodies().mesh_reference();
    const auto at = [&](std::int32_t node) {
        const std::size_t k = 2 * index(node);
        return Vec2<double>{reference[k] + u[k], reference[k + 1] + u[k + 1]};
    };
    const double w = points_.weight_b[point];
    return (1 - w) * at(points_.a[point]) + w * at(points_.b[point]);
}

template <class T>
Vec2<T> Walls::force(std::size_t number, std::size_t point, double t, const Vec2<T>& x, std::span<const double> old,
                     Response& response) const {
    const Wall& wall = walls_[number];
    const Vec2<double> p = wall.point + t * wall.velocity, tangent = turned(wall.normal);
    const double k_n = stiffness_of(point), k_t = tangential_factor_ * k_n;
    const T depth = wall.normal.x * (T(p.x) - x.x) + wall.normal.y * (T(p.y) - x.y) + T(closer(number, point));
    const T along = tangent.x * (x.x - T(p.x)) + tangent.y * (x.y - T(p.y));
    // the normal and the friction law of contact_point.hpp
    const double returned = restitution_ * restitution_, lost = 1 - returned, unloading = k_n / returned;
    const T deepest = plain(depth) > old[4] ? depth : T(old[4]);
    const T above = depth - lost * deepest;
    const T held = plain(above) > 0 ? above : T(0.0);
    const T normal = unloading * held;
    const T limit = (wall.friction / k_t) * normal;
    const T trial = old[0] > 0.5 ? along - T(old[1]) : T(0.0);
    const T s = plain(trial) > plain(limit) ? limit : plain(trial) < -plain(limit) ? -limit : trial;
    response.stored = 0.5 * unloading * plain(held) * plain(held) + 0.5 * k_t * plain(s) * plain(s);
    response.lost = 0.5 * k_n * lost * (plain(deepest) * plain(deepest) - old[4] * old[4]);
    response.slid = old[0] > 0.5 ? sliding_work(k_t, old[2], plain(trial), old[3], plain(limit)) : 0.0;
    response.next = {1.0, plain(along) - plain(s), plain(s), plain(limit), plain(deepest)};
    const T shear = k_t * s;
    return {wall.normal.x * normal - tangent.x * shear, wall.normal.y * normal - tangent.y * shear};
}

/// visit(wall, point, position) wherever a point is in a wall, by ascending wall and point.
template <class Visit>
void Walls::for_each_touch(const Trial& trial, Visit visit) const {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const Vec2<double> p = walls_[w].point + trial.t * walls_[w].velocity;
        for (std::size_t point = 0; point < points_.size(); ++point) {
            const Vec2<double> x = position(point, trial.u);
            if (dot(p - x, walls_[w].normal) + closer(w, point) > 0) visit(w, point, x);
        }
    }
}

void Walls::add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                      std::span<double> updated) const {
    std::vector<Vec2<double>> on_bodies(walls_.size(), Vec2<double>{0, 0});
    double slid = 0, lost = 0;
    if (!updated.empty())
        for (std::size_t w = 0; w < walls_.size(); ++w)
            for (std::size_t point = 0; point < points_.size(); ++point) {
                const std::size_t at = place(w, point);
                slid += 0.5 * tangential_factor_ * stiffness_of(point) * history[at + 2] * history[at + 2];
                std::ranges::fill(updated.subspan(at, n_members), 0.0);
            }
    for_each_touch(trial, [&](std::size_t w, std::size_t point, const Vec2<double>& x) {
        const std::size_t at = place(w, point);
        Response response;
        const Vec2<double> force_on = force(w, point, trial.t, x, history.subspan(at, n_members), response);
        const double weight = points_.weight_b[point];
        const std::size_t a = 2 * index(points_.a[point]), b = 2 * index(points_.b[point]);
        f[a] += (1 - weight) * force_on.x;
        f[a + 1] += (1 - weight) * force_on.y;
        f[b] += weight * force_on.x;
        f[b + 1] += weight * force_on.y;
        if (updated.empty()) return;
        on_bodies[w] += force_on;
        // it has kept its spring: what was taken for the energy of one that is released
        slid += response.slid - 0.5 * tangential_factor_ * stiffness_of(point) * history[at + 2] * history[at + 2];
        lost += response.lost;
        std::ranges::copy(response.next, updated.begin() + static_cast<std::ptrdiff_t>(at));
    });
    if (updated.empty()) return;
    double work = 0;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const std::size_t at = Sums::n + w * n_per_wall;
        const Vec2<double> before{history[at], history[at + 1]};
        work += 0.5 * dot(before + on_bodies[w], walls_[w].velocity) * (trial.t - history[3]);
        updated[at] = on_bodies[w].x;
        updated[at + 1] = on_bodies[w].y;
    }
    updated[0] = history[0] + slid;
    updated[1] = history[1] + lost;
    updated[2] = history[2] + work;
    updated[3] = trial.t;
}

void Walls::follow(const Parting&, const State& accepted, std::vector<double>& history, PathEnergies& energies) {
    StoredEnergies before, after;
    add_stored(Trial::of(accepted), history, before);
    const ContactorPoints old = points_;
    const std::size_t n_front = place(0, 0);
    std::vector<double> now(history.begin(), history.begin() + static_cast<std::ptrdiff_t>(n_front));
    points_ = contact_.bodies().mesh_points();
    const std::vector<FormerPoint> former = former_points(old, points_);
    if (!closer_.empty()) {
        std::vector<double> moved;
        for (std::size_t w = 0; w < walls_.size(); ++w)
            for (const FormerPoint& point : former)
                moved.push_back(point.point < 0 ? 0.0 : closer_[w * old.size() + index(point.point)]);
        closer_ = std::move(moved);
    }
    for (std::size_t w = 0; w < walls_.size(); ++w)
        for (const FormerPoint& point : former)
            for (std::size_t k = 0; k < n_members; ++k)
                now.push_back(
                    point.point < 0 ? 0.0 : history[n_front + (w * old.size() + index(point.point)) * n_members + k]);
    history = std::move(now);
    add_stored(Trial::of(accepted), history, after);
    energies.splitting += after.contact - before.contact;
}

std::vector<std::array<std::int32_t, 2>> Walls::couplings() const {
    std::vector<std::array<std::int32_t, 2>> all;
    for (std::size_t point = 0; point < points_.size(); ++point)
        for (const std::int32_t i : {points_.a[point], points_.b[point]})
            for (const std::int32_t j : {points_.a[point], points_.b[point]}) all.push_back({i, j});
    return all;
}

bool Walls::symmetric() const {
    return std::ranges::all_of(walls_, [](const Wall& wall) { return wall.friction == 0; });
}

void Walls::stiffness(const Trial& trial, std::span<const double> history,
                      std::span<ForceTerm::Stiffness> df_du) const {
    using D = Dual<2>;
    std::ranges::fill(df_du, ForceTerm::Stiffness{0, 0, 0, 0});
    for_each_touch(trial, [&](std::size_t w, std::size_t point, const Vec2<double>& x) {
        Response response;
        const Vec2<D> f = force(w, point, trial.t, Vec2<D>{D::variable(x.x, 0), D::variable(x.y, 1)},
                                history.subspan(place(w, point), n_members), response);
        const std::array weights{1 - points_.weight_b[point], points_.weight_b[point]};
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t j = 0; j < 2; ++j) {
                ForceTerm::Stiffness& to = df_du[4 * point + 2 * i + j];
                const double weight = weights[i] * weights[j];
                to.xx += weight * f.x.derivative[0];
                to.xy += weight * f.x.derivative[1];
                to.yx += weight * f.y.derivative[0];
                to.yy += weight * f.y.derivative[1];
            }
    });
}

// Every point counts as if it were in a wall, always: a bound must hold until it is evaluated again. In a corner the
// projections on two normals add up to less than 2.
double Walls::bound_of(std::size_t point) const {
    double friction = 0;
    for (const Wall& wall : walls_) friction = std::max(friction, wall.friction);
    const double factor = 1 / (restitution_ * restitution_) + (friction > 0 ? tangential_factor_ : 0.0);
    return factor * stiffness_of(point) * (walls_.size() > 1 ? 2 : 1);
}

double Walls::omega_squared(const Trial& trial, std::span<const double> history,
                            std::span<const double> lumped_mass) const {
    std::vector<double> bound(lumped_mass.size(), 0.0);
    add_stiffness_bound(trial, history, bound);
    double largest = 0;
    for (std::size_t i = 0; i < bound.size(); ++i) largest = std::max(largest, bound[i] / lumped_mass[i]);
    return largest;
}

void Walls::add_stiffness_bound(const Trial&, std::span<const double>, std::span<double> bound) const {
    for (std::size_t point = 0; point < points_.size(); ++point) {
        const double k = bound_of(point), w = points_.weight_b[point];
        for (std::size_t component = 0; component < 2; ++component) {
            bound[2 * index(points_.a[point]) + component] += (1 - w) * k;
            bound[2 * index(points_.b[point]) + component] += w * k;
        }
    }
}

void Walls::add_stored(const Trial& accepted, std::span<const double> history, StoredEnergies& energies) const {
    for_each_touch(accepted, [&](std::size_t w, std::size_t point, const Vec2<double>& x) {
        Response response;
        force(w, point, accepted.t, x, history.subspan(place(w, point), n_members), response);
        energies.contact += response.stored;
    });
}

void Walls::add_dissipated(std::span<const double> from, std::span<const double> to, PathEnergies& energies) const {
    energies.friction += to[0] - from[0];
    energies.contact += to[1] - from[1];
    energies.support_work += to[2] - from[2];
}

Gaps Walls::gaps(double t, std::span<const double> u) const {
    Gaps gaps;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const Vec2<double> p = walls_[w].point + t * walls_[w].velocity;
        for (std::size_t point = 0; point < points_.size(); ++point) {
            const double gap = dot(position(point, u) - p, walls_[w].normal) - closer(w, point);
            const std::int32_t body = contact_.bodies().body_of_mesh_node(points_.a[point]);
            const auto [found, first] = gaps.try_emplace({-1 - static_cast<std::int32_t>(w), body}, gap);
            if (!first) found->second = std::min(found->second, gap);
        }
    }
    return gaps;
}

std::vector<ContactPlace> Walls::places() const {
    const std::vector<double> at_rest(2 * contact_.bodies().n_mesh_nodes(), 0.0);
    std::vector<ContactPlace> all;
    for (const Wall& wall : walls_)
        for (std::size_t point = 0; point < points_.size(); ++point) {
            const Vec2<double> p = position(point, at_rest);
            if (std::abs(dot(p - wall.point, wall.normal)) <= contact_.options().skin)
                all.push_back({points_.a[point], -1, {p.x, p.y}, wall.normal});
        }
    return all;
}

double Walls::deepest_at_rest() const {
    const std::vector<double> at_rest(2 * contact_.bodies().n_mesh_nodes(), 0.0);
    double deepest = -std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls_)
        for (std::size_t point = 0; point < points_.size(); ++point)
            deepest = std::max(deepest, dot(wall.point - position(point, at_rest), wall.normal));
    return deepest;
}

std::unique_ptr<Walls> make_walls(const Contact& contact, const std::vector<WallOptions>& walls, double friction) {
    std::vector<Walls::Wall> made;
    for (const WallOptions& wall : walls) {
        const double length = std::hypot(wall.normal[0], wall.normal[1]);
        if (!(length > 0 && std::isfinite(length))) throw InputError("[[wall]]", "its normal must have a length > 0");
        made.push_back({{wall.point[0], wall.point[1]},
                        {wall.normal[0] / length, wall.normal[1] / length},
                        {wall.velocity[0], wall.velocity[1]},
                        wall.friction.value_or(friction)});
    }
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < made.size(); ++i) {
        const double depth = Walls(contact, {made[i]}).deepest_at_rest();
        if (depth > overlap_tolerance * contact.bodies().shortest_edge())
            problems.push_back({fmt::format("[[wall]] {}", i + 1),
                                fmt::format("a body reaches {:.3g} m into the wall at the start", depth)});
    }
    if (!problems.empty()) throw InputError(problems);
    return std::make_unique<Walls>(contact, std::move(made));
}

}  // namespace gneiss
