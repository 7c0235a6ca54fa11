#pragma once
// An Abaqus input file as a list of its keywords.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace gneiss {

/// `*ELSET, ELSET=rock, GENERATE` and the lines below it, up to the next keyword.
struct AbaqusKeyword {
    std::string name;                               ///< "ELSET": capitals, one blank between words
    std::map<std::string, std::string> parameters;  ///< by name in capitals; values as written, "" where there is none
    std::vector<std::vector<std::string>> data;     ///< entries of each line; a line that ends in a comma goes on below
    std::string where;                              ///< "mesh.inp:12"

    bool has(const std::string& parameter) const { return parameters.contains(parameter); }
    /// Empty where it is not given.
    std::string value(const std::string& parameter) const;
};

/// Reads a file and those that it includes. Comments (`**`) and everything from the first `*STEP` on are left out.
/// @throws InputError if a file cannot be read, or something stands before the first keyword
std::vector<AbaqusKeyword> abaqus_keywords(const std::filesystem::path& file);

/// In capitals: names mean the same in Abaqus whatever their case.
std::string capitals(std::string text);

}  // namespace gneiss
