// Bad decks, as a user sees them: on stderr, all at once, with place, cause and cure; exit code 2, no results.

#include <gmock/gmock.h>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using test::small_deck;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ProgramErrors : public test::ProgramTest {
protected:
    Ended run(const std::string& deck) const {
        put("case.toml", deck);
        const Ended ended = gneiss({"run", "case.toml", "--threads", "1"});
        EXPECT_EQ(ended.code, 2) << ended.err;
        EXPECT_THAT(ended.out, IsEmpty());
        EXPECT_FALSE(exists("results"));
        return ended;
    }
    static std::string replaced(std::string text, const std::string& what, const std::string& by) {
        const std::size_t at = text.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        return at == std::string::npos ? text : text.replace(at, what.size(), by);
    }
};

TEST_F(ProgramErrors, Deck_EveryClass_HasItsMessage) {
    struct Bad {
        std::string what, by, message;
    };
    const std::string load = "on = \"left\"", elastic = "constants = { E = 1e9, nu = 0.25 }";
    for (const Bad& bad : std::vector<Bad>{
             {"density = 1000.0", "densty = 1000.0",
              "case.toml:7:1: key `material[0].densty`: unknown, did you mean `density`?"},
             {"density = 1000.0", "density = \"heavy\"",
              "case.toml:7:11: key `material[0].density`: given \"heavy\" (a string), must be a number > 0 kg/m³"},
             {"density = 1000.0", "density = -1",
              "case.toml:7:11: key `material[0].density`: given -1, must be > 0 kg/m³"},
             {"density = 1000.0\n", "", "case.toml:6:1: key `material[0].density`: missing"},
             {"t_end = 1e-3", "t_end = ", "no valid TOML"},
             {load, "on = \"lft\"",
              "on = \"lft\": the mesh has no boundary of this name; there are: \"bottom\", \"boundary\", \"left\", "
              "\"outer\", \"right\", \"top\"; did you mean \"left\"?"},
             {load, "on = \"solid\"", "on = \"solid\": this is a region, needed: boundary"},
             {"density = 1000.0", "density = 1000.0\nregion = \"rock\"",
              "[[material]] 1: the mesh has no region `rock`; it has: solid"},
             {"at = [0.5, 0.5]", "at = [2.0, 0.5]", "output.probes `p`: "},
             {"about = [0.0, 0.0]", "about = [0.5, 0.5]", "output.probes `p`: stands at the centre"},
             {"value = 1e6", "value = \"1e6*foo(x)\"", "foo"},
             {elastic,
              "constants = { E_alpha = 2e9, E_beta = 1e9, G = 4e8, nu_alpha_beta = 0.2, nu_beta_alpha = 0.2, "
              "nu_p_alpha = 0.2 }",
              "nu_beta_alpha"},
             {elastic, "constants = { E = 1e9, nu = 0.6 }", "material[0]"},
             {"plane = \"strain\"", "plane = \"strain\", volumetric = \"centre\"", "direct"},
             {"plane = \"strain\"", "plane = \"strian\"", "did you mean `strain`?"},
             {"generator = \"rectangle\", width = 1.0, height = 1.0, cells = [4, 4]", "file = \"nowhere.msh\"",
              "nowhere.msh"},
             {"generator = \"rectangle\", width = 1.0, height = 1.0, cells = [4, 4]", "file = \"plate.stl\"",
              "must be a file of Gmsh, ending in .msh or .geo"},
         }) {
        const Ended ended = run(replaced(small_deck, bad.what, bad.by));
        EXPECT_THAT(ended.err, AllOf(HasSubstr(bad.message), HasSubstr("problem"))) << bad.by;
    }
}

TEST_F(ProgramErrors, Deck_ManyMistakes_ComeTogetherWithTheirNumber) {
    std::string deck = replaced(small_deck, "density = 1000.0", "densty = 1000.0");
    deck = replaced(deck, "t_end = 1e-3", "t_end = 0");
    deck = replaced(deck, "type = \"fixed\"", "type = \"fixt\"");
    const Ended ended = run(deck);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("`material[0].densty`"), HasSubstr("`run.t_end`"),
                                 HasSubstr("`boundary[0].type`"), HasSubstr("\n3 problems\n")));
}

TEST_F(ProgramErrors, Mesh_WhatTheDeckPutsOnIt_IsReportedTogether) {
    std::string deck = replaced(small_deck, "on = \"left\"", "on = \"lft\"");
    deck = replaced(deck, "on = \"right\"", "on = \"rihgt\"");
    deck = replaced(deck, "at = [0.5, 0.5]", "at = [7.0, 0.5]");
    deck += "[[boundary]]\non = \"tpo\"\ntype = \"absorbing\"\n";
    const Ended ended = run(deck);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("[[load]] 1: on = \"lft\""), HasSubstr("[[boundary]] 1: on = \"rihgt\""),
                                 HasSubstr("[[boundary]] 2: on = \"tpo\""), HasSubstr("output.probes `p`"),
                                 HasSubstr("\n4 problems\n")));
}

TEST_F(ProgramErrors, Check_FindsTheSame) {
    put("case.toml", replaced(small_deck, "on = \"left\"", "on = \"lft\""));
    const Ended run = gneiss({"run", "case.toml", "--threads", "1"}),
                check = gneiss({"check", "case.toml", "--threads", "1"});
    EXPECT_EQ(check.code, 2);
    EXPECT_EQ(check.err, run.err);
    EXPECT_THAT(check.out, IsEmpty());
}

TEST_F(ProgramErrors, Set_BadOverride_IsNamed) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"check", "case.toml", "--set", "run.tend=1"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("--set run.tend=1: key `run.tend`: unknown, did you mean `t_end`?"));
}

}  // namespace
}  // namespace gneiss
