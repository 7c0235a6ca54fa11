#include "io/deck/deck.hpp"

#include <fmt/format.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "io/deck/overrides.hpp"
#include "io/deck/sections.hpp"

namespace gneiss {

namespace {

std::string line_of(std::string_view text, unsigned number) {
    std::istringstream stream{std::string(text)};
    std::string line;
    for (unsigned i = 0; i < number && std::getline(stream, line);) ++i;
    return line;
}

/// What people mean who write a line that is no TOML.
std::string hint_to_syntax(const std::string& line) {
    static const std::regex comma(R"(=\s*[+-]?\d+,\d)"), word(R"(=\s*(True|False|TRUE|FALSE|yes|no|on|off)\b)"),
        colon(R"(^\s*\w+\s*:)");
    if (std::regex_search(line, comma)) return "; decimals are written with a point, 0.001";
    if (std::regex_search(line, word)) return "; TOML has `true` and `false`";
    if (std::regex_search(line, colon)) return "; a key and its value are written `key = value`";
    return "";
}

/// The deck as TOML, with what is set laid over it.
toml::table parse_document(std::string_view text, const std::string& name, const std::vector<std::string>& set,
                           deck::Findings& findings) {
    toml::table document;
    try {
        document = toml::parse(text, name);
    } catch (const toml::parse_error& error) {
        const deck::Position place = deck::position_of(error.source(), {name, 1, 1});
        throw InputError(place.text(), fmt::format("no valid TOML: {}{}", error.description(),
                                                   hint_to_syntax(line_of(text, place.line))));
    }
    for (const std::string& argument : set) deck::apply_override(document, argument, findings);
    return document;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || std::filesystem::is_directory(file))
        throw InputError(file.string(), "no such deck, or not readable");
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

CaseOptions parse_deck(std::string_view text, std::string name, const std::vector<std::string>& set,
                       const std::optional<std::filesystem::path>& folder, DeckNotes* notes) {
    deck::Findings findings;
    findings.folder = folder;
    const toml::table document = parse_document(text, name, set, findings);
    CaseOptions options;
    deck::TableReader table(findings, document, deck::Position{name, 1, 1}, "");
    deck::read_section(deck::case_section(), table, options);
    findings.throw_if_any();
    if (notes != nullptr) *notes = {findings.notes(false), findings.notes(true)};
    return options;
}

CaseOptions read_deck(const std::filesystem::path& file, const std::vector<std::string>& set, DeckNotes* notes) {
    CaseOptions options = parse_deck(text_of(file), file.string(), set, file.parent_path(), notes);
    if (options.mesh.source == MeshOptions::Source::file)
        options.mesh.file = (file.parent_path() / options.mesh.file).string();
    return options;
}

ComparisonDecks read_comparison(const std::filesystem::path& file, const std::vector<std::string>& set) {
    DeckNotes notes;
    ComparisonDecks decks{read_deck(file, set, &notes), {}, {}, {}};
    decks.notes = std::move(notes.on_compare);
    if (!decks.options.compare)
        throw InputError(file.string(), "has no table [compare]: schemes to run, and what to measure them against");
    const CompareOptions& compare = *decks.options.compare;
    deck::Findings findings;
    toml::table document = parse_document(text_of(file), file.string(), set, findings);
    document.erase("compare");
    document["run"].as_table()->erase("checkpoint");  // its times would shorten steps
    if (toml::table& mesh = *document["mesh"].as_table(); mesh.contains("file"))
        mesh.insert_or_assign("file", std::filesystem::absolute(decks.options.mesh.file).lexically_normal().string());
    if (!document.contains("output")) document.insert("output", toml::table{});
    toml::table& output = *document["output"].as_table();
    output.erase("fields");  // so would these
    output.erase("field_times");
    output.insert_or_assign("states", decks.options.run.t_end / compare.samples);
    const auto toml_text = [&document] {
        std::ostringstream text;
        text << toml::toml_formatter(document) << '\n';
        return text.str();
    };
    document.erase("integrator");
    decks.problem = toml_text();
    const auto add = [&](const std::string& scheme, const SchemeVariant& variant) {
        document.insert_or_assign("integrator", *toml::parse("integrator = " + variant.toml)["integrator"].as_table());
        decks.runs.push_back({scheme, variant.setting, toml_text()});
    };
    if (compare.reference) add("reference", *compare.reference);
    for (const SchemeOptions& scheme : compare.schemes)
        for (const SchemeVariant& variant : scheme.variants) add(scheme.name, variant);
    return decks;
}

}  // namespace gneiss
