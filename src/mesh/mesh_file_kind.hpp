#pragma once
// Which reader a mesh file belongs to.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace gneiss {

enum class MeshFileKind { msh, geo, abaqus, other };

/// By how the name ends, in small letters or in capitals.
inline MeshFileKind mesh_file_kind(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".msh") return MeshFileKind::msh;
    if (extension == ".geo") return MeshFileKind::geo;
    return extension == ".inp" ? MeshFileKind::abaqus : MeshFileKind::other;
}

}  // namespace gneiss
