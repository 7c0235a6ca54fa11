#include "io/output/matrix_market.hpp"

#include <gmock/gmock.h>

#include <array>

#include "io/output/atomic_file.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

using test::message_of;
using ::testing::HasSubstr;

class MatrixMarket : public test::OutputFolder {
protected:
    // [ 1/3  -2   0  ]
    // [ -2    0   0.5 ]   with stored zeros at (1, 1) and (2, 2)
    // [  0   0.5  0  ]
    const std::array<std::int64_t, 4> row_starts{0, 2, 5, 7};
    const std::array<std::int64_t, 7> columns{0, 1, 0, 1, 2, 1, 2};
    const std::array<double, 7> values{1.0 / 3, -2, -2, 0, 0.5, 0.5, 0};
    const CompressedRows matrix{row_starts, columns, values};
    const std::filesystem::path path = folder / "stiffness.mtx";
};

TEST_F(MatrixMarket, EveryEntryButZeros_RowsAndColumnsFromOne) {
    write_matrix_market(path, matrix, "a comment, N/m");
    EXPECT_EQ(contents(path),
              "%%MatrixMarket matrix coordinate real general\n% a comment, N/m\n3 3 5\n"
              "1 1 0.3333333333333333\n1 2 -2\n2 1 -2\n2 3 0.5\n3 2 0.5\n");
    EXPECT_EQ(n_files(), 1u);
}

TEST_F(MatrixMarket, FullDisk_OldFileStays) {
    put(path, "old");
    fill_disk(path);
    EXPECT_THAT(message_of<IoError>([&] { write_matrix_market(path, matrix, "N/m"); }), HasSubstr(path.string()));
    EXPECT_EQ(contents(path), "old");
}

}  // namespace
}  // namespace gneiss
