#pragma once
// From what a user says about fracture to joints between the elements of a mesh.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fracture/joints.hpp"
#include "mesh/inner_sides.hpp"
#include "model/element_block.hpp"
#include "model/options.hpp"

namespace gneiss {

/// Opens every inner side: elements have nodes of their own.
/// @return the sub-edges between them
std::vector<JointEdge> open_all_sides(Mesh& mesh);
std::vector<JointEdge> open_all_sides(Mesh& mesh, InnerSides& inner);

/// Sub-edges of every inner side, opened or not.
std::vector<JointEdge> all_edges(const Mesh& mesh, const InnerSides& inner);

/// What holds these edges together. Where two materials meet, or axes differ, each property is the smaller one of the
/// two sides. The scatter of an edge depends on the number of its inner side alone, for both sub-edges of a composite's
/// side.
/// @param blocks         of the mesh
/// @param[out] warnings  edges longer than the length over which cracks soften
/// @throws InputError with every problem: materials without strength, properties that the law cannot take
std::vector<CohesionProperties<double>> edge_properties(const Mesh& mesh, std::span<const JointEdge> edges,
                                                        std::span<const std::unique_ptr<ElementBlock>> blocks,
                                                        const std::vector<MaterialOptions>& materials,
                                                        const FractureOptions& fracture,
                                                        std::vector<std::string>& warnings);

/// Joints on edges that are there from the start.
/// @param edges       of open_all_sides()
/// @param properties  of edge_properties()
std::unique_ptr<Joints> make_cohesion(const Mesh& mesh, std::span<const JointEdge> edges,
                                      std::span<const CohesionProperties<double>> properties,
                                      FractureOptions::Method method, double thickness);

/// Lets blocks watch the strength of their elements' sides.
/// @param edges, properties  of every inner side
void watch_strength(std::span<const JointEdge> edges, std::span<const CohesionProperties<double>> properties,
                    std::span<const std::unique_ptr<ElementBlock>> blocks);

}  // namespace gneiss
