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

namespace gneiss {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// Together these decks use every key of the schema.
const char* const full_decks[] = {
    R"toml(
title = "plate, transversely isotropic rock, hypo-elastic"
[mesh]
generator = "plate_with_hole"
side = 40.0
radius = 1
size = [0.1, 0.5]
layout = "structured"
seed = 3
curved = false
[solid]
element = "compt"
plane = "strain"
thickness = 2.0
volumetric = "centre"
[[material]]
region = ["rock", "vein"]
law = "munjiza"
form = "hypo"
stress_map = "direct"
density = 2650
constants = { E_alpha = 20e9, E_beta = 10e9, nu_alpha_beta = 0.3, nu_beta_alpha = 0.15, nu_p_alpha = 0.2, G = 4.5e9 }
axes = { angle = "0.2*sin(x/5)" }
stiffening = { k = 1, p_ref = 1e6, n = 0.5 }
in_situ_stress = [-1e6, "-2e6 - 25e3*y", 0]
viscosity = { shear = 10, bulk = 20.0 }
[[material]]
density = 2000.0
constants = { M_v = 0, M_alpha = 1e9, M_beta = 2e9, M_psi = 1e9 }
stress_map = "direct"
strength = { tensile = [1e6, 3e6], cohesion = 5e6, friction = 0.6, residual_friction = 0.4, G_I = [50, 200.0], G_II = 500 }
[fracture]
method = "intrinsic"
penalty = 30
weibull_modulus = 12
seed = 3
[contact]
method = "potential"
friction = 0.5
restitution = 0.9
penalty_factor = 2
tangential_factor = 0.8
potential_cap = 3
skin = 0.3
[[wall]]
point = [0, -1]
normal = [0, 1]
velocity = [0.0, 0.1]
friction = 0.2
[[crack]]
on = "fault"
[[interface]]
on = "bedding"
strength = { tensile = 1e6, cohesion = 5e6, friction = 0.6, residual_friction = 0.4, G_I = 50, G_II = 500 }
[[interface]]
between = ["rock", "vein"]
strength = { tensile = 1e6, cohesion = 5e6, friction = 0.6, residual_friction = 0.4, G_I = 50, G_II = 500 }
[[load]]
on = "hole"
type = "pressure"
value = 1e6
amplitude = { type = "ramp", start = 1e-3, end = 2e-3 }
[[load]]
type = "body_force"
value = [0, "-9.81*2650"]
amplitude = { type = "expression", expression = "sin(2*pi*t)*x" }
[[boundary]]
on = "outer"
type = "velocity"
value = ["free", "0.1*x"]
amplitude = { type = "table", times = [0, 1, 1, 2], values = [0, 1, 0, 0] }
[[boundary]]
on = "outer"
type = "displacement"
value = [0, "free"]
amplitude = { type = "heaviside", start = 0.5 }
[[lumped]]
type = "gas"
name = "blast"
on = "hole"
pressure = 1e6
gamma = 1.3
leak = 10
burn = { energy = 1e6, time = 1e-3, exponent = 0.7, reference_pressure = 1e7 }
about = [0, 0]
[[lumped]]
type = "mass"
name = "hammer"
on = "top"
direction = [0, -1]
mass = 100
stiffness = 1e9
damping = 1e5
gap = 1e-3
bonded = false
ground_stiffness = 1e3
velocity = 4
force = 981
[[lumped]]
type = "actuator"
name = "jack"
on = "bottom"
direction = [0, 1]
stiffness = 1e9
displacement = 1e-3
amplitude = { type = "ramp", end = 1e-2 }
[[initial]]
on = "rock"
velocity = [0, "0.1*x"]
[integrator]
type = "central_difference"
safety = 0.5
dt = 1e-6
bound = "lanczos"
[run]
t_end = 0.02
checkpoint = 0.01
mass_damping = 3
event_tolerance = 1e-9
[output]
fields = 2e-4
field_times = [1e-3, 0.5e-3]
history = 1e-5
states = 1e-3
probes = [{ at = [5.0, 0.0], name = "p0", about = [0.0, 0.0] }]
[compare]
samples = 7
exact = { displacement = ["x*t", 0], velocity = ["x", 0], stress = [1e6, 0, 0] }
[[compare.scheme]]
name = "leapfrog"
integrator = { type = "central_difference", safety = [0.8, 0.4] }
)toml",
    R"toml(
[mesh]
generator = "rectangle"
width = 2
height = 1
origin = [-1, -0.5]
cells = [4, 2]
pattern = "crossed"
parts = [{ name = "half", of = "top", from = [0, 0.5], to = [1, 0.5] }]
lines = [{ name = "notch", from = [-1, 0], to = [0, 0] }]
[solid]
plane = "stress"
[[material]]
law = "neo_hookean"
density = 1000
constants = { mu = 1e9, lambda = 2e9 }
[integrator]
type = "quasi_static"
tolerance = 1e-8
step = 0.1
longest = 0.2
shortest = 1e-4
most_iterations = 10
solver = "gmres"
preconditioner = "diagonal"
linear_tolerance = 1e-6
most_linear_iterations = 500
matrix_free = true
[run]
t_end = 1
[compare]
reference = { type = "cvode", rtol = 1e-10 }
[[compare.scheme]]
name = "one"
integrator = { type = "newmark", dt = 1e-3 }
)toml",
    R"toml(
mesh = { generator = "quadrilateral", corners = [[0, 0], [48, 44], [48, 60], [0, 44]], cells = [2, 3] }
solid = { plane = "strain" }
material = [{ density = 1000, constants = { E = 1e9, nu = 0.25 } }]
contact = { method = "potential", friction = 0, penalty = 1e10 }
run = { t_end = 1 }
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "generalized_alpha"
rho_inf = 0.5
adaptive = true
rtol = 1e-5
displacement_scale = 1e-3
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "newmark"
beta = 0.3
gamma = 0.6
dt = 1e-3
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "hht_alpha"
alpha = 0.2
dt = 1e-3
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "cvode"
velocity_scale = 1
stress_scale = 1e6
method = "adams"
iteration = "functional"
max_order = 4
stability_detection = false
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "arkode"
table = "sdirk_2_1_2"
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "verlet"
form = "position"
composition = "suzuki_5"
safety = 0.9
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "noh_bathe"
split = 0.6
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.msh"
[solid]
plane = "strain"
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.25 }
[integrator]
type = "bathe"
rho_inf = 0
dt = 1e-3
[run]
t_end = 1
)toml",
    R"toml(
[mesh]
file = "rock.geo"
parameters = { lc = 0.1, n = 3 }
[solid]
element = "cst"
plane = "stress"
[[material]]
region = "a"
density = 1000
constants = { E = 1e9, nu = 0.25 }
axes = { bedding = [[[0, 0], [1, 0.1], [2, 0]], [[0, 1], [2, 1]]] }
[[material]]
density = 1000
constants = { E = 1e9, nu = 0.5 }
axes = { data = "theta" }
[run]
t_end = 1
)toml"};

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
    for (const char* deck : full_decks) {
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
            EXPECT_NO_THROW(toml::parse(text)) << text;
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
