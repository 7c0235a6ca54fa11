#pragma once
// From options to the objects that compute: mesh, solid, integrator.

#include <memory>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/options.hpp"
#include "model/solid_system.hpp"
#include "system/integrator.hpp"

namespace gneiss {

struct Case {
    CaseOptions options;
    Mesh mesh;
    std::vector<std::string> warnings;  ///< of the mesh
    std::unique_ptr<SolidSystem> system;
    std::unique_ptr<Integrator> integrator;
};

/// @throws InputError with every problem that shows before the first step
Case build_case(CaseOptions options);

/// Bytes that the system and its integrator hold per element, about.
double memory_estimate(const Case& built);

}  // namespace gneiss
