#include "app/run_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/balance_watch.hpp"
#include "app/build_case.hpp"
#include "app/checkpoints.hpp"
#include "app/crack_frames.hpp"
#include "app/field_frames.hpp"
#include "app/finished_run.hpp"
#include "app/make_integrator.hpp"
#include "app/plausibility.hpp"
#include "app/run_summary.hpp"
#include "app/schedule.hpp"
#include "app/state_series.hpp"
#include "app/tables.hpp"
#include "app/threads.hpp"
#include "base/errors.hpp"
#include "integrators/mass_and_damping.hpp"
#include "io/deck/deck.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/checkpoint.hpp"
#include "io/output/fingerprint.hpp"
#include "io/output/folder_lock.hpp"
#include "io/output/progress.hpp"
#include "io/output/run_log.hpp"
#include "io/output/stop_request.hpp"
#include "io/output/version.hpp"
#include "mesh/measure.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The deck as it is run: its text, then the overrides as comments.
std::string deck_text(const RunArguments& arguments) {
    std::string text = read_file(arguments.deck);
    if (!arguments.set.empty() && !text.ends_with('\n')) text += '\n';
    for (const std::string& set : arguments.set) text += "# --set " + set + '\n';
    return text;
}

/// A checkpoint.
struct SavedState {
    double t;  ///< s
    fs::path file;
};

/// A run under way: what it computes, and what it writes.
class Run {
public:
    explicit Run(const RunArguments& arguments);
    int march();

private:
    void take_folder();
    void load_restart();
    void find_last_sound();
    void open_results();
    EnergyLedger ledger(const State& state) const;
    /// Of the supports in state_, N; none where nobody asks for them.
    std::span<const double> reactions() {
        if (!reactions_file_) return {};
        return case_.integrator->reactions(*case_.system, state_);
    }
    /// @param step  number of the step that the state belongs to
    void write_rows(const State& state, std::size_t step, double dt, std::span<const double> reactions);
    void judge_balance(double t, const EnergyLedger& energies);
    void begin();
    void rows_within(const StepReport& step);
    void warn(const std::string& warning);
    bool after_step(const StepReport& step);
    bool within_step(const StepProgress& progress);
    template <class Body>
    void for_each_table(Body body) {
        for (auto* table : {&history_file_, &probes_file_, &reactions_file_, &steps_file_})
            if (*table) body(**table);
    }
    void write_frame() {
        frames_->write(*case_.system, state_, progress_.step);
        if (cracks_) cracks_->write(state_, progress_.step);
    }
    fs::path checkpoint_file() const { return out_ / "checkpoint.h5"; }
    fs::path last_sound_file() const { return out_ / "last_sound.h5"; }
    bool balance_is_sound() const {
        return !std::isfinite(progress_.balance.doubtful_since) && !std::isfinite(progress_.balance.gaining_since);
    }
    void keep_last_sound();
    void write_checkpoint();
    void write_summary_file(RunStatus status, const std::string& message = "");
    int end(RunStatus status, const std::string& message, int code);
    int end_unbalanced();
    int end_failed(const std::exception& error);
    int end_out_of_memory();
    ProgressState progress_state() const;

    RunArguments arguments_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
    double setup_time_ = 0;  ///< wall, s
    StopRequest stop_request_;
    std::string deck_text_;
    Case case_;
    fs::path out_;
    std::optional<FolderLock> lock_;  ///< on it
    std::string fingerprint_;
    std::shared_ptr<spdlog::logger> log_;
    std::vector<std::string> warnings_;  ///< given so far, each once, those of the balance apart
    Plausibility looked_;
    State state_;
    RunProgress progress_;
    std::size_t first_step_ = 0;  ///< of this part of the run
    std::size_t n_rejected_ = 0, n_force_ = 0, n_force_searching_ = 0;
    double last_dt_ = 0, balance_error_ = 0;
    double t_looked_at_ = 0;  ///< where the last step ended, s
    State within_;            ///< of rows within a step
    std::vector<double> reactions_within_;
    bool integrator_stands_ = true;         ///< its memory belongs to state_
    bool unbalanced_ = false;               ///< more energy has come from nothing than run.most_energy_gained lets pass
    std::optional<SavedState> last_sound_;  ///< the last checkpoint with a sound balance
    std::string balance_warning_;           ///< the last one of the balance; empty: there is none
    bool resumed_ = false, begun_ = false;
    std::string other_deck_;  ///< fingerprint of the deck that the restart's checkpoint is from, if it is another

