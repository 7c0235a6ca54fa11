#include "model/impedance.hpp"

#include <cassert>
#include <cmath>
#include <map>

namespace gneiss {
namespace {

/// v of x and y on the material axes, and back.
Vec2<double> to_axes(const Vec2<double>& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x + s * v.y, -s * v.x + c * v.y};
}
Vec2<double> from_axes(const Vec2<double>& v, double angle) { return to_axes(v, -angle); }

SymmetricMatrix christoffel_on_axes(const PlaneStiffness& c, const Vec2<double>& n) {
    return {c.C_aaaa * n.x * n.x + c.C_abab * n.y * n.y, (c.C_aabb + c.C_abab) * n.x * n.y,
            c.C_abab * n.x * n.x + c.C_bbbb * n.y * n.y};
}

}  // namespace

PlaneStiffness plane_stiffness(const MunjizaConstants& constants, double axis_angle, double density) {
    return {constants.M_v + constants.M_alpha,
            constants.M_v + constants.M_beta,
            constants.M_v,
            constants.M_psi / 2,
            axis_angle,
            density};
}

SymmetricMatrix christoffel_matrix(const PlaneStiffness& stiffness, const Vec2<double>& n) {
    const SymmetricMatrix g = christoffel_on_axes(stiffness, to_axes(n, stiffness.axis_angle));
    const double c = std::cos(stiffness.axis_angle), s = std::sin(stiffness.axis_angle);
    return {c * c * g.xx - 2 * c * s * g.xy + s * s * g.yy, c * s * (g.xx - g.yy) + (c * c - s * s) * g.xy,
            s * s * g.xx + 2 * c * s * g.xy + c * c * g.yy};
}

SymmetricMatrix square_root(const SymmetricMatrix& matrix) {
    const double determinant = matrix.xx * matrix.yy - matrix.xy * matrix.xy;
    assert(matrix.xx > 0 && determinant > 0);
    const double root = std::sqrt(determinant);
    const double scale = 1 / std::sqrt(matrix.xx + matrix.yy + 2 * root);
    return {scale * (matrix.xx + root), scale * matrix.xy, scale * (matrix.yy + root)};
}

SymmetricMatrix impedance(const PlaneStiffness& stiffness, const Vec2<double>& n) {
    const SymmetricMatrix gamma = christoffel_matrix(stiffness, n);
    const double rho = stiffness.density;
    return square_root({rho * gamma.xx, rho * gamma.xy, rho * gamma.yy});
}

std::array<PlaneWave, 2> plane_waves(const PlaneStiffness& stiffness, const Vec2<double>& n) {
    const Vec2<double> m = to_axes(n, stiffness.axis_angle);
    const SymmetricMatrix gamma = christoffel_on_axes(stiffness, m);
    const double half_difference = 0.5 * (gamma.xx - gamma.yy);
    const double larger = 0.5 * (gamma.xx + gamma.yy) + std::hypot(half_difference, gamma.xy);
    // from the determinant: the difference of mean and radius would lose digits where the waves differ much
    const double smaller = (gamma.xx * gamma.yy - gamma.xy * gamma.xy) / larger;
    // direction of the larger principal value, as on Mohr's circle
    const double theta = 0.5 * std::atan2(gamma.xy, half_difference);
    const Vec2<double> fast{std::cos(theta), std::sin(theta)};

    const auto wave = [&](double modulus, const Vec2<double>& p) {
        const double speed = std::sqrt(modulus / stiffness.density);
        // rho c v_group = 1/2 d(p . Gamma(n) p)/dn at fixed p
        const double mixed = stiffness.C_aabb + stiffness.C_abab;
        const Vec2<double> flux{
            (stiffness.C_aaaa * p.x * p.x + stiffness.C_abab * p.y * p.y) * m.x + mixed * p.x * p.y * m.y,
            (stiffness.C_abab * p.x * p.x + stiffness.C_bbbb * p.y * p.y) * m.y + mixed * p.x * p.y * m.x};
        const double angle = stiffness.axis_angle;
        return PlaneWave{speed, from_axes(p, angle), from_axes(1 / (stiffness.density * speed) * flux, angle)};
    };
    return {wave(larger, fast), wave(smaller, turned(fast))};
}

std::vector<Damping::Block> absorbing_blocks(const Mesh& mesh, std::span<const BoundaryEdge> edges,
                                             const std::function<PlaneStiffness(int element)>& stiffness,
                                             double thickness) {
    assert(thickness > 0);
    std::map<std::int32_t, SymmetricMatrix> sums;
    for (const BoundaryEdge& edge : edges) {
        const auto& a = mesh.nodes[static_cast<std::size_t>(edge.a)];
        const auto& b = mesh.nodes[static_cast<std::size_t>(edge.b)];
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        const double length = std::hypot(dx, dy);
        const SymmetricMatrix z = impedance(stiffness(edge.element), {dy / length, -dx / length});
        const double half = 0.5 * thickness * length;
        for (std::int32_t node : {edge.a, edge.b}) {
            SymmetricMatrix& sum = sums.try_emplace(node, SymmetricMatrix{0, 0, 0}).first->second;
            sum = {sum.xx + half * z.xx, sum.xy + half * z.xy, sum.yy + half * z.yy};
        }
    }
    std::vector<Damping::Block> blocks;
    for (const auto& [node, sum] : sums) blocks.push_back({node, sum.xx, sum.xy, sum.yy});
    return blocks;
}

double absorbed_work(std::span<const Damping::Block> blocks, const Trial& from, const Trial& to) {
    double work = 0;
    for (const Damping::Block& block : blocks) {
        const std::size_t x = 2 * static_cast<std::size_t>(block.node), y = x + 1;
        const Vec2<double> v{0.5 * (from.v[x] + to.v[x]), 0.5 * (from.v[y] + to.v[y])};
        const Vec2<double> du{to.u[x] - from.u[x], to.u[y] - from.u[y]};
        work += dot(SymmetricMatrix{block.xx, block.xy, block.yy} * v, du);
    }
    return work;
}

}  // namespace gneiss
