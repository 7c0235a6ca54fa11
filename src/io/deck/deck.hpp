#pragma once
// Reading a deck: TOML text into CaseOptions. docs/deck.md is the reference of its keys.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/options.hpp"

namespace gneiss {

/// What is no mistake of a deck, and yet to be told, each with its place: keys that --set, or a list of values, has
/// left without meaning.
struct DeckNotes {
    std::vector<std::string> on_case, on_compare;
};

/// Reads and checks a deck. A mesh file named in it is taken relative to the deck's folder.
/// @param set  "key=value" each, laid over the deck before it is checked: "run.t_end=0.01",
///             "material.0.constants.M_v=1e9"; the value is TOML, a bare word is a string
/// @param[out] notes  if not null
/// @throws InputError with every problem of the deck, in the order of the file: "case.toml:12:11: key `run.t_end`: …",
///         those of `set` after them as "--set key=value: …". A syntax error of TOML comes alone, with its place.
CaseOptions read_deck(const std::filesystem::path& file, const std::vector<std::string>& set = {},
                      DeckNotes* notes = nullptr);

/// The same for text at hand; `name` stands for the file in messages, and a mesh file stays as it is written.
/// @param folder  where the mesh file has to be; none: nobody looks
CaseOptions parse_deck(std::string_view text, std::string name, const std::vector<std::string>& set = {},
                       const std::optional<std::filesystem::path>& folder = std::nullopt, DeckNotes* notes = nullptr);

/// The decks of a comparison: the case itself under one scheme after the other.
struct ComparisonDecks {
    struct Run {
        std::string scheme,
            setting;       ///< SchemeOptions::name, SchemeVariant::setting; of the reference: "reference", ""
        std::string deck;  ///< TOML: without [compare], frames and checkpoints, with states, files by their whole names
    };
    CaseOptions options;             ///< of the deck itself
    std::string problem;             ///< TOML: what all runs have in common, their decks without [integrator]
    std::vector<Run> runs;           ///< the reference first, where there is one
    std::optional<Run> check;        ///< the reference under another setting: how far can it be trusted?
    std::vector<std::string> notes;  ///< DeckNotes::on_compare
};
/// @throws InputError as read_deck does, and if there is nothing to compare
ComparisonDecks read_comparison(const std::filesystem::path& file, const std::vector<std::string>& set = {});

/// What `gneiss list` shows: the names a deck may use for one kind of thing, each with its meaning in one line.
struct Listing {
    struct Entry {
        std::string name, meaning;
    };
    std::string topic;  ///< "elements", "materials", …
    std::string where;  ///< the key that takes these names: "solid.element"
    std::vector<Entry> entries;
};
std::vector<Listing> deck_listings();

/// The text of docs/deck.md with every generated table renewed: between the lines `<!-- keys of NAME -->` and
/// `<!-- end -->`, NAME being the name of a section of the schema.
/// @throws InputError if a section has no such place in the text, or a place names no section
std::string renew_deck_reference(std::string_view document);

/// Every key of a deck by its full name, array positions left out: "material.constants.M_v".
std::vector<std::string> deck_keys();

}  // namespace gneiss
