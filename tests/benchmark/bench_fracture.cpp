// Time per point of the cohesion laws, on packs, in arrays that stay in the second-level cache: intact joints, joints
// that soften, the envelope that edges are watched by; beside them the joint of older codes, which evaluates exp and
// pow at every joint, intact or not.
//
//     bench_fracture --benchmark_repetitions=5 --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fracture/cohesion_law.hpp"
#include "fracture/envelope.hpp"
#include "fracture/y_code_law.hpp"
#include "unit/fracture/loaded_point.hpp"

namespace gneiss::benchmark {
namespace {

constexpr std::size_t n_points = 2048;
using Column = std::vector<double, xsimd::aligned_allocator<double, pack_alignment>>;

/// Points one array per entry, as a block of joints stores them.
template <class Law>
struct Points {
    using History = typename Law::template History<double>;
    using PackedHistory = typename Law::template History<Pack>;
    static constexpr std::size_t n_properties = 7, n_history = History::members.size();

    std::array<Column, n_properties> properties;
    std::array<Column, n_history> history;
    Column opening = Column(n_points), slip = Column(n_points), normal = Column(n_points), shear = Column(n_points);

    /// @param start   smallest opening and slip, in units of the peaks
    /// @param spread  how much more the largest are
    Points(double start, double spread) {
        for (auto& column : history) column.resize(n_points);
        for (auto& column : properties) column.resize(n_points);
        for (std::size_t i = 0; i < n_points; ++i) {
            LoadedPoint<Law> point;
            const double at = static_cast<double>(i) / n_points;
            opening[i] = (start + spread * at) * peak_opening;
            slip[i] = (start + spread * (1 - at)) * peak_slip;
            point.move_to(opening[i], slip[i]);
            for (std::size_t k = 0; k < n_history; ++k) history[k][i] = point.history.*History::members[k];
            const auto& p = point.properties;
            const double values[] = {p.tensile_strength,  p.cohesion,           p.tan_phi_initial, p.tan_phi_residual,
                                     p.fracture_energy_i, p.fracture_energy_ii, p.penalty};
            for (std::size_t k = 0; k < n_properties; ++k) properties[k][i] = values[k];
            opening[i] *= 1.01;  // the step to be evaluated
            slip[i] *= 1.01;
        }
    }

