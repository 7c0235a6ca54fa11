#include "app/check_case.hpp"

#include <omp.h>

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <ostream>

#include "app/build_case.hpp"
#include "app/tables.hpp"
#include "base/flush_denormals.hpp"
#include "io/deck/deck.hpp"
#include "io/output/progress_line.hpp"
#include "mesh/measure.hpp"
#include "system/march.hpp"

namespace gneiss {

void check_case(const std::filesystem::path& deck, const std::vector<std::string>& set, int threads, std::ostream& out) {
    using Clock = std::chrono::steady_clock;
    if (threads > 0) omp_set_num_threads(threads);
    flush_denormals();
    Case built = build_case(read_deck(deck, set));
    const ProbeTable probes(built.mesh, built.options.output.probes);

    // a few steps: long enough to be timed, far too few to go anywhere
    constexpr double measured_seconds = 0.3;
    constexpr int most_steps = 200;
    State state = built.system->initial_state();
    int steps = 0;
    double dt = 0, t_measured = 0;
    Clock::time_point started;
    March march;
    march.t_end = built.options.run.t_end;
    march.after_start = [&] { started = Clock::now(); };
    march.after_step = [&](const StepReport& step) {
        ++steps;
        dt = step.dt;
        t_measured = std::chrono::duration<double>(Clock::now() - started).count();
        return steps < most_steps && t_measured < measured_seconds;
    };
    march.run(*built.system, *built.integrator, state, false);

    const MeshSize size = mesh_size(built.mesh);
    const double n_steps = std::ceil(built.options.run.t_end / dt), per_step = t_measured / steps;
    const auto line = [&out](const char* what, const std::string& value) { out << fmt::format("{:<22}{}\n", what, value); };
    line("deck", deck.string() + ": no errors");
    for (const std::string& warning : built.warnings) line("warning", warning);
    line("elements", fmt::format("{} {}", size.n_elements, built.mesh.kind == ElementKind::cst ? "cst" : "compt"));
    line("nodes", fmt::format("{}", size.n_nodes));
    line("sub-edges", fmt::format("{:.4g} to {:.4g} m", size.smallest_edge, size.largest_edge));
    line("internal variables", fmt::format("{}", built.system->layout().n_internal));
    line("step", fmt::format("{:.4g} s ({})", dt, built.options.integrator.dt > 0 ? "given" : "safety x critical"));
    line("steps", fmt::format("about {:.0f}", n_steps));
    line("time per step", fmt::format("{:.3g} ms on {} threads, {:.3g} ns per element", 1e3 * per_step, omp_get_max_threads(),
                                      1e9 * per_step / static_cast<double>(size.n_elements)));
    line("expected run time", duration_text(n_steps * per_step) + ", output apart");
    line("memory", fmt::format("about {:.3g} MB", memory_estimate(built) / 1e6));
}

}  // namespace gneiss
