#include "model/follower_pressure.hpp"

#include <cassert>

#include "base/dual.hpp"
#include "model/edge_pressure.hpp"

namespace gneiss {
namespace {

Vec2<double> at(std::span<const double> values, std::int32_t node) {
    const std::size_t x = 2 * static_cast<std::size_t>(node);
    return {values[x], values[x + 1]};
}

void add(std::span<double> f, std::int32_t node, const Vec2<double>& force) {
    const std::size_t x = 2 * static_cast<std::size_t>(node);
    f[x] += force.x;
    f[x + 1] += force.y;
}

}  // namespace

FollowerPressure::FollowerPressure(std::string name, const Mesh& mesh, const std::vector<BoundaryEdge>& edges,
                                   const CompiledFormula& value, Amplitude amplitude, double thickness)
    : name_(std::move(name)), amplitude_(std::move(amplitude)), thickness_(thickness) {
    assert(thickness > 0);
    for (const BoundaryEdge& edge : edges) {
        const auto& a = mesh.nodes[static_cast<std::size_t>(edge.a)];
        const auto& b = mesh.nodes[static_cast<std::size_t>(edge.b)];
        edges_.push_back(
            {edge.a, edge.b, edge.element, {a[0], a[1]}, {b[0], b[1]}, value(a[0], a[1]), value(b[0], b[1])});
    }
}

std::array<Vec2<double>, 2> FollowerPressure::forces(const Edge& edge, const Amplitude::Instant& amplitude,
                                                     std::span<const double> u) const {
    // Reference differences first: the rounding of a far origin does not enter the current edge.
    const Vec2<double> current = (edge.x_b - edge.x_a) + (at(u, edge.b) - at(u, edge.a));
    return edge_pressure_forces(current, amplitude(edge.x_a.x, edge.x_a.y) * edge.p_a,
                                amplitude(edge.x_b.x, edge.x_b.y) * edge.p_b, thickness_);
}

void FollowerPressure::add_force(const Trial& trial, std::span<double> f) const {
    const Amplitude::Instant amplitude = amplitude_.at(trial.t, trial.last_event);
    for (const Edge& edge : edges_) {
        const auto [force_a, force_b] = forces(edge, amplitude, trial.u);
        add(f, edge.a, force_a);
        add(f, edge.b, force_b);
    }
}

void FollowerPressure::corner_forces(const Trial& trial, std::vector<CornerForce>& corners) const {
    const Amplitude::Instant amplitude = amplitude_.at(trial.t, trial.last_event);
    for (const Edge& edge : edges_) {
        const auto [force_a, force_b] = forces(edge, amplitude, trial.u);
        corners.push_back({edge.element, edge.a, force_a});
        corners.push_back({edge.element, edge.b, force_b});
    }
}

std::vector<std::array<std::int32_t, 2>> FollowerPressure::couplings() const {
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (const Edge& edge : edges_)
        pairs.insert(pairs.end(), {{edge.a, edge.a}, {edge.a, edge.b}, {edge.b, edge.a}, {edge.b, edge.b}});
    return pairs;
}

void FollowerPressure::stiffness(const Trial& trial, std::span<Stiffness> df_du) const {
    using D = Dual<2>;
    const Amplitude::Instant amplitude = amplitude_.at(trial.t, trial.last_event);
    auto out = df_du.begin();
    for (const Edge& edge : edges_) {
        // linear in the current edge u_b - u_a + ...: the derivative does not depend on where it is
        const Vec2<D> current{D::variable(0, 0), D::variable(0, 1)};
        const auto forces = edge_pressure_forces(current, amplitude(edge.x_a.x, edge.x_a.y) * edge.p_a,
                                                 amplitude(edge.x_b.x, edge.x_b.y) * edge.p_b, thickness_);
        for (const Vec2<D>& force : forces) {
            const auto& x = force.x.derivative;
            const auto& y = force.y.derivative;
            *out++ = {-x[0], -x[1], -y[0], -y[1]};
            *out++ = {x[0], x[1], y[0], y[1]};
        }
    }
}

void FollowerPressure::add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const {
    const Amplitude::Instant before = amplitude_.at(from.t, from.last_event);
    const Amplitude::Instant after = amplitude_.at(to.t, to.last_event);
    double work = 0;
    for (const Edge& edge : edges_) {
        const auto old_force = forces(edge, before, from.u);
        const auto new_force = forces(edge, after, to.u);
        work += 0.5 * (dot(old_force[0] + new_force[0], at(to.u, edge.a) - at(from.u, edge.a)) +
                       dot(old_force[1] + new_force[1], at(to.u, edge.b) - at(from.u, edge.b)));
    }
    energies.external_work += work;
}

}  // namespace gneiss
