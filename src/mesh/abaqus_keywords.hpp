#pragma once
// An Abaqus input file as a list of its keywords.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gneiss {

/// A line of data.
struct AbaqusLine {
    std::vector<std::string> entries;  ///< between commas; the empty one behind a comma at the end is none
    bool ends_in_comma;                ///< what it begins may go on below, if it is not complete
    std::shared_ptr<const std::string> file;
    int number;  ///< in the file, from 1

    std::string where() const;  ///< "mesh.inp:13"
};

/// `*ELSET, ELSET=rock, GENERATE` and the lines below it, up to the next keyword.
struct AbaqusKeyword {
    std::string name;                               ///< "ELSET": capitals, one blank between words
    std::map<std::string, std::string> parameters;  ///< by name in capitals; values as written, "" where there is none
    std::vector<AbaqusLine> data;
    std::string where;  ///< "mesh.inp:12"

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
