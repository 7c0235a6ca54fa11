#include "linear/free_matrix.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace gneiss {
namespace {

using testing::ElementsAre;

/// [1 2 0 0; 3 4 5 0; 0 6 7 8; 0 0 9 10]
const std::vector<std::int64_t> row_starts{0, 2, 5, 8, 10}, row_columns{0, 1, 0, 1, 2, 1, 2, 3, 2, 3};
const std::vector<double> row_values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};

TEST(FreeMatrix, RowsAndColumnsOfFixedUnknowns_AreTakenOut) {
    const std::vector<std::size_t> fixed{1};
    const FreeMatrix matrix({row_starts, row_columns}, fixed);
    EXPECT_EQ(matrix.n(), 3u);
    EXPECT_THAT(matrix.free(), ElementsAre(0, 2, 3));
    EXPECT_THAT(matrix.pattern().row_starts, ElementsAre(0, 1, 3, 5));
    EXPECT_THAT(matrix.pattern().columns, ElementsAre(0, 1, 2, 1, 2));
    std::vector<double> free_values(matrix.pattern().n_nonzero());
    matrix.take_values(row_values, free_values);
    EXPECT_THAT(free_values, ElementsAre(1, 7, 8, 9, 10));
}

TEST(FreeMatrix, Values_MayBeTakenInPlace) {
    const std::vector<std::size_t> fixed{0, 3};
    const FreeMatrix matrix({row_starts, row_columns}, fixed);
    std::vector<double> shared = row_values;
    matrix.take_values(shared, {shared.data(), matrix.pattern().n_nonzero()});
    shared.resize(matrix.pattern().n_nonzero());
    EXPECT_THAT(shared, ElementsAre(4, 5, 6, 7));
}

TEST(FreeMatrix, Vectors_ComeAndGoBack) {
    const std::vector<std::size_t> fixed{0, 3};
    const FreeMatrix matrix({row_starts, row_columns}, fixed);
    std::vector<double> free(2), full{-1, -2, -3, -4};
    matrix.take(full, free);
    EXPECT_THAT(free, ElementsAre(-2, -3));
    matrix.put(std::vector<double>{20, 30}, full);
    EXPECT_THAT(full, ElementsAre(-1, 20, 30, -4));
}

TEST(FreeMatrix, ChangesOfFixedUnknowns_GoToTheRightSide) {
    const std::vector<std::size_t> fixed{0, 3};
    const FreeMatrix matrix({row_starts, row_columns}, fixed);
    std::vector<double> right{100, 200};
    matrix.subtract_fixed(row_values, std::vector<double>{2, 0.5}, right);
    EXPECT_THAT(right, ElementsAre(100 - 3 * 2, 200 - 8 * 0.5));
}

TEST(FreeMatrix, NothingOrEverythingFixed_IsAllOrNothing) {
    const FreeMatrix all({row_starts, row_columns}, {});
    EXPECT_THAT(all.pattern().columns, testing::ElementsAreArray(row_columns));
    const std::vector<std::size_t> every{0, 1, 2, 3};
    const FreeMatrix none({row_starts, row_columns}, every);
    EXPECT_EQ(none.n(), 0u);
    EXPECT_THAT(none.pattern().row_starts, ElementsAre(0));
}

}  // namespace
}  // namespace gneiss