    std::optional<Schedule> schedule_;
    std::optional<BalanceWatch> balance_watch_;
    std::optional<CsvSeries> history_file_, probes_file_, reactions_file_, steps_file_;
    std::optional<FieldFrames> frames_;
    std::optional<CrackFrames> cracks_;
    std::optional<StateSeries> states_;
    std::optional<Progress> bar_;
};

Run::Run(const RunArguments& arguments) : arguments_(arguments) {
    const std::string too_many_threads = use_threads(arguments.threads);
    DeckNotes notes;
    CaseOptions options = read_deck(arguments.deck, arguments.set, &notes);
    deck_text_ = deck_text(arguments);
    fingerprint_ = fingerprint_text(deck_text_);
    out_ = arguments_.out.empty() ? fs::path("results") / arguments_.deck.stem() : arguments_.out;
    if (fs::exists(out_)) take_folder();  // before minutes go into a mesh
    case_ = build_case(std::move(options));
    case_.warnings.insert(case_.warnings.begin(), notes.on_case.begin(), notes.on_case.end());
    check_linear_solver(case_.options.integrator, *case_.system);
    looked_ = plausibility(case_, out_);
    schedule_.emplace(case_.options, case_.integrator->interpolates());
    balance_watch_.emplace(case_.options, case_.integrator->is_static());
    state_ = case_.system->initial_state();
    if (arguments.restart)
        load_restart();
    else
        progress_.balance.largest_entry = least_energy(*case_.system, state_, largest_coordinate(*case_.mesh));
    open_results();
    if (!too_many_threads.empty()) warn(too_many_threads);
    first_step_ = progress_.step;
    bar_.emplace(ProgressOptions{.quiet = arguments.quiet, .t_start = state_.t});
    setup_time_ = seconds_since(started_);
}

void Run::load_restart() {
    const fs::path& file = *arguments_.restart;
    other_deck_ = load_checkpoint(file, case_, state_, progress_);
    if (other_deck_ == fingerprint_) other_deck_.clear();
    resumed_ = true;
    find_last_sound();
    const double t_end = case_.options.run.t_end;
    if (!(state_.t < t_end))
        throw InputError(file.string(),
                         fmt::format("stands at t = {:.9g} s, the deck ends at {:.9g} s: nothing is left "
                                     "to run",
                                     state_.t, t_end));
}

/// Where this part of the run goes astray, the last sound state is one that an earlier part has left.
void Run::find_last_sound() {
    const fs::path& file = *arguments_.restart;
    std::error_code none;
    const bool is_last = fs::equivalent(file, checkpoint_file(), none);
    if (balance_is_sound())
        last_sound_ = {state_.t, is_last ? checkpoint_file() : file};
    else if (is_last && fs::exists(last_sound_file()))
        last_sound_ = {Checkpoint::load(last_sound_file()).get<double>("state.t"), last_sound_file()};
}

void Run::take_folder() {
    make_folder(out_);
    lock_.emplace(out_, "gneiss run " + fs::absolute(arguments_.deck).string());
    if (arguments_.overwrite) return;
    std::vector<std::string> own{fingerprint_};
    if (arguments_.restart) own.push_back(Checkpoint::load(*arguments_.restart).deck_fingerprint());
    keep_finished_run(out_, own);
}

