// What the schema says about itself: the tables of docs/deck.md and the lists of `gneiss list`.

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "io/deck/choices.hpp"
#include "io/deck/deck.hpp"
#include "io/deck/sections.hpp"
#include "model/formula_grammar.hpp"

namespace gneiss {
namespace deck {
namespace {

template <class T>
SectionDoc describe(std::string name, std::string heading, std::vector<std::string> paths, const Section<T>& section) {
    SectionDoc doc{std::move(name), std::move(heading), std::move(paths), {}};
    for (const Key<T>& key : section.keys) doc.keys.push_back(key.doc);
    return doc;
}

std::string conditions(const std::vector<Condition>& list) {
    std::string text;
    for (const Condition& condition : list) {
        std::string words;
        for (std::string_view word : condition.words) words += fmt::format("{}{}", words.empty() ? "" : ", ", word);
        text +=
            fmt::format("{}{}{}", text.empty() ? "" : " or ", condition.key, words.empty() ? " given" : " = " + words);
    }
    return text;
}

std::string default_cell(const KeyDoc& key) {
    if (!key.or_else.empty()) return fmt::format("required unless `{}`", key.or_else);
    if (key.required) return "required";
    if (!key.needed_for.empty()) return fmt::format("required for {}", conditions(key.needed_for));
    return key.default_text.empty() ? "–" : fmt::format("`{}`", key.default_text);
}

std::string range_cell(const KeyDoc& key) {
    if (key.words.empty()) {
        const bool numeric = key.type.find("number") != std::string::npos;
        return key.range.is_any() && !numeric ? "–" : key.range.text();
    }
    std::string text;
    for (const Word& word : key.words) text += fmt::format("{}`\"{}\"`", text.empty() ? "" : ", ", word.name);
    return text;
}

std::string meaning_cell(const KeyDoc& key) {
    return key.meaning + (key.only_for.empty() ? "" : fmt::format(" *(only for {})*", conditions(key.only_for)));
}

std::string key_table(const SectionDoc& section) {
    std::string text = "| Key | Type | Unit | Range | Default | Meaning |\n|---|---|---|---|---|---|\n";
    for (const KeyDoc& key : section.keys) {
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, key.type,
                            key.unit.empty() ? "–" : key.unit, range_cell(key), default_cell(key), meaning_cell(key));
    }
    for (const KeyDoc& key : section.keys) {
        if (key.words.empty()) continue;
        text += fmt::format("\n`{}`:\n", key.name);
        for (const Word& word : key.words) text += fmt::format("- `\"{}\"`: {}\n", word.name, word.meaning);
    }
    return text;
}

/// What expressions are made of, from the table that they are compiled against.
std::string expression_tables() {
    std::string text = "| Operator | Meaning |\n|---|---|\n";
    const auto cell = [](std::string_view code) {  // a bar would end the cell
        std::string escaped;
        for (const char c : code) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
        return escaped;
    };
    for (const FormulaOperator& one : formula_operators())
        text += fmt::format("| `{}` | {} |\n", cell(one.text), cell(one.meaning));
    text += "\n| Function or constant | Meaning |\n|---|---|\n";
    for (const FormulaFunction& one : formula_functions())
        text += fmt::format("| `{}({})` | {} |\n", one.name, one.arguments, one.meaning);
    for (const FormulaConstant& one : formula_constants())
        text += fmt::format("| `{}` | {} |\n", one.name, one.meaning);
    return text;
}

template <class E, std::size_t n>
Listing list(std::string topic, std::string where, const std::array<Choice<E>, n>& choices) {
    Listing listing{std::move(topic), std::move(where), {}};
    for (const Choice<E>& choice : choices) {
        listing.entries.push_back({std::string(choice.name), std::string(choice.meaning)});
    }
    return listing;
}

}  // namespace

const std::vector<SectionDoc>& section_docs() {
    static const std::vector<SectionDoc> all{
        describe("deck", "the deck", {""}, case_section()),
        describe("mesh", "[mesh]", {"mesh"}, mesh_section()),
        describe("mesh.parts", "mesh.parts", {"mesh.parts"}, part_section()),
        describe("mesh.lines", "mesh.lines", {"mesh.lines"}, line_section()),
        describe("solid", "[solid]", {"solid"}, solid_section()),
        describe("material", "[[material]]", {"material"}, material_section()),
        describe("material.constants", "material.constants", {"material.constants"}, constants_section()),
        describe("material.axes", "material.axes", {"material.axes"}, axes_section()),
        describe("material.stiffening", "material.stiffening", {"material.stiffening"}, stiffening_section()),
        describe("material.viscosity", "material.viscosity", {"material.viscosity"}, viscosity_section()),
        describe("material.strength", "material.strength", {"material.strength"}, strength_section()),
        describe("load", "[[load]]", {"load"}, load_section()),
        describe("boundary", "[[boundary]]", {"boundary"}, boundary_section()),
        describe("lumped", "[[lumped]]", {"lumped"}, lumped_section()),
        describe("lumped.burn", "lumped.burn", {"lumped.burn"}, burn_section()),
        describe("amplitude", "an amplitude", {"load.amplitude", "boundary.amplitude", "lumped.amplitude"},
                 amplitude_section()),
        describe("initial", "[[initial]]", {"initial"}, initial_section()),
        describe("fracture", "[fracture]", {"fracture"}, fracture_section()),
        describe("contact", "[contact]", {"contact"}, contact_section()),
        describe("wall", "[[wall]]", {"wall"}, wall_section()),
        describe("crack", "[[crack]]", {"crack"}, crack_section()),
        describe("interface", "[[interface]]", {"interface"}, interface_section()),
        describe("integrator", "[integrator]", {"integrator"}, integrator_section()),
        describe("run", "[run]", {"run"}, run_section()),
        describe("output", "[output]", {"output"}, output_section()),
        describe("output.probes", "output.probes", {"output.probes"}, probe_section()),
        describe("compare", "[compare]", {"compare"}, compare_section()),
        describe("compare.scheme", "[[compare.scheme]]", {"compare.scheme"}, scheme_section()),
        describe("compare.exact", "[compare.exact]", {"compare.exact"}, exact_section()),
    };
    return all;
}

std::string home_of(std::string_view name) {
    std::string home;
    for (const SectionDoc& section : section_docs()) {
        for (const KeyDoc& key : section.keys) {
            if (key.name != name) continue;
            if (!home.empty()) return {};  // a word like `type` is at home everywhere
            home = section.heading;
        }
    }
    return home;
}

bool is_key_of_deck(std::string_view name) {
    return std::ranges::any_of(case_section().keys, [name](const auto& key) { return key.doc.name == name; });
}

}  // namespace deck

