#pragma once
// Too few supports: the rigid motions that prescribed motion leaves free.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// A connected part of a mesh that can move as a rigid body.
struct FreePart {
    std::size_t n_elements = 0;
    std::array<double, 2> centre{0, 0};  ///< mean of its nodes, m
    std::vector<std::string> motions;    ///< "translation in x", "translation in y", "rotation about (x, y)"
};

/// Two nodes whose parts may press on each other, or a node and something fixed.
struct Touch {
    std::int32_t node, other;  ///< other: -1 is what is fixed
    std::array<double, 2> at;  ///< m
    std::array<double, 2> normal;
    bool rough = false;  ///< holds along the tangent as well
};

/// Parts of a mesh, by their first element, with the small rigid motions about the reference shape that no constraint
/// holds: those that elastic forces do not resist, so that a static tangent is singular. A part is what elements with
/// common nodes make up. Mechanisms of rigid parts that hang together by a single node are not looked for.
///
/// A prescribed x holds the translation in x; prescribed x at different heights, or prescribed y at different widths,
/// hold the rotation.
/// @param bonds    pairs of nodes that hold together without being one: joints
/// @param touches  taken to press: parts that hold each other in this way, and those held by what is fixed, are not
/// free
std::vector<FreePart> free_parts(const Mesh& mesh, std::span<const Constraint> constraints,
                                 std::span<const std::array<std::int32_t, 2>> bonds = {},
                                 std::span<const Touch> touches = {});

/// One line for each, "the solid: translation in x, rotation about (0, 0)", but no more than a few.
std::string describe(const std::vector<FreePart>& parts, const Mesh& mesh);

}  // namespace gneiss