    static Pack load(const Column& column, std::size_t i) { return Pack::load_aligned(&column[i]); }
    CohesionProperties<Pack> properties_at(std::size_t i) const {
        return {load(properties[0], i), load(properties[1], i), load(properties[2], i), load(properties[3], i),
                load(properties[4], i), load(properties[5], i), load(properties[6], i)};
    }
    PackedHistory history_at(std::size_t i) const {
        PackedHistory packed;
        for (std::size_t k = 0; k < n_history; ++k) packed.*PackedHistory::members[k] = load(history[k], i);
        return packed;
    }
};

void report(::benchmark::State& state) {
    using ::benchmark::Counter;
    state.counters["ns/point"] =
        Counter(static_cast<double>(state.iterations()) * n_points * 1e-9, Counter::kIsRate | Counter::kInvert);
}

constexpr double intact_start = 0.1, intact_spread = 0.4, softening_start = 2, softening_spread = 15;

template <class Law>
void traction(::benchmark::State& state, Law, double start, double spread) {
    Points<Law> points(start, spread);
    for (auto _ : state) {
        for (std::size_t i = 0; i < n_points; i += pack_width) {
            const auto t = Law::traction(points.properties_at(i), points.history_at(i), points.load(points.opening, i),
                                         points.load(points.slip, i));
            t.normal.store_aligned(&points.normal[i]);
            t.shear.store_aligned(&points.shear[i]);
        }
        ::benchmark::ClobberMemory();
    }
    report(state);
}

/// Traction, and the history of the accepted step into other arrays.
template <class Law>
void accepted_step(::benchmark::State& state, Law, double start, double spread) {
    Points<Law> points(start, spread);
    auto after = points.history;
    for (auto _ : state) {
        for (std::size_t i = 0; i < n_points; i += pack_width) {
            const auto p = points.properties_at(i);
            const auto h = points.history_at(i);
            const Pack o = points.load(points.opening, i), s = points.load(points.slip, i);
            const auto t = Law::traction(p, h, o, s);
            t.normal.store_aligned(&points.normal[i]);
            t.shear.store_aligned(&points.shear[i]);
            const auto next = Law::advance(p, h, o, s);
            for (std::size_t k = 0; k < after.size(); ++k) (next.*next.members[k]).store_aligned(&after[k][i]);
        }
        ::benchmark::ClobberMemory();
    }
    report(state);
}

template <class Law>
void tangent(::benchmark::State& state, Law, double start, double spread) {
    using D = Dual<2, Pack>;
    Points<Law> points(start, spread);
    for (auto _ : state) {
        for (std::size_t i = 0; i < n_points; i += pack_width) {
            const auto t = Law::traction(points.properties_at(i), points.history_at(i),
                                         D::variable(points.load(points.opening, i), 0),
                                         D::variable(points.load(points.slip, i), 1));
            (t.normal.derivative[0] + t.normal.derivative[1]).store_aligned(&points.normal[i]);
            (t.shear.derivative[0] + t.shear.derivative[1]).store_aligned(&points.shear[i]);
        }
        ::benchmark::ClobberMemory();
    }
    report(state);
}

/// Edges that are watched: opening and slip stand for the tractions.
void envelope(::benchmark::State& state) {
    using Law = MixedModeLaw<Insertion::intrinsic>;
    Points<Law> points(intact_start, intact_spread);
    for (auto _ : state) {
        bool beyond = false;
        for (std::size_t i = 0; i < n_points; i += pack_width) {
            const Pack k = points.load(points.properties[6], i);
            const Pack index = envelope_index(points.properties_at(i), Pack(k * points.load(points.opening, i)),
                                              Pack(k * points.load(points.slip, i)));
            beyond = beyond || xsimd::any(index > 1.0);
        }
        if (beyond) state.SkipWithError("beyond the envelope");
        ::benchmark::DoNotOptimize(beyond);
    }
    report(state);
}

/// One joint after the other with exp and pow at each, without history or friction.
void older_codes(::benchmark::State& state) {
    Points<YCodeLaw> points(intact_start, intact_spread);
    const auto p = rock_joint();
    const double o_p = 2 * peak_opening, s_p = 2 * peak_slip;
    const double o_t = 3 * p.fracture_energy_i / p.tensile_strength, s_t = 3 * p.fracture_energy_ii / p.cohesion;
    using namespace softening;
    for (auto _ : state) {
        for (std::size_t i = 0; i < n_points; ++i) {
            const double o = points.opening[i], s = points.slip[i];
            const double x = std::max(0.0, (o - o_p) / o_t), y = std::max(0.0, (std::abs(s) - s_p) / s_t);
            const double d = std::min(1.0, std::sqrt(x * x + y * y));
            const double z = (1 - C * std::exp(kappa * d)) * (a * (1 - d) + b * std::pow(1 - d, c));
            points.normal[i] = z * p.tensile_strength * (o > o_p ? 1 : 2 * o / o_p - (o / o_p) * (o / o_p));
            points.shear[i] = z * p.cohesion * (s > s_p ? 1 : 2 * s / s_p - (s / s_p) * (s / s_p));
        }
        ::benchmark::ClobberMemory();
    }
    report(state);
}

using Intrinsic = MixedModeLaw<Insertion::intrinsic>;
BENCHMARK(older_codes);
BENCHMARK(envelope);
BENCHMARK_CAPTURE(traction, intrinsic_intact, Intrinsic{}, intact_start, intact_spread);
BENCHMARK_CAPTURE(traction, intrinsic_softening, Intrinsic{}, softening_start, softening_spread);
BENCHMARK_CAPTURE(accepted_step, intrinsic_intact, Intrinsic{}, intact_start, intact_spread);
BENCHMARK_CAPTURE(accepted_step, intrinsic_softening, Intrinsic{}, softening_start, softening_spread);
BENCHMARK_CAPTURE(tangent, intrinsic_intact, Intrinsic{}, intact_start, intact_spread);
BENCHMARK_CAPTURE(tangent, intrinsic_softening, Intrinsic{}, softening_start, softening_spread);
BENCHMARK_CAPTURE(traction, y_code_intact, YCodeLaw{}, intact_start, intact_spread);
BENCHMARK_CAPTURE(traction, y_code_softening, YCodeLaw{}, softening_start, softening_spread);

}  // namespace
}  // namespace gneiss::benchmark

BENCHMARK_MAIN();
