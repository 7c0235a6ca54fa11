#pragma once
// From options to the objects that compute: mesh, solid, integrator, probes.

#include <memory>
#include <string>
#include <vector>

#include "app/tables.hpp"
#include "contact/touches.hpp"
#include "fracture/cracking.hpp"
#include "mesh/mesh.hpp"
#include "model/options.hpp"
#include "model/solid_system.hpp"
#include "system/integrator.hpp"

namespace gneiss {

struct Case {
    CaseOptions options;
    std::unique_ptr<Mesh> mesh = std::make_unique<Mesh>();  ///< comes apart under way where cracks grow
    std::unique_ptr<InnerSides> inner;                      ///< of the mesh
    std::vector<std::string> warnings;                      ///< "mesh: …"
    std::unique_ptr<SolidSystem> system;
    Cracking* cracking = nullptr;    ///< one of the system's events; null: nothing cracks
    Touches* touches = nullptr;      ///< one of the system's events; null: nobody asks when bodies touch
    std::vector<std::int64_t> held;  ///< degrees of freedom of the mesh at the start whose motion is given, ascending
    std::string layout;              ///< fingerprint of mesh and blocks at the start: what z and history are ordered by
    std::unique_ptr<Integrator> integrator;
    ProbeTable probes;
    ReactionTable reactions;
};

/// @throws InputError with everything that is wrong with the mesh, or else with what the deck puts on it
Case build_case(CaseOptions options);

/// Bytes that the system and its integrator hold per element, about.
double memory_estimate(const Case& built);

}  // namespace gneiss
