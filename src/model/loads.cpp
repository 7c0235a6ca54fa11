#include "model/loads.hpp"

#include <fmt/format.h>

#include <cassert>
#include <numeric>
#include <optional>

#include "model/dead_load.hpp"
#include "model/follower_pressure.hpp"
#include "model/mesh_names.hpp"
#include "model/problem_list.hpp"

namespace gneiss {
namespace {

/// The nodes, edges or elements that a load acts on: one of them, as its kind wants.
struct Target {
    std::vector<std::int32_t> nodes, elements;
    std::vector<BoundaryEdge> edges;
};

Target find_target(const Mesh& mesh, const LoadOptions& load) {
    Target target;
    switch (load.kind) {
        case LoadOptions::Kind::nodal_force:
            target.nodes = nodes_named(mesh, load.on);
            break;
        case LoadOptions::Kind::traction:
        case LoadOptions::Kind::pressure:
            target.edges = boundary_named(mesh, load.on);
            break;
        case LoadOptions::Kind::body_force:
            if (load.on.empty()) {
                target.elements.resize(mesh.n_elements());
                std::iota(target.elements.begin(), target.elements.end(), 0);
            } else {
                target.elements = elements_named(mesh, load.on);
            }
            break;
    }
    return target;
}

std::string describe(const LoadOptions& load) {
    switch (load.kind) {
        case LoadOptions::Kind::nodal_force:
            return fmt::format("nodal force on \"{}\"", load.on);
        case LoadOptions::Kind::traction:
            return fmt::format("traction on \"{}\"", load.on);
        case LoadOptions::Kind::pressure:
            return fmt::format("pressure on \"{}\"", load.on);
        case LoadOptions::Kind::body_force:
            break;
    }
    return load.on.empty() ? "body force" : fmt::format("body force on \"{}\"", load.on);
}

std::unique_ptr<ForceTerm> build(const Mesh& mesh, const LoadOptions& load, const Target& target, const Field& value,
                                 const Amplitude& amplitude, double thickness) {
    const std::string name = describe(load);
    const auto dead = [&](std::vector<LoadShare> shares) {
        return std::make_unique<DeadLoad>(name, std::move(shares), amplitude);
    };
    switch (load.kind) {
        case LoadOptions::Kind::nodal_force:
            return dead(nodal_force_shares(mesh, target.nodes, value));
        case LoadOptions::Kind::traction:
            return dead(traction_shares(mesh, target.edges, value, thickness));
        case LoadOptions::Kind::pressure:
            return std::make_unique<FollowerPressure>(name, mesh, target.edges, value[0], amplitude, thickness);
        case LoadOptions::Kind::body_force:
            break;
    }
    return dead(body_force_shares(mesh, target.elements, value, thickness));
}

}  // namespace

std::vector<std::unique_ptr<ForceTerm>> make_loads(const Mesh& mesh, const std::vector<LoadOptions>& options,
                                                   double thickness, const Courses& courses) {
    assert(thickness > 0);
    ProblemList problems;
    std::vector<std::unique_ptr<ForceTerm>> loads;
    for (std::size_t i = 0; i < options.size(); ++i) {
        const LoadOptions& load = options[i];
        const std::string where = fmt::format("[[load]] {}", i + 1);
        Target target;
        std::optional<CompiledFormula> x, y;
        std::optional<Amplitude> amplitude;
        bool sound = problems.attempt(where, [&] { target = find_target(mesh, load); });
        sound &= problems.attempt(where, [&] { x.emplace(load.value[0], "xy"); });
        sound &= problems.attempt(where, [&] { y.emplace(load.value[1], "xy"); });
        sound &= problems.attempt(where, [&] { amplitude.emplace(load.amplitude, course_at(courses, i)); });
        if (!sound) continue;
        problems.attempt(where, [&] {
            loads.push_back(build(mesh, load, target, Field{*x, *y}, *amplitude, thickness));
        });
    }
    problems.throw_if_any();
    return loads;
}

}  // namespace gneiss
