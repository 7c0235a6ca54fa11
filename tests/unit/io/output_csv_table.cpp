// Tables read again.

#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.hpp"
#include "io/output/csv_series.hpp"
#include "io/output/csv_table.hpp"
#include "output_folder.hpp"

namespace gneiss {
namespace {

using CsvTableTest = test::OutputFolder;

TEST_F(CsvTableTest, ASeries_ReadsBackBitByBit) {
    const std::vector<CsvColumn> columns{{"t", "s"}, {"energy", "J"}, {"count"}};
    CsvSeries series(folder / "a.csv", columns);
    series.row(std::vector<double>{0.1, 1.0 / 3, 5});
    series.row(std::vector<double>{0.2, std::nan(""), -1e-300});
    series.close();
    const CsvTable table = read_csv(folder / "a.csv");
    EXPECT_EQ(table.names, (std::vector<std::string>{"t", "energy", "count"}));
    EXPECT_EQ(table.units, (std::vector<std::string>{"s", "J", ""}));
    EXPECT_EQ(table.column("energy")[0], 1.0 / 3);
    EXPECT_TRUE(std::isnan(table.column("energy")[1]));
    EXPECT_EQ(table.column("count")[1], -1e-300);
    EXPECT_THROW(table.column("mass"), InputError);
}

}  // namespace
}  // namespace gneiss
