#pragma once
// COMPT, the six-noded composite triangle: four sub-triangles with strains of their own and one volume  [FORMULATION 2;
// Lei et al. 2016, section 3]. The numbering is drawn in mesh/composite.hpp.

#include "mesh/composite.hpp"

namespace gneiss {

struct CompositeTriangle {
    static constexpr int n_nodes = composite_nodes;
    static constexpr int n_sub = sub_triangles_per_composite;
    static constexpr std::array<SubTriangle, n_sub> sub_triangles = composite_sub_triangles;
    static constexpr const char* name = "compt";
    /// The sub-triangle at whose centre `Volumetric::centre` takes the volumetric stretch: number 4 of Table 1.
    static constexpr int central = 3;
};

}  // namespace gneiss
