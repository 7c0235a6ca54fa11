// Time and memory of what implicit and static solvers spend theirs on: tangents, factorisations, solves, Newton's
// method.
//
// `assembly` stands beside the textbook's linear CST matrix (textbook_stiffness.hpp) on the same mesh and pattern;
// `linear` takes a system apart into its shares; `statics` is a whole load step of quasi_static, peak memory included;
// `newton_form` solves the Newton systems of second-order dynamics in n displacements, and in 2 n displacements and
// velocities.
//
//     bench_implicit --benchmark_filter=linear

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <omp.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <string>

#include "app/large_arrays.hpp"
#include "benchmark/textbook_stiffness.hpp"
#include "integrators/free_part.hpp"
#include "integrators/quasi_static.hpp"
#include "support/small_solids.hpp"

namespace gneiss::benchmark {
namespace {

using ::benchmark::Counter;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// ---- memory ---------------------------------------------------------------------------------------------------------

/// A line of /proc/self/status, bytes.
double status_bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word != key + ":") continue;
        double kib = 0;
        status >> kib;
        return 1024 * kib;
    }
    return std::nan("");
}

/// Largest growth of the resident memory since the last mark.
class PeakMemory {
public:
    PeakMemory() { mark(); }
    void mark() {
        malloc_trim(0);
        std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak
        before_ = status_bytes("VmRSS");
    }
    double growth() const { return status_bytes("VmHWM") - before_; }

private:
    double before_ = 0;
};

// ---- the problem ----------------------------------------------------------------------------------------------------

struct Kind {
    bool compt = false;
    Form form = Form::hyper;
    StressMap map = StressMap::conjugate;
    bool follower = false;
};

/// Cells of a square whose nodes carry about n unknowns.
int cells_of_unknowns(std::int64_t n) {
    return static_cast<int>(std::lround((std::sqrt(static_cast<double>(n) / 2) - 1) / 2));
}

/// Fixed on the left, pulled on the right and down, to strains of a few percent at t = 1.
test::Solid pulled_square(const Kind& kind, int cells) {
    test::SolidDescription what;
    what.solid.compt = kind.compt;
    what.solid.plane = Plane::strain;
    MaterialOptions& material = what.materials[0];
    material.form = kind.form;
    material.stress_map = kind.map;
    BoundaryOptions left;
    left.on = "left";
    left.value = {Formula(0), Formula(0)};
    what.boundaries = {left};
    LoadOptions load;
    load.on = "right";
    load.kind = kind.follower ? LoadOptions::Kind::pressure : LoadOptions::Kind::traction;
    load.value = {Formula(kind.follower ? -2e7 : 2e7), Formula(kind.follower ? 0 : -4e6)};
    load.amplitude.kind = AmplitudeOptions::Kind::ramp;
    load.amplitude.end = 1;
    what.loads = {load};
    return test::make_solid(test::rectangle(kind.compt, 1, 1, {cells, cells}), what);
}

/// Strains of about 1e-2, different in every element.
State strained(const test::Solid& solid) {
    State state = solid.system->initial_state();
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        const auto& [x, y] = solid.mesh.nodes[node];
        state.u[2 * node] = 0.004 * std::sin(2 * y + x);
        state.u[2 * node + 1] = 0.004 * std::cos(x) * y;
    }
    return state;
}

// ---- assembly -------------------------------------------------------------------------------------------------------

void report_assembly(::benchmark::State& state, const test::Solid& solid, double triangles_per_element) {
    const double triangles = static_cast<double>(solid.mesh.n_elements()) * triangles_per_element;
    state.counters["ns/triangle"] =
        Counter(triangles * 1e-9 * static_cast<double>(state.iterations()), Counter::kIsRate | Counter::kInvert);
}

void assembly_textbook(::benchmark::State& state) {
    const test::Solid solid = pulled_square({}, cells_of_unknowns(state.range(0)));
    const Tangent& tangent = *solid.system->tangent();
    const MatrixPattern pattern = tangent.pattern();
    const TextbookStiffness stiffness(solid.mesh, 0.267e9, 0.4e9, 1, pattern.row_starts, pattern.columns);
    std::vector<double> values(tangent.n_nonzero());
    for (auto _ : state) stiffness.assemble(values);
    ::benchmark::DoNotOptimize(values.data());
    report_assembly(state, solid, 1);
}

