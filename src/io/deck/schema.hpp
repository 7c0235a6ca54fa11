#pragma once
// What a deck may contain, as data. One list of keys per table of the deck; reading, checking and docs/deck.md all come
// from it. Defaults are taken from the option structs themselves and are never written twice.

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/deck/value.hpp"

namespace gneiss::deck {

/// A key applies only where another key of its table has one of these words; without words: where that key is given.
struct Condition {
    std::string_view key;
    std::vector<std::string_view> words;
};

/// A word and its meaning, for the reference.
struct Word {
    std::string_view name, meaning;
};

/// What the reference says about a key, and what decides whether it must, may or must not be given.
struct KeyDoc {
    std::string name;
    std::string type;
    std::string unit;
    Range range;
    std::string default_text;  ///< as it would be written in a deck; empty: none
    std::string meaning;
    bool required = false;
    std::string or_else;                ///< required unless this key is given
    std::vector<Condition> only_for;    ///< any of them; empty: always
    std::vector<Condition> needed_for;  ///< required where any of them holds
    std::vector<Word> words;            ///< the allowed words, of a choice

    NumberRule rule() const { return {range, unit}; }
};

/// One table of the deck while it is read.
class TableReader {
public:
    /// @param table   its keys; @param where  stands for the table in messages; @param path  its name, empty for the
    /// deck
    TableReader(Findings& findings, const toml::table& table, Position where, std::string path)
        : findings_(findings), table_(table), where_(std::move(where)), path_(std::move(path)) {}

    Findings& findings() const { return findings_; }
    const toml::table& table() const { return table_; }
    const Position& where() const { return where_; }
    std::string path_of(std::string_view key) const;

    bool given(std::string_view key) const { return table_.contains(key) && !left_out_.contains(key); }
    bool failed(std::string_view key) const { return failed_.contains(key); }
    /// The value of a key that is given.
    Value value(std::string_view key) const;

    /// Reports about a key, at its value or, where it is not given, at the table.
    void problem(std::string_view key, std::string_view message) const;

    /// Reports keys that are not known. The known key that an unknown one seems to mean counts as failed, not as
    /// missing.
    void refuse_unknown(const std::vector<std::string_view>& known);
    bool has_unknown() const { return has_unknown_; }
    void missing(const KeyDoc& key);
    void mark_failed(std::string_view key) { failed_.emplace(key); }
    void choose(std::string_view key, std::string_view word) { chosen_[std::string(key)] = word; }
    std::string_view chosen(std::string_view key) const;

    enum class Holds { yes, no, unknown };
    /// Whether any of the conditions holds; unknown where a key they look at is itself wrong.
    Holds any_of(const std::vector<Condition>& conditions) const;
    /// Reports a key that the choices made in this table leave without meaning.
    /// @param way_out  what to do about it, from the `;` on; may be empty
    void out_of_place(const KeyDoc& key, std::string_view way_out) const;

    /// A key whose value was laid over the deck, or is one of a list of values: what it leaves without meaning in the
    /// table is no mistake of the deck.
    void mark_swapped(std::string_view key) { swapped_.emplace(key); }
    /// Leaves a given key out, with a note, if one of the keys that decide on it has been swapped and the key itself
    /// has not. @return false: nothing of the kind, the key is a mistake
    bool leave_out(std::string_view key, const std::vector<std::string_view>& deciders, std::string_view why);
    /// The same for a key that the choices made in this table leave without meaning.
    bool leave_out(const KeyDoc& key);
    /// Keys that were left out.
    const std::set<std::string, std::less<>>& left_out() const { return left_out_; }

private:
    Findings& findings_;
    const toml::table& table_;
    Position where_;
    std::string path_;
    std::string why_out_of_place(const KeyDoc& key) const;
    bool is_swapped(std::string_view key) const;

    std::set<std::string, std::less<>> failed_, swapped_, left_out_;
    bool has_unknown_ = false;
    std::map<std::string, std::string_view, std::less<>> chosen_;
};

template <class T>
struct Key {
    KeyDoc doc;
    /// Reads the value into the options; false if it reported a problem.
    std::function<bool(const Value&, TableReader&, T&)> read;
};

inline constexpr std::string_view swap_way_out =
    "; delete it, or leave the deck as it was and exchange the word by --set, which leaves such keys out";

/// A table of the deck. `check` looks at combinations once all its keys have been read.
template <class T>
struct Section {
    std::vector<Key<T>> keys;
    std::function<void(TableReader&, T&)> check = {};
    /// One word may be exchanged by --set, or in a list of values: keys that it leaves without meaning are left out
    /// with a note. Elsewhere they are mistakes, always.
    bool swaps = false;
};

/// Reads one table into `out`, reporting everything that is wrong with it.
template <class T>
void read_section(const Section<T>& section, TableReader& table, T& out) {
    std::vector<std::string_view> known;
    for (const Key<T>& key : section.keys) known.push_back(key.doc.name);
    table.refuse_unknown(known);
    for (const Key<T>& key : section.keys) {
        const KeyDoc& doc = key.doc;
        const bool given = table.given(doc.name);
        const auto applies = doc.only_for.empty() ? TableReader::Holds::yes : table.any_of(doc.only_for);
        if (applies == TableReader::Holds::no) {
            if (given && section.swaps && table.leave_out(doc)) continue;
            if (given) table.out_of_place(doc, section.swaps ? swap_way_out : "");
            if (given) table.mark_failed(doc.name);
            continue;
        }
        if (given) {
            if (!key.read(table.value(doc.name), table, out)) table.mark_failed(doc.name);
            continue;
        }
        const bool needed = applies == TableReader::Holds::yes && !table.failed(doc.name) &&
                            ((doc.required && (doc.or_else.empty() || !table.given(doc.or_else))) ||
                             table.any_of(doc.needed_for) == TableReader::Holds::yes);
        if (needed) table.missing(doc);
        if (table.failed(doc.name)) continue;
        for (const Word& word : doc.words) {
            if (doc.default_text == '"' + std::string(word.name) + '"') table.choose(doc.name, word.name);
        }
    }
    if (section.check) section.check(table, out);
}

/// Where a key called `name` lives in the deck, for suggestions: "[run]"; empty if nowhere. Defined with the sections.
std::string home_of(std::string_view name);
/// Whether the deck itself has a key of this name: "run".
bool is_key_of_deck(std::string_view name);

}  // namespace gneiss::deck
