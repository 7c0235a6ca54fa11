#pragma once
// Joints that are there from the start, in a solid under stress in situ.

#include <array>
#include <cstddef>
#include <span>

#include "fracture/joints.hpp"
#include "model/solid_system.hpp"

namespace gneiss {

/// Gives every end of every joint the traction with which the solid moves off as if its elements were bonded: all
/// copies of a node with one acceleration, none where the stress is in equilibrium. What that leaves open, and what
/// supports hold, is the traction of the mean stress of the two elements.
/// @param inner   of the mesh
/// @param stress  of stress_at_rest()
/// @return ends whose traction is beyond their strength: they fail in the first step
std::size_t preload_joints(Joints& joints, const InnerSides& inner, const SolidSystem& solid,
                           std::span<const std::array<double, 3>> stress);

}  // namespace gneiss
