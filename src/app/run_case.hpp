#pragma once
// `gneiss run`: one case from its deck to its results.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gneiss {

/// Exit codes of the program.
namespace exit_code {
inline constexpr int done = 0, bad_input = 2, failed = 3;
}

struct RunArguments {
    std::filesystem::path deck;
    std::filesystem::path out;  ///< empty: results/NAME, NAME being the deck's without its ending
    std::vector<std::string> set;
    int threads = 0;  ///< 0: as many as there are cores
    std::optional<std::filesystem::path> restart;
    bool overwrite = false;  ///< results of a finished run of another deck
    bool quiet = false;
};

/// Results stand in `out`, however the run ends: summary.json says how. Of an older run in the same folder nothing
/// stays but what a restart goes on with; a folder in which a run is under way is refused, and so is one that holds a
/// finished run of another deck, unless `overwrite` is set.
/// @return exit code: 0 done, 3 failed, 130 or 143 interrupted
/// @throws InputError before the first step
/// @throws IoError if results cannot be written
int run_case(const RunArguments& arguments);

}  // namespace gneiss
