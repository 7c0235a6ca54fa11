#include "app/run_summary.hpp"

#include <omp.h>

namespace gneiss {

RunSummary summarise(const Case& built, const std::string& deck, const std::vector<std::string>& set,
                     const RunNumbers& now) {
    RunSummary summary;
    summary.title = built.options.title;
    summary.groups["deck"] = deck;
    if (!set.empty()) summary.groups["overrides"] = set;
    summary.groups["counts"] = {{"elements", built.mesh->n_elements()},
                                {"nodes", built.mesh->n_nodes()},
                                {"steps", now.step},
                                {"threads", omp_get_max_threads()}};
    const WorkCounts work = built.integrator->work();
    summary.groups["work"] = {
        {"steps", now.step - now.first_step},  {"rejected", now.n_rejected},
        {"force_evaluations", now.n_force},    {"start_evaluations", work.starts},
        {"balance_evaluations", work.balance}, {"event_search_evaluations", now.n_force_searching},
        {"jacobians", work.jacobians},         {"factorisations", work.factorisations},
        {"iterations", work.iterations}};
    if (work.interactions > 0) summary.groups["work"]["interaction_evaluations"] = work.interactions;
    if (work.elements > 0) summary.groups["work"]["local_element_evaluations"] = work.elements;
    if (built.cracking != nullptr) {
        std::vector<double> cracks;
        add_crack_columns(*built.cracking, now.state, cracks);
        const Cracking::Overshoot overshoot = built.cracking->overshoot(now.state);
        summary.groups["cracks"] = {{"cracked_length_m", cracks[0]},
                                    {"fragments", cracks[1]},
                                    {"nodes", cracks[2]},
                                    {"splitting_events", built.cracking->n_events()},
                                    {"largest_overshoot", overshoot.largest},
                                    {"overshoot_by_dissipation", overshoot.by_dissipation}};
        if (const auto first = built.cracking->first_opening()) summary.groups["cracks"]["first_opening_s"] = *first;
    }
    if (built.touches != nullptr) {
        const Touches::Record& record = built.touches->record();
        auto& group = summary.groups["touches"];
        group = {{"touched", record.n_touched}, {"parted", record.n_parted}};
        if (record.first_touch) group["first_touch_s"] = *record.first_touch;
        if (record.last_parting) group["last_parting_s"] = *record.last_parting;
    }
    summary.groups["time"] = {{"t_s", now.state.t}, {"t_end_s", built.options.run.t_end}, {"last_dt_s", now.last_dt}};

    const double stepping = now.wall_time - now.setup_time;
    const auto steps = static_cast<double>(now.step - now.first_step);
    const auto elements = static_cast<double>(built.mesh->n_elements());
    summary.groups["timings"] = {{"setup_s", now.setup_time},
                                 {"steps_s", stepping},
                                 {"wall_s", now.wall_time},
                                 {"ns_per_element_step", steps > 0 ? 1e9 * stepping / (steps * elements) : 0.0}};

    const std::vector<CsvColumn> columns = history_columns();
    const std::vector<double> row = history_row(now.state.t, now.step, now.last_dt, now.energies);
    for (std::size_t k = 0; k < columns.size(); ++k)
        if (columns[k].unit == "J") summary.groups["energies_J"][columns[k].name] = row[k];
    summary.groups["energies_J"]["initial"] = now.energies.initial;
    summary.groups["balance_error"] = now.energies.balance_error();
    summary.groups["largest_balance_error"] = now.largest_balance_error;
    return summary;
}

}  // namespace gneiss
