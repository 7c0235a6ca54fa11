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

/// Opens every inner side but some and numbers nodes anew: elements have nodes of their own.
/// @param bonded  numbers of those left out, ascending
void open_all_sides(InnerSides& inner, std::span<const std::int32_t> bonded = {});

/// Sub-edges of every inner side but some, opened or not.
/// @param left_out  their numbers, ascending
std::vector<JointEdge> all_edges(const Mesh& mesh, const InnerSides& inner,
                                 std::span<const std::int32_t> left_out = {});

/// What holds these edges together: the strengths of their interface or else of their materials; those of sides that
/// may not crack are infinite. Where two materials meet, or axes differ, each property is the smaller one of the two
/// sides. The scatter of an edge depends on the number of its inner side alone, for both sub-edges of a composite's
/// side.
/// @param blocks         of the mesh
/// @param interfaces     with which sides belong to them
/// @param[out] warnings  edges longer than the length over which cracks soften
/// @throws InputError with every problem: materials without strength on edges that no interface claims, properties that
///     the law cannot take
std::vector<CohesionProperties<double>> edge_properties(const Mesh& mesh, std::span<const JointEdge> edges,
                                                        std::span<const std::unique_ptr<ElementBlock>> blocks,
                                                        const std::vector<MaterialOptions>& materials,
                                                        const FractureOptions& fracture,
                                                        const std::vector<InterfaceOptions>& interfaces,
                                                        const NamedSides& named, std::vector<std::string>& warnings);

/// Joints on edges that are there from the start.
/// @param edges       of the opened mesh
/// @param properties  of edge_properties()
std::unique_ptr<Joints> make_cohesion(const Mesh& mesh, std::span<const JointEdge> edges,
                                      std::span<const CohesionProperties<double>> properties,
                                      FractureOptions::Method method, double thickness);

/// What stresses are compared with while forces are computed.
struct WatchReach {
    bool around_nodes = false;  ///< with the strengths of all sides at an element's nodes, not of its own sides alone
    double factor = 1;          ///< which have to be this times the stress, -
};

/// Lets blocks watch the strength of sides.
/// @param edges, properties  of every inner side
void watch_strength(const Mesh& mesh, std::span<const JointEdge> edges,
                    std::span<const CohesionProperties<double>> properties,
                    std::span<const std::unique_ptr<ElementBlock>> blocks, const WatchReach& reach);

}  // namespace gneiss
