// Time of contact: the search from a thousand to a million triangles, and the force of a pair.
//
// The bed is the worst that fragmentation leaves: every triangle a body of its own, with six contactor points, among
// neighbours that it overlaps. `search_slope` runs all sizes and fits how the processor time of a search grows with
// size: 1 is linear.
//
//     bench_contact --benchmark_filter=slope

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "contact/contact_point.hpp"
#include "unit/contact/contact_testing.hpp"

namespace gneiss::benchmark {
namespace {

using ::benchmark::Counter;

/// Processor time of this program, s: on a machine that others use too, wall time measures them.
double processor_time() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

constexpr double skin = 0.1;  // of the size of a triangle

void search_bed(::benchmark::State& state) {
    omp_set_num_threads(static_cast<int>(state.range(1)));
    const test::Soup soup = test::bed(static_cast<int>(state.range(0)), 1);
    CellSearch search;
    search.search(soup.surroundings(), skin);  // arrays grow once
    for (auto _ : state) ::benchmark::DoNotOptimize(search.search(soup.surroundings(), skin).data());
    const auto n = static_cast<double>(soup.triangles.size());
    state.counters["ns/triangle"] =
        Counter(1e-9 * n * static_cast<double>(state.iterations()), Counter::kIsRate | Counter::kInvert);
    state.counters["pairs/triangle"] = static_cast<double>(search.candidates().size()) / n;
}
BENCHMARK(search_bed)
    ->ArgsProduct({{1000, 10000, 100000, 1000000}, {1, 2}})
    ->ArgNames({"triangles", "threads"})
    ->Unit(::benchmark::kMillisecond);

/// Least squares of log(time) against log(size) over sizes 1e3 to 1e6, half a decade apart; the fastest of some runs
/// each.
void search_slope(::benchmark::State& state) {
    omp_set_num_threads(1);
    constexpr int runs = 5;
    for (auto _ : state) {
        double n = 0, x = 0, y = 0, x_x = 0, x_y = 0;
        for (int half_decade = 6; half_decade <= 12; ++half_decade) {
            const auto size = static_cast<int>(std::lround(std::pow(10.0, 0.5 * half_decade)));
            const test::Soup soup = test::bed(size, 1);
            CellSearch search;
            double fastest = 1e300;
            for (int run = 0; run < runs; ++run) {
                const double start = processor_time();
                ::benchmark::DoNotOptimize(search.search(soup.surroundings(), skin).data());
                fastest = std::min(fastest, processor_time() - start);
            }
            const double log_size = std::log(size), log_time = std::log(fastest);
            n += 1;
            x += log_size;
            y += log_time;
            x_x += log_size * log_size;
            x_y += log_size * log_time;
        }
        state.counters["slope"] = (n * x_y - x * y) / (n * x_x - x * x);
    }
}
BENCHMARK(search_slope)->Iterations(1)->Unit(::benchmark::kMillisecond);

/// Whether the point lies in the triangle, for packs of pairs already gathered.
void pair_contains(::benchmark::State& state) {
    Vec2<Pack> point{Pack(0.2), Pack(0.3)};
    std::array<Vec2<Pack>, 3> x{{{Pack(0.0), Pack(0.0)}, {Pack(1.0), Pack(0.1)}, {Pack(0.2), Pack(1.0)}}};
    const std::array<Pack, 3> rising{Pack(1.0), Pack(0.0), Pack(1.0)};
    for (auto _ : state) {
        ::benchmark::DoNotOptimize(x);
        ::benchmark::DoNotOptimize(choose(contains(point, x, rising), Pack(1.0), Pack(0.0)));
    }
    state.counters["ns/pair"] =
        Counter(1e-9 * pack_width * static_cast<double>(state.iterations()), Counter::kIsRate | Counter::kInvert);
}
BENCHMARK(pair_contains);

/// Force and history of a pair in touch, sticking, for packs of pairs already gathered.
void pair_response(::benchmark::State& state) {
    const Vec2<Pack> point{Pack(0.2), Pack(0.3)};
    std::array<Vec2<Pack>, 3> x{{{Pack(0.0), Pack(0.0)}, {Pack(1.0), Pack(0.1)}, {Pack(0.2), Pack(1.0)}}};
    const ContactTarget<Pack> target{x, {Pack(0.0), Pack(0.0), Pack(1.0)}, Pack(0.0), Pack(1.0)};
    const ContactLaw<Pack> law{Pack(7.0), Pack(5.0), Pack(0.4), Pack(1.0)};
    ContactHistory<Pack> history = contact_response(point, x, target, law, ContactHistory<Pack>{}).next;
    for (auto _ : state) {
        ::benchmark::DoNotOptimize(x);
        auto response = contact_response(point, x, target, law, history);
        ::benchmark::DoNotOptimize(response);
    }
    state.counters["ns/pair"] =
        Counter(1e-9 * pack_width * static_cast<double>(state.iterations()), Counter::kIsRate | Counter::kInvert);
}
BENCHMARK(pair_response);

}  // namespace
}  // namespace gneiss::benchmark

BENCHMARK_MAIN();
