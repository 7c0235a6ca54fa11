// The times of rows and frames of a run: those that were asked for, under every scheme.

#include <gmock/gmock.h>

#include <algorithm>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// At rest for 20 ms, so that schemes that choose their steps take long ones.
const std::string bar_deck = R"toml(title = "bar at rest until a load jumps at 20 ms"
mesh = { generator = "rectangle", width = 1.0, height = 0.25, cells = [4, 1] }
solid = { plane = "strain" }
material = [{ density = 1000.0, constants = { E = 1e7, nu = 0.0 } }]
load = [{ on = "right", type = "traction", value = [1e4, 0.0], amplitude = { type = "heaviside", start = 0.02 } }]
boundary = [{ on = "left", type = "fixed" }]
run = { t_end = 0.05 }
output = { history = 1e-3, probes = [{ name = "tip", at = [1.0, 0.125] }] }
)toml";

struct Scheme {
    const char* name;
    std::vector<std::string> set;
};

void PrintTo(const Scheme& scheme, std::ostream* out) { *out << scheme.name; }

class ProgramHistory : public test::ProgramTest, public testing::WithParamInterface<Scheme> {
protected:
    ProgramHistory() { put("case.toml", bar_deck); }
    Ended run(const std::string& out, const std::vector<std::string>& set, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"run", "case.toml", "--quiet", "--threads", "1", "--out", out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        arguments.push_back("--set");
        arguments.insert(arguments.end(), set.begin(), set.end());
        return gneiss(arguments);
    }
};

