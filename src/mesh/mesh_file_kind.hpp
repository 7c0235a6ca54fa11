#pragma once
// Which reader a mesh file belongs to.

#include <filesystem>

namespace gneiss {

enum class MeshFileKind { msh, geo, abaqus, other };

/// By how the name ends, in small letters or in capitals.
MeshFileKind mesh_file_kind(const std::filesystem::path& file);

}  // namespace gneiss
