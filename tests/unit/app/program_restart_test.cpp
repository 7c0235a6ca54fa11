// Interrupted runs, and runs that go on: bit for bit what an uninterrupted run gives.

#include <gmock/gmock.h>
#include <signal.h>

#include <regex>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using test::memory_deck;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ProgramRestart : public test::ProgramTest {
protected:
    ProgramRestart() { put("case.toml", memory_deck); }

    Ended run(const std::string& out, const std::vector<std::string>& more = {},
              const std::function<void(pid_t)>& meanwhile = {}) const {
        std::vector<std::string> arguments{"run", "case.toml", "--threads", "1", "--out", out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return gneiss(arguments, meanwhile);
    }
    /// Sends a signal to a run when its first checkpoint is there, an eighth of its way. On a busy machine it may be
    /// over before the signal comes: then once more.
    Ended run_and_send(int signal, const std::string& out) const {
        Ended ended;
        for (int attempt = 0; attempt < 5 && ended.code <= 0 && ended.code != -signal; ++attempt) {
            std::filesystem::remove_all(folder / out);
            ended = run(out, {}, [&](pid_t process) {
                wait_until([&] { return exists(std::filesystem::path(out) / "checkpoint.h5"); });
                ::kill(process, signal);
            });
        }
        return ended;
    }
    void expect_same_results(const std::filesystem::path& a, const std::filesystem::path& b) const {
        for (const char* name : {"probes.csv", "history.csv", "checkpoint.h5", "fields.pvd", "fields_000004.vtu"}) {
            ASSERT_THAT(contents(a / name), Not(IsEmpty())) << name;
            EXPECT_TRUE(contents(a / name) == contents(b / name)) << name;
        }
    }
};

TEST_F(ProgramRestart, Signal_BetweenSteps_SavesAndLeavesWithItsCode) {
    ASSERT_EQ(run("whole").code, 0);
    for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        const std::string out = std::to_string(code);
        const Ended ended = run_and_send(signal, out);
        ASSERT_EQ(ended.code, code) << "the run was over before the signal came: " << ended.err;
        EXPECT_THAT(ended.err, AllOf(HasSubstr("stopped: t = "), HasSubstr("--restart " + out + "/checkpoint.h5")));
        const auto summary = this->summary(out);
        EXPECT_EQ(summary["status"], "interrupted");
        EXPECT_LT(summary["time"]["t_s"], 0.04);

        ASSERT_EQ(run(out, {"--restart", out + "/checkpoint.h5"}).code, 0);
        EXPECT_EQ(this->summary(out)["status"], "done");
        expect_same_results("whole", out);
    }
}

TEST_F(ProgramRestart, PeriodicCheckpoint_AfterAKill_GivesTheSameBits) {
    ASSERT_EQ(run("whole").code, 0);
    const Ended ended = run_and_send(SIGKILL, "killed");
    ASSERT_EQ(ended.code, -SIGKILL) << "the run was over before the signal came";
    EXPECT_EQ(summary("killed")["status"], "running");
    ASSERT_EQ(run("killed", {"--restart", "killed/checkpoint.h5"}).code, 0);
    expect_same_results("whole", "killed");
}

class RestartUnder : public ProgramRestart, public testing::WithParamInterface<const char*> {};

INSTANTIATE_TEST_SUITE_P(
    Integrators, RestartUnder,
    testing::Values("type = \"central_difference\"", "type = \"verlet\"", "type = \"verlet\", form = \"position\"",
                    "type = \"verlet\", composition = \"suzuki_5\"",
                    "type = \"verlet\", form = \"position\", composition = \"mclachlan_5\", safety = 0.5",
                    "type = \"noh_bathe\"", "type = \"bathe\", dt = 2e-4", "type = \"generalized_alpha\", dt = 2e-4",
                    "type = \"newmark\", adaptive = true",
                    "type = \"newmark\", dt = 2e-4, solver = \"gmres\", preconditioner = \"diagonal\"",
                    "type = \"hht_alpha\", dt = 2e-4", "type = \"cvode\"", "type = \"cvode\", solver = \"klu\"",
                    "type = \"cvode\", method = \"adams\", iteration = \"functional\"", "type = \"ida\"",
                    "type = \"ida\", solver = \"gmres\"", "type = \"arkode\"",
                    "type = \"arkode\", table = \"sdirk_2_1_2\"",
                    "type = \"arkode\", table = \"ark324l2sa_4_2_3\", dt = 1e-4"),
    [](const auto& instance) {
        std::string name;
        for (const char c : std::string(instance.param))
            if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
        return name;
    });

