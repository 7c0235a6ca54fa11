// The command line of gneiss. Exit codes: 0 done, 2 bad input, 3 the computation failed, 130 or 143 interrupted.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "app/check_case.hpp"
#include "app/compare_schemes.hpp"
#include "app/large_arrays.hpp"
#include "app/matrices.hpp"
#include "app/run_case.hpp"
#include "app/threads.hpp"
#include "base/errors.hpp"
#include "base/suggest.hpp"
#include "integrators/arkode.hpp"
#include "io/deck/deck.hpp"
#include "io/output/progress_line.hpp"
#include "io/output/version.hpp"
#include "mesh/mesh_process.hpp"

namespace {

using namespace gneiss;

/// @param topic  empty: everything
/// What a deck can name, and which of it this program lacks.
std::vector<Listing> listings_of_this_build() {
    std::vector<Listing> listings = deck_listings();
    for (Listing& listing : listings) {
        if (listing.where != "integrator.table") continue;
        for (const RungeKuttaTable& table : runge_kutta_tables()) {
            const auto entry = std::ranges::find(listing.entries, table.name, &Listing::Entry::name);
            if (!table.here()) entry->meaning += ": not here, this program has SUNDIALS " + sundials_version();
        }
    }
    return listings;
}

void list(const std::string& topic) {
    const std::vector<Listing> listings = listings_of_this_build();
    std::vector<std::string_view> topics;
    std::string text;
    for (const Listing& listing : listings) {
        topics.push_back(listing.topic);
        if (!topic.empty() && listing.topic != topic) continue;
        text += fmt::format("{}{}  ({} = ...)\n", text.empty() ? "" : "\n", listing.topic, listing.where);
        std::size_t width = 18;
        for (const Listing::Entry& entry : listing.entries) width = std::max(width, entry.name.size());
        for (const Listing::Entry& entry : listing.entries)
            text += fmt::format("  {:<{}}  {}\n", entry.name, width, entry.meaning);
    }
    if (text.empty())
        throw InputError("gneiss list", fmt::format("given `{}`, must be one of {}{}", topic, fmt::join(topics, ", "),
                                                    suggestion(topic, topics)));
    std::cout << text;
}

/// What the command line asks for.
struct Arguments {
    RunArguments run;
    std::vector<std::string> topic;  ///< words of it: "stress maps"
};

void add_case_options(CLI::App& command, RunArguments& run) {
    command.add_option("deck", run.deck, "the case (docs/deck.md lists every key)")->required()->type_name("CASE.toml");
    command.add_option("--set", run.set, "laid over the deck: --set run.t_end=0.01 integrator.safety=0.5")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command.add_option("--threads", run.threads, "number of threads [all cores]")
        ->check(CLI::Range(1, 1024).description(""))
        ->type_name("N");
}

void add_overwrite_option(CLI::App& command, RunArguments& run) {
    command.add_flag("--overwrite", run.overwrite, "replace finished results of another deck in the folder");
}

void add_results_options(CLI::App& command, RunArguments& run, const char* restart) {
    command.add_option("--out", run.out, "folder of the results [results/CASE]")->type_name("DIR");
    command.add_option("--restart", run.restart, restart)->type_name("FILE");
}

/// The words of the command line, last first as CLI11 takes them. `--set a=1 b=2 case.toml` becomes `--set a=1 --set
/// b=2 case.toml`: left to itself, an option with many values would take the deck for one.
std::vector<std::string> words_of(int argc, char** argv) {
    std::vector<std::string> words;
    bool setting = false;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool is_override = !word.starts_with('-') && word.find('=') != std::string::npos;
        if (setting && is_override && words.back() != "--set") words.push_back("--set");
        setting = word == "--set" || (setting && is_override);
        words.push_back(word);
    }
    return {words.rbegin(), words.rend()};
}

/// Gmsh works in a second process of this program; from the third second on its progress is shown.
MeshProcess mesh_process(bool quiet) {
    MeshProcess process{.program = "/proc/self/exe"};
    if (quiet) return process;
    struct Shown {
        double next = 2;  // s
        std::size_t width = 0;
    };
    const auto shown = std::make_shared<Shown>();
    const bool on_terminal = isatty(STDERR_FILENO) == 1;
    process.progress = [shown, on_terminal](const std::filesystem::path& file, double seconds, std::string_view said) {
        if (seconds < shown->next) return;
        shown->next = seconds + (on_terminal ? 0 : record_interval(seconds));
        constexpr std::size_t widest = 100;
        const std::string line =
            fmt::format("mesh: {}, {}: {}", file.filename().string(), duration_text(seconds), said).substr(0, widest);
        fmt::print(stderr, "{}{:<{}}{}", on_terminal ? "\r" : "", line, shown->width, on_terminal ? "" : "\n");
        if (on_terminal) shown->width = std::max(shown->width, line.size());
    };
    process.ended = [shown] {
        if (shown->width > 0) fmt::print(stderr, "\r{:<{}}\r", "", shown->width);
        *shown = {};
    };
    return process;
}

