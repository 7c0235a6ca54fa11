// The table [compare]: schemes with their settings, and what they are measured against.

#include <map>
#include <set>
#include <sstream>

#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"

namespace gneiss::deck {
namespace {

/// As TOML, numbers by their shortest decimals that read back alike.
std::string value_text(const toml::node& node) {
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    std::ostringstream text;
    node.visit([&](const auto& value) { text << toml::toml_formatter(value); });
    return text.str();
}

std::string inline_toml(const toml::table& table) {
    std::string text;
    for (const auto& [key, node] : table)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", std::string_view(key.str()), value_text(node));
    return "{ " + text + " }";
}

using Keys = std::set<std::string, std::less<>>;

/// Reads one [integrator] table into a variant.
/// @param varied  the key that has one of several values here; empty: none has
/// @return keys that were left out
Keys read_variant(const Value& value, toml::table content, std::string_view varied, std::string setting,
                  SchemeVariant& out) {
    TableReader table(value.findings(), content, value.where(), value.key());
    if (!varied.empty()) table.mark_swapped(varied);
    read_section(integrator_section(), table, out.integrator);
    const Keys left_out = table.left_out();
    out.setting = std::move(setting);
    for (const std::string& key : left_out) content.erase(key);
    out.toml = inline_toml(content);
    return left_out;
}

const toml::table* table_of(const Value& value) {
    const toml::table* content = value.node().as_table();
    if (content == nullptr) value.refuse("a table with keys of [integrator]");
    return content;
}

/// One table of [integrator] keys, one of which may have a list of values: a variant for each of them.
bool read_variants(const Value& value, TableReader&, SchemeOptions& out) {
    const toml::table* content = table_of(value);
    if (content == nullptr) return false;
    const toml::array* list = nullptr;
    std::string varied;
    for (const auto& [key, node] : *content) {
        const toml::array* array = node.as_array();
        if (array == nullptr) continue;
        if (list != nullptr || array->empty()) {
            value.problem(list != nullptr ? fmt::format("`{}` and `{}` both have a list of values, one key may", varied,
                                                        std::string_view(key.str()))
                                          : fmt::format("`{}` has an empty list", std::string_view(key.str())));
            return false;
        }
        list = array;
        varied = key.str();
    }
    if (list == nullptr) {
        read_variant(value, *content, "", "", out.variants.emplace_back());
        return true;
    }
    std::map<std::string, std::size_t, std::less<>> times_left_out;
    for (const toml::node& element : *list) {
        toml::table one = *content;
        element.visit([&](const auto& any) { one.insert_or_assign(varied, any); });
        for (const std::string& key :
             read_variant(value, one, varied, varied + " = " + value_text(element), out.variants.emplace_back()))
            ++times_left_out[key];
    }
    for (const auto& [key, times] : times_left_out)
        if (times == list->size()) value.problem(fmt::format("`{}` fits none of the values of `{}`", key, varied));
    return true;
}

bool read_reference(const Value& value, TableReader&, CompareOptions& out) {
    const toml::table* content = table_of(value);
    if (content == nullptr) return false;
    read_variant(value, *content, "", "", out.reference.emplace());
    return true;
}

}  // namespace

const Section<SchemeOptions>& scheme_section() {
    using S = SchemeOptions;
    static const Section<S> section{
        {string("name", &S::name, {.required = true, .meaning = "in tables and figures; no two alike"}),
         custom<S>("integrator", "a table", "",
                   {.required = true,
                    .meaning = "keys of `[integrator]`; one of them may have a list of values: a run for each"},
                   read_variants)}};
    return section;
}

const Section<ExactOptions>& exact_section() {
    using E = ExactOptions;
    static const Section<E> section{
        {formulas("displacement", &E::displacement, "xyt", {.unit = "m", .required = true, .meaning = "[u_x, u_y]"}),
         formulas("velocity", &E::velocity, "xyt", {.unit = "m/s", .required = true, .meaning = "[v_x, v_y]"}),
         formulas("stress", &E::stress, "xyt",
                  {.unit = "Pa", .meaning = "Cauchy's, [xx, yy, xy]; left out: stresses have no error"})}};
    return section;
}

const Section<CompareOptions>& compare_section() {
    using C = CompareOptions;
    static const Section<C> section{
        {integer("samples", &C::samples,
                 {.range = at_least(1),
                  .meaning = "states that are compared, equally far apart in time, the last at the end"}),
         custom<C>("reference", "a table", "",
                   {.required = true,
                    .or_else = "exact",
                    .meaning = "keys of `[integrator]`: the run that all others are measured against"},
                   read_reference),
         table("exact", &C::exact, exact_section, {.meaning = "a solution in closed form, in place of a reference"}),
         tables("scheme", &C::schemes, scheme_section,
                {.required = true, .meaning = "schemes, one `[[compare.scheme]]` each"})},
        [](TableReader& table, C& out) {
            if (out.reference && out.exact)
                table.problem("exact", "there is a `reference` already: errors are measured against one of them");
            if (table.failed("scheme")) return;
            if (out.schemes.empty()) table.problem("scheme", "given none, must be at least one [[compare.scheme]]");
            for (std::size_t i = 0; i < out.schemes.size(); ++i)
                for (std::size_t k = 0; k < i; ++k)
                    if (out.schemes[i].name == out.schemes[k].name)
                        table.problem("scheme", fmt::format("the name \"{}\" is given twice", out.schemes[i].name));
        }};
    return section;
}

}  // namespace gneiss::deck
