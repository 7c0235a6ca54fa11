#pragma once
// From what a user says about fracture to joints between the elements of a mesh.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fracture/joints.hpp"
#include "fracture/named_sides.hpp"
#include "mesh/inner_sides.hpp"
#include "model/element_block.hpp"
#include "model/options.hpp"

namespace gneiss {

/// Opens every inner side: elements have nodes of their own, and a joint lies wherever two of them touch.
/// @param inner    of the mesh
/// @param cracked  numbers of sides that get no joint, ascending
/// @return the sub-edges of all joints
std::vector<JointEdge> open_all_sides(const Mesh& mesh, InnerSides& inner, std::span<const std::int32_t> cracked);

/// Joints on these edges, with the strengths of their interface or else of their materials. Where two materials meet,
/// or axes differ, each property is the smaller one of the two sides. The scatter of an edge depends on the number of
/// its inner side alone, for both sub-edges of a composite's side.
/// @param edges          of open_all_sides()
/// @param blocks         of the opened mesh
/// @param named          which sides belong to which of the interfaces
/// @param[out] warnings  edges longer than the length over which cracks soften
/// @throws InputError with every problem: materials without strength on edges that no interface claims, properties that
///     the law cannot take
std::unique_ptr<Interaction> make_cohesion(const Mesh& mesh, std::span<const JointEdge> edges,
                                           std::span<const std::unique_ptr<ElementBlock>> blocks,
                                           const std::vector<MaterialOptions>& materials, const SolidOptions& solid,
                                           const FractureOptions& fracture,
                                           const std::vector<InterfaceOptions>& interfaces, const NamedSides& named,
                                           std::vector<std::string>& warnings);

}  // namespace gneiss
