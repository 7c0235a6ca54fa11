#pragma once
// summary.json: how a run ended, and every number that was asked for.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace gneiss {

enum class RunStatus { running, done, failed, interrupted };

/// "running", "done", "failed", "interrupted".
std::string_view name_of(RunStatus status);

/// The result of a run. The groups are objects that keep the order in which they are filled:
/// groups["energies"]["kinetic"]. Names say the unit where there is one: "wall_time_s", "energies_J".
struct RunSummary {
    RunStatus status = RunStatus::running;
    std::string message = {};                                          ///< why it failed or stopped; left out if empty
    std::string title = {};                                            ///< the deck's
    std::string deck_fingerprint = {};                                 ///< fingerprint_text() of the deck as it was run
    nlohmann::ordered_json groups = nlohmann::ordered_json::object();  ///< counts, timings, energies, metrics, …
    std::string balance_warning = {};                                  ///< that of the balance; left out if empty
    std::vector<std::string> warnings = {};                            ///< all, in the order in which they were given
};

/// What summary.json holds: status, message, balance_warning, warnings (these three if there are any), title, version,
/// deck_fingerprint, then the groups. JSON has no nan and no infinity: such a number becomes null, and "not_finite"
/// lists where it stood and what it was: "/metrics/peak: nan".
nlohmann::ordered_json to_json(const RunSummary& summary);

/// Writes it whole or not at all. Text that is not UTF-8 has its bad bytes replaced. @throws IoError
void write_summary(const std::filesystem::path& path, const RunSummary& summary);

}  // namespace gneiss
