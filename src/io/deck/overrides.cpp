#include "io/deck/overrides.hpp"

#include <fmt/format.h>

#include <charconv>

namespace gneiss::deck {
namespace {

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    const auto last = text.find_last_not_of(" \t");
    return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

/// material[0].density → material.0.density
std::string dotted(std::string_view key) {
    std::string text;
    for (char c : key) {
        if (c == '[')
            text += '.';
        else if (c != ']')
            text += c;
    }
    return text;
}

std::string escaped(std::string_view text) {
    std::string result = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

/// The argument as TOML of its own: nested tables down to the one value.
toml::table parsed(const std::string& key, const std::string& value, const std::string& place) {
    if (value.find('\n') == std::string::npos) {
        try {
            return toml::parse(key + " = " + value, place);
        } catch (const toml::parse_error&) {
            const bool looks_like_toml =
                value.empty() || std::string_view("\"'[{").find(value.front()) != std::string_view::npos;
            if (looks_like_toml) throw;
        }
    }
    return toml::parse(key + " = " + escaped(value), place);
}

/// Follows the one path of `source` into `target`, and moves what lies beyond what exists.
/// @return what is wrong, or empty
std::string lay_over(toml::node& target, toml::table& source, const std::string& path) {
    const std::string name(source.cbegin()->first.str());
    toml::node& node = *source.get(name);
    const std::string here = target.is_array() ? fmt::format("{}[{}]", path, name)
                             : path.empty()    ? name
                                               : fmt::format("{}.{}", path, name);
    toml::node* existing = nullptr;
    if (toml::table* table = target.as_table()) {
        existing = table->get(name);
        if (existing == nullptr || !node.is_table() || node.as_table()->is_inline()) {
            node.visit([&](auto& any) { table->insert_or_assign(name, std::move(any)); });
            return {};
        }
    } else if (toml::array* array = target.as_array()) {
        std::size_t index = 0;
        const auto end = name.data() + name.size();
        if (std::from_chars(name.data(), end, index).ptr != end || index >= array->size()) {
            return fmt::format("key `{}`: there is none, `{}` has {} element{}", here, path, array->size(),
                               array->size() == 1 ? "" : "s");
        }
        existing = array->get(index);
        if (!node.is_table() || node.as_table()->is_inline()) {
            node.visit([&](auto& any) {
                array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), std::move(any));
            });
            return {};
        }
    } else {
        return fmt::format("key `{}`: `{}` holds a single value, nothing can be set inside it", here, path);
    }
    return lay_over(*existing, *node.as_table(), here);
}

}  // namespace

void apply_override(toml::table& deck, const std::string& argument, Findings& findings) {
    const std::string place = std::string(Position::override_prefix) + argument;
    const std::size_t equals = argument.find('=');
    const std::string key = dotted(trimmed(std::string_view(argument).substr(0, equals)));
    if (equals == std::string::npos || key.empty()) {
        findings.add({place}, "must be of the form key=value, as in run.t_end=0.01");
        return;
    }
    try {
        toml::table source = parsed(key, trimmed(std::string_view(argument).substr(equals + 1)), place);
        if (const std::string wrong = lay_over(deck, source, ""); !wrong.empty()) findings.add({place}, wrong);
    } catch (const toml::parse_error& error) {
        findings.add({place}, std::string(error.description()));
    }
}

}  // namespace gneiss::deck
