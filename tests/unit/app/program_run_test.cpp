// What the commands print and leave behind when nothing is wrong, and when a run fails.

#include <gmock/gmock.h>

#include <sstream>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using test::small_deck;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

using ProgramRun = test::ProgramTest;

TEST_F(ProgramRun, Version_IsPrinted) {
    const Ended ended = gneiss({"--version"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.out, StartsWith("gneiss 0."));
}

TEST_F(ProgramRun, Help_NamesTheCommands) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{"--help"}, {"-h"}, {}}) {
        const Ended ended = gneiss(arguments);
        EXPECT_EQ(ended.code, arguments.empty() ? 2 : 0);
        EXPECT_THAT(ended.out, AllOf(HasSubstr("run "), HasSubstr("check "), HasSubstr("list ")));
    }
    EXPECT_THAT(gneiss({"run", "--help"}).out, AllOf(HasSubstr("--restart"), HasSubstr("--set"), HasSubstr("--quiet")));
}

TEST_F(ProgramRun, WrongUse_IsRefusedWithTwo) {
    struct Wrong {
        std::vector<std::string> arguments;
        std::string message;
    };
    for (const Wrong& wrong : std::vector<Wrong>{
             {{"runn", "case.toml"}, "no command `runn`, did you mean `run`?"},
             {{"run"}, "deck is required"},
             {{"run", "a.toml", "--thread", "1"}, "not expected"},
             {{"run", "a.toml", "--threads", "0"}, "Value 0 not in range"},
             {{"run", "a.toml", "--threads", "0"}, "1024"},  // versions of CLI11 write ranges in their own ways
             {{"run", "nowhere.toml"}, "nowhere.toml: no such deck, or not readable\n1 problem\n"},
             {{"list", "load"}, "given `load`, must be one of elements, materials, forms, stress maps"},
             {{"list", "load"}, "did you mean `loads`?"},
         }) {
        const Ended ended = gneiss(wrong.arguments);
        EXPECT_EQ(ended.code, 2) << wrong.message;
        EXPECT_THAT(ended.err, HasSubstr(wrong.message));
        EXPECT_THAT(ended.out, IsEmpty());
    }
    EXPECT_FALSE(exists("results"));
}

TEST_F(ProgramRun, List_WithAndWithoutTopic_NamesWhatADeckTakes) {
    const std::string everything = gneiss({"list"}).out;
    for (const char* name : {"compt", "munjiza", "central_difference", "pressure", "absorbing", "heaviside"})
        EXPECT_THAT(everything, HasSubstr(std::string("\n  ") + name)) << name;
    EXPECT_EQ(gneiss({"list", "elements"}).out,
              "elements  (solid.element = ...)\n"
              "  compt               composite triangle of six nodes, free of volumetric locking\n"
              "  cst                 constant strain triangles on the same nodes, four for each composite\n");
    EXPECT_THAT(gneiss({"list", "stress", "maps"}).out, StartsWith("stress maps  (material.stress_map = ...)\n"));
}

TEST_F(ProgramRun, Check_SoundDeck_PrintsSizesStepAndNames) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"check", "case.toml", "--threads", "1"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.err, IsEmpty());
    for (const char* line : {"deck                case.toml: no errors\n", "elements            32 compt\n",
                             "nodes               81\n", "area                1 m2\n", "regions             solid\n",
                             "boundaries          bottom, boundary, left, outer, right, top\n",
                             "points              bottom_left, bottom_right, top_left, top_right\n",
                             " s, 0.8 of the critical step\n", " on 1 thread, ", "memory              about "})
        EXPECT_THAT(ended.out, HasSubstr(line));
    EXPECT_FALSE(exists("results"));
}

