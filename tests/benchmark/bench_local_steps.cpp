// What local steps of central difference save: wall time of a simulated time on a plate around a borehole whose
// elements grow from its wall to the outer side, sixteen times as long there.
//
//     bench_local_steps --benchmark_repetitions=5 --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>
#include <omp.h>

#include <cmath>

#include "base/flush_denormals.hpp"
#include "benchmark/anisotropic_square.hpp"
#include "integrators/central_difference.hpp"
#include "model/make_blocks.hpp"
#include "model/solid_system.hpp"

namespace gneiss::benchmark {
namespace {

Mesh borehole(bool compt, double finest) {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    options.side = 40;
    options.radius = 1;
    options.size = {finest, 16 * finest};
    return make_mesh(options, compt, {});
}

void run(::benchmark::State& state, bool compt, double finest, Form form, int levels, int threads) {
    omp_set_num_threads(threads);
    flush_denormals();
    const Mesh mesh = borehole(compt, finest);
    SolidOptions solid;
    solid.compt = compt;
    SolidSystem::Parts parts;
    parts.blocks = make_blocks(mesh, solid, {anisotropic(form)});
    for (const auto& node : mesh.nodes)
        parts.initial_velocity.insert(parts.initial_velocity.end(), {std::sin(node[0]), 0});
    const SolidSystem system(mesh, std::move(parts));
    CentralDifference integrator({.safety = 0.8, .bound_interval = 1024}, levels);
    State at = system.initial_state();
    integrator.start(system, at, StartReason::fresh);
    constexpr double forever = 1e9;
    std::size_t n_steps = 0;
    const std::size_t before = integrator.work().elements;
    for (auto _ : state) n_steps += integrator.advance_unseen(system, at, forever, forever).n_steps;
    using ::benchmark::Counter;
    // wall time over simulated time: what a user waits for
    state.counters["s/s"] = Counter(at.t, Counter::kIsRate | Counter::kInvert);
    const double n_elements = static_cast<double>(mesh.n_elements());
    state.counters["elements"] = n_elements;
    state.counters["evaluations/s"] =
        (static_cast<double>(n_steps) * n_elements + static_cast<double>(integrator.work().elements - before)) / at.t;
    state.counters["step"] = integrator.critical_time_step();
}

void register_all() {
    for (const bool compt : {false, true})
        for (const double finest : {0.1, 0.05})
            for (const Form form : {Form::hyper, Form::hypo})
                for (const int levels : {1, 2, 3, 4, 5, 6})
                    for (const int threads : {1, 2}) {
                        if ((threads == 2 || form == Form::hypo) && levels != 1 && levels != 6) continue;
                        const std::string name =
                            std::string("borehole/") + (compt ? "compt" : "cst") +
                            (finest > 0.07 ? "/small" : "/large") + (form == Form::hyper ? "/hyper" : "/hypo") +
                            "/levels:" + std::to_string(levels) + "/threads:" + std::to_string(threads);
                        ::benchmark::RegisterBenchmark(name.c_str(), [=](::benchmark::State& state) {
                            run(state, compt, finest, form, levels, threads);
                        })->UseRealTime();
                    }
}

}  // namespace
}  // namespace gneiss::benchmark

int main(int argc, char** argv) {
    gneiss::benchmark::register_all();
    ::benchmark::Initialize(&argc, argv);
    ::benchmark::RunSpecifiedBenchmarks();
    ::benchmark::Shutdown();
}
