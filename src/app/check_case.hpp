#pragma once
// `gneiss check`: is the deck sound, and what would it cost?

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace gneiss {

/// Prints sizes, stable step, number of steps, expected wall time (from a few steps taken) and memory.
/// @param threads  0: as many as there are cores
/// @throws InputError, RecoverableError
void check_case(const std::filesystem::path& deck, const std::vector<std::string>& set, int threads, std::ostream& out);

}  // namespace gneiss
