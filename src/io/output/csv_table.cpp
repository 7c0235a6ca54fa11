#include "io/output/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"

namespace gneiss {
namespace {

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t from = 0;;) {
        const std::size_t comma = line.find(',', from);
        fields.push_back(line.substr(from, comma - from));
        if (comma == std::string_view::npos) return fields;
        from = comma + 1;
    }
}

double number(std::string_view field) {
    double value = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(field.data(), field.data() + field.size(), value);  // leaves it where there is no number
    return value;
}

}  // namespace

const std::vector<double>& CsvTable::column(std::string_view name) const {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw InputError(std::string(name), "the table has no such column");
    return columns[static_cast<std::size_t>(found - names.begin())];
}

CsvTable read_csv(const std::filesystem::path& path) {
    const std::string text = read_file(path);
    CsvTable table;
    bool header = true;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = text.find('\n', from);
        if (end == std::string::npos) break;  // a row that is not complete
        const auto fields = split(std::string_view(text).substr(from, end - from));
        from = end + 1;
        if (header) {
            for (const std::string_view field : fields) {
                const std::size_t bracket = field.find(" [");
                table.names.emplace_back(field.substr(0, bracket));
                table.units.emplace_back(bracket == std::string_view::npos
                                             ? std::string_view()
                                             : field.substr(bracket + 2, field.size() - bracket - 3));
            }
            table.columns.resize(fields.size());
            header = false;
            continue;
        }
        if (fields.size() != table.columns.size())
            throw InputError(path.string(),
                             fmt::format("a row has {} fields, the header {}", fields.size(), table.columns.size()));
        for (std::size_t k = 0; k < fields.size(); ++k) table.columns[k].push_back(number(fields[k]));
    }
    return table;
}

}  // namespace gneiss
