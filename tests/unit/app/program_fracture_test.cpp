// A case that cracks, from its deck to its results.

#include <gmock/gmock.h>

#include <algorithm>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string cracking_deck = R"toml(title = "a block that is pulled apart"
mesh = { generator = "rectangle", width = 0.04, height = 0.02, cells = [8, 4], pattern = "crossed" }
solid = { plane = "strain" }
run = { t_end = 1e-4, checkpoint = 5e-5 }
output = { history = 1e-9, rows = "steps", probes = [{ name = "p", at = [0.02, 0.01] }] }
[[material]]
density = 2500.0
constants = { E = 30e9, nu = 0.2 }
strength = { tensile = 4e6, cohesion = 1e7, friction = 0.6, residual_friction = 0.4, G_I = 20, G_II = 60 }
[fracture]
method = "intrinsic"
weibull_modulus = 10
[[boundary]]
on = "left"
type = "fixed"
[[boundary]]
on = "right"
type = "velocity"
value = [0.5, "free"]
)toml";

/// Nothing of it breaks.
const std::string strong =
    "material.0.strength={ tensile = 1e9, cohesion = 1e9, friction = 0, residual_friction = 0, G_I = 1e5, G_II = 1e5 }";

class ProgramFracture : public test::ProgramTest {
protected:
    ProgramFracture() { put("case.toml", cracking_deck); }

