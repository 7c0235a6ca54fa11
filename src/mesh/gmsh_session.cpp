#include "mesh/gmsh_session.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <clocale>
#include <map>
#include <utility>

namespace gneiss {
namespace {

std::mutex& one_at_a_time() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace

GmshSession::GmshSession(bool aloud)
    : lock_(one_at_a_time()), n_threads_(omp_get_max_threads()), locale_(std::setlocale(LC_ALL, nullptr)) {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", aloud ? 1 : 0);
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
    bool in_summary = false;
    for (const std::string& line : log) {
        if (!line.starts_with(prefix)) continue;
        std::string text = line.substr(prefix.size());
        if (text.starts_with("----")) {
            in_summary = !in_summary;
            continue;
        }
        if (in_summary) continue;
        for (const auto& [file, name] : names_)
            for (std::size_t at = text.find(file); at != std::string::npos; at = text.find(file, at + name.size()))
                text.replace(at, file.size(), name);
        found.push_back("Gmsh: " + text);
    }
    return found;
}

std::vector<std::string> GmshSession::warnings() const {
    std::vector<std::string> all = log_lines("Warning: ");
    all.insert(all.end(), harmless_.begin(), harmless_.end());
    return all;
}

void GmshSession::throw_errors(const std::string& where, std::size_t n_before,
                               const std::function<bool(const std::string&)>& harmless) {
    const std::vector<std::string> found = errors();
    std::vector<std::pair<std::string, int>> each;  // and how often
    std::map<std::string, std::size_t> place;
    for (std::size_t i = n_before; i < found.size(); ++i) {
        const auto [at, is_new] = place.try_emplace(found[i], each.size());
        if (is_new) each.emplace_back(found[i], 0);
        ++each[at->second].second;
    }
    std::vector<Problem> problems;
    for (const auto& [error, times] : each) {
        const std::string told = times == 1 ? error : fmt::format("{} ({} times)", error, times);
        if (harmless && harmless(error))
            harmless_.push_back(told);
        else
            problems.push_back({where, told});
    }
    if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace gneiss
