#pragma once
// Numbers against time, one row per time: history.csv, probes.csv, reactions.csv, load_steps.csv.

#include <chrono>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gneiss {

/// A column of a table, headed "name [unit]", or "name" alone where it has no unit.
struct CsvColumn {
    std::string name;
    std::string unit = {};
};

/// The field as it stands in a row: quoted where it holds a separator [RFC 4180, 2]; a line break becomes a blank, so
/// that a row is a line.
std::string csv_field(std::string_view field);

/// A growing table. The first column is the time. Numbers are the shortest decimals that read back as the same double;
/// what is no number stands as nan, inf or -inf.
///
/// A series grows, so it cannot appear whole in the way of other files. What holds instead: the file appears with its
/// header by a rename; after that it only ever grows by complete rows, handed to the system in one piece; if
/// that fails, an incomplete row is cut off again. A reader sees every row up to some time and nothing torn. Only a
/// crash of the machine itself can leave a torn last row, and going on from a checkpoint drops it.
class CsvSeries {
public:
    /// Begins the table at `path`; an older one is replaced.
    /// @param restart_time  s; goes on with the table that is there instead: rows later than this are removed
    /// @throws InputError if the table to go on with has other columns, or a row that cannot be understood
    /// @throws IoError
    /// @throws std::invalid_argument if there is no column
    CsvSeries(std::filesystem::path path, const std::vector<CsvColumn>& columns,
              std::optional<double> restart_time = {});
    ~CsvSeries();
    CsvSeries(const CsvSeries&) = delete;
    CsvSeries& operator=(const CsvSeries&) = delete;

    /// Adds a row: the time, then the other columns. It reaches the file within flush_interval of later calls.
    /// @param texts  of the last columns, those that hold no numbers
    /// @throws std::invalid_argument if the row has another length than the header
    /// @throws IoError
    void row(std::span<const double> values, std::initializer_list<std::string_view> texts = {});

    /// Writes what is waiting if the last write was more than flush_interval ago. One look at the clock: call it
    /// where a long time may pass between rows.
    void flush_if_due();

    /// Writes what is waiting. @throws IoError
    void flush();

    /// Flushes and forces to the disk. Without it the destructor flushes, but it cannot report an error.
    /// @throws IoError
    void close();

    /// Time of the last row, s.
    std::optional<double> last_time() const { return last_time_; }

    static constexpr std::chrono::milliseconds flush_interval{500};

private:
    std::filesystem::path path_;
    std::size_t n_columns_;
    int descriptor_ = -1;
    std::string waiting_;  // complete rows that the file does not have yet
    std::optional<double> last_time_;
    std::chrono::steady_clock::time_point last_flush_;
};

}  // namespace gneiss
