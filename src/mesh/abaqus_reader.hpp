#pragma once
// Meshes from input files of Abaqus.

#include <filesystem>

#include "mesh/draft.hpp"

namespace gneiss {

/// Reads the plane triangles of an Abaqus input file (CPS3, CPE3, CPS6, CPE6 and their variants, membranes and shells
/// that lie in the plane), flat or in parts and instances. Sets of triangles give regions, which may overlap; sets of
/// trusses and beams, and surfaces of element faces, give lines; sets of nodes give points. Internal sets give nothing.
/// Materials, sections and steps are not looked at. A set in several instances is one.
/// @throws InputError with everything that is wrong, by line: elements of other shapes, nodes and sets that are not
///     there, keywords that make nodes or elements, a mesh that is not plane
MeshDraft read_abaqus(const std::filesystem::path& file);

}  // namespace gneiss
