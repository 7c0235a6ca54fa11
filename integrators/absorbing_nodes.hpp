#pragma once
// Nodes of absorbing boundaries, whose two velocities are solved for together.

#include <vector>

#include "base/vec2.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

struct AbsorbingNode {
    Damping::Block block;
    bool x_prescribed = false, y_prescribed = false;
    std::size_t x_constraint = 0, y_constraint = 0;  ///< where prescribed

    std::size_t x() const { return 2 * static_cast<std::size_t>(block.node); }
    std::size_t y() const { return x() + 1; }

    /// Solves (1 + w (c + M^-1 block)) v = right for what is not prescribed of the node's v; the rest is given.
    /// @param c           factor of the damping in proportion to mass, 1/s
    /// @param w           s
    /// @param inverse_mass, v  of all degrees of freedom
    void solve(double c, double w, std::span<const double> inverse_mass, const Vec2<double>& right,
               std::span<double> v) const {
        const double to_rate_x = w * inverse_mass[x()], to_rate_y = w * inverse_mass[y()];
        const double xx = 1 + w * c + to_rate_x * block.xx, yy = 1 + w * c + to_rate_y * block.yy;
        const double xy = to_rate_x * block.xy, yx = to_rate_y * block.xy;
        if (!x_prescribed && !y_prescribed) {
            const double determinant = xx * yy - xy * yx;
            v[x()] = (yy * right.x - xy * right.y) / determinant;
            v[y()] = (xx * right.y - yx * right.x) / determinant;
        } else if (!x_prescribed) {
            v[x()] = (right.x - xy * v[y()]) / xx;
        } else if (!y_prescribed) {
            v[y()] = (right.y - yx * v[x()]) / yy;
        }
    }
};

/// Those of a system, by ascending node.
inline std::vector<AbsorbingNode> absorbing_nodes(const SemiDiscrete& system) {
    const auto constraints = system.constraints();
    std::vector<AbsorbingNode> nodes;
    for (const Damping::Block& block : system.damping().blocks) {
        AbsorbingNode node{block};
        for (std::size_t k = 0; k < constraints.size(); ++k) {
            if (constraints[k].dof / 2 != static_cast<std::size_t>(block.node)) continue;
            (constraints[k].dof % 2 == 0 ? node.x_prescribed : node.y_prescribed) = true;
            (constraints[k].dof % 2 == 0 ? node.x_constraint : node.y_constraint) = k;
        }
        nodes.push_back(node);
    }
    return nodes;
}

}  // namespace gneiss
