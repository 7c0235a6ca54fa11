// Static integrators as a user meets them: what a run leaves, what check says, and every way in which it can fail.

#include <gmock/gmock.h>
#include <signal.h>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using test::small_deck;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class ProgramStatic : public test::ProgramTest, public testing::WithParamInterface<const char*> {
protected:
    std::string type() const { return std::string("integrator.type=") + GetParam(); }

    static std::string replaced(std::string text, const std::string& what, const std::string& by) {
        const std::size_t at = text.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        return at == std::string::npos ? text : text.replace(at, what.size(), by);
    }
    /// The small deck with a pressure that grows until its end.
    static std::string ramped(const std::string& value = "1e6") {
        return replaced(small_deck, "value = 1e6\n",
                        "value = " + value + "\namplitude = { type = \"ramp\", end = 1e-3 }\n");
    }
    /// Its mesh twice as wide, as two squares of 32 composites that do not touch, the left one fixed.
    void put_two_squares(const std::string& name) const {
        put("two.geo", R"(
lc = 0.25;
Point(1) = {0, 0, 0, lc}; Point(2) = {1, 0, 0, lc}; Point(3) = {1, 1, 0, lc}; Point(4) = {0, 1, 0, lc};
Point(5) = {2, 0, 0, lc}; Point(6) = {3, 0, 0, lc}; Point(7) = {3, 1, 0, lc}; Point(8) = {2, 1, 0, lc};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(2) = {2};
Physical Curve("left") = {4}; Physical Curve("right") = {2}; Physical Curve("bottom") = {5};
Physical Surface("rock") = {1, 2};
)");
        const std::string deck = small_deck;
        const std::size_t begin = deck.find("mesh = "), end = deck.find('\n', begin);
        put(name, std::string(deck).replace(begin, end - begin, "mesh = { file = \"two.geo\" }"));
    }
};

class ProgramIterative : public ProgramStatic {
protected:
    /// Under a traction, whose tangent is symmetric.
    static std::string dead_load() {
        return replaced(replaced(ramped(), "\"pressure\"", "\"traction\""), "value = 1e6", "value = [1e6, 2e5]");
    }
};

INSTANTIATE_TEST_SUITE_P(Both, ProgramStatic, testing::Values("quasi_static", "dynamic_relaxation"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST_P(ProgramStatic, UnderARamp_StoresTheWorkOfTheLoad) {
    put("case.toml", ramped());
    const Ended ended = gneiss({"run", "case.toml", "--quiet", "--threads", "1", "--set", type()});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const nlohmann::json found = summary("results/case");
    EXPECT_EQ(found["status"], "done");
    EXPECT_EQ(found["energies_J"]["kinetic"], 0);
    EXPECT_GT(found["energies_J"]["external_work"], 0);
    EXPECT_LE(found["counts"]["steps"], 10) << "one for each row, of which there is one every 1e-4 s";
    EXPECT_LE(found["balance_error"], 1e-3) << "of the order of the strains: the force bends by so much";
}

TEST_P(ProgramStatic, LoadSteps_StandInATable_AlsoAfterARestart) {
    put("case.toml", ramped());
    const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"run",   "case.toml", "--quiet", "--threads", "1",
                                           "--out", out,         "--set",   type(),      "integrator.longest=1e-4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return gneiss(arguments);
    };
    ASSERT_EQ(run("whole", {}).code, 0);
    const std::string table = contents("whole/load_steps.csv");
    EXPECT_THAT(
        table,
        StartsWith("t [s],dt [s],rejected,iterations,factorisations,linear_iterations,force_evaluations,unbalanced,"
                   "why_rejected\n0.0001,0.0001,0,"));
    EXPECT_EQ(n_lines("whole/load_steps.csv"), 11u);
    ASSERT_EQ(run("parts", {"run.t_end=5e-4"}).code, 0);
    EXPECT_EQ(n_lines("parts/load_steps.csv"), 6u);
    ASSERT_EQ(run("parts", {"--restart", "parts/checkpoint.h5"}).code, 0);
    EXPECT_EQ(contents("parts/load_steps.csv"), table);

    // and a run of another kind in the same folder leaves none
    ASSERT_EQ(gneiss({"run", "case.toml", "--quiet", "--out", "whole"}).code, 0);
    EXPECT_FALSE(exists("whole/load_steps.csv"));
}

TEST_P(ProgramStatic, WhatHasNoEffect_IsNamed) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"check", "case.toml", "--set", type(), "run.mass_damping=3"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("run.mass_damping: has no effect"));
    EXPECT_THAT(ended.out, HasSubstr("load with a constant amplitude"));
}

