#include "app/check_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>
#include <ostream>

#include "app/build_case.hpp"
#include "app/schedule.hpp"
#include "app/threads.hpp"
#include "io/deck/deck.hpp"
#include "io/output/progress_line.hpp"
#include "mesh/measure.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

/// The names of one map that another one has not.
template <class Map, class Other>
std::string names_of(const Map& map, const Other& without) {
    std::string names;
    for (const auto& [name, unused] : map)
        if (!without.contains(name)) names += (names.empty() ? "" : ", ") + name;
    return names;
}

}  // namespace

void check_case(const std::filesystem::path& deck, const std::vector<std::string>& set, int threads,
                std::ostream& out) {
    using Clock = std::chrono::steady_clock;
    const std::string too_many_threads = use_threads(threads);
    Case built = build_case(read_deck(deck, set));

    // a few steps: long enough to be timed, far too few to go anywhere
    constexpr double measured_seconds = 0.3;
    constexpr int most_steps = 200;
    State state = built.system->initial_state();
    int steps = 0;
    double dt = 0, t_measured = 0;
    Clock::time_point started;
    March march;
    march.t_end = built.options.run.t_end;
    march.next_look = [&](double) { return built.options.run.t_end; };
    march.after_start = [&] { started = Clock::now(); };
    march.after_step = [&](const StepReport& step) {
        steps += static_cast<int>(step.n_steps);
        dt = step.dt;
        t_measured = std::chrono::duration<double>(Clock::now() - started).count();
        return steps < most_steps && t_measured < measured_seconds;
    };
    march.run(*built.system, *built.integrator, state, false);

    const double n_steps = std::ceil(built.options.run.t_end / dt), per_step = t_measured / steps;
    const auto line = [&out](const char* what, const std::string& value) {
        if (!value.empty()) out << fmt::format("{:<20}{}\n", what, value);
    };
    line("deck", deck.string() + ": no errors");
    line("warning", too_many_threads);
    for (const std::string& warning : built.warnings) line("warning", warning);

    const Mesh& mesh = built.mesh;
    const MeshSize size = mesh_size(mesh);
    line("elements", fmt::format("{} {}", size.n_elements, mesh.kind == ElementKind::cst ? "cst" : "compt"));
    line("nodes", fmt::format("{}", size.n_nodes));
    line("sub-edges", fmt::format("{:.4g} to {:.4g} m", size.smallest_edge, size.largest_edge));
    line("area", fmt::format("{:.6g} m2", size.area));
    line("regions", fmt::format("{}", fmt::join(mesh.region_names, ", ")));
    line("boundaries", names_of(mesh.boundaries, decltype(mesh.boundaries){}));
    line("points", names_of(mesh.node_sets, mesh.boundaries));
    line("internal variables", fmt::format("{}", built.system->layout().n_internal));

    const IntegratorOptions& integrator = built.options.integrator;
    const bool adapted = integrator.dt == 0 || integrator.adaptive;
    line("step", built.integrator->is_static() ? fmt::format("{:.4g} s of load time, adapted", dt)
                 : integrator.type == "central_difference" && adapted
                     ? fmt::format("{:.4g} s, {} of the critical step", dt, integrator.safety)
                     : fmt::format("{:.4g} s, {}", dt, adapted ? "adapted" : "fixed"));
    line("steps", fmt::format("about {:.0f} to t = {:.6g} s", n_steps, built.options.run.t_end));
    const Schedule schedule(built.options);
    line("output",
         fmt::format("about {:.0f} rows, at most {:.0f} frames", schedule.expected_rows(dt), schedule.most_frames()));
    line("time per step", fmt::format("{:.3g} ms on {}, {:.3g} ns per element", 1e3 * per_step, threads_text(),
                                      1e9 * per_step / static_cast<double>(size.n_elements)));
    line("run time", fmt::format("about {}, output apart", duration_text(n_steps * per_step)));
    line("memory", fmt::format("about {:.3g} MB", memory_estimate(built) / 1e6));
}

}  // namespace gneiss
