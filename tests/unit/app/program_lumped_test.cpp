// Lumped models as a user meets them: columns, restarts, matrices, and what is refused.

#include <gmock/gmock.h>

#include <map>
#include <sstream>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string lumped_deck = R"toml(title = "gas in a hole, a hammer on the top"
mesh = { generator = "plate_with_hole", layout = "structured", side = 6.0, radius = 1.0, size = [0.8, 1.6] }
solid = { plane = "strain" }
run = { t_end = 4e-3, checkpoint = 2e-3 }
output = { history = 1e-4 }
[[material]]
density = 2500.0
constants = { E = 10e9, nu = 0.25 }
[[lumped]]
type = "gas"
name = "gas"
on = "hole"
pressure = 1e7
leak = 20
burn = { energy = 1e8, time = 2e-3, exponent = 0.5, reference_pressure = 2e7 }
[[lumped]]
type = "mass"
name = "hammer"
on = "top"
direction = [0, -1]
mass = 1000
stiffness = 1e10
velocity = 2
[[boundary]]
on = "bottom"
type = "fixed"
)toml";

class ProgramLumped : public test::ProgramTest, public testing::WithParamInterface<const char*> {
protected:
    ProgramLumped() { put("case.toml", lumped_deck); }
    Ended run(const std::string& out, std::vector<std::string> more) const {
        more.insert(more.begin(), {"run", "case.toml", "--quiet", "--threads", "1", "--out", out});
        return gneiss(more);
    }
    /// The last row of history.csv by its columns.
    std::map<std::string, double> last_row(const std::string& out) const {
        std::istringstream table(contents(out + "/history.csv"));
        std::string header, line, last;
        std::getline(table, header);
        while (std::getline(table, line)) last = line;
        std::istringstream names(header), values(last);
        std::map<std::string, double> row;
        for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');)
            row[name.substr(0, name.find(' '))] = std::stod(value);
        return row;
    }
};

INSTANTIATE_TEST_SUITE_P(Integrators, ProgramLumped,
                         testing::Values("central_difference", "generalized_alpha", "cvode", "arkode", "ida"));

TEST_P(ProgramLumped, Run_TellsOfItsModels_AndResumesWithTheSameBits) {
    const std::string type = std::string("integrator={type=\"") + GetParam() +
                             (GetParam() == std::string("generalized_alpha") ? "\", dt=2e-5}" : "\"}");
    const Ended whole = run("whole", {"--set", type});
    ASSERT_EQ(whole.code, 0) << whole.err;
    std::map<std::string, double> row = last_row("whole");
    EXPECT_NEAR(row["gas.energy"], row["gas.pressure"] * row["gas.volume"] / 0.4, 1e-9 * row["gas.energy"]);
    EXPECT_NEAR(row["stored_models"], row["gas.energy"] + row["gas.charge"], 2e3) << "the hammer's energy at most";
    EXPECT_LT(row["gas.charge"], 5e7);
    EXPECT_GT(row["leaked"], 1e5);
    EXPECT_LT(row["hammer.velocity"], 0) << "it has come back";
    EXPECT_LT(summary("whole")["balance_error"].get<double>(), 1e-4);
    ASSERT_EQ(run("part", {"--set", type, "run.t_end=2e-3"}).code, 0);
    ASSERT_EQ(run("part", {"--set", type, "--restart", "part/checkpoint.h5"}).code, 0);
    EXPECT_TRUE(contents("whole/history.csv") == contents("part/history.csv"));
}

TEST_F(ProgramLumped, CheckAndList_TellOfThem) {
    const Ended check = gneiss({"check", "case.toml"});
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_THAT(check.out, AllOf(HasSubstr("gas.pressure 1e+07 Pa"), HasSubstr("hammer.velocity 2 m/s")));
    EXPECT_THAT(gneiss({"list", "lumped", "models"}).out, AllOf(HasSubstr("gas"), HasSubstr("actuator")));
}

TEST_F(ProgramLumped, Statics_RefuseWhatChangesWithTime) {
    const Ended ended = run("out", {"--set", "integrator={type=\"quasi_static\"}"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err,
                AllOf(HasSubstr("[[lumped]] 1: leak: has no meaning under integrator.type = \"quasi_static\""),
                      HasSubstr("[[lumped]] 1: burn: has no meaning")));
}

TEST_F(ProgramLumped, Statics_RefuseAMassThatNothingHolds) {
    const Ended ended = run("out", {"--set", "integrator={ type = \"quasi_static\" }",
                                    "lumped=[{ type = \"mass\", name = \"m\", on = \"top\", direction = [0, -1], "
                                    "mass = 1, stiffness = 1e9, gap = 1e-3, force = 1 }]"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("gap: nothing holds a mass that touches nothing"));
}

TEST_F(ProgramLumped, GasAtAPlaneOfSymmetry_NeedsItsSupports) {
    const std::string gas = "lumped=[{ type = \"gas\", name = \"g\", on = \"left\", pressure = 1e5, about = [-4, 0] }]";
    const Ended ended =
        run("out", {"--set", gas, "mesh={ generator = \"rectangle\", width = 1, height = 1, cells = [2, 2] }"});
    EXPECT_EQ(ended.code, 2);
    // the lower end stands on the fixed bottom
    EXPECT_THAT(ended.err, AllOf(HasSubstr("about: the wall ends at (0, 1) m"), HasSubstr("along x"),
                                 HasSubstr("along y"), HasSubstr("2 problems")));
}

TEST_F(ProgramLumped, Matrices_HoldTheGasAsWell) {
    const auto form = [&](const std::string& lumped) {
        // u = x on every node: the hole grows by 1 + epsilon in either direction
        EXPECT_EQ(gneiss({"matrices", "case.toml", "--out", "m", "--set", "lumped=" + lumped}).code, 0);
        const auto nodes =
            nlohmann::json::parse(contents("m/system.json"))["nodes_m"].get<std::vector<std::array<double, 2>>>();
        std::istringstream in(contents("m/stiffness.mtx"));
        std::string line;
        while (std::getline(in, line) && line.starts_with('%')) {
        }
        double sum = 0, value = 0;
        for (std::size_t i = 0, j = 0; in >> i >> j >> value;)
            sum += value * nodes[(i - 1) / 2][(i - 1) % 2] * nodes[(j - 1) / 2][(j - 1) % 2];
        return sum;
    };
    const double without = form("[]");
    const double with = form("[{ type = \"gas\", name = \"gas\", on = \"hole\", pressure = 1e10 }]");
    // of U = p V_0/(kappa - 1) (1 + epsilon)^(2 - 2 kappa), twice differentiated; V_0 nearly pi m3
    EXPECT_NEAR(with - without, 2 * 1e10 * 3.1416 * 1.8, 0.03 * with);
}

}  // namespace
}  // namespace gneiss
