#pragma once
// Built-in meshes. They return drafts with straight-sided elements whose mid-side nodes are all there.

#include "mesh/draft.hpp"
#include "mesh/mesh_options.hpp"

namespace gneiss {

/// Rectangle of cells, each cut into composites: two by a diagonal, or four by both diagonals (crossed). Region
/// "solid"; boundaries "left", "right", "bottom", "top", "outer"; points "bottom_left", "bottom_right", "top_right",
/// "top_left".
MeshDraft rectangle(const MeshOptions& options);

/// The same for any convex quadrilateral: the lines between cells are straight and divide opposite sides alike.
MeshDraft quadrilateral(const MeshOptions& options);

/// Square block centred at the origin with a circular hole: rings of cells between the circle and the square, graded
/// geometrically, the diagonals alternating. Has every symmetry of the square. Region, boundaries and points as
/// rectangle(), and boundary "hole".
MeshDraft structured_plate_with_hole(const MeshOptions& options);

/// The same block meshed by Gmsh without structure. The hole is divided into an odd number of edges, the first of which
/// starts at an angle set by the seed, so that no rotation by 45 or 90 degrees maps the mesh to itself.
MeshDraft free_plate_with_hole(const MeshOptions& options);

/// Puts every node of a line on the circle about the origin.
/// @param radius  m
void follow_circle(MeshDraft& draft, const std::string& line, double radius);

/// Edge length of a composite of the plate at distance r from the centre, m: size[0] at the hole, growing linearly to
/// size[1] where the circle touches the outer boundary, and size[1] beyond.
double plate_edge_length(const MeshOptions& options, double r);

/// Cells of the structured plate. `around` is a multiple of 8, so that the corners of the square are nodes, and large
/// enough for size[0] at the hole and size[1] at the outer boundary.
struct PlateDivision {
    double around, rings;  ///< whole numbers; double, since a slip in a size makes them exceed any integer
};
PlateDivision plate_division(const MeshOptions& options);

}  // namespace gneiss
