// `gneiss compare`: its table against separate runs, what it repeats, and what it says of runs that fail.

#include <gmock/gmock.h>
#include <signal.h>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// The small deck without a switched load, so that errors follow the step.
const std::string compare_deck = [] {
    std::string deck = test::small_deck;
    deck.replace(deck.find("value = 1e6"), 11,
                 "value = 1e6\namplitude = { type = \"expression\", expression = \"sin(3000*t)^2\" }");
    return deck + R"toml(
[compare]
samples = 5
reference = { type = "cvode", rtol = 1e-9 }
[[compare.scheme]]
name = "leapfrog"
integrator = { type = "central_difference", dt = [1e-5, 5e-6] }
[[compare.scheme]]
name = "Newmark, mean acceleration"
integrator = { type = "newmark", dt = 2e-5 }
)toml";
}();

class ProgramCompare : public test::ProgramTest {
protected:
    nlohmann::json table(const std::string& out = "results/a-compare") const {
        return nlohmann::json::parse(contents(out + "/compare.json"), nullptr, false);
    }
};

TEST_F(ProgramCompare, Schemes_AreThoseOfSeparateRuns) {
    put("a.toml", compare_deck);
    const Ended ended = gneiss({"compare", "a.toml", "--threads", "1"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, AllOf(HasSubstr("[1/5] reference"), HasSubstr("[4/5] Newmark, mean acceleration")));
    const auto runs = table().at("runs");
    ASSERT_EQ(runs.size(), 4u);
    EXPECT_EQ(runs[0].at("error_displacement"), 0);
    // order 2: a quarter, to what is left of higher orders
    const double coarse = runs[1].at("error_displacement"), fine = runs[2].at("error_displacement");
    EXPECT_EQ(runs[1].at("setting"), "dt = 1e-05");
    EXPECT_NEAR(coarse / fine, 4, 0.4);
    EXPECT_GT(fine, 1e-7) << "the reference is far closer";
    EXPECT_GT(runs[3].at("factorisations"), 0);
    EXPECT_EQ(runs[1].at("force_evaluations"), runs[1].at("steps"));
    for (const auto& run : runs) EXPECT_GE(run.at("start_evaluations"), 1);
    EXPECT_EQ(runs[1].at("balance_evaluations"), 0);
    EXPECT_EQ(runs[1].at("event_search_evaluations"), 0);
    for (const auto& run : runs) {
        EXPECT_GT(run.at("cpu_time_s"), 0);
        EXPECT_GT(run.at("peak_memory_bytes"), 1e6);
    }
    // the deck of a run, run by hand, gives the same numbers
    const std::string deck = runs[3].at("folder").get<std::string>() + "/case.toml";
    ASSERT_EQ(gneiss({"run", deck, "--out", "again", "--threads", "1"}).code, 0);
    ASSERT_TRUE(exists("again/history.csv") && exists("again/states.h5"));
    EXPECT_EQ(contents("again/history.csv"), contents(runs[3].at("folder").get<std::string>() + "/history.csv"));
    EXPECT_EQ(contents("again/states.h5"), contents(runs[3].at("folder").get<std::string>() + "/states.h5"));
    EXPECT_EQ(summary("again").at("work").at("steps"), runs[3].at("steps"));
    EXPECT_EQ(n_lines("results/a-compare/compare.csv"), 5u);
    EXPECT_THAT(contents("results/a-compare/report.html"),
                AllOf(HasSubstr("<svg"), HasSubstr("Newmark, mean acceleration")));
}

TEST_F(ProgramCompare, WhatIsThere_IsNotRepeated_WhatChangedIs) {
    put("a.toml", compare_deck);
    ASSERT_EQ(gneiss({"compare", "a.toml"}).code, 0);
    const Ended again = gneiss({"compare", "a.toml"});
    EXPECT_THAT(again.err, AllOf(HasSubstr("[2/5] leapfrog, dt = 1e-05: there already"),
                                 HasSubstr("[4/5] Newmark, mean acceleration: there already")));
    std::string changed = compare_deck;
    changed.replace(changed.find("dt = 2e-5"), 9, "dt = 4e-5");
    put("a.toml", changed);
    const Ended partly = gneiss({"compare", "a.toml"});
    EXPECT_THAT(partly.err,
                AllOf(HasSubstr("leapfrog, dt = 1e-05: there already"), Not(HasSubstr("acceleration: there already"))));
    const Ended other = gneiss({"compare", "a.toml", "--set", "run.t_end=5e-4"});
    EXPECT_EQ(other.code, 0);
    EXPECT_THAT(other.err, Not(HasSubstr("there already")));
}

TEST_F(ProgramCompare, ARunThatFails_SaysWhy_TheOthersGoOn) {
    std::string deck = compare_deck;
    deck.replace(deck.find("dt = [1e-5, 5e-6]"), 17, "dt = [1.0, 5e-6]");
    put("a.toml", deck);
    const Ended ended = gneiss({"compare", "a.toml"});
    EXPECT_EQ(ended.code, 3);
    const auto runs = table().at("runs");
    EXPECT_EQ(runs[1].at("status"), "failed");
    EXPECT_THAT(runs[1].at("message").get<std::string>(), HasSubstr("exceeds the critical step"));
    EXPECT_FALSE(runs[1].contains("error_displacement"));
    EXPECT_EQ(runs[2].at("status"), "done");
    EXPECT_THAT(ended.out, HasSubstr("failed: the fixed step"));
}

TEST_F(ProgramCompare, ASchemeThatTheCaseRefuses_SaysWhy_TheOthersGoOn) {
    std::string deck = compare_deck + "\n[contact]\nmethod = \"potential\"\nfriction = 0.4\n";
    const std::string forth = "type = \"central_difference\", dt = [1e-5, 5e-6]";
    deck.replace(deck.find(forth), forth.size(), "type = \"verlet\", composition = [\"yoshida_3\", \"single\"]");
    put("a.toml", deck);
    const Ended ended = gneiss({"compare", "a.toml"});
    EXPECT_EQ(ended.code, 3);
    const auto runs = table().at("runs");
    EXPECT_EQ(runs[1].at("status"), "refused");
    EXPECT_THAT(runs[1].at("message").get<std::string>(), HasSubstr("takes steps back in time"));
    EXPECT_EQ(runs[2].at("status"), "done");
}

TEST_F(ProgramCompare, OptionsThatNoSchemeTakes_AreFoundBeforeTheFirstRun) {
    std::string deck = compare_deck;
    deck.replace(deck.find("type = \"newmark\", dt = 2e-5"), 27, "type = \"newmark\", dt = 0");
    put("a.toml", deck);
    const Ended ended = gneiss({"compare", "a.toml"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("Newmark, mean acceleration: integrator.dt"), Not(HasSubstr("[1/5]"))));
}

TEST_F(ProgramCompare, AReferenceThatFails_IsAllThatIsTried) {
    std::string deck = compare_deck;
    deck.replace(deck.find("type = \"cvode\", rtol = 1e-9"), 28, "type = \"central_difference\", dt = 1.0");
    put("a.toml", deck);
    const Ended ended = gneiss({"compare", "a.toml"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("the reference has not come to its end"), Not(HasSubstr("[2/5]"))));
}

TEST_F(ProgramCompare, Terminated_HandsItOn_AndGoesOnLater) {
    std::string deck = compare_deck;
    deck.replace(deck.find("dt = [1e-5, 5e-6]"), 17, "dt = [1e-5, 1e-9]");  // a million steps
    put("a.toml", deck);
    const std::filesystem::path long_run = folder / "results/a-compare/runs/leapfrog-dt_1e-09/run.log";
    const Ended ended = gneiss({"compare", "a.toml"}, [&](pid_t process) {
        wait_until([&] { return std::filesystem::exists(long_run); });
        ::kill(process, SIGTERM);
    });
    EXPECT_EQ(ended.code, 143);
    EXPECT_EQ(summary("results/a-compare/runs/leapfrog-dt_1e-09").at("status"), "interrupted");
    deck.replace(deck.find("dt = [1e-5, 1e-9]"), 17, "dt = [1e-5, 5e-6]");
    put("a.toml", deck);
    EXPECT_THAT(gneiss({"compare", "a.toml"}).err, HasSubstr("leapfrog, dt = 1e-05: there already"));
}

TEST_F(ProgramCompare, AClosedForm_StandsInForAReference) {
    // a square that flies on as it is: u = v t
    put("a.toml", R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 1.0, cells = [2, 2] }
solid = { plane = "strain" }
run = { t_end = 1e-3 }
[[material]]
density = 1000.0
constants = { E = 1e9, nu = 0.25 }
[[initial]]
velocity = [3, -1]
[compare]
samples = 4
[compare.exact]
displacement = ["3*t", "-t"]
velocity = [3, -1]
[[compare.scheme]]
name = "leapfrog"
integrator = { type = "central_difference" }
)toml");
    ASSERT_EQ(gneiss({"compare", "a.toml"}).code, 0);
    const auto run = table().at("runs").at(0);
    EXPECT_LT(run.at("error_displacement"), 1e-12) << "sums of some tens of steps";
    EXPECT_LT(run.at("error_velocity"), 1e-12);
    EXPECT_FALSE(run.contains("error_stress"));
}

TEST_F(ProgramCompare, MistakesInTheTable_ComeAllAtOnce) {
    put("a.toml", test::small_deck);
    EXPECT_THAT(gneiss({"compare", "a.toml"}).err, HasSubstr("has no table [compare]"));
    put("b.toml", test::small_deck + R"toml(
[compare]
samples = 0
[[compare.scheme]]
name = "a"
integrator = { type = "central_difference", dt = [1e-5, "x"], safety = [0.5] }
[[compare.scheme]]
name = "a"
integrator = { type = "newmrk" }
)toml");
    const Ended ended = gneiss({"compare", "b.toml"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("key `compare.samples`: given 0"), HasSubstr("both have a list of values"),
                                 HasSubstr("did you mean `newmark`?"),
                                 HasSubstr("key `compare.reference`: missing (or `exact`)")));
    EXPECT_FALSE(exists("results"));
}

}  // namespace
}  // namespace gneiss
