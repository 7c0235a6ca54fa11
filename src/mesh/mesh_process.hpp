#pragma once
// Gmsh in a process of its own: what it does to itself on a broken file does not happen to the program.

#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/draft.hpp"

namespace gneiss {

/// How files that Gmsh reads are read.
struct MeshProcess {
    /// Is called as `PROGRAM read-mesh RESULT FILE [NAME=VALUE ...]` and passes what follows the first word to
    /// serve_mesh(). Empty: Gmsh works in this process.
    std::filesystem::path program;
    /// Called about five times a second while the other process is at work.
    /// @param seconds  since it started
    /// @param said     the last line that Gmsh has printed
    std::function<void(const std::filesystem::path& file, double seconds, std::string_view said)> progress = {};
    /// Called once it has ended, however it did.
    std::function<void()> ended = {};
};

constexpr std::string_view mesh_process_command = "read-mesh";

/// From here on for all of this process. A program sets it once, before it starts threads; where nobody does, as in a
/// test or behind the library, Gmsh works in this process.
void use_mesh_process(MeshProcess process);

/// A signal that came while the other process was at work, which has been stopped.
class MeshInterrupted : public std::runtime_error {
public:
    explicit MeshInterrupted(int number) : std::runtime_error("interrupted"), signal(number) {}
    int signal;
};

/// read_gmsh(), in the process that use_mesh_process() asks for.
/// @throws InputError as read_gmsh(), or with how the process ended and what Gmsh said last
/// @throws MeshInterrupted on SIGINT and SIGTERM, to either process
MeshDraft read_gmsh_apart(const std::filesystem::path& file, const std::map<std::string, double>& parameters);

/// What the other process does: reads a mesh and leaves the draft, or what is wrong with it, in a file. Ends with the
/// process that has started it.
/// @param words  RESULT FILE [NAME=VALUE ...]
/// @return exit status
int serve_mesh(const std::vector<std::string>& words);

}  // namespace gneiss
