#pragma once
// A small case for the tests of the app: the unit square, one isotropic material, cells of two composites.

#include "app/build_case.hpp"

namespace gneiss::test {

inline CaseOptions square_options(int cells = 2) {
    CaseOptions options;
    options.mesh.cells = {cells, cells};
    options.materials.emplace_back();
    options.materials[0].density = 1000;
    options.materials[0].constants = {.M_v = 4e8, .M_alpha = 8e8, .M_beta = 8e8, .M_psi = 8e8};
    options.run.t_end = 1e-3;
    return options;
}

/// Displacement of a state by a linear field, u = H x.
inline void displace(State& state, const Mesh& mesh, const std::array<double, 4>& h) {
    for (std::size_t i = 0; i < mesh.n_nodes(); ++i) {
        const auto [x, y] = mesh.nodes[i];
        state.u[2 * i] = h[0] * x + h[1] * y;
        state.u[2 * i + 1] = h[2] * x + h[3] * y;
    }
}

}  // namespace gneiss::test
