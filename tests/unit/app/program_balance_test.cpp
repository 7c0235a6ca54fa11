// The energy balance of runs: closed where a run is sound, and said to be open where it is not.

#include <gmock/gmock.h>

#include <cmath>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Sums of some thousand products.
constexpr double balance_round_off = 1e-11;

class ProgramBalance : public test::ProgramTest {
protected:
    Ended run(const std::vector<std::string>& set, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"run", "case.toml", "--threads", "1", "--out", "out"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        if (!set.empty()) arguments.push_back("--set");
        arguments.insert(arguments.end(), set.begin(), set.end());
        return gneiss(arguments);
    }
    std::vector<double> history(const std::string& column) { return table("out/history.csv")[column]; }
};

// ---- sound runs

TEST_F(ProgramBalance, FreeFall_NothingIsLeftOver_WhateverTheStep) {
    put("case.toml", R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 1.0, cells = [1, 1] }
solid = { plane = "strain", thickness = 0.3 }
material = [{ density = 2700.0, constants = { E = 1e6, nu = 0.3 } }]
load = [{ type = "body_force", value = [0.0, "-9.81*2700"] }]
run = { t_end = 0.03 }
output = { history = 0.01 }
)toml");
    for (const char* scheme : {"integrator.type=central_difference", "integrator.type=verlet"})
        // the first step shorter than the stable one, rows that shorten others, a load that comes later
        for (const char* more : {"run.t_end=0.03", "run.t_end=1", "output.history=0.007",
                                 "load.0.amplitude={type='heaviside', start=0.011}"}) {
            ASSERT_EQ(run({scheme, more}).code, 0);
            const std::vector<double> kinetic = history("kinetic [J]");
            EXPECT_EQ(kinetic.front(), 0) << scheme << more;
            for (const double energy : kinetic) EXPECT_GE(energy, 0) << scheme << more;
            EXPECT_GT(kinetic.back(), 1) << scheme << more;
            for (const double left_over : history("left_over [J]"))
                EXPECT_LE(std::abs(left_over), balance_round_off * kinetic.back()) << scheme << more;
        }
}

TEST_F(ProgramBalance, AtRestUnderStress_RoundOffIsNoEnergy) {
    put("case.toml", R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 1.0, cells = [3, 3], pattern = "crossed" }
solid = { element = "compt", plane = "strain" }
material = [{ form = "hypo", density = 2700.0, constants = { E = 30e9, nu = 0.3 }, in_situ_stress = [-30e6, -5e6, 0.0] }]
boundary = [{ on = "left", type = "fixed" }, { on = "right", type = "fixed" }, { on = "bottom", type = "displacement", value = ["free", 0.0] }, { on = "top", type = "displacement", value = ["free", 0.0] }]
run = { t_end = 1e-4 }
output = { history = 1e-6 }
)toml");
    for (const char* scheme : {"central_difference", "noh_bathe", "cvode", "arkode", "ida"}) {
        const Ended ended = run({std::string("integrator.type=") + scheme});
        EXPECT_EQ(ended.code, 0) << scheme << ended.err;
        EXPECT_THAT(ended.err, Not(HasSubstr("from nothing"))) << scheme;
        // what moves is known to eps of a metre, and the least energy to its square: nothing is left over but that
        EXPECT_LT(summary("out")["balance_error"].get<double>(), 0.01) << scheme;
    }
}

TEST_F(ProgramBalance, LoadsThatBeginWithNextToNothing_AreNotMeasuredByIt) {
    put("case.toml", R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 0.1, cells = [10, 1] }
solid = { plane = "stress" }
material = [{ density = 2500.0, constants = { E = 1e9, nu = 0.2 } }]
boundary = [{ on = "left", type = "fixed" }]
load = [{ on = "right", type = "traction", value = [1e5, 0.0], amplitude = { type = "expression", expression = "0" } }]
run = { t_end = 6e-3 }
output = { history = 5e-5 }
)toml");
    for (const char* course : {"0.5*(1+tanh((t-3e-3)/1e-4))", "exp(-((t-3e-3)/2e-4)^2)", "sin(pi*t/6e-3)^400"})
        for (const char* scheme : {"central_difference", "cvode", "arkode", "ida"}) {
            const Ended ended =
                run({std::string("integrator.type=") + scheme, std::string("load.0.amplitude.expression=") + course});
            EXPECT_EQ(ended.code, 0) << scheme << course << ended.err;
            EXPECT_THAT(ended.err, Not(HasSubstr("from nothing"))) << scheme << course;
            EXPECT_GT(summary("out")["energies_J"]["external_work"].get<double>(), 1e-3) << "it does come";
        }
}

