#include "base/pack.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "support/packs.hpp"

namespace gneiss {
namespace {

constexpr std::int32_t n_nodes = 37;

/// The two ways to say where a pair stands.
template <class Index>
class Pairs : public testing::Test {
public:
    static Index at(std::int32_t node) {
        if constexpr (std::is_same_v<Index, PairNumber>)
            return {node};
        else
            return {static_cast<std::uint16_t>(node * static_cast<std::int32_t>(bytes_per_pair))};
    }
    static std::array<Index, pack_width> indices(const std::array<std::int32_t, pack_width>& nodes) {
        std::array<Index, pack_width> index;
        for (std::size_t lane = 0; lane < pack_width; ++lane) index[lane] = at(nodes[lane]);
        return index;
    }
};
using IndexTypes = testing::Types<PairNumber, PairBytes>;
TYPED_TEST_SUITE(Pairs, IndexTypes);

std::array<std::int32_t, pack_width> random_nodes(std::mt19937& random, std::int32_t n) {
    std::uniform_int_distribution<std::int32_t> any(0, n - 1);
    std::array<std::int32_t, pack_width> nodes;
    for (std::int32_t& i : nodes) i = any(random);
    return nodes;
}

TEST(Padded, AnyCount_IsTheNextMultipleOfTheWidth) {
    EXPECT_EQ(padded(0), 0u);
    EXPECT_EQ(padded(1), pack_width);
    EXPECT_EQ(padded(pack_width), pack_width);
    EXPECT_EQ(padded(pack_width + 1), 2 * pack_width);
}

TYPED_TEST(Pairs, GatherOfAnyIndices_BringXAndYOfEachNodeIntoItsLane) {
    std::vector<double> values(2 * n_nodes);
    std::iota(values.begin(), values.end(), 0.5);
    std::mt19937 random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const auto nodes = random_nodes(random, trial < 25 ? n_nodes : 2);  // the second half repeats indices
        Pack x, y;
        gather_pairs(values.data(), this->indices(nodes).data(), x, y);
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            EXPECT_EQ(lanes(x)[lane], 2 * nodes[lane] + 0.5);
            EXPECT_EQ(lanes(y)[lane], 2 * nodes[lane] + 1.5);
        }
    }
}

TYPED_TEST(Pairs, ScatterToRepeatedIndices_AddUpInTheOrderOfTheLanes) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int trial = 0; trial < 50; ++trial) {
        const auto nodes = random_nodes(random, trial < 25 ? n_nodes : 2);
        std::vector<double> values(2 * n_nodes);
        for (double& value : values) value = number(random);
        const Pack x = pack_of([&](std::size_t) { return number(random); });
        const Pack y = pack_of([&](std::size_t) { return number(random); });
        std::vector<double> expected = values;
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            expected[2 * static_cast<std::size_t>(nodes[lane])] += lanes(x)[lane];
            expected[2 * static_cast<std::size_t>(nodes[lane]) + 1] += lanes(y)[lane];
        }
        scatter_add_pairs(values.data(), this->indices(nodes).data(), x, y);
        EXPECT_EQ(values, expected) << "bit by bit: same sums in the same order";
    }
}

TEST(Pack, SumOfLanes_AddsEachOnce) {
    alignas(pack_alignment) std::array<double, pack_width> lanes;
    for (std::size_t lane = 0; lane < pack_width; ++lane) lanes[lane] = std::ldexp(1.0, static_cast<int>(3 * lane));
    double sum = 0;
    for (const double lane : lanes) sum += lane;  // powers of two: exact in any order
    EXPECT_EQ(sum_of_lanes(Pack::load_aligned(lanes.data())), sum);
}

}  // namespace
}  // namespace gneiss
