// Results are not lost to another run: folders in use, and folders that hold what has been computed.

#include <gmock/gmock.h>
#include <signal.h>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using test::small_deck;
using ::testing::AllOf;
using ::testing::HasSubstr;

class ProgramFolder : public test::ProgramTest {
protected:
    ProgramFolder() {
        put("case.toml", small_deck);
        overwrites = false;
    }

    /// Calls the program while another run, far too long to end, is at work in results/case; then kills that one.
    Ended beside_a_run(const std::vector<std::string>& arguments) {
        Ended ended;
        const Ended killed = gneiss({"run", "case.toml", "--quiet", "--set", "run.t_end=1e3"}, [&](pid_t first) {
            wait_until([&] { return exists("results/case/summary.json"); });
            process = first;
            ended = gneiss(arguments);
            EXPECT_TRUE(exists("results/case/run.lock"));
            ::kill(first, SIGKILL);
        });
        EXPECT_EQ(killed.code, -SIGKILL);
        return ended;
    }

    pid_t process = 0;  ///< of the other run
};

TEST_F(ProgramFolder, InUse_IsRefusedWithOwner_AndLeftAlone) {
    const Ended ended = beside_a_run({"run", "case.toml", "--overwrite"});
    EXPECT_EQ(ended.code, 2);
    std::string owner = " ";
    owner += std::to_string(process);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("results/case: in use by `gneiss run "), HasSubstr("case.toml`, process "),
                                 HasSubstr(owner + " on "), HasSubstr(", since 20"), HasSubstr("--out")));
    EXPECT_THAT(contents("results/case/run.log"), HasSubstr("step: t = "));
    EXPECT_TRUE(exists("results/case/fields_000000.vtu"));
}

TEST_F(ProgramFolder, OfARunThatWasKilled_IsFree) {
    EXPECT_EQ(beside_a_run({"check", "case.toml"}).code, 0);
    EXPECT_TRUE(exists("results/case/run.lock"));
    EXPECT_EQ(gneiss({"run", "case.toml", "--quiet"}).code, 0);
    EXPECT_FALSE(exists("results/case/run.lock"));
}

TEST_F(ProgramFolder, FinishedRunOfAnotherDeck_IsKept_UnlessOverwritten) {
    ASSERT_EQ(gneiss({"run", "case.toml", "--quiet"}).code, 0);
    const std::string log = contents("results/case/run.log");
    const std::vector<std::string> other{"run", "case.toml", "--quiet", "--set", "run.t_end=2e-3"};
    const Ended refused = gneiss(other);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err,
                AllOf(HasSubstr("results/case: holds a finished run of another deck, or of this one before it was "
                                "changed ("),
                      HasSubstr("--overwrite replaces it, --out takes another folder"), HasSubstr("1 problem")));
    EXPECT_EQ(contents("results/case/run.log"), log);
    EXPECT_FALSE(exists("results/case/run.lock"));
    // the same deck again loses nothing
    EXPECT_EQ(gneiss({"run", "case.toml", "--quiet"}).code, 0);
    std::vector<std::string> overwriting = other;
    overwriting.push_back("--overwrite");
    EXPECT_EQ(gneiss(overwriting).code, 0);
    EXPECT_EQ(summary("results/case")["time"]["t_s"], 2e-3);
    // and what its overrides were is told
    EXPECT_THAT(gneiss({"run", "case.toml"}).err, HasSubstr("case.toml --set run.t_end=2e-3)"));
}

TEST_F(ProgramFolder, RunThatFailed_IsReplaced) {
    ASSERT_EQ(gneiss({"run", "case.toml", "--quiet", "--set", "load.0.value=1e9"}).code, 3);
    EXPECT_EQ(gneiss({"run", "case.toml", "--quiet"}).code, 0);
}

TEST_F(ProgramFolder, Restart_GoesOnInTheFolderOfItsOwnRun_AndInNoOther) {
    ASSERT_EQ(gneiss({"run", "case.toml", "--quiet", "--out", "a"}).code, 0);
    ASSERT_EQ(gneiss({"run", "case.toml", "--quiet", "--out", "b", "--set", "run.t_end=5e-4"}).code, 0);
    const std::vector<std::string> longer{"run", "case.toml", "--quiet", "--set", "run.t_end=2e-3", "--restart"};
    const auto with = [&](const char* checkpoint, const char* out) {
        std::vector<std::string> arguments = longer;
        arguments.insert(arguments.end(), {checkpoint, "--out", out});
        return arguments;
    };
    EXPECT_THAT(gneiss(with("a/checkpoint.h5", "b")).err, HasSubstr("b: holds a finished run of another deck"));
    EXPECT_EQ(gneiss(with("a/checkpoint.h5", "a")).code, 0);
}

TEST_F(ProgramFolder, ComparisonOnAnotherProblem_IsKept_OtherSchemesAreNone) {
    const std::string compare =
        "[compare]\nsamples = 2\nreference = { type = \"central_difference\", dt = 1e-5 }\n[[compare.scheme]]\nname = "
        "\"leapfrog\"\nintegrator = { type = \"central_difference\", dt = 2e-5 }\n";
    put("case.toml", small_deck + compare);
    ASSERT_EQ(gneiss({"compare", "case.toml", "--quiet"}).code, 0);
    EXPECT_FALSE(exists("results/case-compare/run.lock"));
    put("case.toml",
        small_deck + compare + "[[compare.scheme]]\nname = \"more\"\nintegrator = { type = \"verlet\" }\n");
    EXPECT_EQ(gneiss({"compare", "case.toml", "--quiet"}).code, 0);
    const std::vector<std::string> other{"compare", "case.toml", "--quiet", "--set", "load.0.value=2e6"};
    const Ended refused = gneiss(other);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("results/case-compare: holds a comparison on another problem"));
    std::vector<std::string> overwriting = other;
    overwriting.push_back("--overwrite");
    EXPECT_EQ(gneiss(overwriting).code, 0);
}

}  // namespace
}  // namespace gneiss
