#pragma once
// "did you mean …?": the name that a misspelt one was probably meant to be.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gneiss {

/// Least number of insertions, deletions, replacements and swaps of neighbours that turn a into b, no part being
/// changed twice (Damerau-Levenshtein in its optimal string alignment form). Upper and lower case count as equal.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The nearest of the candidates, or empty if none is near enough to be a slip of the finger.
std::string_view nearest(std::string_view given, const std::vector<std::string_view>& candidates);

/// ", did you mean `x`?" for the nearest candidate, or empty.
std::string suggestion(std::string_view given, const std::vector<std::string_view>& candidates);

}  // namespace gneiss
