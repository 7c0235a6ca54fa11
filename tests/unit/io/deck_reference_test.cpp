// The schema against docs/deck.md, the option structs and decks that use every key.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "base/errors.hpp"
#include "io/deck/deck.hpp"
#include "io/deck/sections.hpp"
#include "unit/io/full_decks.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Full names of the keys in a parsed deck, array positions left out.
void collect(const toml::node& node, const std::string& path, std::set<std::string>& names) {
    if (const auto* table = node.as_table()) {
        for (const auto& [key, value] : *table) {
            const std::string name = path.empty() ? std::string(key.str()) : path + "." + std::string(key.str());
            names.insert(name);
            collect(value, name, names);
        }
    } else if (const auto* array = node.as_array()) {
        for (const toml::node& element : *array) collect(element, path, names);
    }
}

std::string read(const std::string& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

TEST(DeckReference, EveryKey_IsAcceptedInSomeDeck) {
    std::set<std::string> used;
    for (const char* deck : test::full_decks) {
        EXPECT_NO_THROW(parse_deck(deck, "full.toml"));
        collect(toml::parse(deck), "", used);
    }
    std::vector<std::string> unused;
    for (const std::string& key : deck_keys()) {
        const bool also_in_boundary = key.starts_with("boundary.amplitude.") || key.starts_with("load.amplitude.") ||
                                      key.starts_with("lumped.amplitude.");
        const std::string bare = key.substr(key.rfind('.') + 1);
        if (used.contains(key) || (also_in_boundary && (used.contains("load.amplitude." + bare) ||
                                                        used.contains("boundary.amplitude." + bare)))) {
            continue;
        }
        unused.push_back(key);
    }
    EXPECT_THAT(unused, IsEmpty());
}

/// With GNEISS_RENEW_DECK_REFERENCE set, writes docs/deck.md instead of comparing.
TEST(DeckReference, Document_IsWhatTheSchemaSays) {
    const std::string file = GNEISS_DECK_REFERENCE;
    const std::string document = read(file);
    const std::string renewed = renew_deck_reference(document);
    if (std::getenv("GNEISS_RENEW_DECK_REFERENCE") != nullptr)
        std::ofstream(file) << renewed;
    else
        EXPECT_EQ(document, renewed) << "renew it by GNEISS_RENEW_DECK_REFERENCE=1 test_deck";
    for (const std::string& key : deck_keys())
        EXPECT_THAT(renewed, HasSubstr(fmt::format("`{}`", key.substr(key.rfind('.') + 1))));
}

TEST(DeckReference, EveryKey_HasTypeAndMeaning) {
    for (const deck::SectionDoc& section : deck::section_docs()) {
        for (const deck::KeyDoc& key : section.keys) {
            EXPECT_NE(key.type, "") << section.name << "." << key.name;
            EXPECT_NE(key.meaning, "") << section.name << "." << key.name;
            for (const deck::Word& word : key.words) EXPECT_NE(word.meaning, "") << word.name;
        }
    }
}

TEST(DeckReference, PlaceLost_Throws) {
    EXPECT_THROW(renew_deck_reference("nothing"), InputError);
    std::string document = renew_deck_reference(read(GNEISS_DECK_REFERENCE));
    const std::string place = "<!-- keys of run -->";
    document.replace(document.find(place), place.size(), "<!-- keys of rnu -->");
    EXPECT_THROW(renew_deck_reference(document), InputError);
}

/// The ten-line deck and every other whole deck shown in the document must be accepted as printed.
TEST(DeckReference, DecksInTheDocument_AreAccepted) {
    const std::string document = read(GNEISS_DECK_REFERENCE);
    const std::string opening = "```toml\n";
    int wholes = 0;
    for (std::size_t at = 0; (at = document.find(opening, at)) != std::string::npos;) {
        at += opening.size();
        const std::string text = document.substr(at, document.find("```", at) - at);
        if (text.find("t_end") == std::string::npos) {
            EXPECT_NO_THROW(static_cast<void>(toml::parse(text))) << text;
        } else {
            EXPECT_NO_THROW(parse_deck(text, "deck.md")) << text;
            ++wholes;
        }
    }
    EXPECT_GE(wholes, 2);
}

/// Every written default, read from a deck, gives the same options as leaving the key out would.
TEST(DeckReference, WrittenDefaults_AreTheStructsDefaults) {
    const auto defaults = [](const std::string& name, const std::string& only_for = {}) {
        std::string text;
        for (const deck::SectionDoc& section : deck::section_docs()) {
            if (section.name != name) continue;
            for (const deck::KeyDoc& key : section.keys) {
                const bool applies = only_for.empty() || key.only_for.empty() ||
                                     std::ranges::find(key.only_for[0].words, only_for) != key.only_for[0].words.end();
                if (!key.default_text.empty() && applies) text += key.name + " = " + key.default_text + "\n";
            }
        }
        return text;
    };
    const std::string deck = "[mesh]\nfile = \"a.msh\"\n[solid]\nplane = \"stress\"\n" + defaults("solid") +
                             "[[material]]\ndensity = 1\nconstants = { E = 1, nu = 0 }\nform = \"hypo\"\n" +
                             "in_situ_stress = [0, 0, 0]\nviscosity = { shear = 0, bulk = 0 }\n[integrator]\n" +
                             defaults("integrator", "central_difference") + "[run]\nt_end = 1\n" + defaults("run") +
                             "[output]\n" + defaults("output");
    const CaseOptions read = parse_deck(deck, "defaults.toml");
    const SolidOptions solid;
    EXPECT_EQ(read.solid.compt, solid.compt);
    EXPECT_EQ(read.solid.thickness, solid.thickness);
    EXPECT_EQ(read.solid.volumetric, solid.volumetric);
    const IntegratorOptions integrator;
    EXPECT_EQ(read.integrator.type, integrator.type);
    EXPECT_EQ(read.integrator.safety, integrator.safety);
    EXPECT_EQ(read.integrator.dt, integrator.dt);
    EXPECT_EQ(read.integrator.lanczos, integrator.lanczos);
    std::string of_statics = defaults("integrator", "quasi_static");
    of_statics.replace(of_statics.find("central_difference"), 18, "quasi_static");
    const IntegratorOptions statics =
        parse_deck(
            "[mesh]\nfile = \"a.msh\"\n[solid]\nplane = \"stress\"\n[[material]]\ndensity = 1\nconstants = "
            "{ E = 1, nu = 0 }\n[integrator]\n" +
                of_statics + "[run]\nt_end = 1\n",
            "defaults.toml")
            .integrator;
    EXPECT_EQ(statics.type, "quasi_static");
    EXPECT_EQ(statics.tolerance, integrator.tolerance);
    EXPECT_EQ(statics.step, integrator.step);
    EXPECT_EQ(statics.longest, integrator.longest);
    EXPECT_EQ(statics.shortest, integrator.shortest);
    EXPECT_EQ(statics.most_iterations, integrator.most_iterations);
    EXPECT_EQ(statics.solver, integrator.solver);
    const auto check_scheme = [&](const std::string& type) {
        std::string text = defaults("integrator", type);
        text.replace(text.find("central_difference"), 18, type);
        const IntegratorOptions scheme =
            parse_deck(
                "[mesh]\nfile = \"a.msh\"\n[solid]\nplane = \"stress\"\n[[material]]\ndensity = 1\nconstants = "
                "{ E = 1, nu = 0 }\n[integrator]\n" +
                    text + "[run]\nt_end = 1\n",
                "defaults.toml")
                .integrator;
        EXPECT_EQ(scheme.rho_inf, integrator.rho_inf);
        EXPECT_EQ(scheme.beta, integrator.beta);
        EXPECT_EQ(scheme.gamma, integrator.gamma);
        EXPECT_EQ(scheme.alpha, integrator.alpha);
        EXPECT_EQ(scheme.adaptive, integrator.adaptive);
        EXPECT_EQ(scheme.interface_tolerance, integrator.interface_tolerance);
        EXPECT_EQ(scheme.adams, integrator.adams);
        EXPECT_EQ(scheme.functional, integrator.functional);
        EXPECT_EQ(scheme.stability_detection, integrator.stability_detection);
        EXPECT_EQ(scheme.table, integrator.table);
        EXPECT_EQ(scheme.max_order, integrator.max_order);
        EXPECT_EQ(scheme.rtol, integrator.rtol);
        EXPECT_EQ(scheme.stress_scale, integrator.stress_scale);
    };
    for (const char* type : {"generalized_alpha", "newmark", "hht_alpha", "cvode", "arkode", "ida"}) check_scheme(type);
    EXPECT_EQ(read.run.checkpoint, RunOptions{}.checkpoint);
    EXPECT_EQ(read.run.mass_damping, RunOptions{}.mass_damping);
    EXPECT_EQ(read.output.fields, OutputOptions{}.fields);
    EXPECT_EQ(read.output.history, OutputOptions{}.history);
    EXPECT_EQ(read.output.field_times, OutputOptions{}.field_times);
}

TEST(DeckListings, EveryTopic_HasEntriesWithMeanings) {
    std::set<std::string> topics;
    for (const Listing& listing : deck_listings()) {
        topics.insert(listing.topic);
        EXPECT_FALSE(listing.entries.empty()) << listing.topic;
        for (const auto& entry : listing.entries) EXPECT_FALSE(entry.name.empty() || entry.meaning.empty());
    }
    for (const char* topic :
         {"elements", "materials", "integrators", "loads", "boundaries", "lumped models", "amplitudes"}) {
        EXPECT_TRUE(topics.contains(topic)) << topic;
    }
}

}  // namespace
}  // namespace gneiss
