#pragma once
// Outlines that cross themselves: told from the geometry, since Gmsh's mesher need not say so.

#include <string>
#include <vector>

#include "base/errors.hpp"

namespace gneiss {

/// Straight lines of the outline of a surface of Gmsh's current model that are crossed between their ends by another
/// straight line of it, or by one embedded in the surface: one problem per surface, with the first crossing and the
/// number of them. Gmsh 4.8 refuses the first kind and meshes something else than the drawing of the second; 4.13 may
/// not come back from either. Embedded lines may cross each other. Nothing is said of curved lines, of lines on top of
/// each other, and of a line that leaves the surface by way of a point of its outline.
/// @param where  the file, for the problems
std::vector<Problem> crossed_outlines(const std::string& where);

}  // namespace gneiss