/// An override that is none, "key" of `--set key value`; empty if there is none.
std::string broken_override(int argc, char** argv) {
    for (int i = 1; i + 1 < argc; ++i)
        if (std::string_view(argv[i]) == "--set" && std::string_view(argv[i + 1]).find('=') == std::string_view::npos)
            return argv[i + 1];
    return {};
}

/// @return exit code
int carry_out(const CLI::App& app, const Arguments& arguments, char** argv) {
    const RunArguments& run = arguments.run;
    // before threads are thought of: each run of a comparison is a process of its own
    if (app.got_subcommand("compare")) return compare_schemes(run, std::filesystem::canonical("/proc/self/exe"));
    if (app.got_subcommand("list")) {
        list(fmt::format("{}", fmt::join(arguments.topic, " ")));
        return exit_code::done;
    }
    wait_briefly(run.threads, argv);
    if (app.got_subcommand("run")) return run_case(run);
    if (app.got_subcommand("matrices")) {
        write_matrices(run);
        return exit_code::done;
    }
    check_case(run.deck, run.set, run.threads, std::cout);
    return exit_code::done;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && argv[1] == mesh_process_command) return serve_mesh({argv + 2, argv + argc});

    return_large_arrays();
    CLI::App app("gneiss: plane problems in anisotropic solids, under any time integrator", "gneiss");
    app.set_version_flag("--version", "gneiss " + version_string());
    app.require_subcommand(0, 1);

    Arguments arguments;
    RunArguments& run = arguments.run;
    CLI::App* run_command = app.add_subcommand("run", "run a case; results go to a folder of their own");
    add_case_options(*run_command, run);
    add_results_options(*run_command, run, "go on from a checkpoint.h5");
    add_overwrite_option(*run_command, run);
    run_command->add_flag("--quiet", run.quiet, "print nothing but errors");
    CLI::App* compare_command =
        app.add_subcommand("compare", "run a case under the schemes of its [compare]; table, work and precision");
    add_case_options(*compare_command, run);
    compare_command->add_option("--out", run.out, "folder of the results [results/CASE-compare]")->type_name("DIR");
    add_overwrite_option(*compare_command, run);
    compare_command->add_flag("--quiet", run.quiet, "print nothing but errors");
    CLI::App* check_command =
        app.add_subcommand("check", "check a deck; print sizes, stable step, expected time and memory");
    add_case_options(*check_command, run);
    CLI::App* matrices_command =
        app.add_subcommand("matrices", "write stiffness, damping and mass in Matrix Market format");
    add_case_options(*matrices_command, run);
    add_results_options(*matrices_command, run, "of the state of a checkpoint.h5 [of the start]");
    CLI::App* list_command = app.add_subcommand("list", "list what a deck can name: elements, materials, loads, ...");
    list_command->add_option("topic", arguments.topic, "one of them only")->type_name("");

    try {
        app.parse(words_of(argc, argv));
        if (app.get_subcommands().empty()) throw CLI::CallForHelp();
    } catch (const CLI::CallForHelp& help) {
        app.exit(help);
        return argc > 1 ? exit_code::done : exit_code::bad_input;
    } catch (const CLI::ExtrasError& error) {
        if (!app.get_subcommands().empty()) {
            if (const std::string key = broken_override(argc, argv); !key.empty())
                std::cerr << fmt::format("gneiss: --set {}: must be key=value without blanks, as in run.t_end=0.01\n",
                                         key);
            return app.exit(error), exit_code::bad_input;
        }
        std::cerr << fmt::format("gneiss: no command `{}`{}\n", argv[1],
                                 suggestion(argv[1], {"run", "compare", "check", "matrices", "list"}));
        return exit_code::bad_input;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_code::done : exit_code::bad_input;
    }
    try {
        use_mesh_process(mesh_process(arguments.run.quiet));
        return carry_out(app, arguments, argv);
    } catch (const MeshInterrupted& error) {
        constexpr int by_signal = 128;
        return by_signal + error.signal;
    } catch (const InputError& error) {
        std::cerr << error.what() << '\n';
        const std::size_t n = error.problems().size();
        std::cerr << fmt::format("{} {}\n", n, n == 1 ? "problem" : "problems");
        return exit_code::bad_input;
    } catch (const std::exception& error) {
        std::cerr << "gneiss: " << error.what() << '\n';
        return exit_code::failed;
    }
}