TEST_F(ProgramRun, Run_SoundDeck_LeavesEveryResult) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"run", "case.toml"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.out, IsEmpty());
    EXPECT_THAT(ended.err, AllOf(HasSubstr("done: t = 0.001 s, "), HasSubstr("results: results/case\n")));
    for (const char* name : {"checkpoint.h5", "deck.toml", "fields.pvd", "fields_000000.vtu", "fields_000001.vtu",
                             "fields_000002.vtu", "history.csv", "probes.csv", "run.log", "summary.json"})
        EXPECT_TRUE(exists(std::filesystem::path("results/case") / name)) << name;
    EXPECT_FALSE(exists("results/case/fields_000003.vtu"));  // one frame at t_end, not two
    EXPECT_EQ(contents("results/case/deck.toml"), small_deck);
    EXPECT_EQ(n_lines("results/case/history.csv"), 12u);  // header, start, ten intervals
    EXPECT_EQ(n_lines("results/case/probes.csv"), 12u);

    const auto summary = this->summary("results/case");
    EXPECT_EQ(summary["status"], "done");
    EXPECT_EQ(summary["title"], "a square");
    EXPECT_EQ(summary["counts"]["elements"], 32);
    EXPECT_EQ(summary["time"]["t_s"], 1e-3);
    EXPECT_EQ(summary["time"]["t_s"], summary["time"]["t_end_s"]);
    EXPECT_EQ(summary["deck"], std::filesystem::canonical(folder / "case.toml").string());
    EXPECT_FALSE(summary.contains("overrides"));
    EXPECT_LT(summary["balance_error"], 1e-2);  // a step load on four cells: the ledger closes, roughly
    EXPECT_GT(summary["energies_J"]["kinetic"], 0);

    const std::string log = contents("results/case/run.log");
    for (const char* record :
         {"case.toml, ", "mesh: 32 elements, 81 nodes", "start: t = 0, t_end = 0.001", "step: t = ", "done: step = "})
        EXPECT_THAT(log, HasSubstr(record));
}

TEST_F(ProgramRun, Set_LaysValuesOverTheDeck_AndIsKept) {
    put("case.toml", small_deck);
    ASSERT_EQ(
        gneiss({"run", "--set", "run.t_end=2e-4", "title=short", "case.toml", "--out", "a/b", "--threads", "1"}).code,
        0);
    const auto summary = this->summary("a/b");
    EXPECT_EQ(summary["time"]["t_s"], 2e-4);
    EXPECT_EQ(summary["title"], "short");
    EXPECT_EQ(summary["overrides"], (std::vector<std::string>{"run.t_end=2e-4", "title=short"}));
    EXPECT_EQ(contents("a/b/deck.toml"), small_deck + "# --set run.t_end=2e-4\n# --set title=short\n");
    EXPECT_THAT(contents("a/b/run.log"), HasSubstr("set: run.t_end=2e-4"));
}

TEST_F(ProgramRun, Quiet_PrintsNothing) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"run", "case.toml", "--quiet", "--threads", "64"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.out + ended.err, IsEmpty());
}

TEST_F(ProgramRun, Threads_MoreThanCores_IsWarnedOf) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"run", "case.toml", "--threads", "1024", "--set", "run.t_end=1e-5"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.err, HasSubstr("warning: 1024 threads on "));
    EXPECT_THAT(contents("results/case/run.log"), HasSubstr("1024 threads on "));
    EXPECT_THAT(summary("results/case").at("warnings").dump(), HasSubstr("1024 threads on "));
}

TEST_F(ProgramRun, Threads_OneAndTwo_GiveTheSameBits) {
    put("case.toml", test::memory_deck);
    for (const char* threads : {"1", "2"})
        ASSERT_EQ(gneiss({"run", "case.toml", "--quiet", "--threads", threads, "--out", threads}).code, 0);
    for (const char* name : {"probes.csv", "history.csv", "checkpoint.h5", "fields_000004.vtu"}) {
        ASSERT_THAT(contents(std::filesystem::path("1") / name), Not(IsEmpty())) << name;
        EXPECT_TRUE(contents(std::filesystem::path("1") / name) == contents(std::filesystem::path("2") / name)) << name;
    }
}

TEST_F(ProgramRun, SameFolder_Twice_NothingOfTheFirstRunStays) {
    put("case.toml", small_deck);
    ASSERT_EQ(gneiss({"run", "case.toml"}).code, 0);
    const std::string probes = contents("results/case/probes.csv");
    ASSERT_EQ(gneiss({"run", "case.toml"}).code, 0);
    EXPECT_EQ(contents("results/case/probes.csv"), probes);
    ASSERT_EQ(gneiss({"run", "case.toml", "--overwrite", "--set", "output.probes=[]", "output.fields=0"}).code, 0);
    EXPECT_FALSE(exists("results/case/probes.csv"));
    EXPECT_FALSE(exists("results/case/fields_000002.vtu"));
}