TEST_P(RestartUnder, FromItsCheckpoint_GivesTheSameBits) {
    // an expression is looked at over the whole run (decision 025): steps that follow it depend on where that ends
    const std::vector<std::string> scheme{"--set", "mesh.cells=[4,2]", "boundary.1.amplitude={type='ramp',end=8e-3}",
                                          "--set", std::string("integrator={") + GetParam() + "}"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), scheme.begin(), scheme.end());
        return more;
    };
    // the first quarter of the run, up to a checkpoint that the whole run writes as well
    const Ended whole = run("whole", with({"--set", "run.t_end=1e-2"}));
    ASSERT_EQ(whole.code, 0) << whole.err;
    ASSERT_EQ(run("part", with({"--set", "run.t_end=5e-3"})).code, 0);
    ASSERT_EQ(run("part", with({"--set", "run.t_end=1e-2", "--restart", "part/checkpoint.h5"})).code, 0);
    EXPECT_TRUE(contents("whole/probes.csv") == contents("part/probes.csv"));
    const auto energies = [&](const char* out) { return this->summary(out)["energies_J"]; };
    EXPECT_EQ(energies("whole"), energies("part"));
    EXPECT_LT(this->summary("whole")["balance_error"].get<double>(), 0.05);
}

TEST_F(ProgramRestart, IntoAnotherFolder_HoldsWhatComesAfter) {
    ASSERT_EQ(run("whole").code, 0);
    ASSERT_EQ(run_and_send(SIGINT, "first").code, 130);
    ASSERT_EQ(run("second", {"--restart", "first/checkpoint.h5"}).code, 0);
    const std::string whole = contents("whole/probes.csv"), second = contents("second/probes.csv");
    const std::string rows = second.substr(second.find('\n') + 1);
    EXPECT_TRUE(whole.ends_with(rows));
    EXPECT_GT(whole.size(), second.size());
    EXPECT_TRUE(contents("whole/checkpoint.h5") == contents("second/checkpoint.h5"));
}

TEST_F(ProgramRestart, OtherDeck_IsWarnedOf) {
    ASSERT_EQ(run("a", {"--set", "run.t_end=1e-3"}).code, 0);
    const Ended ended = run("a", {"--set", "run.t_end=2e-3", "--restart", "a/checkpoint.h5"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.err, HasSubstr("warning: restart: the checkpoint was written under another deck (fnv1a64:"));
    // two rows for each of two milliseconds would be there if the restart wrote its own time again
    const std::string history = contents("a/history.csv");
    EXPECT_EQ(history.find("\n0.001,"), history.rfind("\n0.001,"));
    EXPECT_NE(history.find("\n0.001,"), std::string::npos);
}

TEST_F(ProgramRestart, WhatDoesNotFit_IsRefused) {
    ASSERT_EQ(run("a", {"--set", "run.t_end=1e-3"}).code, 0);
    const std::vector<std::string> restart{"--restart", "a/checkpoint.h5"};
    const auto error_of = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = restart;
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ended ended = run("b", arguments);
        EXPECT_EQ(ended.code, 2);
        return ended.err;
    };
    EXPECT_THAT(error_of({"--set", "run.t_end=1e-3"}),
                HasSubstr("a/checkpoint.h5: stands at t = 0.001 s, the deck ends at 0.001 s: nothing is left to run"));
    EXPECT_THAT(error_of({"--set", "mesh.width=5.0"}),
                HasSubstr("was written for another mesh or other laws than the deck gives"));
    EXPECT_THAT(error_of({"--set", "solid.element=cst"}), HasSubstr("another mesh"));
    EXPECT_THAT(error_of({"--set", "material.0.form=hyper", "material.0.in_situ_stress=[0, 0, 0]"}),
                Not(IsEmpty()));  // refused by the deck: in-situ stress is for hypo only
    EXPECT_THAT(error_of({"--set", "boundary.1.on=top"}),
                AllOf(HasSubstr("a/checkpoint.h5: was written under other supports: the deck holds "),
                      HasSubstr(" components on `top` more, and the deck no longer holds "),
                      HasSubstr(" on `bottom`. A restart goes on with the same supports")));
    EXPECT_THAT(error_of({"--set", "contact.method=potential", "contact.friction=0.5"}),
                HasSubstr("the deck has fracture.method = \"none\", contact.method = \"potential\": joints and contact "
                          "do not come or go at a restart"));
    EXPECT_THAT(
        error_of({"--set", "integrator.type=verlet"}),
        HasSubstr("was written by integrator `central_difference`, the deck has `verlet`: a restart goes on under "
                  "the same scheme"));
    const Ended of_a_folder = run("b", {"--restart", "a"});
    EXPECT_THAT(of_a_folder.err, HasSubstr("a: is a folder, needed: a checkpoint.h5"));
    put("a/checkpoint.h5", "no checkpoint");
    EXPECT_THAT(error_of({}), HasSubstr("a/checkpoint.h5: is no checkpoint"));
    EXPECT_FALSE(exists("b"));
    const Ended missing = run("b", {"--restart", "nowhere.h5"});
    EXPECT_NE(missing.code, 0);
    EXPECT_THAT(missing.err, HasSubstr("nowhere.h5"));
}

}  // namespace
}  // namespace gneiss
