#pragma once
// The six-noded composite triangle as tables of local node numbers, 0-based. The one place where its numbering lives.
//
//              4            nodes counter-clockwise around the triangle,
//             / \           corners 0, 2, 4, mid-sides 1, 3, 5
//            / 2 \          (1 to 6 in Lei et al. 2016, Figure 1a);
//           5-----3         sub-triangles 0 to 3 (1 to 4 there)
//          / \ 3 / \       .
//         / 0 \ / 1 \      .
//        0-----1-----2

#include <array>

namespace gneiss {

inline constexpr int composite_nodes = 6;
inline constexpr int sub_triangles_per_composite = 4;

using SubTriangle = std::array<int, 3>;

/// Sub-triangles as (a, b, c) of FORMULATION 2: (2,1,6), (3,2,4), (5,4,6), (4,2,6) there. Edge vectors leave from b:
/// det[x_a - x_b, x_c - x_b] has the sign of the composite's numbering, the triple a, b, c itself runs the other way.
inline constexpr std::array<SubTriangle, 4> composite_sub_triangles{{{1, 0, 5}, {2, 1, 3}, {4, 3, 5}, {3, 1, 5}}};

/// The three sides, each as corner, mid-side, corner in walking order with the element on the left.
inline constexpr std::array<std::array<int, 3>, 3> composite_sides{{{0, 1, 2}, {2, 3, 4}, {4, 5, 0}}};

/// The same corners for a three-noded triangle: (b, a, c), counter-clockwise where the composite is.
constexpr SubTriangle counter_clockwise(const SubTriangle& abc) { return {abc[1], abc[0], abc[2]}; }

}  // namespace gneiss
