#include "io/deck/deck.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "io/deck/overrides.hpp"
#include "io/deck/sections.hpp"

namespace gneiss {

CaseOptions parse_deck(std::string_view text, std::string name, const std::vector<std::string>& set) {
    toml::table document;
    try {
        document = toml::parse(text, name);
    } catch (const toml::parse_error& error) {
        throw InputError(deck::position_of(error.source(), {name, 1, 1}).text(),
                         fmt::format("no valid TOML: {}", error.description()));
    }
    deck::Findings findings;
    for (const std::string& argument : set) deck::apply_override(document, argument, findings);

    CaseOptions options;
    deck::TableReader table(findings, document, deck::Position{name, 1, 1}, "");
    deck::read_section(deck::case_section(), table, options);
    findings.throw_if_any();
    return options;
}

CaseOptions read_deck(const std::filesystem::path& file, const std::vector<std::string>& set) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || std::filesystem::is_directory(file))
        throw InputError(file.string(), "no such deck, or not readable");
    text << stream.rdbuf();
    CaseOptions options = parse_deck(text.str(), file.string(), set);
    if (options.mesh.source == MeshOptions::Source::file) {
        options.mesh.file = (file.parent_path() / options.mesh.file).string();
    }
    return options;
}

}  // namespace gneiss
