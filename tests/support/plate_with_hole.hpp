#pragma once

#include <array>

#include "mesh/make_mesh.hpp"

namespace gneiss::test {

/// A square plate with a hole of radius 1 m, coarse.
/// @param size  of the elements at the hole and outside, m
inline Mesh plate_with_hole(bool compt, double side = 6, const std::array<double, 2>& size = {0.8, 1.6}) {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    options.layout = MeshOptions::Layout::structured;
    options.side = side;
    options.radius = 1;
    options.size = size;
    return make_mesh(options, compt, {});
}

}  // namespace gneiss::test
