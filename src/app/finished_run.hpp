#pragma once
// Results of a run that has ended are not replaced by those of another.

#include <filesystem>
#include <string>
#include <vector>

namespace gneiss {

/// @param own  fingerprints of the decks whose results may go
/// @throws InputError if the folder holds a finished run of any other deck
void keep_finished_run(const std::filesystem::path& folder, const std::vector<std::string>& own);

}  // namespace gneiss
