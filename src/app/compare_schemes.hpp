#pragma once
// `gneiss compare`: one case under several schemes.

#include "app/run_case.hpp"

namespace gneiss {

/// Runs the case under the reference and every scheme of [compare], each in a process of its own, one after the other.
/// In `out` (empty: results/NAME-compare) stand compare.csv, compare.json, report.html, and a folder of each run under
/// runs/. A run that is there already, of the same deck, files and program, is not repeated. One that fails has a row
/// that says why.
/// @param program  path of this program
/// @return exit code: 0 if every run came to its end, 3 if one did not, 130 or 143 interrupted
/// @throws InputError if the deck has mistakes or nothing to compare, if `out` is in use, or if it holds a comparison
/// on
///         another problem and `overwrite` is not set
/// @throws RecoverableError if the reference failed: it comes first, and nothing else has run then
/// @throws IoError
int compare_schemes(const RunArguments& arguments, const std::filesystem::path& program);

}  // namespace gneiss
