#include "mesh/gmsh_session.hpp"

#include <omp.h>

#include <clocale>
#include <utility>

namespace gneiss {
namespace {

std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace

GmshSession::GmshSession()
    : lock_(one_at_a_time()), n_threads_(omp_get_max_threads()), locale_(std::setlocale(LC_ALL, nullptr)) {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 0);
    gmsh::logger::start();
}

GmshSession::~GmshSession() {
    try {
        gmsh::logger::stop();
        gmsh::finalize();
    } catch (...) {
        // Nothing depends on a clean end: the next session initialises Gmsh anew.
    }
    omp_set_num_threads(n_threads_);
    std::setlocale(LC_ALL, locale_.c_str());
}

std::vector<std::string> GmshSession::log_lines(const std::string& prefix) const {
    std::vector<std::string> log, found;
    gmsh::logger::get(log);
    for (const std::string& line : log)
        if (line.rfind(prefix, 0) == 0) found.push_back("Gmsh: " + line.substr(prefix.size()));
    return found;
}

void GmshSession::throw_errors(const std::string& where, std::size_t n_before) const {
    const std::vector<std::string> found = errors();
    std::vector<Problem> problems;
    for (std::size_t i = n_before; i < found.size(); ++i) problems.push_back({where, found[i]});
    if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace gneiss