    nlohmann::json energies(const std::vector<std::string>& more, const std::string& out) const {
        std::vector<std::string> arguments{"run", "case.toml", "--quiet", "--out", out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ended ended = gneiss(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return summary(out)["energies_J"];
    }
};

TEST_F(ProgramFracture, PulledApart_PaysForItsCracks) {
    for (const char* element : {"solid.element=cst", "solid.element=compt"})
        for (const char* method :
             {"fracture.method=intrinsic", "fracture.method=y_code", "fracture.method=extrinsic"}) {
            const nlohmann::json found = energies({"--set", element, method}, "out");
            EXPECT_GT(found["dissipated_fracture"], 0.01) << element << method;
            // waves that crack edges at steps of 0.8 of the critical one: kinks of the law within steps
            EXPECT_LT(summary("out")["balance_error"], 5e-3) << element << method;
        }
}

TEST_F(ProgramFracture, ThreadsAndRestarts_DoNotMoveABit) {
    for (const std::string method : {"fracture.method=intrinsic", "fracture.method=extrinsic"}) {
        energies({"--threads", "1", "--set", method}, "one");
        energies({"--threads", "2", "--set", method}, "two");
        EXPECT_EQ(contents("one/history.csv"), contents("two/history.csv")) << method;
        energies({"--threads", "1", "--set", method, "run.t_end=5e-5"}, "parts");
        energies({"--threads", "1", "--restart", "parts/checkpoint.h5", "--set", method}, "parts");
        EXPECT_EQ(contents("parts/probes.csv"), contents("one/probes.csv")) << method;
    }
}

TEST_F(ProgramFracture, Results_TellOfCracksAndFragments) {
    for (const std::string method : {"fracture.method=intrinsic", "fracture.method=extrinsic"}) {
        energies({"--set", method}, "out");
        const nlohmann::json cracks = summary("out")["cracks"];
        EXPECT_GE(cracks["cracked_length_m"], 0.02) << "from top to bottom, " << method;
        EXPECT_GE(cracks["fragments"], 2);
        EXPECT_THAT(contents("out/cracks.pvd"), HasSubstr("cracks_000001.vtu"));
        EXPECT_TRUE(contents("out/fragments.csv")
                        .starts_with("t [s],fragment,elements,mass [kg],x [m],y [m],v_x [m/s],v_y [m/s]\n"));
        auto fragments = table("out/fragments.csv");
        std::map<double, double> mass;
        for (std::size_t row = 0; row < fragments["t [s]"].size(); ++row)
            mass[fragments["t [s]"][row]] += fragments["mass [kg]"][row];
        ASSERT_EQ(mass.size(), 2u);
        for (const auto& [t, sum] : mass) EXPECT_NEAR(sum, 2500 * 0.04 * 0.02, 1e-12) << "at " << t;
    }
}

TEST_F(ProgramFracture, PulledApartAndPushedTogether_FragmentsTouch) {
    // broken after 30 us, and closed again after 60 us
    const std::string back =
        "boundary.1.amplitude={ type = \"table\", times = [0, 4e-5, 5e-5, 1e-4], values = [1, 1, -2, -2] }";
    for (const std::string method : {"fracture.method=intrinsic", "fracture.method=extrinsic"})
        for (const std::string element : {"solid.element=cst", "solid.element=compt"}) {
            const std::string what = method + " " + element;
            const std::vector<std::string> sets{"--set", method, element, back,
                                                "contact={ method = \"potential\", friction = 0.4 }"};
            energies(sets, "out");
            const double largest = std::ranges::max(table("out/history.csv")["stored_contact [J]"]);
            EXPECT_GT(largest, 1e-3) << "J that pieces press into each other, " << what;
            EXPECT_LT(summary("out")["balance_error"], 5e-3) << what;
        }
}

TEST_F(ProgramFracture, Extrinsic_UnderOtherIntegrators_BreaksAlike) {
    const std::vector<std::string> coarse{"--set", "fracture.method=extrinsic", "mesh.cells=[4,2]", "run.t_end=6e-5"};
    const auto broken = [&](const std::string& integrator) {
        std::vector<std::string> arguments = coarse;
        arguments.push_back("integrator={ " + integrator + " }");
        const nlohmann::json found = energies(arguments, "out");
        // cracked right through; schemes to a tolerance damp what follows the break by as much as that
        EXPECT_NEAR(summary("out")["cracks"]["cracked_length_m"].get<double>(), 0.02, 1e-12) << integrator;
        EXPECT_LT(summary("out")["balance_error"], 1e-2) << integrator;
        return found["dissipated_fracture"].get<double>();
    };
    const double explicit_loop = broken("type = \"central_difference\"");
    EXPECT_GT(explicit_loop, 20 * 0.02);  // G_I times the height, and edges that soften and do not break
    // a step late is a step's growth of the traction, up to a tenth here: another path afterwards
    for (const char* integrator : {R"(type = "generalized_alpha", dt = 2e-8)", R"(type = "cvode", rtol = 1e-4)",
                                   R"(type = "arkode")", R"(type = "ida", rtol = 1e-4)"})
        EXPECT_NEAR(broken(integrator), explicit_loop, 0.15 * explicit_loop) << integrator;
}

/// A plate that is stretched evenly, u_x = 10 x t: all of it reaches its strength at one instant.
const std::string stretched_deck = R"toml(
mesh = { generator = "rectangle", width = 0.04, height = 0.02, cells = [4, 2], pattern = "crossed" }
solid = { plane = "strain" }
run = { t_end = 1.3e-5 }
fracture = { method = "extrinsic" }
[[material]]
density = 2500.0
constants = { E = 30e9, nu = 0.2 }
strength = { tensile = 4e6, cohesion = 1e8, friction = 0, residual_friction = 0, G_I = 20, G_II = 60 }
[[initial]]
velocity = ["10*x", 0]
[[boundary]]
on = "left"
type = "velocity"
value = ["10*x", 0]
[[boundary]]
on = "right"
type = "velocity"
value = ["10*x", 0]
[[boundary]]
on = "top"
type = "velocity"
value = ["10*x", 0]
[[boundary]]
on = "bottom"
type = "velocity"
value = ["10*x", 0]
)toml";

TEST_F(ProgramFracture, EventTolerance_TheSameInstantUnderEveryScheme) {
    put("stretched.toml", stretched_deck);
    const auto opening = [&](const std::string& integrator, const std::string& tolerance,
                             const std::string& overshoot = "0") {
        const Ended ended =
            gneiss({"run", "stretched.toml", "--quiet", "--out", "out", "--set", "integrator={ " + integrator + " }",
                    "run.event_tolerance=" + tolerance, "fracture.overshoot=" + overshoot});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return summary("out").at("cracks").at("first_opening_s").get<double>();
    };
    const double exact = opening("type = \"central_difference\"", "1e-13");
    // f_t over the P-wave modulus and the rate, to the order of the strain, 1.2e-4
    const double modulus = 30e9 * 0.8 / (1.2 * 0.6);
    EXPECT_NEAR(exact, 4e6 / (modulus * 10), 3e-4 * exact);
    for (const char* integrator :
         {R"(type = "central_difference")", R"(type = "generalized_alpha", dt = 1e-6)",
          R"(type = "newmark", dt = 1e-6)", R"(type = "hht_alpha", dt = 1e-6)", R"(type = "cvode", rtol = 1e-6)",
          R"(type = "arkode", rtol = 1e-6)", R"(type = "ida", rtol = 1e-6)"}) {
        const double late = opening(integrator, "1e-9") - exact;
        EXPECT_GE(late, -1e-13) << integrator;
        EXPECT_LE(late, 1e-9) << integrator;
        EXPECT_LT(summary("out").at("cracks").at("largest_overshoot"), 1e-4) << integrator;  // growth in 1e-9 s
    }
    const std::string long_steps = "type = \"generalized_alpha\", dt = 1e-6";
    EXPECT_GT(opening(long_steps, "0", "1") - exact, 1e-7) << "a step late without it";
    // without a time, the traction may be 1 % beyond the strength: the same part of the time in which it has grown
    EXPECT_LE(opening(long_steps, "0") - exact, 0.01 * exact);
    EXPECT_GT(summary("out").at("cracks").at("largest_overshoot"), 0);
    EXPECT_LE(summary("out").at("cracks").at("largest_overshoot"), 0.01);
}

TEST_F(ProgramFracture, Extrinsic_BeforeAnythingBreaks_IsTheWholeSolidToTheBit) {
    const std::string tension = "material.0.strength.tensile=1e9", shear = "material.0.strength.cohesion=1e9";
    energies({"--set", "fracture.method=extrinsic", tension, shear, "material.0.strength.G_I=1e6",
              "material.0.strength.G_II=1e6"},
             "watched");
    energies({"--set", "fracture={ method = \"none\" }"}, "whole");
    EXPECT_EQ(contents("watched/probes.csv"), contents("whole/probes.csv"));
}

TEST_F(ProgramFracture, Scatter_AnotherSeedIsAnotherSample) {
    const auto fracture = [&](const std::string& set) {
        return energies({"--set", set}, "out")["dissipated_fracture"].get<double>();
    };
    EXPECT_NE(fracture("fracture.seed=1"), fracture("fracture.seed=2"));
    EXPECT_EQ(fracture("fracture.seed=1"), fracture("fracture.seed=1"));
}

TEST_F(ProgramFracture, BadInput_IsNamed) {
    const auto refusal = [&](const std::vector<std::string>& set) {
        std::vector<std::string> arguments{"run", "case.toml", "--quiet", "--set"};
        arguments.insert(arguments.end(), set.begin(), set.end());
        const Ended ended = gneiss(arguments);
        EXPECT_EQ(ended.code, 2);
        return ended.err;
    };
    EXPECT_THAT(refusal({"material.0.strength.G_I=1e-3"}),
                AllOf(HasSubstr("[[material]] 1 strength: fracture_energy_i is 0.001 J/m2"), HasSubstr("1 problem")));
    EXPECT_THAT(refusal({"material.0.strength.tensile=0"}), HasSubstr("given 0, must be"));
    EXPECT_THAT(refusal({"material.0.strength={ tensile = 1e6 }"}),
                HasSubstr("`material[0].strength.cohesion`: missing"));
    EXPECT_THAT(refusal({"fracture={ seed = 3, method = \"intrinsic\" }"}),
                HasSubstr("has no effect without `weibull_modulus`"));
    const std::size_t strength = cracking_deck.find("strength =");
    put("case.toml", cracking_deck.substr(0, strength) + "# " + cracking_deck.substr(strength));
    EXPECT_THAT(refusal({"run.t_end=1e-6"}), HasSubstr("`strength` is missing, which [fracture] needs"));
    EXPECT_THAT(refusal({"crack=[{ on = \"left\" }]"}), HasSubstr("[[crack]] 1: on = \"left\": this is a boundary"));
}

TEST_F(ProgramFracture, Crack_IsOpenWithAndWithoutJoints) {
    // the block is cut through: half of it stays where it is
    const std::string probe = "output.probes=[{ name = \"left\", at = [0.015, 0.01] }]";
    const std::string cut = "mesh.lines=[{ name = \"cut\", from = [0.02, 0], to = [0.02, 0.02] }]";
    for (const char* element : {"solid.element=cst", "solid.element=compt"})
        for (const char* method : {"fracture={ method = \"none\" }", "fracture.method=intrinsic"}) {
            const nlohmann::json found =
                energies({"--set", element, method, cut, strong, "crack=[{ on = \"cut\" }]", probe}, "out");
            EXPECT_EQ(found["dissipated_fracture"].get<double>(), 0) << element << method;
            EXPECT_GT(found["kinetic"].get<double>(), 0.05) << element << method;
            EXPECT_TRUE(contents("out/probes.csv").ends_with(",0,0,0,0,0,0,0\n")) << "left of the cut nothing moves";
        }
}

TEST_F(ProgramFracture, Interface_BreaksInPlaceOfTheMaterial) {
    const std::string line = "mesh.lines=[{ name = \"seam\", from = [0.02, 0], to = [0.02, 0.02] }]";
    const std::string seam =
        "interface=[{ on = \"seam\", strength = { tensile = 4e6, cohesion = 1e7, friction = 0, "
        "residual_friction = 0, G_I = 20, G_II = 60 } }]";
    EXPECT_EQ(energies({"--set", line, strong}, "out")["dissipated_fracture"].get<double>(), 0);
    const double apart =
        energies({"--set", line, strong, seam, "fracture.weibull_modulus=0"}, "out")["dissipated_fracture"];
    EXPECT_NEAR(apart, 20 * 0.02, 1e-3 * 20 * 0.02) << "G_I times the seam's length";
}

TEST_F(ProgramFracture, CoarseEdges_AreWarnedOf) {
    const Ended ended = gneiss({"check", "case.toml", "--set", "material.0.strength.G_I=0.5"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    // l_ch = G E'/f_t^2 = 0.5 J/m2 * 33 GPa / (4 MPa)^2 = 1.04 mm against sub-edges of up to 2.5 mm
    EXPECT_THAT(ended.out, HasSubstr("longer than the length over which a crack softens"));
}

/// Cracks along a line in the middle alone, or between grains; the material has no strength.
const std::string seam_deck = R"toml(title = "a block that comes apart along a seam"
mesh = { generator = "rectangle", width = 0.04, height = 0.02, cells = [8, 4], lines = [{ name = "seam", from = [0.02, 0], to = [0.02, 0.02] }] }
solid = { plane = "strain" }
material = [{ density = 2500.0, constants = { E = 30e9, nu = 0.2 } }]
fracture = { method = "intrinsic", on = [] }
interface = [{ on = "seam", strength = { tensile = 4e6, cohesion = 1e7, friction = 0.6, residual_friction = 0.4, G_I = 20, G_II = 60 } }]
boundary = [{ on = "left", type = "displacement", value = [0.0, 0.0] }, { on = "right", type = "displacement", value = [3e-5, 0.0], amplitude = { type = "ramp", end = 1e-3 } }]
run = { t_end = 1e-3 }
)toml";

/// J, of a seam of 0.02 m that is pulled until nothing holds it: G_I times its length.
constexpr double whole_seam = 20 * 0.02;

TEST_F(ProgramFracture, CracksWhereTheDeckAllowsThemAlone_CostThoseSides) {
    put("seam.toml", seam_deck);
    for (const char* element : {"solid.element=cst", "solid.element=compt"})
        for (const char* method :
             {"fracture.method=intrinsic", "fracture.method=y_code", "fracture.method=extrinsic"}) {
            const Ended ended = gneiss({"run", "seam.toml", "--quiet", "--out", "out", "--set", element, method});
            ASSERT_EQ(ended.code, 0) << element << method << ended.err;
            // waves that are left when the seam snaps, and ends of the extrinsic law that begin at their strength
            constexpr double of_waves = 0.02;
            // 3 times the integral of Y-code's softening curve: y_code_law_test.cpp
            const double of_law = std::string(method).ends_with("y_code") ? 1.159 : 1;
            EXPECT_NEAR(summary("out")["energies_J"]["dissipated_fracture"].get<double>() / whole_seam, of_law,
                        of_waves)
                << element << method;
            EXPECT_EQ(summary("out")["cracks"]["fragments"], 2) << element << method;
        }
}

TEST_F(ProgramFracture, StaticSeam_HoldsUpToItsStrengthAndNothingElseSoftens) {
    put("seam.toml", seam_deck);
    // 0.02 m of joints at 1e-6 of strain: the displacement that gives half the strength
    for (const char* element : {"solid.element=cst", "solid.element=compt"}) {
        const Ended ended = gneiss({"run", "seam.toml", "--quiet", "--out", "out", "--set", element,
                                    "integrator.type=quasi_static", "boundary.1.value=[2e-6, 0.0]"});
        ASSERT_EQ(ended.code, 0) << element << ended.err;
        EXPECT_EQ(summary("out")["energies_J"]["dissipated_fracture"].get<double>(), 0) << element;
        EXPECT_EQ(summary("out")["cracks"]["fragments"], 1) << element;
    }
}

/// A block under stress in situ that is held on all sides: nothing moves.
const std::string held_deck = R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 1.0, cells = [2, 2] }
solid = { element = "cst", plane = "strain" }
fracture = { method = "intrinsic" }
run = { t_end = 5e-4 }
output = { history = 1e-4 }
[[material]]
form = "hypo"
density = 2700.0
constants = { E = 30e9, nu = 0.3 }
in_situ_stress = [-30e6, -5e6, 0.0]
strength = { tensile = 1e6, cohesion = 20e6, friction = 0.8, residual_friction = 0.8, G_I = 200.0, G_II = 4000.0 }
[[boundary]]
on = "left"
type = "displacement"
value = [0.0, "free"]
[[boundary]]
on = "right"
type = "displacement"
value = [0.0, "free"]
[[boundary]]
on = "bottom"
type = "displacement"
value = ["free", 0.0]
[[boundary]]
on = "top"
type = "displacement"
value = ["free", 0.0]
)toml";

