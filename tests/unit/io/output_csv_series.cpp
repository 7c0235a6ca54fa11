#include "io/output/csv_series.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <bit>
#include <charconv>
#include <csignal>
#include <limits>
#include <random>
#include <thread>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using ::testing::HasSubstr;

class CsvOutput : public test::OutputFolder {
protected:
    const std::vector<CsvColumn> columns{{"t", "s"}, {"kinetic_energy", "J"}, {"steps"}};
    const std::string header = "t [s],kinetic_energy [J],steps\n";
    const fs::path path = folder / "history.csv";

    static void add(CsvSeries& series, double t, double energy, double steps) {
        series.row(std::array{t, energy, steps});
    }
};

TEST_F(CsvOutput, New_HeaderIsThereAtOnce) {
    const CsvSeries series(path, columns);
    EXPECT_EQ(contents(path), header);
    EXPECT_EQ(n_files(), 1u);
}

TEST_F(CsvOutput, Rows_StandInShortestDecimals) {
    {
        CsvSeries series(path, columns);
        add(series, 0.1, 1e-7, 100000);
        add(series, 1.0 / 3, -2.5e300, 1e6);
    }
    EXPECT_EQ(contents(path), header + "0.1,1e-07,100000\n0.3333333333333333,-2.5e+300,1000000\n");
}

TEST_F(CsvOutput, RandomNumbers_ReadBackExactly) {
    std::mt19937_64 random(4711);
    std::vector<double> numbers(1000);
    for (double& x : numbers) do
            x = std::bit_cast<double>(random());
        while (!std::isfinite(x));
    {
        CsvSeries series(path, std::vector<CsvColumn>(numbers.size(), {"x"}));
        series.row(numbers);
    }
    const std::string text = contents(path);
    const char* at = text.data() + text.find('\n') + 1;
    for (const double expected : numbers) {
        double found = 0;
        at = std::from_chars(at, text.data() + text.size(), found).ptr + 1;
        EXPECT_EQ(found, expected);
    }
}

TEST_F(CsvOutput, NotFinite_IsSpelledOut) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    {
        CsvSeries series(path, columns);
        add(series, 1, nan, -nan);
        add(series, 2, inf, -inf);
    }
    EXPECT_EQ(contents(path), header + "1,nan,nan\n2,inf,-inf\n");
}

TEST_F(CsvOutput, NamesWithCommasOrQuotes_AreQuoted) {
    const CsvSeries series(path, {{"t", "s"}, {"p 1, \"left\"", "Pa"}});
    EXPECT_EQ(contents(path), "t [s],\"p 1, \"\"left\"\" [Pa]\"\n");
}

TEST_F(CsvOutput, TextInTheLastColumn_IsQuotedAndReadAgain) {
    const std::vector<CsvColumn> with_text{{"t", "s"}, {"steps"}, {"why"}};
    {
        CsvSeries series(path, with_text);
        series.row(std::array{0.1, 1.0}, {""});
        series.row(std::array{0.2, 2.0}, {"element 3, \"left\"\nis inverted"});
        series.row(std::array{0.3, 3.0}, {"dropped, as it is later"});
    }
    CsvSeries series(path, with_text, 0.2);
    EXPECT_EQ(contents(path), "t [s],steps,why\n0.1,1,\n0.2,2,\"element 3, \"\"left\"\" is inverted\"\n");
    EXPECT_EQ(series.last_time(), 0.2);
}

TEST_F(CsvOutput, RowOfOtherLength_IsRefused) {
    CsvSeries series(path, columns);
    EXPECT_EQ(message_of<std::invalid_argument>([&] { series.row(std::array{1.0}); }),
              path.string() + ": a row of 1 fields for 3 columns");
    EXPECT_THROW(CsvSeries(path, {}), std::invalid_argument);
}

