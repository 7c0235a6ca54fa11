#include "mesh/mesh_file_kind.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace gneiss {

MeshFileKind mesh_file_kind(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".msh") return MeshFileKind::msh;
    if (extension == ".geo") return MeshFileKind::geo;
    return extension == ".inp" ? MeshFileKind::abaqus : MeshFileKind::other;
}

}  // namespace gneiss
