#pragma once
// From options to the objects that compute: mesh, solid, integrator, probes.

#include <memory>
#include <string>
#include <vector>

#include "app/tables.hpp"
#include "mesh/mesh.hpp"
#include "model/options.hpp"
#include "model/solid_system.hpp"
#include "system/integrator.hpp"

namespace gneiss {

struct Case {
    CaseOptions options;
    Mesh mesh;
    std::vector<std::string> warnings;        ///< "mesh: …"
    std::vector<std::int32_t> cracked_sides;  ///< open from the start, ascending: numbers that InnerSides gave to the
                                              ///< sides of the mesh before any was open
    std::unique_ptr<SolidSystem> system;
    std::unique_ptr<Integrator> integrator;
    ProbeTable probes;
    ReactionTable reactions;
};

/// @throws InputError with everything that is wrong with the mesh, or else with what the deck puts on it
Case build_case(CaseOptions options);

/// Bytes that the system and its integrator hold per element, about.
double memory_estimate(const Case& built);

}  // namespace gneiss
