#pragma once
// The three-noded triangles of which the elements of a mesh consist.

#include <span>

#include "mesh/composite.hpp"
#include "mesh/mesh.hpp"

namespace gneiss {

/// Local node numbers of the triangles of one element: (a, b, c) of composite.hpp, or the CST itself.
inline std::span<const SubTriangle> sub_triangles(ElementKind kind) {
    static constexpr SubTriangle cst{0, 1, 2};
    if (kind == ElementKind::cst) return {&cst, 1};
    return composite_sub_triangles;
}

/// Node numbers of triangle `sub` of element e.
inline std::array<int, 3> triangle_nodes(const Mesh& mesh, std::size_t e, int sub) {
    const auto [i, j, k] = sub_triangles(mesh.kind)[static_cast<std::size_t>(sub)];
    return {mesh.element(e)[i], mesh.element(e)[j], mesh.element(e)[k]};
}

}  // namespace gneiss