void Run::open_results() {
    if (!lock_) take_folder();
    // What an earlier run has left would pass for a result of this one.
    if (!resumed_)
        for (const char* name : {"checkpoint.h5", "last_sound.h5", "probes.csv", "reactions.csv", "load_steps.csv",
                                 "states.h5", "summary.json"})
            fs::remove(out_ / name);
    log_ = open_run_log({out_ / "run.log", resumed_, arguments_.quiet, false});
    log_->info("gneiss {}: {}, {}", version_string(), fs::absolute(arguments_.deck).string(), threads_text());
    for (const std::string& set : arguments_.set) log_->info("set: {}", set);
    const MeshSize size = mesh_size(*case_.mesh);
    log_->info("mesh: {} elements, {} nodes, edges {:.4g} to {:.4g} m", size.n_elements, size.n_nodes,
               size.smallest_edge, size.largest_edge);
    for (const auto& [name, value] : looked_.facts) log_->info("{}: {}", name, value);
    for (const std::string& warning : case_.warnings) warn(warning);
    for (const std::string& warning : looked_.warnings) warn(warning);
    if (resumed_) log_->info("restart: {}, t = {:.9g}", arguments_.restart->string(), state_.t);
    if (!other_deck_.empty())
        warn(fmt::format("restart: the checkpoint was written under another deck ({})", other_deck_));

    write_atomically(out_ / "deck.toml", deck_text_);
    const std::optional<double> restart_time = resumed_ ? std::optional(state_.t) : std::nullopt;
    std::vector<CsvColumn> columns = history_columns(case_.cracking != nullptr);
    add_model_columns(*case_.system, columns);
    history_file_.emplace(out_ / "history.csv", columns, restart_time);
    if (!case_.probes.empty()) probes_file_.emplace(out_ / "probes.csv", case_.probes.columns(), restart_time);
    if (!case_.reactions.empty())
        reactions_file_.emplace(out_ / "reactions.csv", case_.reactions.columns(), restart_time);
    if (!case_.integrator->step_columns().empty())
        steps_file_.emplace(out_ / "load_steps.csv", step_columns(*case_.integrator), restart_time);
    const VtuData data = case_.options.output.base64 ? VtuData::base64 : VtuData::raw;
    frames_.emplace(out_, *case_.mesh, restart_time, data);
    if (case_.cracking != nullptr) cracks_.emplace(out_, *case_.cracking, restart_time, data);
    if (case_.options.output.states > 0) states_.emplace(out_ / "states.h5", *case_.mesh, restart_time);
}

EnergyLedger Run::ledger(const State& state) const {
    EnergyLedger ledger;
    if (!case_.integrator->is_static()) {
        std::vector<double> partial;
        ledger.kinetic = synchronised_kinetic_energy(*case_.system, state.v, partial);
        if (integrator_stands_) ledger.scheme = case_.integrator->kinetic_energy(*case_.system, state) - ledger.kinetic;
    }
    ledger.stored = case_.system->stored_energies(state);
    ledger.path = state.path;
    ledger.initial = progress_.initial_energy;
    ledger.largest_before = progress_.balance.largest_entry;
    return ledger;
}

void Run::begin() {
    begun_ = true;
    t_looked_at_ = state_.t;
    if (!resumed_) {
        const EnergyLedger at_start = ledger(state_);
        progress_.initial_energy = at_start.kinetic + at_start.stored.sum();
        write_rows(state_, progress_.step, 0, reactions());
        write_frame();
    }
    log_->info("start: t = {:.9g}, t_end = {:.9g}", state_.t, case_.options.run.t_end);
    write_summary_file(RunStatus::running);
}

void Run::write_rows(const State& state, std::size_t step, double dt, std::span<const double> reactions) {
    const EnergyLedger energies = ledger(state);
    judge_balance(state.t, energies);
    // a step that ends where a row is due does so but for round-off
    const double t = schedule_->row_time(state.t);
    const auto at_time = [t](std::vector<double> row) {
        row.front() = t;
        return row;
    };
    std::vector<double> row = history_row(t, step, dt, energies);
    if (case_.cracking != nullptr) add_crack_columns(*case_.cracking, state, row);
    add_model_columns(*case_.system, state, row);
    history_file_->row(row);
    if (probes_file_) probes_file_->row(at_time(case_.probes.row(*case_.system, state)));
    if (reactions_file_ && case_.reactions.n_constraints() != case_.system->constraints().size())
        case_.reactions = ReactionTable(*case_.mesh, case_.options.boundaries, case_.system->constraints());
    if (reactions_file_) reactions_file_->row(case_.reactions.row(t, reactions));
}

void Run::judge_balance(double t, const EnergyLedger& energies) {
    BalanceRecord& record = progress_.balance;
    balance_watch_->look(t, energies, record);
    balance_error_ = energies.balance_error();
    if (balance_warning_.empty() && balance_watch_->to_be_warned_of(t, record)) {
        balance_warning_ = balance_watch_->text(t, record);
        log_->warn("{}", balance_warning_);
    }
    unbalanced_ = unbalanced_ || balance_watch_->to_be_ended(t, record);
}

void Run::rows_within(const StepReport& step) {
    for (const double t : schedule_->rows_between(t_looked_at_, step.t)) {
        if (unbalanced_) return;
        case_.integrator->state_within(*case_.system, t, within_, reactions_within_);
        write_rows(within_, progress_.step + step.n_steps, step.dt, reactions_within_);
    }
}