/// A bar that is loaded and unloaded, statically.
const std::string loaded_bar_deck = R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 0.25, cells = [4, 1] }
solid = { plane = "strain" }
material = [{ density = 1000.0, constants = { E = 1e7, nu = 0.0 } }]
run = { t_end = 4.0 }
integrator = { type = "quasi_static" }
output = { history = 0.5, probes = [{ name = "tip", at = [1.0, 0.125] }] }
[[boundary]]
on = "left"
type = "fixed"
)toml";

const std::string up_and_down = "amplitude = { type = \"table\", times = [0, 1, 2, 3, 4], values = [0, 0, 1, 0, 0] }";

TEST_F(ProgramBalance, UnloadedStatics_AreMeasuredByWhatThereWas) {
    const std::string load = "[[load]]\non = \"right\"\ntype = \"traction\"\nvalue = [1e4, 0.0]\n" + up_and_down,
                      support = "[[boundary]]\non = \"right\"\ntype = \"displacement\"\nvalue = [1e-3, \"free\"]\n" +
                                up_and_down;
    for (const std::string& what : {load, support, std::string()}) {
        put("case.toml", loaded_bar_deck + what);
        ASSERT_EQ(run({}).code, 0);
        const std::vector<double> tip = table("out/probes.csv")["tip.u_x [m]"];
        ASSERT_EQ(tip.size(), 9u);
        const double top = what.empty() ? 0 : 1e-3;  // small strain
        EXPECT_NEAR(tip[4], top, 2e-3 * top);
        for (const std::size_t at_rest : {0, 1, 2, 6, 7, 8}) EXPECT_NEAR(tip[at_rest], 0, 1e-12);
        for (const double error : history("balance_error")) EXPECT_LT(error, 1e-3);  // strain
        EXPECT_LT(history("balance_error").back(), 1e-3);
    }
}

TEST_F(ProgramBalance, LoadThatJumps_InStatics_DoesTheWorkThatIsStored) {
    for (const char* type : {"integrator.type=quasi_static", "integrator.type=dynamic_relaxation"})
        for (const char* amplitude : {"amplitude = \"constant\"", "amplitude = \"heaviside\"",
                                      "amplitude = { type = \"heaviside\", start = 2.0 }"}) {
            put("case.toml",
                loaded_bar_deck + "[[load]]\non = \"right\"\ntype = \"traction\"\nvalue = [1e4, 0.0]\n" + amplitude);
            ASSERT_EQ(run({type}).code, 0);
            const double work = history("external_work [J]").back();
            EXPECT_NEAR(work, 0.5 * 1e4 * 0.25 * 1e-3, 2e-3 * work) << type << amplitude;  // strain
            EXPECT_LT(history("balance_error").back(), 1e-3) << type << amplitude;
            // and the same after a restart where it has just jumped
            ASSERT_EQ(run({type, "run.checkpoint=2"}).code, 0);
            const std::string whole = contents("out/history.csv");
            ASSERT_EQ(run({type, "run.checkpoint=2", "run.t_end=2"}).code, 0);
            ASSERT_EQ(run({type, "run.checkpoint=2"}, {"--restart", "out/checkpoint.h5"}).code, 0);
            EXPECT_EQ(contents("out/history.csv"), whole) << type << amplitude;
        }
}

TEST_F(ProgramBalance, RunThatFails_LastRowHoldsNoEnergyThatNothingHasMade) {
    put("case.toml", test::small_deck);
    for (const char* scheme : {"integrator.type=central_difference", "integrator.type=verlet"}) {
        ASSERT_EQ(run({"load.0.value=3e8", "run.t_end=1e-2", "output.history=1e-9", "output.rows=steps", scheme}).code,
                  3);
        EXPECT_EQ(history("splitting [J]").back(), 0) << scheme;
        // as good as the rows before it
        const std::vector<double> error = history("balance_error");
        EXPECT_LT(error.back(), 2 * error[error.size() - 2] + balance_round_off) << scheme;
    }
}

// ---- runs that are not