TEST_F(ProgramRun, FieldTimes_AreHitExactlyOnce) {
    put("case.toml", small_deck);
    // 3e-4 is the third multiple of 1e-4 but for round-off, 1e-3 the end: no frame twice, no step as short as round-off
    const Ended ended =
        gneiss({"run", "case.toml", "--set", "output.fields=1e-4", "output.field_times=[3e-4, 1.23e-4, 1e-3]",
                "output.history=1e-9", "output.rows=steps"});
    EXPECT_EQ(ended.code, 0);
    const std::string list = contents("results/case/fields.pvd");
    EXPECT_THAT(list, AllOf(HasSubstr("\"0.000123\""), HasSubstr("\"0.001\"")));
    EXPECT_TRUE(exists("results/case/fields_000011.vtu"));  // start, ten multiples, 1.23e-4
    EXPECT_FALSE(exists("results/case/fields_000012.vtu"));

    std::istringstream history(contents("results/case/history.csv"));
    std::string line;
    for (std::getline(history, line), std::getline(history, line); std::getline(history, line);) {
        const double dt = std::stod(line.substr(line.find(',', line.find(',') + 1) + 1));
        EXPECT_GT(dt, 1e-7) << line;
    }
}

TEST_F(ProgramRun, FieldTimeAfterTheEnd_IsRefused) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"run", "case.toml", "--set", "output.field_times=[3e-4, 0.5]"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("output.field_times[1]`: given 0.5, must be <= 0.001 s, where the run ends"));
}

TEST_F(ProgramRun, RelativeDeck_FromAnotherFolder_FindsItsMesh) {
    put("decks/square.geo", R"(
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 1, 0, 0.5}; Point(4) = {0, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("left") = {4}; Physical Curve("right") = {2}; Physical Surface("rock") = {1};
)");
    std::string deck = small_deck;
    const std::size_t begin = deck.find("mesh = "), end = deck.find('\n', begin);
    put("decks/case.toml", deck.replace(begin, end - begin, "mesh = { file = \"square.geo\" }"));
    EXPECT_EQ(gneiss({"run", "decks/case.toml"}).code, 0);
    EXPECT_EQ(summary("results/case")["status"], "done");
}

TEST_F(ProgramRun, InvertedElement_FailsWithTheLastGoodState) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"run", "case.toml", "--set", "load.0.value=1e9", "--threads", "1"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("gneiss: error: element "), HasSubstr(" is inverted at t = "),
                                 HasSubstr("failed: t = ")));
    const auto summary = this->summary("results/case");
    EXPECT_EQ(summary["status"], "failed");
    EXPECT_THAT(summary["message"].get<std::string>(),
                AllOf(StartsWith("element "), HasSubstr(" is inverted at t = ")));
    EXPECT_TRUE(exists("results/case/fields_000001.vtu"));
    EXPECT_TRUE(exists("results/case/checkpoint.h5"));

    // the last row of the history is the state that was saved
    const std::string history = contents("results/case/history.csv");
    const std::size_t last = history.rfind('\n', history.size() - 2) + 1;
    EXPECT_EQ(std::stod(history.substr(last)), summary["time"]["t_s"].get<double>());
    // and the run goes on from there, to fail again
    EXPECT_EQ(gneiss({"run", "case.toml", "--set", "load.0.value=1e9", "--threads", "1", "--restart",
                      "results/case/checkpoint.h5"})
                  .code,
              3);
}

TEST_F(ProgramRun, FormulaWithoutAValue_FailsWithTheLastGoodState) {
    put("case.toml", small_deck);
    const std::string amplitude = "load.0.amplitude={type='expression',expression='sqrt(3e-4-t)'}";
    EXPECT_EQ(gneiss({"run", "case.toml", "--set", amplitude, "--threads", "1"}).code, 3);
    const auto summary = this->summary("results/case");
    EXPECT_EQ(summary["status"], "failed");
    EXPECT_THAT(summary["message"].get<std::string>(), HasSubstr("sqrt(3e-4-t)"));
    EXPECT_GT(summary["time"]["t_s"].get<double>(), 0.0);
    EXPECT_LE(summary["time"]["t_s"].get<double>(), 3e-4);
    EXPECT_TRUE(exists("results/case/checkpoint.h5"));
}

TEST_F(ProgramRun, FixedStepAboveTheCriticalOne_FailsAtOnce) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"run", "case.toml", "--set", "integrator.dt=1e-3"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err, HasSubstr("exceeds the critical step"));
    EXPECT_EQ(summary("results/case")["status"], "failed");
}

TEST_F(ProgramRun, FolderThatCannotBeWritten_FailsWithItsName) {
    put("case.toml", small_deck);
    put("taken", "a file where the folder should be");
    const Ended ended = gneiss({"run", "case.toml", "--out", "taken"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err, AllOf(StartsWith("gneiss: "), HasSubstr("taken")));
}

}  // namespace
}  // namespace gneiss
