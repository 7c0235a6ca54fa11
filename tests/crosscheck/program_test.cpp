// The program from outside: its file, its exit codes.

#include <gmock/gmock.h>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::ProgramTest;
using testing::HasSubstr;

class CrosscheckProgram : public ProgramTest {
protected:
    nlohmann::json results(const char* name) const { return nlohmann::json::parse(contents(name), nullptr, false); }
};

constexpr const char* deck = R"toml(
mesh = { generator = "rectangle", width = 1.0, height = 1.0, cells = [4, 4] }
solid = { element = "cst", plane = "strain" }
material = [{ density = 1000.0, constants = { E = 1e9, nu = 0.25 } }]
load = [{ on = "top", type = "traction", value = [1e5, 0] }]
boundary = [{ on = "bottom", type = "fixed" }]
run = { t_end = 1 }
output = { probes = [{ name = "corner", at = [1.0, 1.0] }] }
)toml";

TEST_F(CrosscheckProgram, EveryElement_WritesWhatTheReadmeSays) {
    put("case.toml", deck);
    double before = 0;
    for (const char* element : {"p1", "p2", "taylor_hood"}) {
        const auto ended = gneiss(
            {"case.toml", "--element", element, "--set", "mesh.cells=[3, 5]", "--refine", "1", "--out", "o.json"});
        ASSERT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(ended.out + ended.err, "");
        const nlohmann::json json = results("o.json");
        EXPECT_EQ(json["element"], element);
        EXPECT_EQ(json["deal_ii"].get<std::string>().substr(0, 2), "9.");
        EXPECT_EQ(json["n_cells"], before == 0 ? 480 : 120);
        EXPECT_EQ(json["displacement"].size(), 7u * 11u);
        EXPECT_EQ(json["cauchy"].size(), 120u);
        EXPECT_EQ(json["pressure"].size(), 120u);
        const double compliance = json["compliance"], energy = json["strain_energy"];
        EXPECT_GT(compliance, before);  // softer and softer
        EXPECT_NEAR(energy, 0.5 * compliance, 1e-10 * energy);
        EXPECT_LT(json["residual"].get<double>(), 1e-10);
        const auto corner = json["probes"]["corner"];
        EXPECT_THAT(json["displacement"], testing::Contains(corner));
        before = compliance;
    }
}

TEST_F(CrosscheckProgram, BadInput_EndsWithTwo_AndSaysWhat) {
    put("case.toml", deck);
    auto ended = gneiss({"case.toml", "--element", "q1", "--out", "o.json"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("--element"));
    ended = gneiss({"case.toml", "--element", "p1", "--set", "solid.plane=curved", "--out", "o.json"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("solid.plane"));
    ended = gneiss({"case.toml", "--element", "p1", "--set", "boundary.0.type=absorbing", "--out", "o.json"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("nothing moves"));
    EXPECT_FALSE(exists("o.json"));
}

TEST_F(CrosscheckProgram, NoSupports_EndsWithThree) {
    put("case.toml", deck);
    const auto ended = gneiss({"case.toml", "--element", "p1", "--set", "boundary=[]", "--out", "o.json"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err, HasSubstr("enough supports?"));
    EXPECT_FALSE(exists("o.json"));
}

}  // namespace
}  // namespace gneiss