INSTANTIATE_TEST_SUITE_P(
    Schemes, ProgramHistory,
    testing::Values(
        Scheme{"CentralDifference", {"integrator.type=central_difference"}},
        Scheme{"Verlet", {"integrator.type=verlet", "integrator.composition=suzuki_5"}},
        // its balance is of order 2: at half of its largest step, twice that of the leapfrog, 6e-2
        Scheme{"NohBathe", {"integrator.type=noh_bathe", "integrator.split=0.5", "integrator.safety=0.1"}},
        Scheme{"Newmark", {"integrator.type=newmark", "integrator.dt=1.3e-4"}},
        Scheme{"GeneralizedAlpha",
               {"integrator.type=generalized_alpha", "integrator.adaptive=true", "integrator.rtol=1e-5"}},
        Scheme{"Bathe", {"integrator.type=bathe", "integrator.dt=1.3e-4", "integrator.rho_inf=1"}},
        Scheme{"CvodeBdf", {"integrator.type=cvode"}},
        Scheme{"CvodeAdams", {"integrator.type=cvode", "integrator.method=adams"}},
        Scheme{"Arkode", {"integrator.type=arkode"}},
        Scheme{"ArkodeOrderEight",
               {"integrator.type=arkode", "integrator.table=fehlberg_13_7_8", "integrator.dt=3.1e-4"}},
        Scheme{"Mri", {"integrator.type=mri", "integrator.dt=1.3e-4", "contact={method='potential', friction=0.0}"}},
        Scheme{"Ida", {"integrator.type=ida"}},
        Scheme{"QuasiStatic", {"integrator.type=quasi_static", "load.0.amplitude={type='ramp', start=0.02, end=0.05}"}},
        Scheme{"DynamicRelaxation",
               {"integrator.type=dynamic_relaxation", "load.0.amplitude={type='ramp', start=0.02, end=0.05}"}}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(ProgramHistory, IntervalOfAMillisecond_EveryTableHasItsMultiples) {
    ASSERT_EQ(run("out", GetParam().set).code, 0);
    for (const char* file : {"out/history.csv", "out/probes.csv", "out/reactions.csv"}) {
        const std::vector<double> times = table(file)["t [s]"];
        ASSERT_EQ(times.size(), 51u) << file;
        for (std::size_t k = 0; k < times.size(); ++k) EXPECT_EQ(times[k], static_cast<double>(k) / 1000) << file;
    }
    // energies are those of the time of the row: that of an interpolated row closes as that of a step does
    const std::vector<double> errors = table("out/history.csv")["balance_error"];
    for (const double error : errors) EXPECT_LT(error, 3e-3);
    EXPECT_EQ(table("out/probes.csv")["tip.u_x [m]"][19], 0);
}

TEST_P(ProgramHistory, Checkpoint_BetweenRows_GivesTheSameTables) {
    std::vector<std::string> set = GetParam().set, part = set;
    for (auto* one : {&set, &part}) one->push_back("run.checkpoint=0.0265");
    part.push_back("run.t_end=0.0265");
    ASSERT_EQ(run("whole", set).code, 0);
    ASSERT_EQ(run("part", part).code, 0);
    ASSERT_EQ(run("part", set, {"--restart", "part/checkpoint.h5"}).code, 0);
    const std::string whole = contents("whole/probes.csv"), resumed = contents("part/probes.csv");
    // the part's last row is at its end
    const std::size_t extra = resumed.find("\n0.0265,");
    ASSERT_NE(extra, std::string::npos);
    EXPECT_TRUE(whole == std::string(resumed).erase(extra, resumed.find('\n', extra + 1) - extra));
}

TEST_F(ProgramHistory, Interpolated_IsAsExactAsSteps) {
    const std::string rtol = "integrator.rtol=1e-8";
    ASSERT_EQ(run("reference", {"integrator.type=cvode", "integrator.method=adams", "integrator.rtol=1e-11"}).code, 0);
    const auto reference = table("reference/probes.csv"), energies = table("reference/history.csv");
    for (const char* type : {"integrator.type=cvode", "integrator.type=ida", "integrator.type=arkode"}) {
        ASSERT_EQ(run("out", {type, rtol}).code, 0);
        auto found = table("out/probes.csv"), history = table("out/history.csv");
        const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
            const double scale = *std::ranges::max_element(b);
            for (std::size_t k = 0; k < a.size(); ++k)
                EXPECT_NEAR(a[k], b[k], tolerance * scale) << type << " at " << 1e-3 * static_cast<double>(k);
        };
        // some hundred steps of 1e-8; stresses and energies follow displacements
        for (const char* column : {"tip.u_x [m]", "tip.v_x [m/s]", "tip.sigma_xx [Pa]"})
            compare(found[column], reference.at(column), 1e-5);
        for (const char* column : {"kinetic [J]", "stored_material [J]", "external_work [J]"})
            compare(history[column], energies.at(column), 1e-5);
    }
}

TEST_F(ProgramHistory, NoInterval_NoStepIsShortened) {
    const std::vector<std::string> none{"integrator.type=newmark", "integrator.dt=1e-3", "output.history=0"};
    ASSERT_EQ(run("out", none).code, 0);
    EXPECT_EQ(summary("out")["counts"]["steps"], 50);
    EXPECT_EQ(n_lines("out/history.csv"), 52u);  // header and start
    ASSERT_EQ(run("out", {"integrator.type=newmark", "integrator.dt=1e-3", "output.rows=steps"}).code, 0);
    EXPECT_EQ(n_lines("out/history.csv"), 52u);
}

TEST_F(ProgramHistory, Frames_HaveTheNearestDecimals) {
    ASSERT_EQ(run("out", {"run.t_end=3e-3", "output.fields=3e-4", "output.history=3e-4"}).code, 0);
    const std::string frames = contents("out/fields.pvd");
    for (const char* time :
         {"0.0003", "0.0006", "0.0009", "0.0012", "0.0015", "0.0018", "0.0021", "0.0024", "0.0027", "0.003"})
        EXPECT_THAT(frames, HasSubstr(std::string("\"") + time + "\""));
    EXPECT_THAT(frames, Not(HasSubstr("99999")));
    EXPECT_THAT(contents("out/history.csv"), AllOf(HasSubstr("\n0.0015,"), HasSubstr("\n0.0018,")));
}

}  // namespace
}  // namespace gneiss