void assembly(::benchmark::State& state, Kind kind) {
    omp_set_num_threads(1);
    const test::Solid solid = pulled_square(kind, cells_of_unknowns(state.range(0)));
    const Tangent& tangent = *solid.system->tangent();
    const State rest = solid.system->initial_state(), at = strained(solid);
    std::vector<double> values(tangent.n_nonzero());
    for (auto _ : state) tangent.assemble(rest, Trial::of(at), {.stiffness = 1}, values);
    ::benchmark::DoNotOptimize(values.data());
    report_assembly(state, solid, kind.compt ? 4 : 1);
}

// ---- linear systems -------------------------------------------------------------------------------------------------

void linear(::benchmark::State& state, const char* solver_name, Kind kind) {
    omp_set_num_threads(1);
    const test::Solid solid = pulled_square(kind, cells_of_unknowns(state.range(0)));
    const SemiDiscrete& system = *solid.system;
    const State rest = system.initial_state(), at = strained(solid);
    PeakMemory memory;
    auto start = Clock::now();
    const Tangent& tangent = *system.tangent();
    const FreeMatrix free = free_part(system, *system.tangent());
    const double pattern = seconds_since(start);
    start = Clock::now();
    const auto solver = make_linear_solver(solver_name, tangent.symmetric());
    solver->analyse(free.pattern());
    const double analysis = seconds_since(start);
    std::vector<double> full(tangent.n_nonzero()), values(free.pattern().n_nonzero());
    std::vector<double> b(free.n(), 1.0), x(free.n());
    double assembly = 0, factorisation = 0, solution = 0;
    for (auto _ : state) {
        start = Clock::now();
        tangent.assemble(rest, Trial::of(at), {.stiffness = 1}, full);
        free.take_values(full, values);
        assembly += seconds_since(start);
        start = Clock::now();
        solver->factorise(values);
        factorisation += seconds_since(start);
        start = Clock::now();
        solver->solve(b, x);
        solution += seconds_since(start);
    }
    const double total = assembly + factorisation + solution, runs = static_cast<double>(state.iterations());
    state.counters["pattern_ms"] = 1e3 * pattern;
    state.counters["analysis_ms"] = 1e3 * analysis;
    state.counters["assembly_ms"] = 1e3 * assembly / runs;
    state.counters["factorisation_ms"] = 1e3 * factorisation / runs;
    state.counters["solve_ms"] = 1e3 * solution / runs;
    state.counters["assembly_%"] = 100 * assembly / total;
    state.counters["factorisation_%"] = 100 * factorisation / total;
    state.counters["solve_%"] = 100 * solution / total;
    state.counters["iterations"] = static_cast<double>(solver->iterations()) / runs;
    state.counters["factor_B/unknown"] = static_cast<double>(solver->factor_bytes()) / static_cast<double>(free.n());
    state.counters["all_B/unknown"] = memory.growth() / static_cast<double>(free.n());
}

// ---- statics --------------------------------------------------------------------------------------------------------

struct Step {
    double seconds, bytes;
    std::size_t n;
    QuasiStatic::Counts counts;
};

/// A load step from the integrator's allocations on; memory from the mesh on.
Step load_step(const char* solver_name, const Kind& kind, int cells, double tolerance) {
    PeakMemory memory;
    const test::Solid solid = pulled_square(kind, cells);
    const auto start = Clock::now();
    QuasiStatic::Options options;
    options.solver = solver_name;
    options.tolerance = tolerance;
    QuasiStatic integrator(options);
    State at = solid.system->initial_state();
    integrator.start(*solid.system, at, StartReason::fresh);
    while (at.t < 1) integrator.advance(*solid.system, at, 1);
    return {seconds_since(start), memory.growth(), at.u.size(), integrator.counts()};
}

void statics(::benchmark::State& state, const char* solver_name, Kind kind, double tolerance = 1e-9) {
    omp_set_num_threads(1);
    load_step(solver_name, kind, 10, tolerance);  // libraries are loaded
    Step step{};
    for (auto _ : state) {
        step = load_step(solver_name, kind, cells_of_unknowns(state.range(0)), tolerance);
        state.SetIterationTime(step.seconds);
    }
    state.counters["iterations"] = static_cast<double>(step.counts.iterations);
    state.counters["factorisations"] = static_cast<double>(step.counts.factorisations);
    state.counters["unknowns"] = static_cast<double>(step.n);
    state.counters["all_B/unknown"] = step.bytes / static_cast<double>(step.n);
}

