#pragma once
// What a comparison of schemes finds out about each run: how far it is from the reference, what it cost.

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/state_series.hpp"
#include "io/output/summary.hpp"
#include "model/options.hpp"

namespace gneiss {

/// How far states are from others, relative: the largest difference at any of the times, over the largest value that
/// the reference has at any of them, both in the root mean square over the area of the solid.
struct StateErrors {
    std::optional<double> displacement, velocity;  ///< none where the reference has none and the states have
    std::optional<double> stress;                  ///< none where the reference has no stresses, too
};

/// What a run cost the processor.
struct RunCost {
    double cpu_time = 0;     ///< user and system, all threads, start and output included, s
    double peak_memory = 0;  ///< bytes
};

/// A number of a run against time.
struct RunHistory {
    std::vector<double> t, dt, balance_error;  ///< s, s, 1
};

/// "cvode bdf, rtol = 1e-06".
inline std::string run_title(const std::string& scheme, const std::string& setting) {
    return setting.empty() ? scheme : fmt::format("{}, {}", scheme, setting);
}

struct ComparedRun {
    std::string scheme, setting;
    std::filesystem::path folder;
    std::string status;   ///< of summary.json; "refused" if there was nothing to begin with
    std::string message;  ///< why it failed
    std::string warning;  ///< of its energy balance; empty: none
    RunCost cost;
    std::optional<StateErrors> errors;           ///< none if it did not come to its end
    std::optional<StateErrors> reference_error;  ///< what the reference is worth: how far it is from its own check
    double energy_error = 0;  ///< largest energy left over, over the largest entry that the ledger ever had
    double energy_drift = 0;  ///< the same of what is left over at the end, signed
    std::size_t steps = 0, rejected = 0, jacobians = 0, factorisations = 0, iterations = 0;
    std::size_t force_evaluations = 0;  ///< of the scheme itself; those beside them:
    std::size_t start_evaluations = 0, balance_evaluations = 0, event_search_evaluations = 0;
    double wall_time = 0;  ///< of stepping, s
    RunHistory history;

    bool done() const { return status == name_of(RunStatus::done); }
    std::string title() const { return run_title(scheme, setting); }
};

/// Reads what a run has left in its folder; without errors.
ComparedRun read_run(const std::filesystem::path& folder);

/// @throws InputError if the samples are of other times or places, or the reference has not moved at all
StateErrors errors_against(const SavedStates& states, const SavedStates& reference);
StateErrors errors_against(const SavedStates& states, const ExactOptions& exact);

/// The table of a comparison: a header, and a row of texts for each run. Numbers are the shortest that read back alike,
/// or rounded to three digits for people.
std::vector<std::string> comparison_header();
std::vector<std::string> comparison_row(const ComparedRun& run, bool rounded);

}  // namespace gneiss
