// What a deck hardly means is warned of, with numbers; sound decks are not.

#include <gmock/gmock.h>

#include <fstream>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using test::small_deck;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ProgramPlausibility : public test::ProgramTest {
protected:
    std::string checked(const std::vector<std::string>& set, const std::string& deck = small_deck) const {
        put("case.toml", deck);
        std::vector<std::string> arguments{"check", "case.toml", "--threads", "1"};
        for (const std::string& one : set) arguments.insert(arguments.end(), {"--set", one});
        const Ended ended = gneiss(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return ended.out;
    }
};

TEST_F(ProgramPlausibility, NumbersThatHardlyAreMeant_AreWarnedOf) {
    struct Doubtful {
        std::vector<std::string> set;
        std::string warning;
    };
    const std::string strength =
        "material.0.strength={ tensile = 3.0, cohesion = 9.0, friction = 0.6, residual_friction = 0.5, "
        "G_I = 20.0, G_II = 60.0 }";
    const std::string weight = "load.0={ type = 'body_force', value = [0, ";
    for (const Doubtful& doubtful : std::vector<Doubtful>{
             // moduli in GPa, in MPa
             {{"material.0.constants={ E = 30, nu = 0.25 }"},
              "[[load]] 1, pressure on \"left\": 1e+06 Pa at (0, 0) m is 2.8e+04 of the modulus there, 36 Pa"},
             {{"material.0.constants={ E = 1e3, nu = 0.25 }"}, "of the modulus there, 1200 Pa"},
             // the stiffer direction counts: 1e6 over E_alpha + M_v, not over E_beta
             {{"material.0.constants={ M_v = 0, M_alpha = 8e6, M_beta = 1e5, M_psi = 1e5 }"},
              "0.12 of the modulus there, 8e+06 Pa"},
             // lengths in mm: few steps
             {{"mesh.width=1000.0", "mesh.height=1000.0"}, "run.t_end, 0.001 s, is no more than 0.0"},
             {{"integrator={ type = 'newmark', dt = 2e-4 }"},
              "run.t_end, 0.001 s, is no more than 5 steps of 0.0002 s"},
             {{"material.0.density=2.65"}, "[[material]] 1: a density of 2.65 kg/m3: water has 1000"},
             {{"material.0.density=2.65e6"}, "a density of 2.65e+06 kg/m3"},
             {{"material.0.axes={ angle = 45 }"}, "axes turned by up to 45 rad"},
             {{"material.0.axes={ angle = '30+x' }"}, "30.92 degrees are 0.5396"},
             {{"contact={ method = 'potential', friction = 30 }"},
              "contact.friction: 30 is the tangent of 88.1 degrees; that of 30 degrees is 0.5774"},
             {{weight + "-9.81] }"},
              "a body force of -9.81 N/m3 is per volume; the weight is density times gravity, -9810"},
             {{strength, "fracture.method=intrinsic"}, "a tensile strength of 3 Pa is 2.5e-09 of the modulus"},
             {{"output.fields=1.0"}, "output.fields: an interval of 1 s is longer than the run, 0.001 s"},
             {{"run.checkpoint=1.0"}, "run.checkpoint: an interval of 1 s is longer than the run"},
             {{"output.history=1e-10"},
              "output.history: 1e+07 rows, each at its own time, make as many steps; `rows = "},
             {{"material.0.form=hypo", "material.0.in_situ_stress=[-1e6, -1e6, 0]", "load.0.value=[0, 1]",
               "load.0.type=traction"},
              "in_situ_stress of up to 1e+06 Pa is out of balance at the start"},
             {{"boundary.0={ on = 'right', type = 'velocity', value = [1200.0, 0.0], amplitude = { type = 'ramp', end "
               "= 1e-3 } }"},
              "a velocity of 1200 m/s is prescribed, waves run at 1095 m/s"},
             {{strength, "fracture.method=intrinsic", "material.0.strength.tensile=1e6"},
              "cracks without contact in a solid that is pressed"},
             {{"output.fields=1e-15"}, "fields and states may take"},
             {{"boundary=[{ on = 'right', type = 'fixed' }, { on = 'right', type = 'absorbing' }]"},
              "[[boundary]] 2: nothing is absorbed on \"right\""},
         })
        EXPECT_THAT(checked(doubtful.set), HasSubstr(doubtful.warning)) << testing::PrintToString(doubtful.set);
}

