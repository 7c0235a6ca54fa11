#include "fracture/cohesion.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "base/errors.hpp"
#include "fracture/interface_strength.hpp"
#include "model/impedance.hpp"
#include "model/make_blocks.hpp"

namespace gneiss {
namespace {

InterfaceStrength strength_of(const StrengthOptions& options) {
    const auto directional = [](const DirectionalOption& value) { return DirectionalValue{value[0], value[1]}; };
    return {directional(options.tensile),           directional(options.cohesion),
            directional(options.friction),          directional(options.residual_friction),
            directional(options.fracture_energy_i), directional(options.fracture_energy_ii)};
}

/// Property by property the smaller one.
CohesionProperties<double> weaker(CohesionProperties<double> a, const CohesionProperties<double>& b) {
    for (const auto member : CohesionProperties<double>::members) a.*member = std::min(a.*member, b.*member);
    return a;
}

std::string place(std::size_t material) { return fmt::format("[[material]] {}", material + 1); }

/// Where a user speaks about the strength of an edge.
struct StrengthOf {
    std::array<const StrengthOptions*, 2> sides;  ///< of the left and the right element; null: none is given
    std::array<std::string, 2> places;
};

/// @param materials_of  numbers of the materials on both sides
StrengthOf strength_of_edge(const JointEdge& edge, std::array<std::size_t, 2> materials_of,
                            const std::vector<MaterialOptions>& materials,
                            const std::vector<InterfaceOptions>& interfaces, const NamedSides& named) {
    if (const auto found = named.interface_of.find(edge.side); found != named.interface_of.end()) {
        const std::string there = fmt::format("[[interface]] {}", found->second + 1);
        const StrengthOptions* own = &interfaces[found->second].strength;
        return {{own, own}, {there, there}};
    }
    StrengthOf of;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto& strength = materials[materials_of[k]].strength;
        of.sides[k] = strength ? &*strength : nullptr;
        of.places[k] = place(materials_of[k]);
    }
    return of;
}

/// Numbers of inner sides, ascending.
std::vector<std::int32_t> all_but(const InnerSides& inner, std::span<const std::int32_t> left_out) {
    std::vector<std::int32_t> all(inner.sides().size()), rest;
    std::iota(all.begin(), all.end(), 0);
    std::ranges::set_difference(all, left_out, std::back_inserter(rest));
    return rest;
}

bool may_crack(const NamedSides& named, const JointEdge& edge) {
    return !std::ranges::binary_search(named.bonded, edge.side);
}

/// Of an edge that stays bonded whatever happens; no joint ever has them.
CohesionProperties<double> unbreakable() {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {infinite, infinite, 0, 0, infinite, infinite, 1};
}

}  // namespace

std::vector<JointEdge> all_edges(const Mesh& mesh, const InnerSides& inner, std::span<const std::int32_t> left_out) {
    return joint_edges(mesh, inner, all_but(inner, left_out));
}

void open_all_sides(InnerSides& inner, std::span<const std::int32_t> bonded) {
    inner.open(all_but(inner, bonded));
    inner.renumber();
}

std::vector<CohesionProperties<double>> edge_properties(const Mesh& mesh, std::span<const JointEdge> edges,
                                                        std::span<const std::unique_ptr<ElementBlock>> blocks,
                                                        const std::vector<MaterialOptions>& materials,
                                                        const FractureOptions& fracture,
                                                        const std::vector<InterfaceOptions>& interfaces,
                                                        const NamedSides& named, std::vector<std::string>& warnings) {
    std::vector<Problem> problems;
    const std::vector<std::int32_t> material_of = material_of_elements(mesh, materials);
    const auto materials_of = [&](const JointEdge& edge) {
        const auto of = [&](std::int32_t e) {
            return static_cast<std::size_t>(material_of[static_cast<std::size_t>(e)]);
        };
        return std::array{of(edge.left), of(edge.right)};
    };
    std::set<std::string> without;
    for (const JointEdge& edge : edges) {
        if (!may_crack(named, edge)) continue;
        const StrengthOf of = strength_of_edge(edge, materials_of(edge), materials, interfaces, named);
        for (std::size_t k = 0; k < 2; ++k)
            if (of.sides[k] == nullptr && without.insert(of.places[k]).second)
                problems.push_back({of.places[k], "`strength` is missing, which [fracture] needs"});
    }
    const std::optional<WeibullScatter> scatter =
        fracture.weibull_modulus > 0
            ? std::optional(WeibullScatter{fracture.weibull_modulus, static_cast<std::uint64_t>(fracture.seed)})
            : std::nullopt;
    if (!problems.empty()) throw InputError(problems);

    const std::vector<PlaneStiffness> stiffness = element_stiffness(mesh, blocks);

    const bool y_code = fracture.method == FractureOptions::Method::y_code;
    std::set<std::string> refused;
    std::vector<CohesionProperties<double>> all;
    std::size_t n_coarse = 0;
    double shortest = std::numeric_limits<double>::infinity(), its_edge = 0;
    for (const JointEdge& edge : edges) {
        if (!may_crack(named, edge)) {
            all.push_back(unbreakable());
            continue;
        }
        const auto& start = mesh.nodes[static_cast<std::size_t>(edge.nodes[0])];
        const auto& end = mesh.nodes[static_cast<std::size_t>(edge.nodes[1])];
        const Vec2<double> along{end[0] - start[0], end[1] - start[1]};
        const double length = std::hypot(along.x, along.y);
        std::array<CohesionProperties<double>, 2> sides;
        double modulus = std::numeric_limits<double>::infinity();
        const std::array<std::int32_t, 2> elements{edge.left, edge.right};
        const StrengthOf strength = strength_of_edge(edge, materials_of(edge), materials, interfaces, named);
        for (std::size_t k = 0; k < 2; ++k) {
            const auto e = static_cast<std::size_t>(elements[k]);
            const PlaneStiffness& of = stiffness[e];
            const Vec2<double> n{along.y / length, -along.x / length};
            const SymmetricMatrix gamma = christoffel_matrix(of, n);
            const double across = dot(n, gamma * n);
            modulus = std::min(modulus, across);
            sides[k] = strength_of(*strength.sides[k])
                           .properties(along, {std::cos(of.axis_angle), std::sin(of.axis_angle)},
                                       fracture.penalty * across / length);
        }
        CohesionProperties<double> properties = weaker(sides[0], sides[1]);
        if (scatter) properties = scaled_strength(properties, scatter->factor(static_cast<std::uint64_t>(edge.side)));
        try {
            (y_code ? validate_y_code : validate_mixed_mode)(properties);
        } catch (const InputError& error) {
            for (const Problem& problem : error.problems())
                if (refused.insert(problem.message.substr(0, problem.message.find(' '))).second)
                    problems.push_back(
                        {strength.places[0] + " strength", fmt::format("{} (an edge of {:.3g} m, penalty {:.3g} Pa/m)",
                                                                       problem.message, length, properties.penalty)});
        }
        if (const double l_ch = cohesion_length(properties.fracture_energy_i, modulus, properties.tensile_strength);
            l_ch < length) {
            ++n_coarse;
            if (l_ch / length < shortest) {
                shortest = l_ch / length;
                its_edge = length;
            }
        }
        all.push_back(properties);
    }
    if (!problems.empty()) throw InputError(problems);
    if (all.empty()) throw InputError("[fracture]", "the mesh has a single element: no edge can crack");
    if (n_coarse > 0)
        warnings.push_back(
            fmt::format("fracture: {} of {} edges are longer than the length over which a crack softens, G E/f_t^2; at "
                        "the worst one "
                        "of {:.3g} m it is {:.3g} m: cracks there depend on the mesh",
                        n_coarse, all.size(), its_edge, shortest * its_edge));
    return all;
}

