#pragma once
// --set key=value

#include <string>
#include <vector>

#include "io/deck/value.hpp"

namespace gneiss::deck {

/// Lays one "key=value" over the deck. Keys are dotted, elements of arrays by their number: material.0.density or
/// material[0].density. The value is TOML; what is no TOML and begins like a word is a string.
/// Everything it brings into the deck has the place "--set key=value". Problems are reported, the deck then stays.
void apply_override(toml::table& deck, const std::string& argument, Findings& findings);

}  // namespace gneiss::deck
