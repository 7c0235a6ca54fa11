#pragma once
// The kinds of keys from which sections are made. Each builder takes the member it fills and reads the default from a
// default-constructed struct.

#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/suggest.hpp"
#include "io/deck/choices.hpp"
#include "io/deck/schema.hpp"

namespace gneiss::deck {

/// What a section says about a key beyond its name, type and default.
struct Spec {
    std::string_view unit = {};
    Range range = {};
    bool required = false;
    std::string_view or_else = {};
    std::vector<Condition> only_for = {};
    std::vector<Condition> needed_for = {};
    std::string_view meaning;
};

inline std::string written(double value) { return fmt::format("{}", value); }
inline std::string written(int value) { return fmt::format("{}", value); }
inline std::string written(bool value) { return value ? "true" : "false"; }
/// Empty for an empty string, which a deck expresses by leaving the key out.
inline std::string written(const std::string& value) { return value.empty() ? "" : fmt::format("\"{}\"", value); }
inline std::string written(const Formula& value) {
    return value.constant ? value.text : fmt::format("\"{}\"", value.text);
}
template <class E, std::size_t n>
std::string written(const std::array<E, n>& values) {
    std::string text;
    for (const E& value : values) text += (text.empty() ? "" : ", ") + written(value);
    return "[" + text + "]";
}

inline KeyDoc document(std::string_view name, std::string_view type, std::string default_text, const Spec& spec) {
    KeyDoc doc;
    doc.name = name;
    doc.type = type;
    doc.unit = spec.unit;
    doc.range = spec.range;
    doc.default_text = spec.required ? std::string() : std::move(default_text);
    doc.meaning = spec.meaning;
    doc.required = spec.required;
    doc.or_else = spec.or_else;
    doc.only_for = spec.only_for;
    doc.needed_for = spec.needed_for;
    return doc;
}

/// A key read by a function of one's own.
template <class T, class Read>
Key<T> custom(std::string_view name, std::string_view type, std::string default_text, const Spec& spec, Read read) {
    return {document(name, type, std::move(default_text), spec), std::move(read)};
}

template <class T>
Key<T> number(std::string_view name, double T::*member, const Spec& spec) {
    return custom<T>(name, "a number", written(T{}.*member), spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return value.read(out.*member, NumberRule{range, unit});
                     });
}

/// A number that may be left out without having a value then.
template <class T>
Key<T> number(std::string_view name, std::optional<double> T::*member, const Spec& spec) {
    return custom<T>(name, "a number", "", spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return value.read((out.*member).emplace(), NumberRule{range, unit});
                     });
}

template <class T>
Key<T> integer(std::string_view name, int T::*member, const Spec& spec) {
    return custom<T>(name, "an integer", written(T{}.*member), spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return value.read(out.*member, NumberRule{range, unit});
                     });
}

template <class T>
Key<T> boolean(std::string_view name, bool T::*member, const Spec& spec) {
    return custom<T>(name, "a boolean", written(T{}.*member), spec,
                     [=](const Value& value, TableReader&, T& out) { return value.read(out.*member); });
}

template <class T>
Key<T> string(std::string_view name, std::string T::*member, const Spec& spec) {
    return custom<T>(name, "a string", written(T{}.*member), spec,
                     [=](const Value& value, TableReader&, T& out) { return value.read(out.*member); });
}

/// A number or an expression of the variables ("xy", "xyt").
template <class T>
Key<T> formula(std::string_view name, Formula T::*member, std::string_view variables, const Spec& spec) {
    return custom<T>(name, "a number or an expression", written(T{}.*member), spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return value.read(out.*member, NumberRule{range, unit}, variables);
                     });
}

template <std::size_t n>
bool read_formulas(const Value& value, std::array<Formula, n>& out, const NumberRule& rule,
                   std::string_view variables) {
    const auto values = value.elements(n, "numbers or expressions");
    bool good = values.has_value();
    for (std::size_t i = 0; values && i < n; ++i) good = (*values)[i].read(out[i], rule, variables) && good;
    return good;
}

template <class T, std::size_t n>
Key<T> formulas(std::string_view name, std::array<Formula, n> T::*member, std::string_view variables,
                const Spec& spec) {
    return custom<T>(name, fmt::format("an array of {} numbers or expressions", n), written(T{}.*member), spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return read_formulas(value, out.*member, NumberRule{range, unit}, variables);
                     });
}

/// Formulas that may be left out without having a value then.
template <class T, std::size_t n>
Key<T> formulas(std::string_view name, std::optional<std::array<Formula, n>> T::*member, std::string_view variables,
                const Spec& spec) {
    return custom<T>(name, fmt::format("an array of {} numbers or expressions", n), "", spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return read_formulas(value, (out.*member).emplace(), NumberRule{range, unit}, variables);
                     });
}