std::vector<Listing> deck_listings() {
    using namespace deck;
    return {list("elements", "solid.element", elements),
            list("materials", "material.law", laws),
            list("forms", "material.form", forms),
            list("stress maps", "material.stress_map", stress_maps),
            list("fracture", "fracture.method", fracture_methods),
            list("contact", "contact.method", contact_methods),
            list("integrators", "integrator.type", integrators),
            list("Verlet compositions", "integrator.composition", verlet_compositions),
            list("Runge-Kutta tables", "integrator.table", runge_kutta_tables),
            list("multirate tables", "integrator.slow_table", multirate_tables),
            list("loads", "load.type", loads),
            list("boundaries", "boundary.type", boundaries),
            list("lumped models", "lumped.type", lumped_models),
            list("amplitudes", "load.amplitude", amplitudes),
            list("meshes", "mesh.generator", mesh_generators)};
}

std::vector<std::string> deck_keys() {
    std::vector<std::string> names;
    for (const deck::SectionDoc& section : deck::section_docs()) {
        for (const std::string& path : section.paths) {
            for (const deck::KeyDoc& key : section.keys)
                names.push_back(path.empty() ? key.name : path + "." + key.name);
        }
    }
    return names;
}

std::string renew_deck_reference(std::string_view document) {
    constexpr std::string_view opening = "<!-- keys of ", closing = "<!-- end -->";
    const auto& sections = deck::section_docs();
    std::vector<bool> placed(sections.size(), false);
    std::string text;
    std::size_t from = 0;
    for (std::size_t at = 0; (at = document.find(opening, from)) != std::string_view::npos;) {
        const std::size_t name_end = document.find(" -->\n", at), end = document.find(closing, at);
        if (name_end == std::string_view::npos || end == std::string_view::npos) {
            throw InputError("", "a place for keys in the reference is not closed by <!-- end -->");
        }
        const std::string_view name = document.substr(at + opening.size(), name_end - at - opening.size());
        if (name == "expressions") {
            text += document.substr(from, name_end + 5 - from);
            text += fmt::format("\n{}\n", deck::expression_tables());
            from = end;
            continue;
        }
        const auto section =
            std::find_if(sections.begin(), sections.end(), [&](const auto& s) { return s.name == name; });
        if (section == sections.end()) throw InputError("", fmt::format("the schema has no section `{}`", name));
        placed[static_cast<std::size_t>(section - sections.begin())] = true;
        text += document.substr(from, name_end + 5 - from);
        text += fmt::format("\n{}\n", deck::key_table(*section));
        from = end;
    }
    text += document.substr(from);
    for (std::size_t i = 0; i < sections.size(); ++i) {
        if (!placed[i])
            throw InputError("", fmt::format("the reference has no place for the keys of `{}`", sections[i].name));
    }
    return text;
}

}  // namespace gneiss
