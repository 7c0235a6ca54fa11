#pragma once
// The list of a series' files with their times: a .pvd, which ParaView opens as one animation.

#include <filesystem>
#include <string>
#include <vector>

namespace gneiss {

struct PvdFrame {
    double t;          ///< s
    std::string file;  ///< relative to the .pvd
};

/// Writes the list whole or not at all; times in the shortest decimals that read back exactly. @throws IoError
void write_pvd(const std::filesystem::path& path, const std::vector<PvdFrame>& frames);

/// Reads a list that write_pvd() wrote. @throws InputError if the file is none. @throws IoError if it cannot be read
std::vector<PvdFrame> read_pvd(const std::filesystem::path& path);

}  // namespace gneiss