TEST_P(ProgramStatic, Check_SaysWhatMemoryTheMatrixTakes_AndNothingOfTime) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"check", "case.toml", "--set", type(), "integrator.step=1e-4"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("load step           0.0001 s at first, then adapted\n"));
    EXPECT_THAT(ended.out, Not(HasSubstr("run time")));
    const bool newton = std::string(GetParam()) == "quasi_static";
    EXPECT_EQ(newton, ended.out.find("MB of it matrices and their factors") != std::string::npos) << ended.out;
}

TEST_F(ProgramIterative, Reactions_StandInATableAndBalanceTheLoad) {
    put("case.toml", dead_load() + "[[boundary]]\non = \"bottom\"\ntype = \"displacement\"\nvalue = [\"free\", 0]\n");
    for (const char* type : {"quasi_static", "dynamic_relaxation", "central_difference"}) {
        const Ended ended =
            gneiss({"run", "case.toml", "--quiet", "--threads", "1", "--set", std::string("integrator.type=") + type});
        ASSERT_EQ(ended.code, 0) << ended.err;
        const std::string table = contents("results/case/reactions.csv");
        EXPECT_THAT(table, StartsWith("t [s],right.R_x [N],right.R_y [N],bottom.R_y [N]\n"));
        EXPECT_EQ(n_lines("results/case/reactions.csv"), n_lines("results/case/history.csv")) << type;
        if (std::string(type) == "central_difference") continue;  // inertia takes part
        double t = 0, right_x = 0, right_y = 0, bottom_y = 0;
        const std::string last = table.substr(table.rfind('\n', table.size() - 2) + 1);
        ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf,%lf,%lf", &t, &right_x, &right_y, &bottom_y), 4) << last;
        // 1 m by 1 m under 1 MPa and 0.2 MPa; forces out of balance by 1e-9 at every node
        EXPECT_NEAR(right_x, -1e6, 1e-6 * 1e6);
        EXPECT_NEAR(right_y + bottom_y, -2e5, 1e-6 * 1e6);
    }
}

TEST_F(ProgramIterative, EverySolver_FindsTheSameEquilibrium) {
    const auto left = [&](const std::string& settings) {
        put("case.toml", dead_load());
        const Ended ended = gneiss({"run", "case.toml", "--quiet", "--threads", "1", "--set",
                                    "integrator={ type = \"quasi_static\", tolerance = 1e-8, " + settings + " }"});
        EXPECT_EQ(ended.code, 0) << settings << ended.err;
        return summary("results/case")["energies_J"]["stored_material"].get<double>();
    };
    const double direct = left("solver = \"cholmod\"");
    EXPECT_GT(direct, 0);
    for (const char* settings :
         {"solver = \"pcg\"", "solver = \"pcg\", preconditioner = \"diagonal\", linear_tolerance = 1e-6",
          "solver = \"gmres\", most_linear_iterations = 500",
          "solver = \"pcg\", preconditioner = \"diagonal\", matrix_free = true",
          "solver = \"gmres\", preconditioner = \"diagonal\", matrix_free = true"})
        // forces out of balance by 1e-8 leave the energy at the equilibrium alone but for a condition of some hundred
        EXPECT_NEAR(left(settings), direct, 1e-6 * direct) << settings;
}

