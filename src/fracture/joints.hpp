#pragma once
// Joints: pairs of sub-edges that a cohesion law holds together  [FORMULATION 7].

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fracture/cohesion_properties.hpp"
#include "mesh/inner_sides.hpp"
#include "model/interaction.hpp"

namespace gneiss {

/// One joint: nodes of the sub-edge of the left element in walking order, the nodes opposite them, and what holds them.
struct Joint {
    std::array<std::int32_t, 4> nodes;  ///< a0, a1, b0, b1 of joint_kernel.hpp
    CohesionProperties<double> properties;
};

/// A sub-edge along which two elements touch.
struct JointEdge {
    std::array<std::int32_t, 4> nodes;  ///< as in Joint
    std::int32_t left, right;           ///< elements
    std::int32_t side;                  ///< number of the inner side
};

/// The sub-edges of sides of elements: one for a CST, two for a composite.
/// @param sides  numbers of inner sides, all of them open
std::vector<JointEdge> joint_edges(const Mesh& mesh, const InnerSides& inner, std::span<const std::int32_t> sides);

enum class JointLaw {
    intrinsic,  ///< MixedModeLaw<Insertion::intrinsic>
    y_code      ///< YCodeLaw
};

/// @param joints     at least one; their nodes stand at the same places in pairs
/// @param thickness  of the solid, m
std::unique_ptr<Interaction> make_joints(const Mesh& mesh, const std::vector<Joint>& joints, JointLaw law,
                                         double thickness);

}  // namespace gneiss