TEST_F(CsvOutput, WhileRunning_FileGrowsByWholeRows) {
    CsvSeries series(path, columns);
    for (int i = 0; i < 100'000; ++i) add(series, i, 0.5, i);
    const std::string text = contents(path);
    EXPECT_GT(text.size(), 1'000'000u);  // far more than is ever kept back
    EXPECT_EQ(text.back(), '\n');
    series.flush();
    EXPECT_THAT(contents(path), ::testing::EndsWith("\n99999,0.5,99999\n"));
}

TEST_F(CsvOutput, AfterTheInterval_RowReachesTheFile) {
    CsvSeries series(path, columns);
    add(series, 1, 2, 3);
    std::this_thread::sleep_for(CsvSeries::flush_interval);
    series.flush_if_due();
    EXPECT_EQ(contents(path), header + "1,2,3\n");
    std::this_thread::sleep_for(CsvSeries::flush_interval);
    add(series, 2, 3, 4);
    EXPECT_EQ(contents(path), header + "1,2,3\n2,3,4\n");
}

TEST_F(CsvOutput, Restarted_DropsLaterRowsAndGoesOn) {
    {
        CsvSeries series(path, columns);
        for (int i = 0; i < 5; ++i) add(series, 0.1 * i, i, i);
    }
    {
        CsvSeries series(path, columns, 0.1 * 2);
        EXPECT_EQ(series.last_time(), 0.1 * 2);
        add(series, 0.25, 9, 9);
    }
    EXPECT_EQ(contents(path), header + "0,0,0\n0.1,1,1\n0.2,2,2\n0.25,9,9\n");
}

TEST_F(CsvOutput, RestartedOnTornLastRow_DropsIt) {
    put(path, header + "0,0,0\n0.1,1,1\n0.2,2");
    {
        CsvSeries series(path, columns, 0.9);
        EXPECT_EQ(series.last_time(), 0.1);
        add(series, 0.2, 2, 2);
    }
    EXPECT_EQ(contents(path), header + "0,0,0\n0.1,1,1\n0.2,2,2\n");
}

TEST_F(CsvOutput, RestartedBeforeTheFirstRow_KeepsTheHeader) {
    put(path, header + "0.5,0,0\n");
    const CsvSeries series(path, columns, 0.1);
    EXPECT_FALSE(series.last_time().has_value());
    EXPECT_EQ(contents(path), header);
}

TEST_F(CsvOutput, RestartedElsewhere_BeginsAnew) {
    const CsvSeries series(path, columns, 0.1);
    EXPECT_EQ(contents(path), header);
}

TEST_F(CsvOutput, RestartedOnOtherColumns_InputErrorAndFileStays) {
    put(path, "t [s],momentum [N s]\n0,1\n");
    EXPECT_THAT(
        message_of<InputError>([&] { CsvSeries(path, columns, 0.1); }),
        HasSubstr("history.csv:1: cannot go on with this table, its columns differ: it has 't [s],momentum [N s]', "
                  "this run writes 't [s],kinetic_energy [J],steps'"));
    EXPECT_EQ(contents(path), "t [s],momentum [N s]\n0,1\n");
}

TEST_F(CsvOutput, RestartedOnNonsense_InputErrorWithItsLine) {
    for (const char* row : {"one,2,3", "0.1,2", "0.1,2,3,4", "0.1x,2,3", ""}) {
        put(path, header + "0,0,0\n" + row + "\n0.2,2,2\n");
        EXPECT_THAT(
            message_of<InputError>([&] { CsvSeries(path, columns, 0.9); }),
            HasSubstr("history.csv:3: cannot go on with this table: '" + std::string(row) + "' is no row of it"));
    }
}

TEST_F(CsvOutput, DiskFull_IoErrorAndNoTornRow) {
    // A limit on the size of files stands for the full disk: a write first comes out short, then fails.
    struct rlimit former {};
    getrlimit(RLIMIT_FSIZE, &former);
    const auto former_handler = std::signal(SIGXFSZ, SIG_IGN);
    CsvSeries series(path, columns);
    add(series, 1, 2, 3);
    series.flush();
    const std::string before = contents(path);
    const struct rlimit tight { before.size() + 8, former.rlim_max };
    setrlimit(RLIMIT_FSIZE, &tight);
    add(series, 2, 3, 4);
    add(series, 3, 4, 5);
    const std::string message = message_of<IoError>([&] { series.flush(); });
    const std::string during = contents(path);
    setrlimit(RLIMIT_FSIZE, &former);
    std::signal(SIGXFSZ, former_handler);

    EXPECT_EQ(message, path.string() + ": cannot write: File too large");
    EXPECT_EQ(during, before);
    series.close();  // there is room again: nothing was lost
    EXPECT_EQ(contents(path), before + "2,3,4\n3,4,5\n");
}

TEST_F(CsvOutput, ParentIsAFile_IoError) {
    put(folder / "file", "");
    EXPECT_THAT(message_of<IoError>([&] { CsvSeries(folder / "file" / "a.csv", columns); }),
                HasSubstr("a.csv: cannot open: Not a directory"));
}

}  // namespace
}  // namespace gneiss