TEST_F(ProgramPlausibility, StressInSituThatLoadsOrSupportsMatch_IsNot) {
    const std::vector<std::string> stressed{
        "material.0.form=hypo", "material.0.in_situ_stress=[-2e6, -1e6, 0]",
        "load=[{ on = 'left', type = 'pressure', value = 2e6 }, { on = 'top', type = "
        "'traction', value = [0, -1e6] }]",
        "boundary=[{ on = 'right', type = 'fixed' }, { on = 'bottom', type = "
        "'displacement', value = ['free', 0.0] }]"};
    EXPECT_THAT(checked(stressed), Not(HasSubstr("plausibility")));
    std::vector<std::string> weight = stressed;
    weight[1] = "material.0.in_situ_stress=['-1e4*(1-y)', '-1e4*(1-y)', 0]";
    weight[2] =
        "load=[{ on = 'left', type = 'pressure', value = '1e4*(1-y)' }, { type = 'body_force', value = [0, -1e4] }]";
    EXPECT_THAT(checked(weight), Not(HasSubstr("plausibility")));
    weight[2] = "load=[{ on = 'left', type = 'pressure', value = '1e4*(1-y)' }]";
    EXPECT_THAT(checked(weight), HasSubstr("in_situ_stress of up to"));
}

TEST_F(ProgramPlausibility, Run_KeepsThemInItsLogAndSummary_AndNamesTheLikelyCauseOfItsEnd) {
    put("case.toml", small_deck);
    const Ended ended = gneiss({"run", "case.toml", "--set", "load.0.value=1e9", "--threads", "1"});
    EXPECT_EQ(ended.code, 3);
    const char* warning = "[[load]] 1, pressure on \"left\": 1e+09 Pa";
    EXPECT_THAT(ended.err, HasSubstr(std::string("gneiss: warning: plausibility: ") + warning));
    EXPECT_THAT(contents("results/case/run.log"),
                AllOf(HasSubstr(warning), HasSubstr("waves: [[material]] 1: c_P 1095")));
    const auto summary = this->summary("results/case");
    EXPECT_THAT(summary["warnings"].dump(), HasSubstr("1e+09 Pa"));
    EXPECT_THAT(summary["message"].get<std::string>(), AllOf(HasSubstr(" m of region `solid` is inverted at t = "),
                                                             HasSubstr(std::string("; likely cause: ") + warning)));
}

TEST_F(ProgramPlausibility, Check_PrintsSpeedsTimesLoadsAndSpace) {
    const std::string out = checked({"load.0.amplitude={ type = 'expression', expression = 'sin(2*pi*5e3*t)' }"});
    for (const char* line :
         {"waves               [[material]] 1: c_P 1095 m/s, c_S 632.5 m/s\n",
          "size                1 x 1 m; the fastest wave crosses it in 0.000913 s, 1.1 times in the run\n",
          "load                [[load]] 1, pressure on \"left\": 1e+06 Pa, 0.00083 of the modulus there, 1.2e+09 Pa\n",
          "wavelength          [[load]] 1, pressure on \"left\": 0.0001 s from trough to crest, 0.126 m of the slowest "
          "wave",
          "disk                4 frames of at most "})
        EXPECT_THAT(out, HasSubstr(line));
}

TEST_F(ProgramPlausibility, SoundDecks_AreNotWarnedOf) {
    namespace fs = std::filesystem;
    const fs::path root = GNEISS_ROOT;
    std::vector<std::string> decks;
    for (const auto& entry : fs::recursive_directory_iterator(root / "studies"))
        if (entry.path().extension() == ".toml") decks.push_back(entry.path().string());
    ASSERT_GE(decks.size(), 6U);
    std::ifstream stream(root / "README.md");
    const std::string readme{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t begin = readme.find("```toml\n") + 8, end = readme.find("```", begin);
    put("readme.toml", readme.substr(begin, end - begin));
    put("small.toml", small_deck);
    decks.insert(decks.end(), {"readme.toml", "small.toml"});
    for (const std::string& deck : decks) {
        const Ended ended = gneiss({"check", deck});
        EXPECT_EQ(ended.code, 0) << deck << ended.err;
        EXPECT_THAT(ended.out, Not(HasSubstr("plausibility"))) << deck;
    }
}

}  // namespace
}  // namespace gneiss
