// Orders of elimination on the graphs of meshes.

#include "linear/ordering.hpp"

#include <gmock/gmock.h>

#include <numeric>

#include "support/small_solids.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;

struct Grid {
    test::Solid solid;
    const Tangent& tangent = *solid.system->tangent();
    MatrixPattern arrays = tangent.pattern();
    SparsePattern pattern{arrays.row_starts, arrays.columns};
    explicit Grid(int cells) : solid(test::make_solid(test::rectangle(false, 1, 1, {cells, cells}), {})) {}
};

/// Entries of L without its diagonal, by elimination on the graph itself.
double entries_of_factor(const SparsePattern& pattern, const std::vector<std::int64_t>& order) {
    const std::size_t n = pattern.n();
    std::vector<std::size_t> position(n);
    for (std::size_t k = 0; k < n; ++k) position[static_cast<std::size_t>(order[k])] = k;
    std::vector<std::vector<std::size_t>> later(n);
    for (std::size_t i = 0; i < n; ++i)
        for (auto k = pattern.row_starts[i]; k < pattern.row_starts[i + 1]; ++k) {
            const std::size_t j = position[static_cast<std::size_t>(pattern.columns[static_cast<std::size_t>(k)])];
            if (j > position[i]) later[position[i]].push_back(j);
        }
    double entries = 0;
    for (std::size_t k = 0; k < n; ++k) {
        auto& column = later[k];
        std::ranges::sort(column);
        column.erase(std::unique(column.begin(), column.end()), column.end());
        entries += static_cast<double>(column.size());
        if (column.empty()) continue;
        auto& parent = later[column.front()];  // its column takes over the rest
        parent.insert(parent.end(), column.begin() + 1, column.end());
    }
    return entries;
}

TEST(StructuralSymmetry, MissingMirrorImagesAndDiagonals_AreSeen) {
    const auto check = [](const std::vector<std::int64_t>& starts, const std::vector<std::int64_t>& columns) {
        return is_structurally_symmetric({starts, columns});
    };
    EXPECT_TRUE(check({0, 2, 5, 7}, {0, 1, 0, 1, 2, 1, 2}));
    EXPECT_FALSE(check({0, 2, 4, 6}, {0, 1, 1, 2, 1, 2})) << "(1, 0) is missing";
    EXPECT_FALSE(check({0, 1, 4, 6}, {0, 0, 1, 2, 1, 2})) << "(0, 1) is missing";
    EXPECT_FALSE(check({0, 2, 4, 6}, {0, 1, 0, 2, 1, 2})) << "(1, 1) is missing";
    EXPECT_TRUE(is_structurally_symmetric(Grid(3).pattern));
}

TEST(Ordering, AnyPattern_IsAPermutationWithTheComponentsOfANodeTogether) {
    for (const int cells : {3, 40}) {  // minimum degree, and nested dissection
        const Grid grid(cells);
        const Ordering ordering = fill_reducing_ordering(grid.pattern);
        std::vector<std::int64_t> sorted = ordering.unknowns, expected(grid.pattern.n());
        std::ranges::sort(sorted);
        std::iota(expected.begin(), expected.end(), 0);
        EXPECT_EQ(sorted, expected);
        for (std::size_t k = 0; k < ordering.unknowns.size(); k += 2) {
            EXPECT_EQ(ordering.unknowns[k] % 2, 0);
            EXPECT_EQ(ordering.unknowns[k + 1], ordering.unknowns[k] + 1);
        }
    }
}

TEST(Ordering, LargeMesh_FactorIsAsSparseAsExpectedAndSparserThanInTheMeshsOrder) {
    const Grid grid(40);
    const Ordering ordering = fill_reducing_ordering(grid.pattern);
    std::vector<std::int64_t> natural(grid.pattern.n());
    std::iota(natural.begin(), natural.end(), 0);
    const double entries = entries_of_factor(grid.pattern, ordering.unknowns);
    EXPECT_LT(entries, 0.5 * entries_of_factor(grid.pattern, natural));
    // the estimate counts whole blocks of a node, half of the diagonal ones are not in L
    EXPECT_NEAR(ordering.factor_entries, entries, 0.1 * entries);
}

TEST(Ordering, UnknownsWithoutNeighboursAndOddOnes_AreOrdered) {
    const std::vector<std::int64_t> starts{0, 1, 4, 7, 10}, columns{0, 1, 2, 3, 1, 2, 3, 1, 2, 3};
    const Ordering ordering = fill_reducing_ordering({starts, columns});
    std::vector<std::int64_t> sorted = ordering.unknowns;
    std::ranges::sort(sorted);
    EXPECT_THAT(sorted, ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace gneiss
