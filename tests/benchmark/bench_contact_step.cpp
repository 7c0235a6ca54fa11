// Time per triangle of a step of a bed of free fragments in sustained contact, beside the step of the same CST in one
// piece.
//
//     bench_contact --benchmark_filter=step --benchmark_repetitions=5 --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "base/flush_denormals.hpp"
#include "contact/make_contact.hpp"
#include "integrators/central_difference.hpp"
#include "mesh/inner_sides.hpp"
#include "mesh/make_mesh.hpp"
#include "model/make_blocks.hpp"
#include "model/solid_system.hpp"
#include "system/march.hpp"

namespace gneiss::benchmark {
namespace {

using ::benchmark::Counter;

enum class Fragments { none, cells, triangles };  ///< one piece; pieces of 8 triangles; every triangle

/// A square of about n bedded CST on distorted nodes.
Mesh square(int n) {
    MeshOptions options;
    options.source = MeshOptions::Source::rectangle;
    const int cells = static_cast<int>(std::lround(std::sqrt(n / 8.0)));
    options.cells = {cells, cells};
    options.pattern = MeshOptions::Pattern::alternating;
    Mesh mesh = make_mesh(options, false, {});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> wobble(-0.1 / (2 * cells), 0.1 / (2 * cells));
    for (auto& node : mesh.nodes)
        if (node[0] > 0 && node[0] < 1 && node[1] > 0 && node[1] < 1)
            node = {node[0] + wobble(random), node[1] + wobble(random)};
    return mesh;
}

struct Bed {
    Mesh mesh;
    std::vector<std::int32_t> original_of, failed;
    std::vector<std::array<double, 2>> centre;  ///< of the fragment of each node, m
    double size;                                ///< of a fragment, m
};

Bed bed(int n, Fragments kind) {
    Bed made{square(n), {}, {}, {}, 0};
    Mesh& mesh = made.mesh;
    const int cells = static_cast<int>(std::lround(std::sqrt(n / 8.0)));
    made.size = 1.0 / cells * (kind == Fragments::triangles ? 0.5 : 1);
    std::vector<int> fragment(mesh.n_elements());
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        double x = 0, y = 0;
        for (int k = 0; k < 3; ++k) {
            x += mesh.nodes[static_cast<std::size_t>(mesh.element(e)[k])][0] / 3;
            y += mesh.nodes[static_cast<std::size_t>(mesh.element(e)[k])][1] / 3;
        }
        fragment[e] = kind == Fragments::triangles ? static_cast<int>(e)
                      : kind == Fragments::cells   ? static_cast<int>(x * cells) * cells + static_cast<int>(y * cells)
                                                   : 0;
    }
    InnerSides sides(mesh);
    for (std::size_t s = 0; s < sides.sides().size(); ++s)
        if (fragment[static_cast<std::size_t>(sides.sides()[s].left.element)] !=
            fragment[static_cast<std::size_t>(sides.sides()[s].right.element)])
            made.failed.push_back(static_cast<std::int32_t>(s));
    sides.open(made.failed);
    made.original_of.assign(sides.original_of().begin(), sides.original_of().end());
    std::map<int, std::array<double, 3>> sums;
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (int k = 0; k < 3; ++k) {
            const auto& node = mesh.nodes[static_cast<std::size_t>(mesh.element(e)[k])];
            auto& sum = sums[fragment[e]];
            sum = {sum[0] + node[0], sum[1] + node[1], sum[2] + 1};
        }
    made.centre.resize(mesh.n_nodes());
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (int k = 0; k < 3; ++k) {
            const auto& sum = sums[fragment[e]];
            made.centre[static_cast<std::size_t>(mesh.element(e)[k])] = {sum[0] / sum[2], sum[1] / sum[2]};
        }
    return made;
}

constexpr double compression = 3e-3;  ///< of the bed: neighbours overlap by this part of a fragment
constexpr double speed = 2;           ///< of fragments at random, m/s, beside waves of 1400 m/s

void step(::benchmark::State& state, Fragments kind, double friction) {
    omp_set_num_threads(static_cast<int>(state.range(1)));
    flush_denormals();
    const Bed rubble = bed(static_cast<int>(state.range(0)), kind);
    SolidOptions solid;
    solid.compt = false;
    MaterialOptions material;
    material.density = 1000;
    material.constants = {0.267e9, 0.8e9, 1.6e9, 0.8e9};
    material.axes.angle = Formula(0.3);
    SolidSystem::Parts parts;
    parts.blocks = make_blocks(rubble.mesh, solid, {material});
    const Contact* contact = nullptr;
    if (kind != Fragments::none) {
        ContactOptions options;
        options.friction = friction;
        auto made = make_contact({rubble.mesh, rubble.original_of, rubble.failed}, parts.blocks, solid, options, false);
        contact = made.get();
        parts.interactions.push_back(std::move(made));
    }
    SolidSystem system(rubble.mesh, std::move(parts));
    CentralDifference integrator({.safety = 0.8, .bound_interval = 1024});
    State at = system.initial_state();
    std::map<std::array<double, 2>, std::array<double, 2>> velocities;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-speed, speed);
    for (std::size_t node = 0; node < rubble.mesh.n_nodes() && contact != nullptr; ++node) {
        const auto [found, is_new] = velocities.try_emplace(rubble.centre[node]);
        if (is_new) found->second = {uniform(random), uniform(random)};
        for (const std::size_t k : {0, 1}) {
            at.u[2 * node + k] = -compression * rubble.centre[node][k];
            at.v[2 * node + k] = found->second[k];
        }
    }
    apply_due_events(system, at);
    integrator.start(system, at, StartReason::fresh);
    std::size_t n_steps = 0;
    for (auto _ : state) {
        integrator.advance(system, at, 1e9);
        apply_due_events(system, at);
        ++n_steps;
    }
    const auto n = static_cast<double>(rubble.mesh.n_elements());
    state.counters["ns/triangle"] =
        Counter(1e-9 * n * static_cast<double>(n_steps), Counter::kIsRate | Counter::kInvert);
    if (contact == nullptr) return;
    state.counters["points/triangle"] = static_cast<double>(contact->bodies().points().size()) / n;
    state.counters["pairs/triangle"] = static_cast<double>(contact->n_candidates()) / n;
    state.counters["touching/triangle"] = static_cast<double>(contact->n_touching()) / n;
    state.counters["searches"] = static_cast<double>(contact->n_searches()) / static_cast<double>(n_steps);
}