TEST_F(ProgramFracture, StressAtRest_ErrorsAreNotMeasuredAgainstItsRoundOff) {
    put("held.toml", held_deck);
    const double energy_at_rest = 30e6 * 30e6 / (2 * 30e9);  // J, of a block of 1 m3, about
    const std::vector<std::vector<std::string>> schemes = {{"integrator.type=cvode"},
                                                           {"integrator.type=cvode", "integrator.method=adams"},
                                                           {"integrator.type=arkode"},
                                                           {"integrator.type=ida"},
                                                           {"integrator.type=mri", "integrator.dt=1e-5"},
                                                           {"integrator.type=newmark", "integrator.adaptive=true"}};
    for (const auto& scheme : schemes)
        for (const char* method : {"fracture.method=intrinsic", "fracture.method=extrinsic"}) {
            std::vector<std::string> arguments{"run", "held.toml", "--quiet", "--out", "out", "--set", method};
            arguments.insert(arguments.end(), scheme.begin(), scheme.end());
            const Ended ended = gneiss(arguments);
            ASSERT_EQ(ended.code, 0) << scheme[0] << ended.err;
            const nlohmann::json found = summary("out");
            // explicit steps at the limit of stability are some hundred; with errors of round-off they were millions
            EXPECT_LT(found["counts"]["steps"], 1000) << scheme[0] << method;
            EXPECT_LT(found["energies_J"]["kinetic"], 1e-15 * energy_at_rest) << scheme[0] << method << ": round-off";
        }
}

TEST_F(ProgramFracture, WithoutAnythingThatMayCrack_IsRefused) {
    put("seam.toml", seam_deck);
    const Ended ended = gneiss({"check", "seam.toml", "--set", "interface=[]"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("[fracture] on: no side may crack: it names none, and there is no [[interface]]"));
    EXPECT_THAT(gneiss({"check", "seam.toml", "--set", "fracture.on=['solid']"}).err,
                HasSubstr("`strength` is missing, which [fracture] needs"));
}

}  // namespace
}  // namespace gneiss
