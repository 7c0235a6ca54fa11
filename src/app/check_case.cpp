#include "app/check_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>
#include <ostream>
#include <set>

#include "app/build_case.hpp"
#include "app/make_integrator.hpp"
#include "app/plausibility.hpp"
#include "app/schedule.hpp"
#include "app/threads.hpp"
#include "io/deck/deck.hpp"
#include "io/output/progress_line.hpp"
#include "mesh/measure.hpp"
#include "mesh/regions.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

/// The names of one map that another one has not.
template <class Map, class Other>
std::string names_of(const Map& map, const Other& without) {
    std::string names;
    for (const auto& [name, unused] : map)
        if (!without.contains(name)) names += (names.empty() ? "" : ", ") + name;
    return names;
}

/// What a few steps took: long enough to be timed, far too few to go anywhere.
struct Measured {
    double dt = 0, per_step = 0;  ///< s: the last step, wall time of one
};

Measured measure_steps(const Case& built) {
    using Clock = std::chrono::steady_clock;
    constexpr double measured_seconds = 0.3;
    constexpr int most_steps = 200;
    State state = built.system->initial_state();
    int steps = 0;
    double t_measured = 0;
    Measured measured;
    Clock::time_point started;
    March march;
    march.t_end = built.options.run.t_end;
    march.next_look = [&](double) { return built.options.run.t_end; };
    march.after_start = [&] { started = Clock::now(); };
    march.after_step = [&](const StepReport& step) {
        steps += static_cast<int>(step.n_steps);
        measured.dt = step.dt;
        t_measured = std::chrono::duration<double>(Clock::now() - started).count();
        return steps < most_steps && t_measured < measured_seconds;
    };
    march.run(*built.system, *built.integrator, state, false);
    measured.per_step = t_measured / steps;
    return measured;
}

/// A row of what check prints; nothing where there is nothing to say.
void print_line(std::ostream& out, const char* what, const std::string& value) {
    if (!value.empty()) out << fmt::format("{:<20}{}\n", what, value);
}

void print_memory(const Case& built, std::ostream& out) {
    const double matrices = built.integrator->matrix_bytes();
    print_line(out, "memory",
               fmt::format("about {:.3g} MB", (memory_estimate(built) + matrices) / 1e6) +
                   (matrices > 0 ? fmt::format(", {:.3g} MB of it matrices and their factors", matrices / 1e6) : ""));
}

void print_cost_of_steps(const Case& built, const Measured& measured, std::ostream& out) {
    const IntegratorOptions& integrator = built.options.integrator;
    const double t_end = built.options.run.t_end, n_steps = std::ceil(t_end / measured.dt);
    const bool from_bound = has_critical_step(integrator) && integrator.dt == 0;
    const bool from_error = !from_bound && (integrator.dt == 0 || integrator.adaptive);
    const Schedule schedule(built.options);
    if (from_error) {
        print_line(out, "step", fmt::format("{:.4g} s at first, then from the error estimate", measured.dt));
        print_line(out, "output", fmt::format("at most {:.0f} frames", schedule.most_frames()));
    } else {
        print_line(out, "step",
                   from_bound ? fmt::format("{:.4g} s, {} of the critical step", measured.dt, integrator.safety)
                              : fmt::format("{:.4g} s, fixed", measured.dt));
        print_line(out, "steps", fmt::format("about {:.0f} to t = {:.6g} s", n_steps, t_end));
        print_line(out, "output",
                   fmt::format("about {:.0f} rows, at most {:.0f} frames", schedule.expected_rows(measured.dt),
                               schedule.most_frames()));
    }
    print_line(out, "time per step",
               fmt::format("{:.3g} ms on {}, {:.3g} ns per element", 1e3 * measured.per_step, threads_text(),
                           1e9 * measured.per_step / static_cast<double>(built.mesh->n_elements())));
    if (!from_error)
        print_line(out, "run time", fmt::format("about {}, output apart", duration_text(n_steps * measured.per_step)));
    print_memory(built, out);
}

/// How many load steps and iterations there will be, nobody knows before.
void print_cost_of_statics(const Case& built, std::ostream& out) {
    const double first = built.options.integrator.step;
    print_line(out, "load step",
               first > 0 ? fmt::format("{:.4g} s at first, then adapted", first)
                         : "as far as the next stop at first, then adapted");
    print_line(out, "output", fmt::format("at most {:.0f} frames", Schedule(built.options).most_frames()));
    print_memory(built, out);
}

}  // namespace

void check_case(const std::filesystem::path& deck, const std::vector<std::string>& set, int threads,
                std::ostream& out) {
    const std::string too_many_threads = use_threads(threads);
    DeckNotes notes;
    Case built = build_case(read_deck(deck, set, &notes));
    const auto line = [&out](const char* what, const std::string& value) { print_line(out, what, value); };
    line("deck", deck.string() + ": no errors");
    line("warning", too_many_threads);
    for (const std::string& note : notes.on_case) line("warning", note);
    for (const std::string& warning : built.warnings) line("warning", warning);
    const Plausibility looked = plausibility(built, fs::path("results") / deck.stem());
    for (const std::string& warning : looked.warnings) line("warning", warning);

    const Mesh& mesh = *built.mesh;
    const MeshSize size = mesh_size(mesh);
    line("elements", fmt::format("{} {}", size.n_elements, mesh.kind == ElementKind::cst ? "cst" : "compt"));
    line("nodes", fmt::format("{}", size.n_nodes));
    line("sub-edges", fmt::format("{:.4g} to {:.4g} m", size.smallest_edge, size.largest_edge));
    line("area", fmt::format("{:.6g} m2", size.area));
    line("regions", fmt::format("{}", fmt::join(names_of_regions(mesh), ", ")));
    line("boundaries", names_of(mesh.boundaries, decltype(mesh.boundaries){}));
    line("inner lines", names_of(mesh.inner_lines, decltype(mesh.inner_lines){}));
    std::set<std::string> lines;
    for (const auto& [name, unused] : mesh.boundaries) lines.insert(name);
    for (const auto& [name, unused] : mesh.inner_lines) lines.insert(name);
    line("points", names_of(mesh.node_sets, lines));
    for (const auto& quantity : built.system->models().quantities(built.system->initial_state()))
        line("at the start", fmt::format("{} {:.6g} {}", quantity.name, quantity.value, quantity.unit));
    for (const auto& [name, value] : looked.facts) line(name.c_str(), value);
    line("internal variables", fmt::format("{}", built.system->layout().n_internal));

    // last: a step that fails ends the check, and what is said before may tell why
    if (built.integrator->is_static()) {
        State state = built.system->initial_state();
        built.integrator->start(*built.system, state, StartReason::fresh);  // orders the unknowns
        print_cost_of_statics(built, out);
    } else {
        print_cost_of_steps(built, measure_steps(built), out);
    }
}

}  // namespace gneiss
