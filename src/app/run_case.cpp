#include "app/run_case.hpp"

#include <omp.h>

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "app/build_case.hpp"
#include "app/checkpoints.hpp"
#include "app/field_frames.hpp"
#include "app/tables.hpp"
#include "base/errors.hpp"
#include "base/flush_denormals.hpp"
#include "io/deck/deck.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/fingerprint.hpp"
#include "io/output/progress.hpp"
#include "io/output/run_log.hpp"
#include "io/output/stop_request.hpp"
#include "io/output/summary.hpp"
#include "io/output/version.hpp"
#include "mesh/measure.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

/// Number of the interval that t lies in, so that a row is due where it grows. A time that should be a multiple of the
/// interval counts as one despite round-off.
double interval_number(double t, double interval) {
    constexpr double round_off = 1e-9;
    return std::floor(t / interval + round_off);
}

/// The next multiple of an interval after t; infinite if there is no interval.
double next_multiple(double t, double interval) {
    return interval > 0 ? (interval_number(t, interval) + 1) * interval : std::numeric_limits<double>::infinity();
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A run under way: what it computes, and what it writes.
class Run {
public:
    explicit Run(const RunArguments& arguments);
    int march();

private:
    EnergyLedger ledger() const;
    double next_stop(double t) const;
    bool after_step(const StepReport& step);
    void write_rows(double dt);
    void write_frame() { frames_->write(*case_.system, state_, progress_.step); }
    void write_checkpoint() { save_checkpoint(out_ / "checkpoint.h5", fingerprint_, case_, state_, progress_); }
    void write_summary_file(RunStatus status, const std::string& message);
    ProgressState progress_state() const;

    RunArguments arguments_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
    double setup_time_ = 0;  ///< wall, s
    Case case_;
    std::filesystem::path out_;
    std::string fingerprint_;
    std::shared_ptr<spdlog::logger> log_;
    State state_;
    RunProgress progress_;
    std::size_t first_step_ = 0;  ///< of this part of the run
    double last_dt_ = 0, balance_error_ = 0;
    double history_interval_ = 0;
    bool resumed_ = false;

    std::optional<ProbeTable> probes_;
    std::optional<CsvSeries> history_file_, probes_file_;
    std::optional<FieldFrames> frames_;
    std::optional<Progress> bar_;
    StopRequest stop_request_;
};

std::string deck_text(const RunArguments& arguments) {
    std::string text = read_file(arguments.deck);
    for (const std::string& set : arguments.set) text += "\n--set " + set;
    return text;
}

Run::Run(const RunArguments& arguments) : arguments_(arguments) {
    if (arguments.threads > 0) omp_set_num_threads(arguments.threads);
    flush_denormals();
    CaseOptions options = read_deck(arguments.deck, arguments.set);
    fingerprint_ = fingerprint_text(deck_text(arguments));
    case_ = build_case(std::move(options));
    probes_.emplace(case_.mesh, case_.options.output.probes);
    history_interval_ = case_.options.output.history > 0 ? case_.options.output.history : case_.options.run.t_end / 1000;
    state_ = case_.system->initial_state();

    std::string other_deck;
    if (arguments.restart) {
        other_deck = load_checkpoint(*arguments.restart, case_, state_, progress_);
        if (other_deck == fingerprint_) other_deck.clear();
        resumed_ = true;
        if (!(state_.t < case_.options.run.t_end))
            throw InputError(arguments.restart->string(), fmt::format("stands at t = {:.9g} s, the deck ends at {:.9g} s: "
                             "nothing is left to run", state_.t, case_.options.run.t_end));
    }

    out_ = arguments.out.empty() ? std::filesystem::path("results") / arguments.deck.stem() : arguments.out;
    make_folder(out_);
    log_ = open_run_log({out_ / "run.log", resumed_, arguments.quiet, false});
    log_->info("gneiss {}: {}, {} threads", version_string(), arguments.deck.string(), omp_get_max_threads());
    const MeshSize size = mesh_size(case_.mesh);
    log_->info("mesh: {} elements, {} nodes, edges {:.4g} to {:.4g} m", size.n_elements, size.n_nodes, size.smallest_edge,
               size.largest_edge);
    for (const std::string& warning : case_.warnings) log_->warn("mesh: {}", warning);
    if (!other_deck.empty()) log_->warn("restart: the checkpoint was written under another deck ({})", other_deck);

    const std::optional<double> restart_time = resumed_ ? std::optional(state_.t) : std::nullopt;
    history_file_.emplace(out_ / "history.csv", history_columns(), restart_time);
    if (!probes_->empty()) probes_file_.emplace(out_ / "probes.csv", probes_->columns(), restart_time);
    frames_.emplace(out_, case_.mesh, restart_time);
    bar_.emplace(ProgressOptions{.quiet = arguments.quiet, .t_start = state_.t});
    first_step_ = progress_.step;
    setup_time_ = seconds_since(started_);
}

EnergyLedger Run::ledger() const {
    EnergyLedger ledger;
    ledger.kinetic = case_.integrator->kinetic_energy(*case_.system, state_);
    ledger.stored = case_.system->stored_energies(state_);
    ledger.path = state_.path;
    ledger.initial = progress_.initial_energy;
    return ledger;
}

double Run::next_stop(double t) const {
    double stop = std::min(next_multiple(t, case_.options.output.fields), next_multiple(t, case_.options.run.checkpoint));
    for (const double time : case_.options.output.field_times)
        if (time > t) stop = std::min(stop, time);
    return stop;
}

void Run::write_rows(double dt) {
    const EnergyLedger energies = ledger();
    balance_error_ = energies.balance_error();
    history_file_->row(history_row(state_.t, progress_.step, dt, energies));
    if (probes_file_) probes_file_->row(probes_->row(*case_.system, state_));
}

bool Run::after_step(const StepReport& step) {
    ++progress_.step;
    last_dt_ = step.dt;
    const double before = step.t - step.dt;
    const auto passed = [&](double interval) {
        return interval > 0 && interval_number(step.t, interval) > interval_number(before, interval);
    };
    const auto& output = case_.options.output;
    const bool last = !(step.t < case_.options.run.t_end);
    if (passed(history_interval_) || last) write_rows(step.dt);
    const bool named_time = std::find(output.field_times.begin(), output.field_times.end(), step.t) != output.field_times.end();
    if (passed(output.fields) || named_time || last) write_frame();
    if (passed(case_.options.run.checkpoint)) write_checkpoint();
    history_file_->flush_if_due();
    if (probes_file_) probes_file_->flush_if_due();
    bar_->update([&] { return progress_state(); });
    return !stop_request_.requested();
}

ProgressState Run::progress_state() const {
    return {state_.t, case_.options.run.t_end, static_cast<std::int64_t>(progress_.step), last_dt_, balance_error_, {}};
}

void Run::write_summary_file(RunStatus status, const std::string& message) {
    const EnergyLedger energies = ledger();
    const double wall = seconds_since(started_), stepping = wall - setup_time_;
    const auto steps = static_cast<double>(progress_.step - first_step_);
    const auto elements = static_cast<double>(case_.mesh.n_elements());
    RunSummary summary{status, message, case_.options.title, fingerprint_};
    summary.groups["counts"] = {{"elements", case_.mesh.n_elements()},
                                {"nodes", case_.mesh.n_nodes()},
                                {"steps", progress_.step},
                                {"threads", omp_get_max_threads()}};
    summary.groups["time"] = {{"t_s", state_.t}, {"t_end_s", case_.options.run.t_end}, {"last_dt_s", last_dt_}};
    summary.groups["timings"] = {{"setup_s", setup_time_}, {"steps_s", stepping}, {"wall_s", wall},
                                 {"ns_per_element_step", steps > 0 ? 1e9 * stepping / (steps * elements) : 0.0}};
    const auto columns = history_columns();
    const std::vector<double> row = history_row(state_.t, progress_.step, last_dt_, energies);
    for (std::size_t k = 3; k < columns.size(); ++k)
        if (!columns[k].unit.empty()) summary.groups["energies_J"][columns[k].name] = row[k];
    summary.groups["energies_J"]["initial"] = energies.initial;
    summary.groups["balance_error"] = energies.balance_error();
    write_summary(out_ / "summary.json", summary);
}

int Run::march() {
    const auto end = [&](RunStatus status, const std::string& message, int code) {
        history_file_->close();
        if (probes_file_) probes_file_->close();
        write_checkpoint();
        write_summary_file(status, message);
        bar_->finish(status == RunStatus::done ? "done" : status == RunStatus::failed ? "failed" : "stopped", progress_state());
        log_->info("{}: step = {}, t = {:.9g}, balance_error = {:.3g}", name_of(status), progress_.step, state_.t,
                   ledger().balance_error());
        return code;
    };
    March march;
    march.t_end = case_.options.run.t_end;
    march.next_stop = [this](double t) { return next_stop(t); };
    march.after_start = [this] {
        if (!resumed_) {
            const EnergyLedger at_start = ledger();
            progress_.initial_energy = at_start.kinetic + at_start.stored.sum();
            write_rows(0);
            write_frame();
        }
        log_->info("start: t = {:.9g}, t_end = {:.9g}", state_.t, case_.options.run.t_end);
    };
    march.after_step = [this](const StepReport& step) { return after_step(step); };
    try {
        if (march.run(*case_.system, *case_.integrator, state_, resumed_) == MarchOutcome::interrupted)
            return end(RunStatus::interrupted, "stopped by a signal; go on with --restart", stop_request_.exit_code());
    } catch (const RecoverableError& error) {
        log_->error("{}", error.what());
        write_frame();
        return end(RunStatus::failed, error.what(), exit_code::failed);
    }
    return end(RunStatus::done, "", exit_code::done);
}

}  // namespace

int run_case(const RunArguments& arguments) { return Run(arguments).march(); }

}  // namespace gneiss