/// The next checkpoint does not replace it.
void Run::keep_last_sound() {
    if (!last_sound_ || last_sound_->file != checkpoint_file()) return;
    fs::rename(checkpoint_file(), last_sound_file());
    last_sound_->file = last_sound_file();
}

void Run::write_checkpoint() {
    // A checkpoint must not be ahead of the tables: after a crash, a restart could not bring the missing rows back.
    for_each_table([](CsvSeries& table) { table.flush(); });
    if (cracks_) cracks_->flush();
    if (states_) states_->save();
    const fs::path file = checkpoint_file();
    if (!balance_is_sound()) keep_last_sound();
    save_checkpoint(file, fingerprint_, case_, state_, progress_);
    if (balance_is_sound()) last_sound_ = {state_.t, file};
}

/// The one way of a warning: to stderr, run.log and, once, summary.json.
void Run::warn(const std::string& warning) {
    log_->warn("{}", warning);
    if (std::ranges::find(warnings_, warning) == warnings_.end()) warnings_.push_back(warning);
}

bool Run::after_step(const StepReport& step) {
    if (progress_.step == first_step_) log_->info("step: t = {:.9g}, dt = {:.6g}", step.t, step.dt);
    progress_.step += step.n_steps;
    n_rejected_ += step.n_rejected;
    n_force_ += step.n_force;
    n_force_searching_ += step.n_force_searching;
    last_dt_ = step.dt;
    t_looked_at_ = step.t;
    if (!step.warning.empty()) warn(step.warning);
    if (steps_file_) steps_file_->row(step_row(step), {step.rejected});
    if (schedule_->row_due(step) && !unbalanced_) write_rows(state_, progress_.step, step.dt, reactions());
    if (unbalanced_) return false;
    if (schedule_->frame_due(step)) write_frame();
    if (states_ && schedule_->state_due(step)) states_->add(*case_.system, state_);
    if (schedule_->checkpoint_due(step)) {
        if (renew_events(*case_.system, state_) == EventOutcome::resize)
            case_.integrator->start(*case_.system, state_, StartReason::resize);
        write_checkpoint();
        case_.integrator->forget(*case_.system, state_);
        log_->info("checkpoint: step = {}, t = {:.9g}", progress_.step, step.t);
    }
    for_each_table([](CsvSeries& table) { table.flush_if_due(); });
    bar_->update([&] { return progress_state(); });
    return !stop_request_.requested();
}

bool Run::within_step(const StepProgress& progress) {
    bar_->update([&] {
        ProgressState shown = progress_state();
        shown.within = fmt::format("iteration {}: {:.1e} out of balance", progress.iteration, progress.unbalanced);
        return shown;
    });
    return !stop_request_.requested();
}

ProgressState Run::progress_state() const {
    return {state_.t, case_.options.run.t_end, static_cast<std::int64_t>(progress_.step), last_dt_, balance_error_, {},
            {}};
}

void Run::write_summary_file(RunStatus status, const std::string& message) {
    RunSummary summary = summarise(
        case_, fs::absolute(arguments_.deck).string(), arguments_.set,
        {state_, last_dt_, progress_.step, first_step_, n_rejected_, n_force_, n_force_searching_, setup_time_,
         seconds_since(started_), ledger(state_), BalanceWatch::largest_error(progress_.balance)});
    summary.status = status;
    summary.message = message;
    summary.balance_warning = balance_warning_;
    summary.warnings = warnings_;
    if (!balance_warning_.empty()) summary.warnings.insert(summary.warnings.begin(), balance_warning_);
    summary.deck_fingerprint = fingerprint_;
    write_summary(out_ / "summary.json", summary);
}

int Run::end(RunStatus status, const std::string& message, int code) {
    for_each_table([](CsvSeries& table) { table.close(); });
    if (begun_) write_checkpoint();
    if (BalanceWatch::largest_error(progress_.balance) >= BalanceWatch::doubtful) {
        const std::string warning = balance_watch_->text(state_.t, progress_.balance);
        if (balance_warning_.empty()) log_->warn("{}", warning);
        balance_warning_ = warning;
    }
    write_summary_file(status, message);
    balance_error_ = ledger(state_).balance_error();
    const char* word = status == RunStatus::done ? "done" : status == RunStatus::failed ? "failed" : "stopped";
    bar_->finish(word, progress_state());
    if (!arguments_.quiet) fmt::print(stderr, "results: {}\n", out_.string());
    log_->info("{}: step = {}, t = {:.9g}, balance_error = {:.3g}, wall time = {:.3g} s", name_of(status),
               progress_.step, state_.t, balance_error_, seconds_since(started_));
    if (status == RunStatus::interrupted) log_->warn("{}", message);
    return code;
}

