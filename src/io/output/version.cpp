#include "io/output/version.hpp"

#include "gneiss_git_revision.hpp"

namespace gneiss {

std::string version() { return GNEISS_VERSION; }

std::string git_revision() { return GNEISS_GIT_REVISION; }

std::string version_string() { return version() + " (" + git_revision() + ")"; }

}  // namespace gneiss