/// A bar in its first mode, undamped: fifty periods.
const std::string vibration_deck = R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 0.1, cells = [4, 1] }
solid = { plane = "stress" }
material = [{ density = 2000, constants = { E = 1e9, nu = 0.0 } }]
initial = [{ velocity = ["1e-3*sin(pi*x/2)", 0] }]
boundary = [{ on = "left", type = "fixed" }]
run = { t_end = 0.28 }
output = { history = 1e-3 }
)toml";

const std::vector<std::string> unstable{"integrator.type=cvode", "integrator.method=adams", "integrator.rtol=1e-3"};

TEST_F(ProgramBalance, EnergyMadeFromNothing_EndsTheRun_AndSaysWhy) {
    put("case.toml", vibration_deck);
    const Ended ended = run(unstable);
    EXPECT_EQ(ended.code, 3);
    const auto said = AllOf(HasSubstr("have come from nothing"), HasSubstr("a smaller `rtol`"));
    EXPECT_THAT(ended.err, AllOf(said, HasSubstr("gneiss: warning: energy balance: "), HasSubstr("gneiss: error: ")));
    EXPECT_THAT(contents("out/run.log"), said);
    const nlohmann::json found = summary("out");
    EXPECT_EQ(found["status"], "failed");
    EXPECT_THAT(found["balance_warning"].get<std::string>(), said);
    EXPECT_EQ(found["warnings"][0], found["balance_warning"]);
    EXPECT_THAT(found["message"].get<std::string>(),
                AllOf(HasSubstr("`run.most_energy_gained` = 0.5 ends the run"), HasSubstr("no sound state was saved")));
    EXPECT_GE(found["balance_error"], 0.5);
    EXPECT_LT(found["time"]["t_s"], 0.28);
    EXPECT_TRUE(exists("out/checkpoint.h5"));
}

TEST_F(ProgramBalance, EnergyMadeFromNothing_WithCheckpoints_TheLastSoundOneStays) {
    put("case.toml", vibration_deck);
    std::vector<std::string> set = unstable;
    set.push_back("run.checkpoint=3e-3");
    ASSERT_EQ(run(set).code, 3);
    const std::string message = summary("out")["message"];
    const std::string phrase = "the last state with a sound balance, t = ";
    ASSERT_THAT(message, HasSubstr(phrase));
    const double t = std::stod(message.substr(message.find(phrase) + phrase.size()));
    EXPECT_LT(t, summary("out")["time"]["t_s"]);
    ASSERT_TRUE(exists("out/last_sound.h5"));
    // from there the run goes on with another setting of the scheme, to its end
    set[2] = "integrator.rtol=1e-8";
    const Ended resumed = run(set, {"--restart", "out/last_sound.h5"});
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(summary("out")["status"], "done");
}

TEST_F(ProgramBalance, EnergyMadeFromNothing_AfterARestart_TheSoundCheckpointBeforeItStays) {
    put("case.toml", vibration_deck);
    std::vector<std::string> begun = unstable, gone_on = unstable;
    begun.push_back("run.t_end=4e-3");
    gone_on.push_back("run.checkpoint=0.2");
    const std::string in = "the last state with a sound balance, t = 0.004 s, is in ";
    // in the folder of the first part its checkpoint gives way to the next one
    ASSERT_EQ(run(begun).code, 0);
    ASSERT_LT(summary("out")["balance_error"], 0.01);
    ASSERT_EQ(run(gone_on, {"--restart", "out/checkpoint.h5"}).code, 3);
    EXPECT_THAT(summary("out")["message"].get<std::string>(), HasSubstr(in + "out/last_sound.h5"));
    // and is found again by a part that begins where nothing is sound any more
    EXPECT_EQ(run(gone_on, {"--restart", "out/checkpoint.h5"}).code, 3);
    EXPECT_THAT(summary("out")["message"].get<std::string>(), HasSubstr(in + "out/last_sound.h5"));
    const std::vector<std::string> finer{"integrator.type=cvode", "integrator.method=adams", "integrator.rtol=1e-8"};
    EXPECT_EQ(run(finer, {"--restart", "out/last_sound.h5"}).code, 0);
    // in another folder it stays where it is
    ASSERT_EQ(run(begun).code, 0);
    const std::string first = contents("out/checkpoint.h5");
    std::vector<std::string> elsewhere{"run", "case.toml", "--out", "other", "--restart", "out/checkpoint.h5", "--set"};
    elsewhere.insert(elsewhere.end(), gone_on.begin(), gone_on.end());
    ASSERT_EQ(gneiss(elsewhere).code, 3);
    EXPECT_THAT(summary("other")["message"].get<std::string>(), HasSubstr(in + "out/checkpoint.h5"));
    EXPECT_EQ(contents("out/checkpoint.h5"), first);
    EXPECT_FALSE(exists("other/last_sound.h5"));
}

