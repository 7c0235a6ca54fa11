#pragma once
// Sizes of a mesh and of its elements, in the reference shape.

#include <array>
#include <vector>

#include "mesh/mesh.hpp"

namespace gneiss {

/// Centroid of each element, m: of a composite the centroid of its four sub-triangles together.
std::vector<std::array<double, 2>> element_centroids(const Mesh& mesh);

/// Area of each element, m2: of a composite the sum of its four sub-triangles.
std::vector<double> element_areas(const Mesh& mesh);

/// True if the mid-side nodes of a composite stand in the middle of straight sides, to round-off.
bool has_straight_sides(const Mesh& mesh, std::size_t element);

struct MeshSize {
    std::size_t n_nodes = 0, n_elements = 0;
    double smallest_edge = 0, largest_edge = 0;  ///< of the sub-triangles, m
    double area = 0;                             ///< m2
};
MeshSize mesh_size(const Mesh& mesh);

/// By size, m: nodes are known to round-off of it.
double largest_coordinate(const Mesh& mesh);

}  // namespace gneiss
