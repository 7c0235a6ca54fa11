// The cross-check from the command line. Exit codes: 0 done, 2 bad input, 3 the computation failed.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <map>

#include "app/run_case.hpp"
#include "base/errors.hpp"
#include "case.hpp"
#include "cholesky.hpp"
#include "io/deck/deck.hpp"
#include "io/output/atomic_file.hpp"
#include "report.hpp"

int main(int argc, char** argv) {
    using namespace gneiss;
    using namespace gneiss::crosscheck;

    CLI::App app(
        "The linear elasticity of a gneiss deck by deal.II; tests/crosscheck/README.md explains what comes out",
        "gneiss_crosscheck");
    std::filesystem::path deck, out;
    std::vector<std::string> set;
    Element element = Element::p1;
    int refine = 0;
    std::map<std::string, Element> elements;
    for (const Element e : {Element::p1, Element::p2, Element::taylor_hood}) elements[name_of(e)] = e;
    app.add_option("deck", deck, "the case (docs/deck.md lists every key)")->required()->type_name("CASE.toml");
    app.add_option("--element", element, "p1, p2 or taylor_hood")
        ->required()
        ->type_name("NAME")
        ->transform(CLI::CheckedTransformer(elements).description(""));
    app.add_option("--refine", refine, "cut every cell into four so many times [0]")
        ->check(CLI::Range(0, 8).description(""))
        ->type_name("K");
    app.add_option("--set", set, "laid over the deck, once for each key: --set run.t_end=2 --set mesh.cells=[8,8]")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    app.add_option("--out", out, "the results, JSON")->required()->type_name("FILE.json");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_code::done : exit_code::bad_input;
    }
    try {
        const ElasticCase what = elastic_case(read_deck(deck, set), element, refine);
        write_atomically(out, report(what, solve(what.problem, cholesky())).dump() + '\n');
        return exit_code::done;
    } catch (const InputError& error) {
        std::cerr << error.what() << '\n';
        return exit_code::bad_input;
    } catch (const std::exception& error) {
        std::cerr << "gneiss_crosscheck: " << error.what() << '\n';
        return exit_code::failed;
    }
}
