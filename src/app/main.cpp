// The command line of gneiss. Exit codes: 0 done, 2 bad input, 3 the computation failed, 130 or 143 interrupted.

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <iostream>

#include "app/check_case.hpp"
#include "app/run_case.hpp"
#include "base/errors.hpp"
#include "io/deck/deck.hpp"
#include "io/output/version.hpp"

namespace {

using namespace gneiss;

/// @param topic  empty: everything
void list(const std::string& topic) {
    std::string topics;
    bool found = false;
    for (const Listing& listing : deck_listings()) {
        topics += (topics.empty() ? "" : ", ") + listing.topic;
        if (!topic.empty() && listing.topic != topic) continue;
        found = true;
        std::cout << fmt::format("{} (key {})\n", listing.topic, listing.where);
        for (const Listing::Entry& entry : listing.entries) std::cout << fmt::format("  {:<22}{}\n", entry.name, entry.meaning);
        std::cout << '\n';
    }
    if (!found) throw InputError("gneiss list", fmt::format("given `{}`, must be one of {}", topic, topics));
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("gneiss: plane problems in anisotropic solids, under any time integrator", "gneiss");
    app.set_version_flag("--version", version_string());
    app.require_subcommand(1);

    RunArguments run;
    CLI::App* run_command = app.add_subcommand("run", "run a case; results go to a folder of their own");
    run_command->add_option("deck", run.deck, "TOML deck (docs/deck.md lists every key)")->required();
    run_command->add_option("--out", run.out, "folder of the results [results/NAME of the deck]");
    run_command->add_option("--set", run.set, "overrides, such as --set run.t_end=0.01")->type_name("KEY=VALUE");
    run_command->add_option("--threads", run.threads, "number of threads [all cores]")->check(CLI::Range(1, 1024));
    run_command->add_option("--restart", run.restart, "go on from a checkpoint.h5");
    run_command->add_flag("--quiet", run.quiet, "no progress on the terminal");

    CLI::App* check_command = app.add_subcommand("check", "check a deck; print sizes, stable step, expected time and memory");
    check_command->add_option("deck", run.deck, "TOML deck")->required();
    check_command->add_option("--set", run.set, "overrides, such as --set run.t_end=0.01")->type_name("KEY=VALUE");
    check_command->add_option("--threads", run.threads, "number of threads [all cores]")->check(CLI::Range(1, 1024));

    std::string topic;
    CLI::App* list_command = app.add_subcommand("list", "list elements, materials, integrators, loads, ...");
    list_command->add_option("topic", topic, "one topic only");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_code::done : exit_code::bad_input;
    }
    try {
        if (*run_command) return run_case(run);
        if (*check_command) check_case(run.deck, run.set, run.threads, std::cout);
        if (*list_command) list(topic);
        return exit_code::done;
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