/// The first iterate of a linear problem from nothing: pattern, analysis, assembly, factorisation, solve.
void first_solve(::benchmark::State& state, const char* solver_name, Kind kind, int cells) {
    omp_set_num_threads(1);
    double bytes = 0;
    std::size_t n = 0;
    for (auto _ : state) {
        const test::Solid solid = pulled_square(kind, cells);
        const SemiDiscrete& system = *solid.system;
        const State rest = system.initial_state();
        PeakMemory memory;
        const auto start = Clock::now();
        const Tangent& tangent = *system.tangent();
        const FreeMatrix free = free_part(system, *system.tangent());
        const auto solver = make_linear_solver(solver_name, tangent.symmetric());
        solver->analyse(free.pattern());
        std::vector<double> values(tangent.n_nonzero()), f(rest.u.size()), x(free.n());
        Trial trial = Trial::of(rest);
        trial.t = 1;
        system.force(rest, trial, f);
        tangent.assemble(rest, trial, {.stiffness = 1}, values);
        free.take_values(values, values);
        free.take(f, x);
        solver->factorise({values.data(), free.pattern().n_nonzero()});
        solver->solve(x, x);
        state.SetIterationTime(seconds_since(start));
        n = free.n();
        bytes = memory.growth();
    }
    state.counters["unknowns"] = static_cast<double>(n);
    state.counters["all_B/unknown"] = bytes / static_cast<double>(n);
}

// ---- second-order dynamics ------------------------------------------------------------------------------------------

/// A sparse matrix of its own, row by row.
struct Rows {
    std::vector<std::int64_t> starts{0}, columns;
    std::vector<double> values;

    void add(std::size_t column, double value) {
        columns.push_back(static_cast<std::int64_t>(column));
        values.push_back(value);
    }
    void end_row() { starts.push_back(static_cast<std::int64_t>(columns.size())); }
    SparsePattern pattern() const { return {starts, columns}; }
};

/// Newton systems of u' = v, M v' = f(u) - c M v: (M + gamma c M + gamma^2 K) dv, or both unknowns in
/// [I, -gamma I; gamma M^-1 K, (1 + gamma c) I]. gamma belongs to steps of fifty times the explicit one.
void newton_form(::benchmark::State& state, const char* solver_name, bool both, Kind kind) {
    omp_set_num_threads(1);
    const test::Solid solid = pulled_square(kind, cells_of_unknowns(state.range(0)));
    const SemiDiscrete& system = *solid.system;
    const State rest = system.initial_state();
    const Tangent& tangent = *system.tangent();
    const FreeMatrix free = free_part(system, *system.tangent());
    std::vector<double> stiffness(tangent.n_nonzero());
    tangent.assemble(rest, Trial::of(rest), {.stiffness = 1}, stiffness);
    free.take_values(stiffness, stiffness);
    const double gamma = 50 / system.frequency_bound(rest).omega, damped = 1 + gamma * 10;
    const std::size_t n = free.n();
    const SparsePattern pattern = free.pattern();
    PeakMemory memory;
    Rows rows;
    const auto for_row = [&](std::size_t i, auto visit) {
        for (auto k = static_cast<std::size_t>(pattern.row_starts[i]);
             k < static_cast<std::size_t>(pattern.row_starts[i + 1]); ++k)
            visit(static_cast<std::size_t>(pattern.columns[k]), stiffness[k]);
    };
    for (std::size_t i = 0; i < n && both; ++i) {
        rows.add(i, 1);
        rows.add(n + i, -gamma);
        rows.end_row();
    }
    for (std::size_t i = 0; i < n; ++i) {
        const double mass = system.lumped_mass()[free.free()[i]];
        for_row(i, [&](std::size_t j, double k) {
            rows.add(j, both ? gamma / mass * k : gamma * gamma * k + (i == j ? damped * mass : 0));
        });
        if (both) rows.add(n + i, damped);
        rows.end_row();
    }
    const auto solver = make_linear_solver(solver_name, tangent.symmetric() && !both);
    auto start = Clock::now();
    solver->analyse(rows.pattern());
    const double analysis = seconds_since(start);
    std::vector<double> b(rows.pattern().n(), 1.0), x(b.size());
    double factorisation = 0, solution = 0;
    for (auto _ : state) {
        start = Clock::now();
        solver->forget();
        solver->factorise(rows.values);
        factorisation += seconds_since(start);
        start = Clock::now();
        solver->solve(b, x);
        solution += seconds_since(start);
    }
    const double runs = static_cast<double>(state.iterations());
    state.counters["analysis_ms"] = 1e3 * analysis;
    state.counters["factorisation_ms"] = 1e3 * factorisation / runs;
    state.counters["solve_ms"] = 1e3 * solution / runs;
    state.counters["factor_B/displacement"] = static_cast<double>(solver->factor_bytes()) / static_cast<double>(n);
    state.counters["all_B/displacement"] = memory.growth() / static_cast<double>(n);
}

// ---- what is run ----------------------------------------------------------------------------------------------------

