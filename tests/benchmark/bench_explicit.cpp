// Time per element of one complete explicit step: element forces, assembly, node update.
// Beside our elements stands the textbook loop of older codes (textbook_cst.hpp), in the same binary and on the same
// mesh.
//
// Counters: ns per element and step, bytes per element that a force evaluation streams, and the fractions of memory
// bandwidth and multiply-add rate, as measured on this machine when the program starts.
//
//     bench_explicit --benchmark_repetitions=5 --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>

#include "base/flush_denormals.hpp"
#include "benchmark/anisotropic_square.hpp"
#include "benchmark/counted_flops.hpp"
#include "benchmark/machine_peaks.hpp"
#include "benchmark/textbook_cst.hpp"
#include "integrators/central_difference.hpp"
#include "mesh/measure.hpp"
#include "model/make_blocks.hpp"
#include "model/solid_system.hpp"

namespace gneiss::benchmark {
namespace {

const MachinePeaks& peaks() {
    static const MachinePeaks measured = measure_peaks();
    return measured;
}

void report(::benchmark::State& state, std::size_t n_elements, std::size_t n_steps, double bytes, double flops) {
    const double steps = static_cast<double>(n_elements) * static_cast<double>(n_steps);
    using ::benchmark::Counter;
    state.counters["ns/element"] = Counter(steps * 1e-9, Counter::kIsRate | Counter::kInvert);
    state.counters["bytes/element"] = bytes;
    state.counters["flops/element"] = flops;
    state.counters["of_memory_peak"] = Counter(steps * bytes / peaks().bytes_per_s, Counter::kIsRate);
    state.counters["of_flop_peak"] = Counter(steps * flops / peaks().flops_per_s, Counter::kIsRate);
}

void textbook(::benchmark::State& state) {
    const Mesh mesh = square(false, state.range(0));
    TextbookCst loop(mesh, 0.267e9, 0.4e9, 1000, 1);
    for (std::size_t i = 0; i < mesh.n_nodes(); ++i) loop.vx()[i] = velocity(mesh.nodes[i][0]);
    const double dt = 0.2 * mesh_size(mesh).smallest_edge / 1400;
    for (auto _ : state) loop.step(dt);
    if (!std::isfinite(loop.kinetic_energy())) state.SkipWithError("not finite");
    // three node numbers, and half a node with nine doubles per element
    report(state, mesh.n_elements(), static_cast<std::size_t>(state.iterations()), 3 * 4 + 0.5 * 9 * 8, textbook_flops);
}

/// @param seen  true: as if every step had a row in the history; false: as if few have
void explicit_step(::benchmark::State& state, bool compt, Form form, int threads, bool seen) {
    omp_set_num_threads(threads);
    flush_denormals();
    const Mesh mesh = square(compt, state.range(0));
    SolidOptions solid;
    solid.compt = compt;
    SolidSystem::Parts parts;
    parts.blocks = make_blocks(mesh, solid, {anisotropic(form)});
    const std::size_t block_bytes = parts.blocks.front()->bytes_per_element();
    parts.initial_velocity = velocities(mesh);
    const SolidSystem system(mesh, std::move(parts));
    // the bound of the step is looked at ever more rarely, down to once in a thousand steps: begin there
    CentralDifference integrator({.safety = 0.8, .bound_interval = 1024});
    State at = system.initial_state();
    integrator.start(system, at, StartReason::fresh);
    constexpr double forever = 1e9;
    std::size_t n_steps = 0;
    for (auto _ : state) n_steps += integrator.advance_unseen(system, at, forever, seen ? at.t : forever).n_steps;
    // of a node: u and f of the elements; u, v, inverse mass, f and next u of the step between two of them; and what
    // writing fetches first; x and y
    const double nodes = static_cast<double>(mesh.n_nodes()) / static_cast<double>(mesh.n_elements());
    report(state, mesh.n_elements(), n_steps, static_cast<double>(block_bytes) + nodes * 10 * 16,
           compt ? counted_flops<StraightCompositeTriangle>() : counted_flops<Cst>());
}

void sizes(::benchmark::internal::Benchmark* bench) {
    for (const std::int64_t n : {2000, 20000, 200000, 1000000}) bench->Arg(n);
    bench->UseRealTime()->MinTime(0.5);
}

BENCHMARK(textbook)->Apply(sizes);
BENCHMARK_CAPTURE(explicit_step, cst, false, Form::hyper, 1, false)->Apply(sizes);
BENCHMARK_CAPTURE(explicit_step, compt, true, Form::hyper, 1, false)->Apply(sizes);
BENCHMARK_CAPTURE(explicit_step, cst_hypo, false, Form::hypo, 1, false)->Apply(sizes);
BENCHMARK_CAPTURE(explicit_step, compt_hypo, true, Form::hypo, 1, false)->Apply(sizes);
BENCHMARK_CAPTURE(explicit_step, cst_seen, false, Form::hyper, 1, true)->Arg(200000)->UseRealTime()->MinTime(0.5);
BENCHMARK_CAPTURE(explicit_step, compt_seen, true, Form::hyper, 1, true)->Arg(200000)->UseRealTime()->MinTime(0.5);
BENCHMARK_CAPTURE(explicit_step, cst_2_threads, false, Form::hyper, 2, false)->Arg(200000)->UseRealTime()->MinTime(0.5);
BENCHMARK_CAPTURE(explicit_step, compt_2_threads, true, Form::hyper, 2, false)
    ->Arg(200000)
    ->UseRealTime()
    ->MinTime(0.5);

}  // namespace
}  // namespace gneiss::benchmark

int main(int argc, char** argv) {
    using gneiss::benchmark::peaks;
    benchmark::AddCustomContext("memory peak", std::to_string(peaks().bytes_per_s / 1e9) + " GB/s");
    benchmark::AddCustomContext("multiply-add peak", std::to_string(peaks().flops_per_s / 1e9) + " Gflop/s");
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