template <class T, std::size_t n>
Key<T> numbers(std::string_view name, std::array<double, n> T::*member, const Spec& spec) {
    return custom<T>(name, fmt::format("an array of {} numbers", n), written(T{}.*member), spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return value.read(std::span<double>(out.*member), NumberRule{range, unit});
                     });
}

template <class T, std::size_t n>
Key<T> numbers(std::string_view name, std::optional<std::array<double, n>> T::*member, const Spec& spec) {
    return custom<T>(name, fmt::format("an array of {} numbers", n), "", spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return value.read(std::span<double>((out.*member).emplace()), NumberRule{range, unit});
                     });
}

/// Any number of numbers.
template <class T>
Key<T> numbers(std::string_view name, std::vector<double> T::*member, const Spec& spec) {
    return custom<T>(name, "an array of numbers", "[]", spec,
                     [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, T& out) {
                         return value.read(out.*member, NumberRule{range, unit});
                     });
}

/// Reads one of the words; remembers it for the conditions of other keys.
template <class E>
const Choice<E>* read_choice(const Value& value, Choices<E> choices) {
    std::vector<std::string_view> names;
    std::string allowed;
    for (const Choice<E>& choice : choices) {
        names.push_back(choice.name);
        allowed += fmt::format("{}\"{}\"", allowed.empty() ? "" : ", ", choice.name);
    }
    const auto* word = value.node().as_string();
    for (const Choice<E>& choice : choices) {
        if (word != nullptr && word->get() == choice.name) return &choice;
    }
    std::string must = (choices.size() > 1 ? "one of " : "") + allowed;
    value.refuse(must + (word ? suggestion(word->get(), names) : ""));
    return nullptr;
}

/// One of several words, handed to `set(out, value)`; `current(T)` gives the default, if there is one.
template <class T, class E, std::size_t n, class Set>
Key<T> choice(std::string_view name, const std::array<Choice<E>, n>& choices, std::string_view default_name, Set set,
              const Spec& spec) {
    const std::string default_text = default_name.empty() ? "" : fmt::format("\"{}\"", default_name);
    Key<T> key =
        custom<T>(name, "one of", default_text, spec,
                  [&choices, set, key_name = std::string(name)](const Value& value, TableReader& table, T& out) {
                      const Choice<E>* found = read_choice(value, Choices<E>(choices));
                      if (found == nullptr) return false;
                      table.choose(key_name, found->name);
                      set(out, found->value);
                      return true;
                  });
    for (const Choice<E>& word : choices) key.doc.words.push_back({word.name, word.meaning});
    return key;
}

template <class T, class E, std::size_t n>
Key<T> choice(std::string_view name, E T::*member, const std::array<Choice<E>, n>& choices, const Spec& spec) {
    return choice<T>(
        name, choices, name_of(choices, T{}.*member), [=](T& out, const E& value) { out.*member = value; }, spec);
}

/// Reads a table into `out`; reports if the value is none.
template <class S>
bool read_table(const Value& value, const Section<S>& section, S& out) {
    const toml::table* content = value.node().as_table();
    if (content == nullptr) {
        value.refuse("a table");
        return false;
    }
    TableReader table(value.findings(), *content, value.where(), value.key());
    read_section(section, table, out);
    return true;
}

template <class T, class S>
Key<T> table(std::string_view name, S T::*member, const Section<S>& (*section)(), const Spec& spec) {
    return custom<T>(name, "a table", "", spec, [=](const Value& value, TableReader&, T& out) {
        return read_table(value, section(), out.*member);
    });
}

/// A table that may be left out without anything standing for it then.
template <class T, class S>
Key<T> table(std::string_view name, std::optional<S> T::*member, const Section<S>& (*section)(), const Spec& spec) {
    return custom<T>(name, "a table", "", spec, [=](const Value& value, TableReader&, T& out) {
        return read_table(value, section(), (out.*member).emplace());
    });
}

/// A table whose keys fill members of the same struct.
template <class T>
Key<T> table(std::string_view name, const Section<T>& (*section)(), const Spec& spec) {
    return custom<T>(name, "a table", "", spec,
                     [=](const Value& value, TableReader&, T& out) { return read_table(value, section(), out); });
}

template <class T, class S>
Key<T> tables(std::string_view name, std::vector<S> T::*member, const Section<S>& (*section)(), const Spec& spec) {
    return custom<T>(name, "an array of tables", "", spec, [=](const Value& value, TableReader&, T& out) {
        if (value.node().is_table()) {
            value.problem(fmt::format("given one table, must be an array of tables: [[{}]], with two brackets each",
                                      value.key()));
            return false;
        }
        const auto values = value.elements(std::nullopt, "tables");
        if (!values) return false;
        bool good = true;
        for (const Value& element : *values)
            good = read_table(element, section(), (out.*member).emplace_back()) && good;
        return good;
    });
}

}  // namespace gneiss::deck