/// A side of a mesh of joints that fails, in a random place.
void follow(::benchmark::State& state) {
    omp_set_num_threads(1);
    Mesh mesh = square(static_cast<int>(state.range(0)));
    InnerSides sides(mesh);
    std::vector<std::int32_t> all(sides.sides().size());
    std::iota(all.begin(), all.end(), 0);
    sides.open(all);
    std::ranges::shuffle(all, std::mt19937(1));
    Contact contact({mesh, sides.original_of()}, std::vector<double>(mesh.n_elements(), 1e-12), 4,
                    {.friction = 0.5, .skin = 0.1 * std::sqrt(2.0 / static_cast<double>(mesh.n_elements()))});
    State at;
    at.u.resize(2 * mesh.n_nodes());
    std::vector<double> history(contact.n_history());
    contact.initial_history(history);
    PathEnergies energies;
    std::size_t next = 0;
    for (auto _ : state) contact.follow({mesh, {}, {}, {}, std::span(&all[next++], 1)}, at, history, energies);
}
BENCHMARK(follow)->Arg(2000)->Arg(20000)->ArgName("triangles")->Unit(::benchmark::kMicrosecond);

void sizes(::benchmark::internal::Benchmark* bench) {
    bench->ArgsProduct({{20000}, {1, 2}})->ArgNames({"triangles", "threads"})->UseRealTime()->MinTime(0.5);
}

BENCHMARK_CAPTURE(step, one_piece, Fragments::none, 0.0)->Apply(sizes);
BENCHMARK_CAPTURE(step, fragments_of_8, Fragments::cells, 0.0)->Apply(sizes);
BENCHMARK_CAPTURE(step, fragments_of_8_rough, Fragments::cells, 0.5)->Apply(sizes);
BENCHMARK_CAPTURE(step, single_triangles, Fragments::triangles, 0.0)->Apply(sizes);
BENCHMARK_CAPTURE(step, single_triangles_rough, Fragments::triangles, 0.5)->Apply(sizes);

}  // namespace
}  // namespace gneiss::benchmark
