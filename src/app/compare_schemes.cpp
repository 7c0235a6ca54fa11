#include "app/compare_schemes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <system_error>
#include <thread>

#include "app/comparison.hpp"
#include "app/comparison_report.hpp"
#include "app/make_integrator.hpp"
#include "base/errors.hpp"
#include "io/deck/deck.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/csv_series.hpp"
#include "io/output/fingerprint.hpp"
#include "io/output/folder_lock.hpp"
#include "io/output/stop_request.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

/// "cvode bdf, rtol = 1e-06" as the name of a folder: cvode_bdf-rtol_1e-06.
std::string folder_name(const std::string& scheme, const std::string& setting) {
    std::string name;
    const auto add = [&](const std::string& text) {
        for (const char c : text) {
            const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+';
            if (plain)
                name += c;
            else if (!name.empty() && name.back() != '_')
                name += '_';
        }
    };
    add(scheme);
    if (!setting.empty()) {
        name += '-';
        add(setting);
    }
    return name;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// How a process of its own ended.
struct Ended {
    int exit_code = 0;  ///< 128 + signal where a signal ended it
    RunCost cost;
};

/// Where the messages of a process go.
class Messages {
public:
    /// @param file  empty: where those of this one go
    explicit Messages(const fs::path& file) {
        if (const int error = posix_spawn_file_actions_init(&actions_); error != 0) throw std::bad_alloc();
        constexpr mode_t readable = 0644;
        if (!file.empty() && posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, file.c_str(),
                                                              O_WRONLY | O_CREAT | O_TRUNC, readable) != 0)
            throw std::bad_alloc();
    }
    Messages(const Messages&) = delete;
    Messages& operator=(const Messages&) = delete;
    ~Messages() { posix_spawn_file_actions_destroy(&actions_); }

    const posix_spawn_file_actions_t* actions() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

/// Runs a program to its end. A stop that is asked for is handed on.
/// @param messages  file for what it says; empty: that is seen
Ended carry_out(const fs::path& program, const std::vector<std::string>& arguments, const StopRequest& stop,
                const fs::path& messages = {}) {
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    pid_t process = 0;
    const Messages destination(messages);
    if (const int error =
            posix_spawn(&process, program.c_str(), destination.actions(), nullptr, pointers.data(), environ);
        error != 0)
        throw IoError(program, std::generic_category().message(error));
    int status = 0;
    rusage usage{};
    for (bool told = false;;) {
        const pid_t ended = wait4(process, &status, WNOHANG, &usage);
        if (ended == process) break;
        if (ended < 0 && errno != EINTR) throw io_error_from_errno(program, "waiting for it");
        if (stop.requested() && !told) told = kill(process, SIGTERM) == 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    constexpr double bytes_per_unit = 1024;  // of ru_maxrss on Linux
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            {seconds(usage.ru_utime) + seconds(usage.ru_stime), bytes_per_unit * static_cast<double>(usage.ru_maxrss)}};
}

std::string text_of(const std::optional<double>& error) {
    return error ? fmt::format("{:.2e}", *error) : "of what does not move in the reference";
}

void add_errors(const ComparedRun& run, nlohmann::ordered_json& row) {
    if (!run.errors) return;
    const auto add = [&](const char* name, const std::optional<double>& error) {
        if (error) row[name] = *error;
    };
    add("error_displacement", run.errors->displacement);
    add("error_velocity", run.errors->velocity);
    add("error_stress", run.errors->stress);
}

/// What a reference is worth, in a sentence.
std::string worth(const std::optional<ComparedRun>& check) {
    if (!check) return "Nothing says how far the reference itself is off.";
    if (!check->errors)
        return fmt::format("The reference could not be checked ({}): {}.", check->setting, check->message);
    return fmt::format(
        "The reference is off by {} in u and {} in v, as its check{}{} says: errors below that say nothing.",
        text_of(check->errors->displacement), text_of(check->errors->velocity), check->setting.empty() ? "" : " with ",
        check->setting);
}

class Comparison {
public:
    Comparison(const RunArguments& arguments, fs::path program)
        : arguments_(arguments),
          program_(std::move(program)),
          decks_(read_comparison(arguments.deck, arguments.set)),
          program_fingerprint_(fingerprint_text(read_file(program_))) {
        out_ =
            arguments.out.empty() ? fs::path("results") / (arguments.deck.stem().string() + "-compare") : arguments.out;
        if (decks_.options.mesh.source == MeshOptions::Source::file)
            mesh_fingerprint_ = fingerprint_text(read_file(decks_.options.mesh.file));
        check_schemes();
        std::set<std::string> names;
        if (decks_.check) names.insert(folder_name(decks_.check->scheme, decks_.check->setting));
        for (const auto& run : decks_.runs)
            if (const std::string name = folder_name(run.scheme, run.setting);
                name.find_first_not_of("._-") == std::string::npos || !names.insert(name).second)
                throw InputError(
                    arguments.deck.string(),
                    fmt::format("[compare]: the run \"{}\" would have the folder \"{}\", which is none or that "
                                "of another run: give its scheme another name",
                                run_title(run.scheme, run.setting), name));
    }

    int carry_out_all();

private:
    void check_schemes() const;
    void keep_other_comparison() const;
    /// @param label  "[2/5]"
    ComparedRun carry_out_one(const ComparisonDecks::Run& run, const std::string& label);
    std::string why_refused(const fs::path& deck) const;
    void measure(std::vector<ComparedRun>& runs, std::optional<ComparedRun>& check) const;
    std::string reference_text() const;
    void write(const std::vector<ComparedRun>& runs, const std::optional<ComparedRun>& check) const;

    RunArguments arguments_;
    fs::path program_;
    ComparisonDecks decks_;
    std::string program_fingerprint_, mesh_fingerprint_;
    fs::path out_;
    StopRequest stop_;
};

/// Options that no scheme would take are found before the first run.
void Comparison::check_schemes() const {
    std::vector<Problem> problems;
    std::vector<ComparisonDecks::Run> all = decks_.runs;
    if (decks_.check) all.push_back(*decks_.check);
    for (const ComparisonDecks::Run& run : all) try {
            make_integrator(parse_deck(run.deck, arguments_.deck.string()).integrator);
        } catch (const InputError& error) {
            for (const Problem& problem : error.problems())
                problems.push_back({fmt::format("[compare] {}: {}", run_title(run.scheme, run.setting), problem.where),
                                    problem.message});
        }
    if (!problems.empty()) throw InputError(problems);
}

/// Schemes may change: runs that are there already are not repeated.
/// @throws InputError if the folder holds a comparison on another problem
void Comparison::keep_other_comparison() const {
    const fs::path file = out_ / "compare.json";
    if (arguments_.overwrite || !fs::exists(file)) return;
    const auto before = nlohmann::json::parse(read_file(file), nullptr, false);
    const std::string own = fingerprint_text(decks_.problem);
    if (!before.is_object() || before.value("problem_fingerprint", own) == own) return;
    throw InputError(out_.string(),
                     "holds a comparison on another problem, or on this one before its deck was changed elsewhere than "
                     "in [compare]: --overwrite replaces it, --out takes another folder");
}

/// What the program says of a deck that it does not run, in one line.
std::string Comparison::why_refused(const fs::path& deck) const {
    const fs::path folder = deck.parent_path(), messages = folder / "refusal.txt";
    carry_out(program_, {"run", deck.string(), "--out", folder.string(), "--quiet"}, stop_, messages);
    std::istringstream lines(read_file(messages));
    std::string text, line;
    while (std::getline(lines, line)) {
        if (line.find_first_not_of(' ') == std::string::npos) continue;
        if (!text.empty()) text += "; ";
        text += line.substr(line.find_first_not_of(' '));
    }
    return text;
}

ComparedRun Comparison::carry_out_one(const ComparisonDecks::Run& run, const std::string& label) {
    const fs::path folder = out_ / "runs" / folder_name(run.scheme, run.setting);
    make_folder(folder);
    const fs::path deck = folder / "case.toml", made_from = folder / "made_from.json";
    const nlohmann::ordered_json key{{"deck", fingerprint_text(run.deck)},
                                     {"mesh", mesh_fingerprint_},
                                     {"program", program_fingerprint_},
                                     {"threads", arguments_.threads}};
    const auto announce = [&](const char* what) {
        if (!arguments_.quiet) fmt::print(stderr, "{} {}{}\n", label, run_title(run.scheme, run.setting), what);
    };
    RunCost cost;
    int ended_with = exit_code::done;
    const auto before = fs::exists(made_from) ? nlohmann::json::parse(read_file(made_from), nullptr, false) : nullptr;
    const bool is_there = before.is_object() && before.value("key", nlohmann::json()) == nlohmann::json(key) &&
                          fs::exists(folder / "summary.json") &&
                          (before.value("exit_code", -1) != exit_code::done || fs::exists(folder / "states.h5"));
    if (is_there) {
        announce(": there already");
        cost = {before.at("cpu_time_s"), before.at("peak_memory_bytes")};
    } else {
        announce("");
        fs::remove(made_from);
        fs::remove(folder / "summary.json");
        write_atomically(deck, run.deck);
        std::vector<std::string> words{"run", deck.string(), "--out", folder.string()};
        if (arguments_.threads > 0) words.insert(words.end(), {"--threads", fmt::format("{}", arguments_.threads)});
        if (arguments_.quiet) words.push_back("--quiet");
        const Ended ended = carry_out(program_, words, stop_);
        cost = ended.cost;
        ended_with = ended.exit_code;
        if (!stop_.requested() && ended.exit_code < 128)
            write_atomically(made_from, nlohmann::ordered_json{{"key", key},
                                                               {"exit_code", ended.exit_code},
                                                               {"cpu_time_s", cost.cpu_time},
                                                               {"peak_memory_bytes", cost.peak_memory}}
                                                .dump(2) +
                                            '\n');
    }
    ComparedRun result = read_run(folder);
    if (result.status == "refused")
        result.message = ended_with == exit_code::bad_input
                             ? why_refused(deck)
                             : fmt::format("the process ended before its first step, exit code {}", ended_with);
    if (result.status == name_of(RunStatus::running)) {
        result.status = name_of(RunStatus::failed);
        result.message = fmt::format("the process ended without a word, exit code {}: out of memory?", ended_with);
    }
    result.scheme = run.scheme;
    result.setting = run.setting;
    result.cost = cost;
    return result;
}

void Comparison::measure(std::vector<ComparedRun>& runs, std::optional<ComparedRun>& check) const {
    const CompareOptions& compare = *decks_.options.compare;
    std::optional<SavedStates> reference;
    if (compare.reference) reference = read_states(runs.front().folder / "states.h5");
    const auto measure_one = [&](ComparedRun& run) {
        if (!run.done()) return;
        try {
            const SavedStates states = read_states(run.folder / "states.h5");
            run.errors = reference ? errors_against(states, *reference) : errors_against(states, *compare.exact);
        } catch (const InputError& error) {
            run.message = error.what();
        }
    };
    if (check) measure_one(*check);
    for (ComparedRun& run : runs) {
        measure_one(run);
        if (check) run.reference_error = check->errors;
    }
}

std::string Comparison::reference_text() const {
    const CompareOptions& compare = *decks_.options.compare;
    return compare.reference ? "the reference, " + compare.reference->toml : "the solution in closed form of the deck";
}

void Comparison::write(const std::vector<ComparedRun>& runs, const std::optional<ComparedRun>& check) const {
    std::string csv;
    const auto add_line = [&](const std::vector<std::string>& cells) {
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (k > 0) csv += ',';
            csv += csv_field(cells[k]);
        }
        csv += '\n';
    };
    const std::vector<std::string> header = comparison_header();
    add_line(header);
    auto rows = nlohmann::ordered_json::array();
    for (const ComparedRun& run : runs) {
        add_line(comparison_row(run, false));
        nlohmann::ordered_json row{{"scheme", run.scheme},
                                   {"setting", run.setting},
                                   {"status", run.status},
                                   {"folder", run.folder.string()},
                                   {"energy_error", run.energy_error},
                                   {"energy_drift", run.energy_drift},
                                   {"steps", run.steps},
                                   {"rejected", run.rejected},
                                   {"force_evaluations", run.force_evaluations},
                                   {"start_evaluations", run.start_evaluations},
                                   {"balance_evaluations", run.balance_evaluations},
                                   {"event_search_evaluations", run.event_search_evaluations},
                                   {"jacobians", run.jacobians},
                                   {"factorisations", run.factorisations},
                                   {"iterations", run.iterations},
                                   {"cpu_time_s", run.cost.cpu_time},
                                   {"stepping_time_s", run.wall_time},
                                   {"peak_memory_bytes", run.cost.peak_memory}};
        if (!run.message.empty()) row["message"] = run.message;
        if (!run.warning.empty()) row["warning"] = run.warning;
        add_errors(run, row);
        rows.push_back(std::move(row));
    }
    nlohmann::ordered_json json{{"title", decks_.options.title},
                                {"problem_fingerprint", fingerprint_text(decks_.problem)},
                                {"reference", reference_text()}};
    if (check) {
        nlohmann::ordered_json row{
            {"setting", check->setting}, {"status", check->status}, {"folder", check->folder.string()}};
        if (!check->message.empty()) row["message"] = check->message;
        add_errors(*check, row);
        json["reference_check"] = std::move(row);
    }
    json["runs"] = rows;
    write_atomically(out_ / "compare.csv", csv);
    write_atomically(out_ / "compare.json",
                     json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
    write_atomically(out_ / "report.html",
                     comparison_report(decks_.options.title, reference_text() + ".",
                                       decks_.options.compare->reference ? worth(check) : "", runs));
}

int Comparison::carry_out_all() {
    make_folder(out_);
    const FolderLock lock(out_, "gneiss compare " + fs::absolute(arguments_.deck).string());
    keep_other_comparison();
    if (!arguments_.quiet)
        for (const std::string& note : decks_.notes) fmt::print(stderr, "gneiss: warning: {}\n", note);
    std::vector<ComparedRun> runs;
    std::optional<ComparedRun> check;
    const std::size_t n = decks_.runs.size() + (decks_.check ? 1 : 0);
    for (std::size_t number = 0; number < decks_.runs.size() && !stop_.requested(); ++number) {
        runs.push_back(carry_out_one(decks_.runs[number], fmt::format("[{}/{}]", number + 1, n)));
        if (number == 0 && decks_.options.compare->reference && !runs.front().done() && !stop_.requested())
            throw RecoverableError(fmt::format("the reference has not come to its end: {}", runs.front().message));
    }
    if (decks_.check && !stop_.requested()) check = carry_out_one(*decks_.check, fmt::format("[{}/{}]", n, n));
    if (stop_.requested()) {
        fmt::print(stderr, "stopped; call it again to go on: runs that are done are not repeated\n");
        return stop_.exit_code();
    }
    measure(runs, check);
    write(runs, check);
    if (!arguments_.quiet) {
        for (const ComparedRun& run : runs)
            std::cout << fmt::format(
                "{:<40} {}\n", run.title(),
                run.errors ? fmt::format("error {} in u, {} in v; balance {:.1e}; {} steps, "
                                         "{} force evaluations, {:.3g} s",
                                         text_of(run.errors->displacement), text_of(run.errors->velocity),
                                         run.energy_error, run.steps, run.force_evaluations, run.cost.cpu_time)
                           : run.status + ": " + run.message);
        if (decks_.options.compare->reference) std::cout << worth(check) << '\n';
        if (check && !check->done())
            fmt::print(stderr, "gneiss: warning: the reference could not be checked: {}: {}\n", check->setting,
                       check->message);
        for (const ComparedRun& run : runs)
            if (run.done() && !run.warning.empty())
                fmt::print(stderr, "gneiss: warning: {}: {}\n", run.title(), run.warning);
        fmt::print(stderr, "results: {}\n", out_.string());
    }
    return std::ranges::all_of(runs, &ComparedRun::done) ? exit_code::done : exit_code::failed;
}

}  // namespace

int compare_schemes(const RunArguments& arguments, const fs::path& program) {
    return Comparison(arguments, program).carry_out_all();
}

}  // namespace gneiss
