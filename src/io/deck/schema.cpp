#include "io/deck/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/suggest.hpp"

namespace gneiss::deck {
namespace {

std::string quoted_list(const std::vector<std::string_view>& names, char quote) {
    std::string text;
    for (std::string_view name : names) text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", quote, name, quote);
    return text;
}

std::string condition_text(const std::vector<Condition>& conditions) {
    std::string text;
    for (const Condition& condition : conditions) {
        text += fmt::format("{}`{}`", text.empty() ? "" : " or ", condition.key);
        if (!condition.words.empty()) text += " = " + quoted_list(condition.words, '"');
    }
    return text;
}

constexpr std::string_view no_file =
    "no file is read here, its numbers belong into the deck: type = \"table\", times = […], values = […]";
constexpr std::string_view harmonic = "type = \"expression\", expression = \"sin(2*pi*50*t)\"";
constexpr std::string_view factor =
    "the magnitude is `value` of the load or the boundary, an amplitude is a factor on it";

/// A key that people expect in a table, and what to write instead.
struct ForeignKey {
    std::string_view table, key, meaning;
};
constexpr std::array<ForeignKey, 12> foreign_keys{{
    {"amplitude", "file", no_file},
    {"amplitude", "data", no_file},
    {"amplitude", "points", no_file},
    {"amplitude", "value", factor},
    {"amplitude", "scale", factor},
    {"amplitude", "frequency", harmonic},
    {"amplitude", "period", harmonic},
    {"amplitude", "omega", harmonic},
    {"amplitude", "time", "`start` of a heaviside or a ramp, `times` of a table"},
    {"amplitude", "duration", "`start` and `end` of a ramp"},
    {"amplitude", "formula", "write `expression`"},
    {"amplitude", "function", "write `expression`"},
}};

/// Empty: nobody expects it there.
std::string_view expected_at(std::string_view path, std::string_view key) {
    const auto found = std::ranges::find_if(
        foreign_keys, [&](const ForeignKey& one) { return path.ends_with(one.table) && one.key == key; });
    return found == foreign_keys.end() ? std::string_view{} : found->meaning;
}

}  // namespace

std::string TableReader::path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

Value TableReader::value(std::string_view key) const { return {findings_, *table_.get(key), path_of(key), where_}; }

void TableReader::problem(std::string_view key, std::string_view message) const {
    const toml::node* node = table_.get(key);
    findings_.add(node ? position_of(node->source(), where_) : where_,
                  fmt::format("key `{}`: {}", path_of(key), message));
}

void TableReader::refuse_unknown(const std::vector<std::string_view>& known) {
    for (const auto& [key, node] : table_) {
        const std::string_view name = key.str();
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        has_unknown_ = true;
        if (const std::string_view meant = nearest(name, known); !meant.empty() && !given(meant)) mark_failed(meant);
        std::string hint = suggestion(name, known);
        if (const std::string home = home_of(name); !home.empty()) hint = fmt::format(", it belongs to {}", home);
        if (!path_.empty() && is_key_of_deck(name))
            hint = fmt::format(
                ", `{}` belongs to the deck itself: what stands below a [table] is part of it, so write it above all "
                "tables, or as a [table] of its own",
                name);
        if (const std::string_view expected = expected_at(path_, name); !expected.empty())
            hint = fmt::format(": {}", expected);
        if (hint.empty()) hint = ", allowed: " + quoted_list(known, '`');
        findings_.add(position_of(key.source(), position_of(node.source(), where_)),
                      fmt::format("key `{}`: unknown{}", path_of(name), hint));
    }
}

void TableReader::missing(const KeyDoc& key) {
    mark_failed(key.name);
    std::string must = key.type + (key.words.empty() ? key.range.requirement(key.unit) : "");
    for (const Word& word : key.words)
        must += fmt::format("{}\"{}\"", &word == &key.words.front() ? " " : ", ", word.name);
    const std::string alternative = key.or_else.empty() ? "" : fmt::format(" (or `{}`)", key.or_else);
    problem(key.name, fmt::format("missing{}, must be {}", alternative, must));
}

std::string_view TableReader::chosen(std::string_view key) const {
    const auto found = chosen_.find(key);
    return found == chosen_.end() ? std::string_view() : found->second;
}

TableReader::Holds TableReader::any_of(const std::vector<Condition>& conditions) const {
    Holds holds = Holds::no;
    for (const Condition& condition : conditions) {
        if (failed(condition.key)) {
            holds = Holds::unknown;
        } else if (condition.words.empty() ? given(condition.key)
                                           : std::find(condition.words.begin(), condition.words.end(),
                                                       chosen(condition.key)) != condition.words.end()) {
            return Holds::yes;
        }
    }
    return holds;
}

std::string TableReader::why_out_of_place(const KeyDoc& key) const {
    const std::string_view decider = key.only_for.front().key;
    const std::string_view word = chosen(decider);
    return fmt::format("only for {}, here `{}` is {}", condition_text(key.only_for), decider,
                       word.empty() ? "not given" : fmt::format("\"{}\"", word));
}

void TableReader::out_of_place(const KeyDoc& key, std::string_view way_out) const {
    problem(key.name, why_out_of_place(key) + std::string(way_out));
}

bool TableReader::is_swapped(std::string_view key) const {
    const toml::node* node = table_.get(key);
    return swapped_.contains(key) || (node != nullptr && position_of(node->source(), where_).is_override());
}

bool TableReader::leave_out(std::string_view key, const std::vector<std::string_view>& deciders, std::string_view why) {
    const bool decided_elsewhere = std::ranges::any_of(
        deciders, [this](std::string_view decider) { return is_swapped(decider) || left_out_.contains(decider); });
    if (is_swapped(key) || !decided_elsewhere) return false;
    const toml::node* node = table_.get(key);
    findings_.note(position_of(node->source(), where_), path_of(key), fmt::format("left out, {}", why));
    left_out_.emplace(key);
    return true;
}

bool TableReader::leave_out(const KeyDoc& key) {
    std::vector<std::string_view> deciders;
    for (const Condition& condition : key.only_for) deciders.push_back(condition.key);
    return leave_out(key.name, deciders, why_out_of_place(key));
}

}  // namespace gneiss::deck
