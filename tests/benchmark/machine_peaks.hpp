#pragma once
// What the machine can do, measured here and now: single-thread memory bandwidth and multiply-add rate.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "base/pack.hpp"

namespace gneiss::benchmark {

struct MachinePeaks {
    double bytes_per_s;  ///< of a triad over arrays far larger than the private caches, reads and writes counted
    double flops_per_s;  ///< of independent chains of packed multiply-adds, two flops each
};

inline MachinePeaks measure_peaks() {
    const auto best_of = [](auto run) {
        double best = 1e300;
        for (int repeat = 0; repeat < 5; ++repeat) {
            const auto start = std::chrono::steady_clock::now();
            run();
            best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        }
        return best;
    };
    constexpr std::size_t n = 8u << 20;
    std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
    const double triad = best_of([&] {
        for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 0.5 * c[i];
    });
    volatile double sink = a[n / 2];
    constexpr int chains = 16, rounds = 4000000;
    const double chained = best_of([&] {
        Pack x[chains];
        for (int k = 0; k < chains; ++k) x[k] = Pack(1.0 + 1e-3 * k);
        const Pack factor(0.999999), term(1e-6);
        for (int round = 0; round < rounds; ++round)
#pragma GCC unroll 16
            for (int k = 0; k < chains; ++k) x[k] = xsimd::fma(x[k], factor, term);
        Pack sum(0.0);
        for (int k = 0; k < chains; ++k) sum += x[k];
        sink = sum_of_lanes(sum);
    });
    (void)sink;
    return {3.0 * n * sizeof(double) / triad, 2.0 * chains * rounds * pack_width / chained};
}

}  // namespace gneiss::benchmark
