#include "app/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/csv_table.hpp"
#include "model/formula.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

/// Root of the mean square of vectors at places.
/// @param at  a vector's component i at place p is at(n p + i)
double root_mean_square(const std::vector<double>& areas, std::size_t n, const std::function<double(std::size_t)>& at) {
    double sum = 0, area = 0;
    for (std::size_t p = 0; p < areas.size(); ++p) {
        double square = 0;
        for (std::size_t i = 0; i < n; ++i) square += at(n * p + i) * at(n * p + i);
        sum += areas[p] * square;
        area += areas[p];
    }
    return std::sqrt(sum / area);
}

/// The larger of two numbers; what is no number stays.
double larger(double a, double b) { return b <= a ? a : b; }

/// The largest difference and the largest value that it is measured against.
class Difference {
public:
    void take(const std::vector<double>& areas, std::size_t n, const std::vector<double>& given,
              const std::vector<double>& expected) {
        difference_ =
            std::max(difference_, root_mean_square(areas, n, [&](std::size_t i) { return given[i] - expected[i]; }));
        scale_ = larger(scale_, root_mean_square(areas, n, [&](std::size_t i) { return expected[i]; }));
    }
    std::optional<double> relative() const {
        if (difference_ == 0) return 0;
        if (scale_ == 0) return std::nullopt;
        return difference_ / scale_;
    }
    bool reference_is_zero() const { return scale_ == 0; }

private:
    double difference_ = 0, scale_ = 0;
};

/// @throws InputError if there is nothing to measure errors against
void need_motion(const Difference& displacement, const Difference& velocity) {
    if (displacement.reference_is_zero() && velocity.reference_is_zero())
        throw InputError("compare.reference",
                         "nothing moves in it at any of the samples: there is nothing to measure errors against");
}

/// Values of formulas at places.
template <std::size_t n>
std::vector<double> values_of(const std::array<Formula, n>& formulas, const std::vector<double>& places, double t) {
    std::vector<CompiledFormula> compiled;
    for (const Formula& formula : formulas) compiled.emplace_back(formula, "xyt");
    std::vector<double> values;
    for (std::size_t p = 0; p < places.size(); p += 2)
        for (const CompiledFormula& formula : compiled) values.push_back(formula(places[p], places[p + 1], t));
    return values;
}

std::string text_of(double value, bool rounded) {
    return rounded ? fmt::format("{:.3g}", value) : fmt::format("{}", value);
}

}  // namespace

ComparedRun read_run(const fs::path& folder) {
    ComparedRun run;
    run.folder = folder;
    const fs::path summary_file = folder / "summary.json";
    if (!fs::exists(summary_file)) {
        run.status = "refused";
        return run;
    }
    const auto summary = nlohmann::json::parse(read_file(summary_file));
    run.status = summary.at("status").get<std::string>();
    run.message = summary.value("message", "");
    run.warning = summary.value("balance_warning", "");
    const auto& work = summary.at("work");
    run.steps = work.at("steps");
    run.rejected = work.at("rejected");
    run.force_evaluations = work.at("force_evaluations");
    run.start_evaluations = work.at("start_evaluations");
    run.balance_evaluations = work.at("balance_evaluations");
    run.event_search_evaluations = work.at("event_search_evaluations");
    run.jacobians = work.at("jacobians");
    run.factorisations = work.at("factorisations");
    run.iterations = work.at("iterations");
    run.wall_time = summary.at("timings").at("steps_s");

    const CsvTable history = read_csv(folder / "history.csv");
    run.history = {history.column("t"), history.column("dt"), history.column("balance_error")};
    double largest = 0, left_over = 0;
    for (std::size_t k = 0; k < history.names.size(); ++k) {
        const bool is_entry =
            history.units[k] == "J" && history.names[k] != "left_over" && history.names[k] != "scheme";
        for (const double value : history.columns[k])
            if (is_entry) largest = larger(largest, std::abs(value));
    }
    for (const double value : history.column("left_over")) {
        run.energy_error = larger(run.energy_error, std::abs(value));
        left_over = value;
    }
    if (largest > 0) {
        run.energy_error /= largest;
        run.energy_drift = left_over / largest;
    }
    return run;
}

