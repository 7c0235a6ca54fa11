#pragma once
// Are the numbers of a case those of a solid in SI units? What cannot be an error of the deck, and hardly was meant.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/build_case.hpp"

namespace gneiss {

struct Plausibility {
    std::vector<std::pair<std::string, std::string>> facts;  ///< "wave speeds", "c_P 5774 m/s, c_S …"
    std::vector<std::string> warnings;                       ///< each with its numbers
    std::string overload;  ///< of the warnings the first that tells of a load too large for the solid; empty: none does
};

/// Looks at speeds of waves, elements per wavelength, loads and strengths against moduli, time and its steps,
/// densities, angles, gravity, stress in situ that nothing balances, faces of cracks that nothing keeps apart,
/// intervals of output and space for it. Of anisotropic materials the largest modulus counts.
/// @param folder  of the results, there or not yet
Plausibility plausibility(const Case& built, const std::filesystem::path& folder);

}  // namespace gneiss
