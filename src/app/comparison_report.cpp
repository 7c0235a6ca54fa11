#include "app/comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "io/report/html_page.hpp"
#include "io/report/svg_chart.hpp"

namespace gneiss {
namespace {

using Number = std::function<double(const ComparedRun&)>;

/// One line per scheme: error against cost, from setting to setting as the deck has them.
std::vector<ChartSeries> work_and_precision(const std::vector<ComparedRun>& runs, const Number& cost,
                                            const Number& error) {
    std::vector<ChartSeries> all;
    for (const ComparedRun& run : runs) {
        if (!run.errors || run.errors->displacement.value_or(0) == 0) continue;  // the reference itself
        auto found = std::ranges::find(all, run.scheme, &ChartSeries::name);
        if (found == all.end()) found = all.insert(all.end(), {run.scheme, {}, {}});
        found->x.push_back(cost(run));
        found->y.push_back(error(run));
    }
    return all;
}

/// One line per run against time, thinned out where there are many rows.
std::vector<ChartSeries> histories(const std::vector<ComparedRun>& runs, const std::vector<double> RunHistory::*what) {
    constexpr std::size_t most = 400;
    std::vector<ChartSeries> all;
    for (const ComparedRun& run : runs) {
        const std::vector<double>& values = run.history.*what;
        if (values.size() < 2) continue;
        ChartSeries series{run.title(), {}, {}, false};
        const std::size_t every = std::max<std::size_t>(1, values.size() / most);
        for (std::size_t k = 1; k < values.size(); k += every) {  // the first row is before any step
            series.x.push_back(run.history.t[k]);
            series.y.push_back(values[k]);
        }
        all.push_back(std::move(series));
    }
    return all;
}

}  // namespace

std::string comparison_report(const std::string& title, const std::string& reference, const std::string& worth,
                              const std::vector<ComparedRun>& runs) {
    HtmlPage page(title.empty() ? "Comparison of schemes" : title);
    page.paragraph(fmt::format(
        "Errors are relative to {} An error is the largest difference of the states that were compared, over "
        "the largest value, both "
        "in the root mean square over the area. Processor time is that of the whole process, all threads, "
        "output included. Force evaluations are those of the scheme itself; those in the states that starts begin "
        "from, for the energy balance and reactions, and of steps that a search for an event threw away "
        "stand in columns of their own.",
        reference));
    if (!worth.empty()) page.paragraph(worth);
    page.heading("Runs");
    std::vector<std::vector<std::string>> rows;
    for (const ComparedRun& run : runs) rows.push_back(comparison_row(run, true));
    page.table(comparison_header(), rows);
    if (std::ranges::any_of(runs, [](const ComparedRun& run) { return !run.warning.empty(); })) {
        page.heading("Not to be trusted");
        for (const ComparedRun& run : runs)
            if (!run.warning.empty()) page.paragraph(fmt::format("{}: {}.", run.title(), run.warning));
    }

    page.heading("Work and precision");
    const Number of_time = [](const ComparedRun& run) { return run.cost.cpu_time; };
    // of the scheme alone: what the balance takes beside it is no part of a method
    const Number of_forces = [](const ComparedRun& run) { return static_cast<double>(run.force_evaluations); };
    const auto chart = [&](const char* what, const Number& cost, const char* label, const Number& error) {
        page.figure(svg_chart(fmt::format("Error of {} against {}", what, label), {label, true},
                              {"relative error", true}, work_and_precision(runs, cost, error)),
                    fmt::format("Error of {} against {}: further down and to the left is better.", what, label));
    };
    const Number displacement = [](const ComparedRun& run) { return run.errors->displacement.value_or(0); };
    const Number stress = [](const ComparedRun& run) { return run.errors->stress.value_or(0); };
    chart("displacement", of_time, "processor time, s", displacement);
    chart("displacement", of_forces, "force evaluations of the scheme", displacement);
    chart("stress", of_time, "processor time, s", stress);

    page.heading("Histories");
    page.figure(svg_chart("Energy balance error", {"t, s"}, {"balance error", true},
                          histories(runs, &RunHistory::balance_error)),
                "Energy left over in the balance, over its largest entry so far.");
    page.figure(svg_chart("Step size", {"t, s"}, {"step, s", true}, histories(runs, &RunHistory::dt)),
                "Steps as they were accepted.");
    return page.text();
}

}  // namespace gneiss
