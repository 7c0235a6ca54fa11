#pragma once
// Meshes from Gmsh: .msh files, .geo files meshed in process.

#include <filesystem>
#include <map>
#include <string>

#include "mesh/draft.hpp"

namespace gneiss {

/// Reads a .msh, or meshes a .geo. Three-noded triangles get mid-side nodes halfway along their sides; six-noded ones
/// keep theirs, which for a .geo follow the geometry. Names come from physical groups, surfaces giving regions, curves
/// giving lines, points giving points; a group without a name is called by its number. Without physical surfaces
/// everything is region "solid"; if some surfaces are in groups, all must be. $ElementData of one component become
/// element_data by the name of the view.
/// @param parameters  numbers defined before a .geo is read, where DefineConstant[] finds them; each must occur in the
///                    file and must still have its value at the end
/// @throws InputError if the file cannot be read or meshed, holds elements other than triangles, is not plane, or holds
///                    data for some triangles only
MeshDraft read_gmsh(const std::filesystem::path& file, const std::map<std::string, double>& parameters);

/// The mesh of Gmsh's current model, as read_gmsh(). A GmshSession must be alive.
/// @param where  prefix of messages
MeshDraft draft_of_current_model(const std::string& where);

}  // namespace gneiss
