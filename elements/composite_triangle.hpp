#pragma once
// COMPT, the six-noded composite triangle: four sub-triangles with strains of their own and one volume  [FORMULATION 2;
// Lei et al. 2016, section 3]. The numbering is drawn in mesh/composite.hpp.

#include "mesh/composite.hpp"

namespace gneiss {

/// Sides may be curved: every sub-triangle has a shape of its own.
struct CompositeTriangle {
    static constexpr int n_nodes = composite_nodes;
    static constexpr int n_sub = sub_triangles_per_composite;
    static constexpr std::array<SubTriangle, n_sub> sub_triangles = composite_sub_triangles;
    static constexpr const char* name = "compt";
    /// The sub-triangle at whose centre `Volumetric::centre` takes the volumetric stretch: number 4 of Table 1.
    static constexpr int central = 3;
    static constexpr bool similar = false;
};

/// The same element with straight sides and mid-side nodes in the middle: the sub-triangles are one triangle, moved,
/// and the central one turned by 180 degrees. A quarter of the geometry is stored and streamed. Each (a, b, c) is that
/// of Table 1, rotated so that corresponding edges correspond.
struct StraightCompositeTriangle {
    static constexpr int n_nodes = composite_nodes;
    static constexpr int n_sub = sub_triangles_per_composite;
    static constexpr std::array<SubTriangle, n_sub> sub_triangles{{{1, 0, 5}, {2, 1, 3}, {3, 5, 4}, {5, 3, 1}}};
    static constexpr const char* name = "compt";
    static constexpr int central = 3;
    static constexpr bool similar = true;
};

}  // namespace gneiss
