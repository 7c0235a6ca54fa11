// Loads and supports that act after a rest, given as expressions: every scheme sees them.

#include <gmock/gmock.h>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string bar = R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 0.1, cells = [10, 1] }
solid = { plane = "stress" }
material = [{ density = 2000, constants = { E = 1e9, nu = 0.25 } }]
run = { t_end = 0.005 }
)toml";

/// 1 ms of load after 2 ms of rest.
const std::string pulse = bar + R"toml(
load = [{ on = "right", type = "traction", value = [1e5, 0], amplitude = { type = "expression", expression = "t>2e-3 && t<3e-3 ? sin(pi*(t-2e-3)/1e-3)^2 : 0" } }]
boundary = [{ on = "left", type = "fixed" }]
)toml";

/// A support shaken for 0.15 ms.
const std::string shaken = bar + R"toml(
boundary = [{ on = "left", type = "displacement", value = [1e-4, 0], amplitude = { type = "expression", expression = "t > 2.05e-3 && t < 2.2e-3 ? sin(pi*(t-2.05e-3)/1.5e-4)^2 : 0" } }]
)toml";

/// 20 microseconds of load, smooth and nowhere zero, that run along the bar.
const std::string passing = bar + R"toml(
load = [{ type = "body_force", value = [1e6, 0], amplitude = { type = "expression", expression = "exp(-((t - 3e-3 - x/1000)/1e-5)^2)" } }]
boundary = [{ on = "left", type = "fixed" }]
)toml";

/// 0.1 ms of load that no comparison switches on and off.
const std::string stepped = bar + R"toml(
load = [{ on = "right", type = "traction", value = [1e5, 0], amplitude = { type = "expression", expression = "atan2(t - 2e-3, 0) - atan2(t - 2.1e-3, 0)" } }]
boundary = [{ on = "left", type = "fixed" }]
)toml";

/// The comparison is over soon after the load is: what is compared is whether it was seen, not how schemes vibrate on.
const std::string adaptive_schemes = R"toml(
[compare]
samples = 10
reference = { type = "central_difference", safety = 0.02 }
[[compare.scheme]]
name = "bdf"
integrator = { type = "cvode", rtol = RTOL, stability_detection = false }
[[compare.scheme]]
name = "adams"
integrator = { type = "cvode", method = "adams", rtol = RTOL }
[[compare.scheme]]
name = "Runge-Kutta"
integrator = { type = "arkode", rtol = RTOL }
[[compare.scheme]]
name = "implicit Runge-Kutta"
integrator = { type = "arkode", table = "sdirk_5_3_4", rtol = RTOL }
[[compare.scheme]]
name = "ida"
integrator = { type = "ida", rtol = RTOL }
[[compare.scheme]]
name = "generalized alpha"
integrator = { type = "generalized_alpha", adaptive = true, rtol = RTOL }
[[compare.scheme]]
name = "newmark"
integrator = { type = "newmark", adaptive = true, rtol = RTOL }
)toml";

class ProgramPulse : public test::ProgramTest {
protected:
    nlohmann::json compared(std::string deck) {
        deck += adaptive_schemes;
        for (std::size_t at = 0; (at = deck.find("RTOL")) != std::string::npos;) deck.replace(at, 4, "1e-5");
        put("a.toml", deck);
        const Ended ended = gneiss({"compare", "a.toml", "--threads", "1", "--quiet"});
        EXPECT_EQ(ended.code, 0) << ended.err;
        return nlohmann::json::parse(contents("results/a-compare/compare.json"), nullptr, false);
    }
};

TEST_F(ProgramPulse, LoadAfterARest_IsSeenByEverySchemeThatChoosesItsSteps) {
    // local errors of 1e-5 add up over some hundred steps, to 0.03 at the kinks of a shaken support; a load that is
    // missed is an error of 1
    constexpr double seen = 0.05;
    for (const std::string& deck : {pulse, shaken, passing, stepped}) {
        const nlohmann::json json = compared(deck);
        ASSERT_EQ(json.at("runs").size(), 8u);
        // order 2 at a fiftieth of the critical step
        EXPECT_LT(json.at("reference_check").at("error_displacement"), 1e-3);
        for (const auto& run : json.at("runs"))
            EXPECT_LT(run.at("error_displacement"), seen) << run.at("scheme") << " of " << deck;
    }
}

TEST_F(ProgramPulse, StepsThatAreGiven_AreToldOfOnceWhereTheyPassOverALoad) {
    put("a.toml", pulse + "integrator = { type = \"newmark\", dt = 1e-3 }\n");
    const Ended coarse = gneiss({"run", "a.toml"});
    EXPECT_EQ(coarse.code, 0) << coarse.err;
    EXPECT_THAT(coarse.err, AllOf(HasSubstr("a step of 0.001 s near t = 0.002 s is longer than"),
                                  HasSubstr("within which a load or a support varies")));
    const Ended fine = gneiss({"run", "a.toml", "--set", "integrator.dt=1e-5", "--out", "fine"});
    EXPECT_THAT(fine.err, Not(HasSubstr("is longer than")));
}

TEST_F(ProgramPulse, DisplacementThatJumps_IsRefusedOfAnExpressionToo) {
    const std::string smooth = "t > 2.05e-3 && t < 2.2e-3 ? sin(pi*(t-2.05e-3)/1.5e-4)^2 : 0";
    for (const char* jumping :
         {"t > 2.05e-3 && t < 2.2e-3 ? 1 : 0", "atan2(t - 1.013e-3, 0)", "atan(1/(t - 1.013e-3))", "tan(pi*t/4e-3)"}) {
        std::string deck = shaken;
        deck.replace(deck.find(smooth), smooth.size(), jumping);
        put("a.toml", deck);
        const Ended ended = gneiss({"run", "a.toml"});
        EXPECT_EQ(ended.code, 2) << jumping;
        EXPECT_THAT(ended.err, HasSubstr("a displacement cannot jump")) << jumping;
    }
}

TEST_F(ProgramPulse, ReferenceThatDoesNotMove_HasNoErrors) {
    std::string deck = pulse;
    deck.replace(deck.find("1e5, 0"), 6, "0, 0");
    const nlohmann::json json = compared(deck);
    for (const auto& run : json.at("runs")) {
        EXPECT_FALSE(run.contains("error_displacement"));
        EXPECT_THAT(run.at("message").get<std::string>(), HasSubstr("nothing moves in it"));
    }
}

}  // namespace
}  // namespace gneiss
