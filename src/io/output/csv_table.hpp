#pragma once
// Tables of CsvSeries, read again.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gneiss {

struct CsvTable {
    std::vector<std::string> names, units;     ///< of the columns; a unit may be empty
    std::vector<std::vector<double>> columns;  ///< shape (columns, rows); what is no number is NaN

    /// @throws InputError if there is none
    const std::vector<double>& column(std::string_view name) const;
};

/// Complete rows of a table without quotes and texts that have commas in them.
/// @throws IoError if it cannot be read, InputError if a row has another length than the header
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace gneiss
