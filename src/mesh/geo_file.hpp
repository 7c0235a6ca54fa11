#pragma once
// Geometries in Gmsh's own language: what is looked at before Gmsh reads them, and what of its errors is none.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/gmsh_session.hpp"

namespace gneiss {

/// Reads a .geo into Gmsh's current model and meshes its surfaces with six-noded triangles, unless the file did so.
/// Errors after which Gmsh has lost nothing but a wish about the size of elements or an option of its own (an option
/// that this version does not know, a field, a transfinite surface that does not work out, fragments of a lone surface)
/// are left to the warnings of the session.
/// @param parameters  numbers defined before the file is read
/// @throws InputError with what Gmsh says, or with outlines that cross themselves (crossed_lines.hpp)
void mesh_geo(GmshSession& session, const std::filesystem::path& file, const std::map<std::string, double>& parameters);

}  // namespace gneiss
