#pragma once

#include <string>

namespace gneiss {

/// Version of the project, as in CMakeLists.txt: "0.1.0".
std::string version();

/// Commit that the program was built from, with "-dirty" if tracked files differed; "unknown" outside a git checkout.
std::string git_revision();

/// Both, as they stand in summary.json and checkpoint.h5: "0.1.0 (85d29ea)".
std::string version_string();

}  // namespace gneiss
