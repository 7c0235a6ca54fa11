#pragma once
// The page that shows a comparison of schemes.

#include <string>
#include <vector>

#include "app/comparison.hpp"

namespace gneiss {

/// @param reference  what errors are measured against, in words
/// @param worth      how far that is off itself, a sentence; empty: not at all
/// @return HTML
std::string comparison_report(const std::string& title, const std::string& reference, const std::string& worth,
                              const std::vector<ComparedRun>& runs);

}  // namespace gneiss
