#pragma once
// What explicit steps are timed on.

#include <cmath>
#include <vector>

#include "mesh/make_mesh.hpp"
#include "model/options.hpp"

namespace gneiss::benchmark {

/// A square of about n elements of a kind, meshed with alternating diagonals.
inline Mesh square(bool compt, std::int64_t n) {
    const int per_cell = compt ? 2 : 8;
    const int cells = static_cast<int>(std::lround(std::sqrt(static_cast<double>(n) / per_cell)));
    MeshOptions options;
    options.source = MeshOptions::Source::rectangle;
    options.cells = {cells, cells};
    options.pattern = MeshOptions::Pattern::alternating;
    return make_mesh(options, compt, {});
}

/// Initial velocity that strains every element by about 1e-3 in the course of the run.
inline double velocity(double x) { return std::sin(7 * x); }

inline MaterialOptions anisotropic(Form form) {
    MaterialOptions material;
    material.form = form;
    material.density = 1000;
    material.constants = {0.267e9, 0.8e9, 1.6e9, 0.8e9};
    material.axes.angle = Formula(0.3);
    return material;
}

inline std::vector<double> velocities(const Mesh& mesh) {
    std::vector<double> v;
    for (const auto& node : mesh.nodes) v.insert(v.end(), {velocity(node[0]), 0.0});
    return v;
}

}  // namespace gneiss::benchmark