TEST_F(ProgramIterative, WhatDoesNotGoTogether_IsRefusedWithAReason) {
    const auto refusal = [&](const std::string& deck, const std::vector<std::string>& settings) {
        put("case.toml", deck);
        std::vector<std::string> arguments{"run", "case.toml", "--quiet", "--set", "integrator.type=quasi_static"};
        arguments.insert(arguments.end(), settings.begin(), settings.end());
        const Ended ended = gneiss(arguments);
        EXPECT_EQ(ended.code, 2);
        EXPECT_FALSE(exists("results"));
        return ended.err;
    };
    EXPECT_THAT(refusal(ramped(), {"integrator.solver=pcg"}), HasSubstr("the tangent is not symmetric: take gmres"));
    EXPECT_THAT(
        refusal(dead_load(), {"integrator.matrix_free=true"}),
        AllOf(HasSubstr("needs solver = \"pcg\" or \"gmres\""), HasSubstr("needs preconditioner = \"diagonal\"")));
    EXPECT_THAT(refusal(dead_load(), {"integrator.preconditioner=diagonal"}),
                HasSubstr("only for `solver` = \"pcg\", \"gmres\", here `solver` is \"automatic\""));
}

TEST_P(ProgramStatic, TooFewSupports_TheMotionsLeftAreNamed) {
    struct Case {
        std::string boundary, left;
    };
    for (const Case& c : std::vector<Case>{
             {"", "the solid: translation in x, translation in y, rotation about (0.5, 0.5)"},
             {"[[boundary]]\non = \"right\"\ntype = \"displacement\"\nvalue = [0, \"free\"]\n",
              "the solid: translation in y\n"},
             {"[[boundary]]\non = \"bottom_left\"\ntype = \"fixed\"\n", "the solid: rotation about (0, 0)\n"},
             {"[[boundary]]\non = \"left\"\ntype = \"absorbing\"\n", "translation in x, translation in y"}}) {
        put("case.toml", small_deck.substr(0, small_deck.find("[[boundary]]")) + c.boundary);
        // a pressure on the left pushes in x alone: whether the load would excite the motion does not matter
        for (const char* command : {"run", "check"}) {
            const Ended ended = gneiss({command, "case.toml", "--threads", "1", "--set", type()});
            EXPECT_EQ(ended.code, 2);
            EXPECT_THAT(ended.err,
                        AllOf(HasSubstr("[[boundary]]: too few supports for a static solution"), HasSubstr(c.left)));
            EXPECT_THAT(ended.out, IsEmpty());
        }
        EXPECT_FALSE(exists("results"));
    }
    // what moves is no problem where there is inertia
    EXPECT_EQ(gneiss({"run", "case.toml", "--quiet"}).code, 0);
}

TEST_P(ProgramStatic, LooseParts_EachIsNamed) {
    put_two_squares("case.toml");
    const Ended ended = gneiss({"check", "case.toml", "--set", type()});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, ContainsRegex("leaves free the part of [0-9]+ elements around \\(2\\.[45].*, 0\\.[45].*\\): "
                                         "translation in x, translation in y, rotation about"));
    EXPECT_EQ(gneiss({"check", "case.toml", "--set", type(),
                      "boundary=[{on='right',type='fixed'},{on='bottom',type='fixed'}]"})
                  .code,
              0);
}