int Run::end_unbalanced() {
    const double t = state_.t;
    std::string message = balance_watch_->text(t, progress_.balance);
    message += fmt::format("; `run.most_energy_gained` = {} ends the run; ", case_.options.run.most_energy_gained);
    keep_last_sound();
    const std::string now = checkpoint_file().string();
    message += last_sound_ ? fmt::format("the last state with a sound balance, t = {:.9g} s, is in {}, this one in {}",
                                         last_sound_->t, last_sound_->file.string(), now)
                           : fmt::format("no sound state was saved (`run.checkpoint`), this one is in {}", now);
    log_->error("{}", message);
    balance_warning_ = balance_watch_->text(t, progress_.balance);
    write_frame();
    return end(RunStatus::failed, message, exit_code::failed);
}

int Run::end_failed(const std::exception& error) {
    std::string message = error.what();
    if (!looked_.overload.empty()) message += "; likely cause: " + looked_.overload;
    if (begun_)
        message += fmt::format("; the last good state, t = {:.9g} s, is in {}", state_.t, checkpoint_file().string());
    log_->error("{}", message);
    if (begun_) {
        // The failed step has left the integrator between two states: let it start from the last good one, so that the
        // energies and the checkpoint are those of this state.
        try {
            case_.integrator->start(*case_.system, state_, StartReason::recover);
        } catch (const std::exception& again) {
            log_->error("{}", again.what());
            integrator_stands_ = false;
        }
        if (history_file_->last_time() != schedule_->row_time(state_.t))
            write_rows(state_, progress_.step, last_dt_, reactions());
    }
    write_frame();
    return end(RunStatus::failed, message, exit_code::failed);
}

int Run::end_out_of_memory() {
    if (!begun_) {
        const std::string message = "out of memory before the first step: take a smaller mesh, or another solver";
        log_->error("{}", message);
        write_summary_file(RunStatus::failed, message);
        return exit_code::failed;
    }
    const double matrices = case_.integrator->matrix_bytes();
    return end_failed(RecoverableError(
        "out of memory" +
        (matrices > 0 ? fmt::format(": matrices and their factors need some {:.0f} MB", 1e-6 * matrices) : "")));
}

int Run::march() {
    March march;
    march.t_end = case_.options.run.t_end;
    march.event_tolerance = case_.options.run.event_tolerance;
    march.next_stop = [this](double t) { return schedule_->next_stop(t); };
    march.next_look = [this](double t) { return schedule_->next_look(t); };
    march.after_start = [this] { begin(); };
    if (case_.integrator->interpolates()) march.before_events = [this](const StepReport& step) { rows_within(step); };
    march.after_step = [this](const StepReport& step) { return after_step(step); };
    march.within_step = [this](const StepProgress& progress) { return within_step(progress); };
    try {
        const MarchOutcome outcome = march.run(*case_.system, *case_.integrator, state_, resumed_);
        if (unbalanced_) return end_unbalanced();
        if (outcome == MarchOutcome::finished) return end(RunStatus::done, "", exit_code::done);
        return end(RunStatus::interrupted,
                   fmt::format("stopped by a signal; go on with --restart {}", checkpoint_file().string()),
                   stop_request_.exit_code());
    } catch (const RecoverableError& error) {
        return end_failed(error);
    } catch (const InputError& error) {
        if (!begun_) throw;
        return end_failed(error);  // a formula that has no value at this time, say
    } catch (const std::bad_alloc&) {
        return end_out_of_memory();
    } catch (const std::exception& error) {
        // A full disk, say: nothing more may be written, except for why, if that still goes.
        try {
            log_->info("failed: {}", error.what());
            write_summary_file(RunStatus::failed, error.what());
        } catch (const std::exception&) {
        }
        throw;
    }
}

}  // namespace

int run_case(const RunArguments& arguments) { return Run(arguments).march(); }

}  // namespace gneiss
