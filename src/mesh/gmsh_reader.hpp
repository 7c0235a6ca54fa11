#pragma once
// Meshes from Gmsh: .msh files, .geo files meshed in process.

#include <filesystem>
#include <map>
#include <string>

#include "mesh/draft.hpp"

namespace gneiss {

/// Reads a .msh, or meshes a .geo. Three-noded triangles get mid-side nodes halfway along their sides; six-noded ones
/// keep theirs, which for a .geo follow the geometry. Names come from physical groups, surfaces giving regions, curves
/// giving lines, points giving points; a group without a name is called by its number. Surfaces in no group are region
/// "solid". $ElementData of one component become element_data by the name of the view. All versions of the format that
/// Gmsh reads are read, partitioned files too.
/// @param parameters  numbers defined before a .geo is read, where DefineConstant[] finds them; each must occur in the
///                    file and must still have its value at the end
/// @param aloud  see GmshSession
/// @throws InputError if the file cannot be read or meshed, holds elements other than triangles, or is not plane
MeshDraft read_gmsh(const std::filesystem::path& file, const std::map<std::string, double>& parameters,
                    bool aloud = false);

/// The mesh of Gmsh's current model, as read_gmsh(). A GmshSession must be alive.
/// @param where  prefix of messages
MeshDraft draft_of_current_model(const std::string& where);

}  // namespace gneiss
