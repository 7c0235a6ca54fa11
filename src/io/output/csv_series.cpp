#include "io/output/csv_series.hpp"

#include <fcntl.h>
#include <fmt/compile.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"

namespace gneiss {
namespace {

// More than this is not kept back, however short the time since the last write.
constexpr std::size_t largest_wait = 1 << 16;  // bytes

/// Fields of a line; separators between quotes do not count.
std::size_t n_fields(std::string_view line) {
    std::size_t n = 1;
    bool inside = false;
    for (const char c : line) {
        if (c == '"') inside = !inside;
        if (c == ',' && !inside) ++n;
    }
    return n;
}

std::string header_of(const std::vector<CsvColumn>& columns) {
    std::string header;
    for (const CsvColumn& column : columns) {
        if (!header.empty()) header += ',';
        header += csv_field(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
    }
    return header + '\n';
}

void append_number(std::string& text, double value) {
    if (std::isnan(value))
        text += "nan";  // without the sign that some operations leave on it
    else
        fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), value);
}

/// The header and those rows of an older table that are not later than `restart_time`.
struct Kept {
    std::string text;
    std::optional<double> last_time;
};

Kept rows_to_keep(const std::filesystem::path& path, const std::string& header, std::size_t n_columns,
                  double restart_time) {
    const std::string text = read_file(path);
    if (!text.starts_with(header)) {
        const std::string found = text.substr(0, text.find('\n'));
        throw InputError(path.string() + ":1", "cannot go on with this table, its columns differ: it has '" + found +
                                                   "', this run writes '" + header.substr(0, header.size() - 1) + "'");
    }
    Kept kept{header, {}};
    int line_number = 1;
    for (std::size_t begin = header.size(); begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string::npos) break;  // torn by a crash
        const std::string_view line(text.data() + begin, end - begin);
        double t = 0;
        const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), t);
        const bool is_time = error == std::errc() && (rest == line.data() + line.size() || *rest == ',');
        ++line_number;
        if (!is_time || n_fields(line) != n_columns)
            throw InputError(fmt::format("{}:{}", path.string(), line_number),
                             "cannot go on with this table: '" + std::string(line) + "' is no row of it");
        if (t > restart_time) break;
        kept.text.append(line).push_back('\n');
        kept.last_time = t;
        begin = end + 1;
    }
    return kept;
}

}  // namespace

std::string csv_field(std::string_view field) {
    if (field.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(field);
    std::string text = "\"";
    for (const char c : field) {
        if (c == '"') text += '"';
        text += c == '\r' || c == '\n' ? ' ' : c;
    }
    return text + '"';
}

CsvSeries::CsvSeries(std::filesystem::path path, const std::vector<CsvColumn>& columns,
                     std::optional<double> restart_time)
    : path_(std::move(path)), n_columns_(columns.size()), last_flush_(std::chrono::steady_clock::now()) {
    if (columns.empty()) throw std::invalid_argument("CsvSeries: needs a column for the time");
    Kept kept{header_of(columns), {}};
    if (restart_time && std::filesystem::exists(path_))
        kept = rows_to_keep(path_, kept.text, n_columns_, *restart_time);
    write_atomically(path_, kept.text);
    last_time_ = kept.last_time;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0) throw io_error_from_errno(path_, "cannot open");
}

CsvSeries::~CsvSeries() {
    try {
        flush();
    } catch (const IoError&) {
        // A destructor cannot report it; close() does.
    }
    if (descriptor_ >= 0) ::close(descriptor_);
}

void CsvSeries::row(std::span<const double> values, std::initializer_list<std::string_view> texts) {
    if (values.size() + texts.size() != n_columns_)
        throw std::invalid_argument(fmt::format("{}: a row of {} fields for {} columns", path_.string(),
                                                values.size() + texts.size(), n_columns_));
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (k > 0) waiting_ += ',';
        append_number(waiting_, values[k]);
    }
    for (const std::string_view text : texts) waiting_.append(",").append(csv_field(text));
    waiting_ += '\n';
    last_time_ = values[0];
    if (waiting_.size() >= largest_wait)
        flush();
    else
        flush_if_due();
}

void CsvSeries::flush_if_due() {
    if (!waiting_.empty() && std::chrono::steady_clock::now() - last_flush_ >= flush_interval) flush();
}

void CsvSeries::flush() {
    last_flush_ = std::chrono::steady_clock::now();
    if (waiting_.empty()) return;
    const off_t complete = ::lseek(descriptor_, 0, SEEK_END);
    try {
        write_all(descriptor_, waiting_, path_);
    } catch (const IoError&) {
        // Part of the rows may be in the file: take them out, they are still waiting.
        if (complete >= 0 && ::ftruncate(descriptor_, complete) != 0)
            throw io_error_from_errno(path_, "cannot cut off an incomplete row");
        throw;
    }
    waiting_.clear();
}

void CsvSeries::close() {
    flush();
    if (::fsync(descriptor_) != 0) throw io_error_from_errno(path_, "cannot force to the disk");
}

}  // namespace gneiss
