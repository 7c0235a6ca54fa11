#pragma once
// Constant strain triangle: one sub-triangle that is its own composite.
//
//     2
//     | \        counter-clockwise
//     0--1

#include <array>

#include "mesh/composite.hpp"

namespace gneiss {

struct Cst {
    static constexpr int n_nodes = 3;
    static constexpr int n_sub = 1;
    /// (a, b, c): edges leave from b.
    static constexpr std::array<SubTriangle, 1> sub_triangles{{{1, 0, 2}}};
    static constexpr const char* name = "cst";
    static constexpr bool similar = true;  ///< all sub-triangles have one shape
    static constexpr int central = -1;     ///< none is turned
};

}  // namespace gneiss
