#include "io/deck/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
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

/// A table [integrator], and what sets it apart.
struct Setting {
    std::string text;
    toml::table integrator;
};

Setting setting_of(const SchemeVariant& variant) {
    return {variant.setting, *toml::parse("integrator = " + variant.toml)["integrator"].as_table()};
}

/// A reference with one setting changed: a tolerance ten times as large, or steps half as long; none where nothing says
/// how accurate it is.
std::optional<Setting> other_setting(const SchemeVariant& reference) {
    const IntegratorOptions& one = reference.integrator;
    const auto changed = [&](const char* key, double to) {
        Setting setting = setting_of(reference);
        setting.integrator.insert_or_assign(key, to);
        setting.text = fmt::format("{} = {}", key, to);
        return setting;
    };
    const bool is_static = one.type == "quasi_static" || one.type == "dynamic_relaxation";
    const bool to_tolerance = one.type == "cvode" || one.type == "ida" || (one.type == "arkode" && one.dt == 0);
    constexpr double largest_tolerance = 0.1;
    if (to_tolerance || one.adaptive) return changed("rtol", std::min(largest_tolerance, 10 * one.rtol));
    if (is_static) return one.step > 0 ? std::optional(changed("step", 0.5 * one.step)) : std::nullopt;
    if (one.dt > 0) return changed("dt", 0.5 * one.dt);
    return changed("safety", 0.5 * one.safety);
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
    ComparisonDecks decks;
    decks.options = read_deck(file, set, &notes);
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
    const auto deck_of = [&](const std::string& scheme, const Setting& setting) {
        document.insert_or_assign("integrator", setting.integrator);
        return ComparisonDecks::Run{scheme, setting.text, toml_text()};
    };
    if (compare.reference) decks.runs.push_back(deck_of("reference", setting_of(*compare.reference)));
    if (const auto other = compare.reference ? other_setting(*compare.reference) : std::nullopt)
        decks.check = deck_of("check of the reference", *other);
    for (const SchemeOptions& scheme : compare.schemes)
        for (const SchemeVariant& variant : scheme.variants)
            decks.runs.push_back(deck_of(scheme.name, setting_of(variant)));
    return decks;
}

}  // namespace gneiss