TEST_F(ProgramBalance, EnergyMadeFromNothing_KeyAtZero_GoesOnWithAWarning) {
    put("case.toml", vibration_deck);
    balance_may_be_out = true;
    std::vector<std::string> set = unstable;
    set.insert(set.end(), {"run.most_energy_gained=0", "run.t_end=0.1"});
    const Ended ended = run(set);
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.err, HasSubstr("gneiss: warning: energy balance: "));
    EXPECT_GT(summary("out")["largest_balance_error"], 0.5);
}

TEST_F(ProgramBalance, EnergyLost_IsWarnedOf_AndNeverEndsTheRun) {
    put("case.toml", vibration_deck);
    balance_may_be_out = true;
    const Ended ended = run({"integrator.type=bathe", "integrator.dt=1e-3", "integrator.rho_inf=0"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("have got lost"), HasSubstr("the scheme damps what its steps do not")));
    EXPECT_GT(summary("out")["largest_balance_error"], 0.01);
}

TEST_F(ProgramBalance, SoundRun_IsNotWarnedOf) {
    put("case.toml", vibration_deck);
    const Ended ended = run({"run.t_end=0.05"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.err, Not(HasSubstr("energy balance")));
    EXPECT_FALSE(summary("out").contains("warnings"));
}

TEST_F(ProgramBalance, Compare_NamesRunsThatAreNotToBeTrusted) {
    put("case.toml", vibration_deck + R"toml(
[compare]
samples = 5
reference = { type = "central_difference" }
[[compare.scheme]]
name = "damped"
integrator = { type = "bathe", dt = 1e-3, rho_inf = 0 }
)toml");
    const Ended ended = gneiss({"compare", "case.toml", "--threads", "1", "--set", "run.t_end=0.1"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.err, HasSubstr("gneiss: warning: damped: energy balance: "));
    EXPECT_THAT(contents("results/case-compare/report.html"),
                AllOf(HasSubstr("Not to be trusted"), HasSubstr("have got lost")));
    const auto runs = nlohmann::json::parse(contents("results/case-compare/compare.json")).at("runs");
    EXPECT_FALSE(runs[0].contains("warning"));
    EXPECT_THAT(runs[1]["warning"].get<std::string>(), HasSubstr("have got lost"));
    // what the program says of other things is not of the balance: light, and as stiff for its mass
    ASSERT_EQ(gneiss({"compare", "case.toml", "--threads", "1", "--set", "run.t_end=0.1", "material.0.density=50",
                      "material.0.constants.E=2.5e7"})
                  .code,
              0);
    const auto light = nlohmann::json::parse(contents("results/case-compare/compare.json")).at("runs");
    EXPECT_THAT(summary(light[0]["folder"].get<std::string>())["warnings"].dump(), HasSubstr("50 kg/m3"));
    EXPECT_FALSE(light[0].contains("warning"));
    EXPECT_THAT(light[1]["warning"].get<std::string>(), HasSubstr("have got lost"));
}

TEST_F(ProgramBalance, Compare_OnlyTheCheckOfTheReferenceFails_EveryRowIsDone) {
    put("case.toml", vibration_deck + R"toml(
[compare]
samples = 5
reference = { type = "cvode", method = "adams", rtol = 1e-4 }
[[compare.scheme]]
name = "leapfrog"
integrator = { type = "central_difference" }
)toml");
    // the check, with rtol = 1e-3, makes more energy from nothing than the key lets pass
    const Ended ended =
        gneiss({"compare", "case.toml", "--threads", "1", "--set", "run.t_end=0.05", "run.most_energy_gained=2e-2"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, AllOf(HasSubstr("gneiss: warning: the reference could not be checked: rtol = 0.001: "),
                                 HasSubstr("have come from nothing")));
    const auto table = nlohmann::json::parse(contents("results/case-compare/compare.json"));
    EXPECT_EQ(table["reference_check"]["status"], "failed");
    for (const auto& row : table["runs"]) EXPECT_EQ(row["status"], "done");
}

}  // namespace
}  // namespace gneiss