std::unique_ptr<Joints> make_cohesion(const Mesh& mesh, std::span<const JointEdge> edges,
                                      std::span<const CohesionProperties<double>> properties,
                                      FractureOptions::Method method, double thickness) {
    std::vector<Joint> joints;
    for (std::size_t i = 0; i < edges.size(); ++i) joints.push_back({edges[i].nodes, properties[i], edges[i].side});
    return make_joints(mesh, joints, method == FractureOptions::Method::y_code ? JointLaw::y_code : JointLaw::intrinsic,
                       thickness);
}

void watch_strength(const Mesh& mesh, std::span<const JointEdge> edges,
                    std::span<const CohesionProperties<double>> properties,
                    std::span<const std::unique_ptr<ElementBlock>> blocks, const WatchReach& reach) {
    // a block's watch is that of its weakest edge, but for a factor of each element
    struct Least {
        double tensile_strength = std::numeric_limits<double>::infinity(), cohesion = tensile_strength,
               tan_phi = tensile_strength;
        void take(double tensile, double shear, double friction) {
            tensile_strength = std::min(tensile_strength, tensile);
            cohesion = std::min(cohesion, shear);
            tan_phi = std::min(tan_phi, friction);
        }
        void take(const Least& other) { take(other.tensile_strength, other.cohesion, other.tan_phi); }
        void take(const CohesionProperties<double>& p) { take(p.tensile_strength, p.cohesion, p.tan_phi_initial); }
    };
    std::map<std::int32_t, Least> of_element;
    const auto is_breakable = [&](std::size_t i) { return std::isfinite(properties[i].tensile_strength); };
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (is_breakable(i))
            for (const std::int32_t e : {edges[i].left, edges[i].right}) of_element[e].take(properties[i]);
    if (reach.around_nodes) {
        std::vector<Least> of_node(mesh.n_nodes());
        for (std::size_t i = 0; i < edges.size(); ++i)
            for (const std::int32_t node : edges[i].nodes)
                if (is_breakable(i)) of_node[static_cast<std::size_t>(node)].take(properties[i]);
        const auto n = static_cast<std::size_t>(mesh.nodes_per_element());
        for (std::size_t e = 0; e < mesh.n_elements(); ++e)
            for (const std::int32_t node : std::span(mesh.element(e), n))
                of_element[static_cast<std::int32_t>(e)].take(of_node[static_cast<std::size_t>(node)]);
    }
    for (const auto& block : blocks) {
        StrengthWatch watch;
        Least least;
        const auto of = [&](std::size_t local) { return of_element.find(block->element(local)); };
        for (std::size_t local = 0; local < block->n_elements(); ++local)
            if (const auto found = of(local); found != of_element.end()) least.take(found->second);
        if (!std::isfinite(least.cohesion)) continue;  // no element of it touches another one
        watch.per_tensile_strength = 1 / least.tensile_strength;
        watch.per_cohesion = 1 / least.cohesion;
        watch.tan_phi = least.tan_phi;
        watch.factor_squared.assign(block->n_packs() * pack_width, std::numeric_limits<double>::infinity());
        for (std::size_t local = 0; local < block->n_elements(); ++local)
            if (const auto found = of(local); found != of_element.end()) {
                const double factor = std::min(found->second.tensile_strength / least.tensile_strength,
                                               found->second.cohesion / least.cohesion) /
                                      reach.factor;
                watch.factor_squared[local] = factor * factor;
            }
        block->watch(std::move(watch));
    }
}

}  // namespace gneiss