using Bench = ::benchmark::internal::Benchmark;
void sizes(Bench* bench) {
    for (const std::int64_t n : {10000, 100000, 400000}) bench->Arg(n);
    bench->UseRealTime()->Unit(::benchmark::kMillisecond);
}
void small_and_large(Bench* bench) {
    for (const std::int64_t n : {10000, 100000}) bench->Arg(n);
    bench->UseRealTime()->Unit(::benchmark::kMillisecond);
}
void one_step(Bench* bench) { bench->Arg(100000)->UseManualTime()->Iterations(1)->Unit(::benchmark::kMillisecond); }

constexpr Kind cst{}, compt{.compt = true};
constexpr Kind cst_follower{.follower = true}, compt_follower{.compt = true, .follower = true};
constexpr Kind compt_hypo{.compt = true, .form = Form::hypo}, cst_hypo{.form = Form::hypo};

BENCHMARK(assembly_textbook)->Apply(sizes);
BENCHMARK_CAPTURE(assembly, cst, cst)->Apply(sizes);
BENCHMARK_CAPTURE(assembly, compt, compt)->Apply(sizes);
BENCHMARK_CAPTURE(assembly, cst_hypo, cst_hypo)->Apply(small_and_large);
BENCHMARK_CAPTURE(assembly, compt_hypo, compt_hypo)->Apply(small_and_large);

BENCHMARK_CAPTURE(linear, cholmod_cst, "cholmod", cst)->Apply(sizes);
BENCHMARK_CAPTURE(linear, cholmod_compt, "cholmod", compt)->Apply(sizes);
BENCHMARK_CAPTURE(linear, umfpack_cst, "umfpack", cst_follower)->Apply(sizes);
BENCHMARK_CAPTURE(linear, umfpack_compt, "umfpack", compt_follower)->Apply(sizes);
BENCHMARK_CAPTURE(linear, klu_cst, "klu", cst_follower)->Apply(sizes);
BENCHMARK_CAPTURE(linear, klu_compt, "klu", compt_follower)->Apply(sizes);

BENCHMARK_CAPTURE(linear, pcg_cst, "pcg", cst)->Apply(small_and_large);
BENCHMARK_CAPTURE(linear, pcg_compt, "pcg", compt)->Apply(small_and_large);
BENCHMARK_CAPTURE(linear, gmres_compt, "gmres", compt_follower)->Apply(small_and_large);

BENCHMARK_CAPTURE(statics, cholmod_cst, "cholmod", cst)->Apply(one_step);
BENCHMARK_CAPTURE(statics, cholmod_compt, "cholmod", compt)->Apply(one_step);
BENCHMARK_CAPTURE(statics, umfpack_cst, "umfpack", cst_follower)->Apply(one_step);
BENCHMARK_CAPTURE(statics, umfpack_compt, "umfpack", compt_follower)->Apply(one_step);
BENCHMARK_CAPTURE(statics, klu_cst, "klu", cst_follower)->Apply(one_step);
BENCHMARK_CAPTURE(statics, klu_compt, "klu", compt_follower)->Apply(one_step);

// 200 thousand triangles
constexpr int reach_cells = 158;
void reach(Bench* bench) { bench->UseManualTime()->Iterations(1)->Unit(::benchmark::kMillisecond); }
BENCHMARK_CAPTURE(first_solve, reach_cst, "cholmod", cst, reach_cells)->Apply(reach);
BENCHMARK_CAPTURE(first_solve, reach_compt, "cholmod", compt, reach_cells)->Apply(reach);
BENCHMARK_CAPTURE(statics, reach_cst, "cholmod", cst)->Arg(200978)->Apply(reach);
BENCHMARK_CAPTURE(statics, reach_compt, "cholmod", compt)->Arg(200978)->Apply(reach);

// the prediction is the first iteration from the state before: three factorisations in all
constexpr double after_three = 1e-4;
BENCHMARK_CAPTURE(statics, three_iterations_cst, "cholmod", cst, after_three)->Arg(200978)->Apply(reach);
BENCHMARK_CAPTURE(statics, three_iterations_compt, "cholmod", compt, after_three)->Arg(200978)->Apply(reach);

BENCHMARK_CAPTURE(newton_form, n_cholmod, "cholmod", false, compt)->Apply(small_and_large);
BENCHMARK_CAPTURE(newton_form, n_klu, "klu", false, compt)->Apply(small_and_large);
BENCHMARK_CAPTURE(newton_form, 2n_klu, "klu", true, compt)->Apply(small_and_large);

}  // namespace
}  // namespace gneiss::benchmark

int main(int argc, char** argv) {
    gneiss::return_large_arrays();  // as the program does
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
