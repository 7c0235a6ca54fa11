#include "base/parallel.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <vector>

namespace gneiss {
namespace {

/// Sets the number of threads for the length of a scope.
class Threads {
public:
    explicit Threads(int n) : before_(omp_get_max_threads()) { omp_set_num_threads(n); }
    ~Threads() { omp_set_num_threads(before_); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

private:
    int before_;
};

constexpr std::size_t sizes[] = {
    0, 1, parallel_range - 1, parallel_range, parallel_range + 1, 7 * parallel_range + 123};

TEST(ParallelRanges, AnySizeAndThreads_CoverEveryIndexOnce) {
    for (const int threads : {1, 2, 5}) {
        const Threads scope(threads);
        for (const std::size_t n : sizes) {
            std::vector<int> visits(n, 0);
            parallel_ranges(n, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) ++visits[i];
            });
            EXPECT_EQ(visits, std::vector<int>(n, 1)) << threads << " threads";
        }
    }
}

TEST(OrderedSum, AnyNumberOfThreads_GivesTheSameBits) {
    std::vector<double> partial;
    for (const std::size_t n : sizes) {
        const auto sum = [&](int threads) {
            const Threads scope(threads);
            return ordered_sum(n, partial, [](std::size_t first, std::size_t last) {
                double s = 0;
                for (std::size_t i = first; i < last; ++i) s += std::sin(static_cast<double>(i)) * 1e3 + 1e-7;
                return s;
            });
        };
        const double one = sum(1);
        for (const int threads : {2, 3, 8}) EXPECT_EQ(sum(threads), one) << n << " terms, " << threads << " threads";
    }
}

TEST(OrderedSum, WholeNumbers_AreSummedExactly) {
    std::vector<double> partial;
    const std::size_t n = 3 * parallel_range + 5;
    const double sum = ordered_sum(n, partial, [](std::size_t first, std::size_t last) {
        double s = 0;
        for (std::size_t i = first; i < last; ++i) s += static_cast<double>(i);
        return s;
    });
    EXPECT_EQ(sum, static_cast<double>(n * (n - 1) / 2));
    EXPECT_EQ(ordered_sum(0, partial, [](std::size_t, std::size_t) { return 1.0; }), 0.0) << "no terms, no call";
}

}  // namespace
}  // namespace gneiss