StateErrors errors_against(const SavedStates& states, const SavedStates& reference) {
    const auto mismatch = [](const std::string& what) {
        return InputError("states.h5", what + " as in the reference: the two cannot be compared");
    };
    if (states.samples.size() != reference.samples.size())
        throw mismatch(fmt::format("{} samples, not {}", states.samples.size(), reference.samples.size()));
    if (states.places.node_at != reference.places.node_at) throw mismatch("its places are not the same");
    Difference displacement, velocity, stress;
    const SamplePlaces& places = states.places;
    for (std::size_t k = 0; k < states.samples.size(); ++k) {
        const StateSample &given = states.samples[k], &expected = reference.samples[k];
        if (!(reached(given.t, expected.t) && reached(expected.t, given.t)))
            throw mismatch(fmt::format("sample {} at t = {} s, not at {} s", k, given.t, expected.t));
        displacement.take(places.node_area, 2, given.displacement, expected.displacement);
        velocity.take(places.node_area, 2, given.velocity, expected.velocity);
        stress.take(places.triangle_area, 3, given.stress, expected.stress);
    }
    need_motion(displacement, velocity);
    return {displacement.relative(), velocity.relative(), stress.relative()};
}

StateErrors errors_against(const SavedStates& states, const ExactOptions& exact) {
    Difference displacement, velocity, stress;
    const SamplePlaces& places = states.places;
    for (const StateSample& given : states.samples) {
        displacement.take(places.node_area, 2, given.displacement,
                          values_of(exact.displacement, places.node_at, given.t));
        velocity.take(places.node_area, 2, given.velocity, values_of(exact.velocity, places.node_at, given.t));
        if (exact.stress)
            stress.take(places.triangle_area, 3, given.stress, values_of(*exact.stress, places.triangle_at, given.t));
    }
    need_motion(displacement, velocity);
    return {displacement.relative(), velocity.relative(), exact.stress ? stress.relative() : std::nullopt};
}

std::vector<std::string> comparison_header() {
    return {"scheme",
            "setting",
            "error_displacement",
            "error_velocity",
            "error_stress",
            "reference_error",
            "energy_error",
            "energy_drift",
            "steps",
            "rejected",
            "force_evaluations",
            "start_evaluations",
            "balance_evaluations",
            "event_search_evaluations",
            "jacobians",
            "factorisations",
            "iterations",
            "cpu_time [s]",
            "stepping_time [s]",
            "memory [MB]",
            "status",
            "message"};
}

std::vector<std::string> comparison_row(const ComparedRun& run, bool rounded) {
    const auto number = [&](double value) { return text_of(value, rounded); };
    const auto error = [&](const std::optional<StateErrors>& errors,
                           std::optional<double> StateErrors::*of) -> std::string {
        return errors && (*errors).*of ? number(*((*errors).*of)) : "";
    };
    return {run.scheme,
            run.setting,
            error(run.errors, &StateErrors::displacement),
            error(run.errors, &StateErrors::velocity),
            error(run.errors, &StateErrors::stress),
            error(run.reference_error, &StateErrors::displacement),
            number(run.energy_error),
            number(run.energy_drift),
            fmt::format("{}", run.steps),
            fmt::format("{}", run.rejected),
            fmt::format("{}", run.force_evaluations),
            fmt::format("{}", run.start_evaluations),
            fmt::format("{}", run.balance_evaluations),
            fmt::format("{}", run.event_search_evaluations),
            fmt::format("{}", run.jacobians),
            fmt::format("{}", run.factorisations),
            fmt::format("{}", run.iterations),
            number(run.cost.cpu_time),
            number(run.wall_time),
            number(1e-6 * run.cost.peak_memory),
            run.status,
            run.message.empty() ? run.warning : run.message};
}

}  // namespace gneiss
