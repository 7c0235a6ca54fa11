#include "fracture/initial_tractions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/index.hpp"
#include "fracture/envelope.hpp"

namespace gneiss {
namespace {

using Ends = std::vector<Joints::WaitingEnd>;

/// y with sum over the ends at i of (y_i - y_j) = x_i, for each connected set of nodes, on which x has to add up to
/// nothing: elimination of the graph's Laplacian, one node of a set held. A node has a dozen copies at most.
/// @param ends   nodes by their places in x, which all differ
std::vector<double> potentials(const std::vector<std::array<std::size_t, 2>>& ends, std::vector<double> x) {
    const std::size_t n = x.size();
    std::vector<double> matrix(n * n, 0.0), y(n, 0.0);
    for (const auto& [i, j] : ends) {
        ++matrix[n * i + i];
        ++matrix[n * j + j];
        --matrix[n * i + j];
        --matrix[n * j + i];
    }
    constexpr double held = 1e-9;  // pivots are rational numbers with small denominators, or none but for round-off
    for (std::size_t k = 0; k < n; ++k) {
        if (matrix[n * k + k] < held) continue;
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = matrix[n * i + k] / matrix[n * k + k];
            for (std::size_t j = k; j < n; ++j) matrix[n * i + j] -= factor * matrix[n * k + j];
            x[i] -= factor * x[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        if (matrix[n * k + k] < held) continue;
        double rest = x[k];
        for (std::size_t j = k + 1; j < n; ++j) rest -= matrix[n * k + j] * y[j];
        y[k] = rest / matrix[n * k + k];
    }
    return y;
}

/// The smallest place that each of n places is connected with.
std::vector<std::size_t> connected(const std::vector<std::array<std::size_t, 2>>& ends, std::size_t n) {
    std::vector<std::size_t> first(n);
    for (std::size_t i = 0; i < n; ++i) first[i] = i;
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [i, j] : ends) {
            const std::size_t least = std::min(first[i], first[j]);
            changed = changed || first[i] != first[j];
            first[i] = first[j] = least;
        }
    }
    return first;
}

/// Forces that the ends around one node exert on their a, N: changed by as little as makes all copies that they hold
/// together go with one acceleration.
/// @param f     on the copies without their joints, N, shape (2 n_nodes)
/// @param free  whether a degree of freedom is
void share(const Ends& ends, const std::vector<std::size_t>& around, std::span<const double> f,
           std::span<const double> mass, const std::vector<bool>& free, std::vector<Vec2<double>>& forces) {
    std::vector<std::int32_t> nodes;
    for (const std::size_t e : around) nodes.insert(nodes.end(), {ends[e].a, ends[e].b});
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const auto place = [&](std::int32_t node) {
        return static_cast<std::size_t>(std::ranges::lower_bound(nodes, node) - nodes.begin());
    };
    std::vector<std::array<std::size_t, 2>> pairs;
    for (const std::size_t e : around) pairs.push_back({place(ends[e].a), place(ends[e].b)});
    const std::vector<std::size_t> set = connected(pairs, nodes.size());
    for (std::size_t c = 0; c < 2; ++c) {
        if (!std::ranges::all_of(nodes, [&](std::int32_t node) { return free[2 * index(node) + c]; })) continue;
        const auto component = [&](Vec2<double>& v) -> double& { return c == 0 ? v.x : v.y; };
        std::vector<double> x(nodes.size()), sum(nodes.size(), 0.0), weight(nodes.size(), 0.0);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const std::size_t dof = 2 * index(nodes[i]) + c;
            x[i] = -f[dof];
            sum[set[i]] += f[dof];
            weight[set[i]] += mass[dof];
        }
        for (std::size_t k = 0; k < around.size(); ++k) {
            x[pairs[k][0]] -= component(forces[around[k]]);
            x[pairs[k][1]] += component(forces[around[k]]);
        }
        for (std::size_t i = 0; i < nodes.size(); ++i)
            x[i] += mass[2 * index(nodes[i]) + c] * (sum[set[i]] / weight[set[i]]);
        const std::vector<double> y = potentials(pairs, std::move(x));
        for (std::size_t k = 0; k < around.size(); ++k) component(forces[around[k]]) += y[pairs[k][0]] - y[pairs[k][1]];
    }
}

}  // namespace

std::size_t preload_joints(Joints& joints, const InnerSides& inner, const SolidSystem& solid,
                           std::span<const std::array<double, 3>> stress) {
    State start = solid.initial_state();
    std::ranges::fill(start.v, 0.0);
    const Ends ends = joints.ends();
    std::vector<Vec2<double>> forces;
    std::map<std::int32_t, std::vector<std::size_t>> around;  // of each original node
    for (std::size_t e = 0; e < ends.size(); ++e) {
        const auto& [left, right] = inner.sides()[index(ends[e].side)];
        const auto &one = stress[index(left.element)], &other = stress[index(right.element)];
        const Vec2<double> n = (0.5 * ends[e].weight) * ends[e].normal;
        forces.push_back({(one[0] + other[0]) * n.x + (one[2] + other[2]) * n.y,
                          (one[2] + other[2]) * n.x + (one[1] + other[1]) * n.y});
        around[inner.original_of()[index(ends[e].a)]].push_back(e);
    }
    std::vector<double> f(start.u.size());
    solid.force(start, Trial::of(start), f);
    std::vector<bool> free(f.size(), true);
    for (const Constraint& constraint : solid.constraints()) free[constraint.dof] = false;
    for (const auto& [node, of_node] : around) share(ends, of_node, f, solid.lumped_mass(), free, forces);
    std::size_t beyond = 0;
    for (std::size_t e = 0; e < ends.size(); ++e) {
        const double normal = dot(forces[e], ends[e].normal) / ends[e].weight;
        const double shear = dot(forces[e], ends[e].along) / ends[e].weight;
        joints.preload(ends[e], normal, shear);
        const JointState joint = joints.state_of(ends[e].joint, start, solid.history_of(joints, start));
        if (envelope_index(joint.properties[ends[e].end], normal, shear) > 1) ++beyond;
    }
    return beyond;
}

}  // namespace gneiss