TEST_P(ProgramStatic, NoEquilibrium_TheLastLoadLevelIsSavedAndNamed) {
    // pushed against the wall by more than any rock bears
    put("case.toml", ramped("3e9"));
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"run",
                                           "case.toml",
                                           "--threads",
                                           "1",
                                           "--set",
                                           type(),
                                           "integrator.shortest=1e-2",
                                           "integrator.step=1e-4",
                                           "output.fields=0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return gneiss(arguments);
    };
    const Ended ended = run({});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err,
                ContainsRegex("no equilibrium found after load time t = [0-9.e-]+ s, with load steps down to "
                              ".*; the last good state, t = [0-9.e-]+ s, is in results/case/checkpoint.h5"));
    const auto summary = this->summary("results/case");
    EXPECT_EQ(summary["status"], "failed");
    EXPECT_THAT(summary["message"].get<std::string>(), HasSubstr("results/case/checkpoint.h5"));
    const double t = summary["time"]["t_s"].get<double>();
    EXPECT_GT(t, 1e-4);
    EXPECT_LT(t, 1e-3);
    // it is the one that was reached last, and the run goes on from there, to fail again
    const std::string table = contents("results/case/load_steps.csv");
    const std::size_t last = table.rfind('\n', table.size() - 2) + 1;
    EXPECT_EQ(std::stod(table.substr(last)), t);
    EXPECT_EQ(run({"--restart", "results/case/checkpoint.h5"}).code, 3);
    EXPECT_EQ(this->summary("results/case")["time"]["t_s"], t);
}

TEST_P(ProgramStatic, Signal_WithinALoadStep_EndsItAtOnce) {
    // the run is one load step, of at least half a second
    put("case.toml", replaced(ramped(), "cells = [4, 4]", "cells = [64, 64]"));
    const std::vector<std::string> run{"run",   "case.toml", "--threads",       "1",
                                       "--set", type(),      "output.fields=0", "integrator.tolerance=1e-11"};
    const Ended ended = gneiss(run, [&](pid_t process) {
        wait_until([&] { return contents("results/case/run.log").find("start: ") != std::string::npos; });
        ::kill(process, SIGINT);
    });
    EXPECT_EQ(ended.code, 130);
    const auto summary = this->summary("results/case");
    EXPECT_EQ(summary["status"], "interrupted");
    EXPECT_EQ(summary["time"]["t_s"], 0);
    EXPECT_TRUE(exists("results/case/checkpoint.h5"));
}

TEST_P(ProgramStatic, BadTolerance_IsRefused) {
    put("case.toml", ramped());
    for (const char* value : {"0", "-1e-9", "0.1", "nan"}) {
        const Ended ended = gneiss({"run", "case.toml", "--set", type(), std::string("integrator.tolerance=") + value});
        EXPECT_EQ(ended.code, 2);
        EXPECT_THAT(ended.err, AllOf(HasSubstr("key `integrator.tolerance`: given "), HasSubstr("(0, 0.01]")));
    }
    EXPECT_FALSE(exists("results"));
}

class ProgramNewton : public ProgramStatic {};
INSTANTIATE_TEST_SUITE_P(One, ProgramNewton, testing::Values("quasi_static"));

TEST_P(ProgramNewton, PastABifurcation_WarnsOnce) {
    // a slender column, pressed far beyond the load at which it buckles: straight as it is, Newton's method stays on
    // the straight path
    put("case.toml", R"toml(
mesh = { generator = "rectangle", width = 10.0, height = 0.5, cells = [20, 1], pattern = "crossed" }
solid = { plane = "strain" }
run = { t_end = 1.0 }
integrator = { type = "quasi_static", step = 0.1, longest = 0.1 }
[[material]]
density = 1000.0
constants = { E = 1e9, nu = 0.0 }
[[load]]
on = "right"
type = "traction"
value = [-2e7, 0]
amplitude = { type = "ramp", end = 1.0 }
[[boundary]]
on = "left"
type = "fixed"
)toml");
    const Ended ended = gneiss({"run", "case.toml", "--threads", "1"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    const std::string log = contents("results/case/run.log"), what = "the tangent is indefinite at load time t = ";
    ASSERT_THAT(log, HasSubstr(what));
    EXPECT_EQ(log.find(what), log.rfind(what));
    // Euler's load of a cantilever, pi^2 E I/(4 L^2) over its height: 5.14e5 Pa, here reached at t = 0.0257; the first
    // tangents are at rest and at the end of the first load step
    EXPECT_THAT(log, HasSubstr(what + "0.1 s: a limit or bifurcation point lies before it"));
}

}  // namespace
}  // namespace gneiss
