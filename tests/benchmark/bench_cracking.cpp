// Time per sub-triangle of an explicit step of a solid that may crack, and does not: watched for its strength
// (`extrinsic`), or with joints on every edge (`intrinsic`), beside the whole one.

#include <benchmark/benchmark.h>
#include <omp.h>

#include "base/flush_denormals.hpp"
#include "benchmark/anisotropic_square.hpp"
#include "fracture/cohesion.hpp"
#include "fracture/cracking.hpp"
#include "integrators/central_difference.hpp"
#include "model/make_blocks.hpp"
#include "model/solid_system.hpp"
#include "system/march.hpp"

namespace gneiss::benchmark {
namespace {

using Method = FractureOptions::Method;

void cracking_step(::benchmark::State& state, bool compt, Method method) {
    omp_set_num_threads(1);
    flush_denormals();
    Mesh mesh = square(compt, compt ? state.range(0) / 4 : state.range(0));
    InnerSides inner(mesh);
    SolidOptions solid;
    solid.compt = compt;
    MaterialOptions material = anisotropic(Form::hyper);
    // rock whose strength the waves stay a tenth below
    material.strength = StrengthOptions{{5e7, 5e7}, {1e8, 1e8}, {0.6, 0.6}, {0.4, 0.4}, {1e7, 1e7}, {1e7, 1e7}};
    FractureOptions fracture;
    fracture.method = method;
    SolidSystem::Parts parts;
    std::vector<std::string> warnings;
    std::unique_ptr<Joints> joints;
    std::vector<CohesionProperties<double>> properties;
    if (method == Method::intrinsic) open_all_sides(inner);
    const std::vector<JointEdge> edges = all_edges(mesh, inner);
    parts.blocks = make_blocks(mesh, solid, {material});
    if (method != Method::none) {
        properties = edge_properties(mesh, edges, parts.blocks, {material}, fracture, {}, {}, warnings);
        if (method == Method::extrinsic) {
            watch_strength(mesh, edges, properties, parts.blocks, watch_reach(fracture.criterion));
            joints = make_extrinsic_joints(inner, properties, solid.thickness);
        } else {
            joints = make_cohesion(mesh, edges, properties, method, solid.thickness);
            properties.clear();
        }
    }
    parts.initial_velocity = velocities(mesh);
    for (double& v : parts.initial_velocity) v *= 0.1;
    Joints* const cohesion = joints.get();
    if (joints) parts.interactions.push_back(std::move(joints));
    SolidSystem system(mesh, std::move(parts));
    if (cohesion != nullptr)
        system.add_event(std::make_unique<Cracking>(Cracking::Parts{.mesh = mesh,
                                                                    .inner = inner,
                                                                    .solid = system,
                                                                    .joints = *cohesion,
                                                                    .properties = std::move(properties),
                                                                    .thickness = solid.thickness}));
    CentralDifference integrator({.safety = 0.8, .bound_interval = 1024});
    State at = system.initial_state();
    integrator.start(system, at, StartReason::fresh);
    constexpr double forever = 1e9;
    std::size_t n_steps = 0;
    for (auto _ : state) {
        n_steps += integrator.advance_unseen(system, at, forever, forever).n_steps;
        if (apply_due_events(system, at) != EventOutcome::none) state.SkipWithError("it has cracked");
    }
    const double sub_triangles = static_cast<double>(mesh.n_elements()) * (compt ? 4 : 1);
    using ::benchmark::Counter;
    state.counters["ns/sub-triangle"] =
        Counter(sub_triangles * static_cast<double>(n_steps) * 1e-9, Counter::kIsRate | Counter::kInvert);
}

void sizes(::benchmark::internal::Benchmark* bench) {
    for (const std::int64_t n : {2000, 20000, 200000}) bench->Arg(n);
    bench->UseRealTime()->MinTime(0.5);
}

BENCHMARK_CAPTURE(cracking_step, cst_whole, false, Method::none)->Apply(sizes);
BENCHMARK_CAPTURE(cracking_step, cst_extrinsic, false, Method::extrinsic)->Apply(sizes);
BENCHMARK_CAPTURE(cracking_step, cst_intrinsic, false, Method::intrinsic)->Apply(sizes);
BENCHMARK_CAPTURE(cracking_step, compt_whole, true, Method::none)->Apply(sizes);
BENCHMARK_CAPTURE(cracking_step, compt_extrinsic, true, Method::extrinsic)->Apply(sizes);
BENCHMARK_CAPTURE(cracking_step, compt_intrinsic, true, Method::intrinsic)->Apply(sizes);

}  // namespace
}  // namespace gneiss::benchmark

BENCHMARK_MAIN();
