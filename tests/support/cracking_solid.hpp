#pragma once
// A small solid whose sides open where they reach their strength.

#include <memory>
#include <vector>

#include "fracture/cohesion.hpp"
#include "fracture/cracking.hpp"
#include "support/small_solids.hpp"

namespace gneiss::test {

struct CrackingSolid {
    std::unique_ptr<Mesh> mesh;
    std::unique_ptr<InnerSides> inner;
    std::unique_ptr<SolidSystem> system;
    Cracking* cracking = nullptr;  ///< one of the system's events

    /// Displacements as given, and all that accepting them leaves.
    State at(std::vector<double> u) const {
        const State rest = system->initial_state();
        State state = rest;
        state.u = std::move(u);
        std::vector<double> f(state.u.size());
        system->force_and_update(rest, Trial::of(state), f, state.z, state.history);
        return state;
    }
};

/// @param what  every material with a strength
inline CrackingSolid cracking_solid(Mesh mesh, const SolidDescription& what, const FractureOptions& fracture = {}) {
    CrackingSolid solid;
    solid.mesh = std::make_unique<Mesh>(std::move(mesh));
    solid.inner = std::make_unique<InnerSides>(*solid.mesh);
    SolidSystem::Parts parts;
    parts.blocks = make_blocks(*solid.mesh, what.solid, what.materials);
    const auto surroundings = [what](const Mesh& now) {
        SolidSystem::Surroundings around;
        around.terms = make_loads(now, what.loads, what.solid.thickness);
        around.models = make_lumped(now, what.lumped, what.solid.thickness);
        around.constraints = make_constraints(now, what.boundaries);
        return around;
    };
    SolidSystem::Surroundings around = surroundings(*solid.mesh);
    parts.terms = std::move(around.terms);
    parts.constraints = std::move(around.constraints);
    parts.models = std::move(around.models);
    parts.initial_velocity = initial_velocity(*solid.mesh, what.initial);
    parts.damping.mass_proportional = what.mass_damping;
    const std::vector<JointEdge> edges = all_edges(*solid.mesh, *solid.inner);
    std::vector<std::string> warnings;
    auto properties = edge_properties(*solid.mesh, edges, parts.blocks, what.materials, fracture, {}, {}, warnings);
    watch_strength(*solid.mesh, edges, properties, parts.blocks, watch_reach(fracture.criterion));
    auto joints = make_extrinsic_joints(*solid.inner, properties, what.solid.thickness);
    Joints& cohesion = *joints;
    parts.interactions.push_back(std::move(joints));
    solid.system = std::make_unique<SolidSystem>(*solid.mesh, std::move(parts));
    auto cracking = std::make_unique<Cracking>(Cracking::Parts{.mesh = *solid.mesh,
                                                               .inner = *solid.inner,
                                                               .solid = *solid.system,
                                                               .joints = cohesion,
                                                               .properties = std::move(properties),
                                                               .criterion = fracture.criterion,
                                                               .thickness = what.solid.thickness,
                                                               .surroundings = surroundings});
    solid.cracking = cracking.get();
    solid.system->add_event(std::move(cracking));
    return solid;
}

}  // namespace gneiss::test
