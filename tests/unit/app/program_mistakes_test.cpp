// Mistakes that people make, and what they are told: each message names the place, what is wrong and the way out.

#include <gmock/gmock.h>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using test::small_deck;
using ::testing::HasSubstr;

struct Mistake {
    std::string what, by;                ///< in small_deck; nothing: at its end
    std::vector<std::string> arguments;  ///< further ones
    int code;
    std::vector<std::string> told;
};

class ProgramMistakes : public test::ProgramTest {};

TEST_F(ProgramMistakes, EachOfThem_IsToldWithItsPlaceAndTheWayOut) {
    const std::string elastic = "constants = { E = 1e9, nu = 0.25 }", value = "value = 1e6",
                      mesh = "generator = \"rectangle\", width = 1.0, height = 1.0, cells = [4, 4]",
                      fixed = "type = \"fixed\"";
    const std::vector<Mistake> mistakes{
        {"[[material]]",
         "[material]",
         {},
         2,
         {"case.toml:6:1: key `material`: given one table, must be an array of tables: [[material]], with two brackets "
          "each"}},
        {"t_end = 1e-3",
         "t_end = 0,001",
         {},
         2,
         {"case.toml:4:", "no valid TOML", "decimals are written with a point, 0.001"}},
        {"",
         "[integrator]\ntype = \"newmark\"\nadaptive = True\n",
         {},
         2,
         {"case.toml:18:12: no valid TOML", "TOML has `true` and `false`"}},
        {"t_end = 1e-3",
         "t_end = \"1 ms\"",
         {},
         2,
         {"case.toml:4:17: key `run.t_end`: given \"1 ms\" (a string), must be a number > 0 s"}},
        {"density = 1000.0", "density: 1000.0", {}, 2, {"a key and its value are written `key = value`"}},
        {"density = 1000.0",
         "density = 1000.0\ndensity = 2000.0",
         {},
         2,
         {"case.toml:8:11", "cannot redefine existing floating-point 'density'"}},
        {"",
         "integrator = { type = \"verlet\" }\n",
         {},
         2,
         {"key `boundary[0].integrator`: unknown, `integrator` belongs to the deck itself: what stands below a [table] "
          "is part of it"}},
        {elastic, "constants = { E = 1e9 }", {}, 2, {"`nu` is missing, must be { E, nu }"}},
        {elastic, "constants = { E = 1e9, nu = 0.5 }", {}, 2, {"given 0.5, must be < 0.5 in plane strain"}},
        {mesh,
         "generator = \"rectangle\", width = 1.0, height = 1.0, cells = 4",
         {},
         2,
         {"key `mesh.cells`: given 4 (an integer), must be an array of 2 integers"}},
        {mesh,
         "file = \"nowhere.msh\"",
         {},
         2,
         {"case.toml:2:17: key `mesh.file`: given \"nowhere.msh\": no such file in "}},
        {value,
         "value = [1e6, 0]",
         {},
         2,
         {"key `load[0].value`: given [1000000, 0], must be one number or expression (Pa) for a pressure"}},
        {"type = \"pressure\"",
         "type = \"traction\"",
         {},
         2,
         {"must be an array of 2 numbers or expressions, [x, y] (Pa)"}},
        {"on = \"left\"", "on = \"Left\"", {}, 2, {"the mesh has no boundary of this name", "did you mean \"left\"?"}},
        {"on = \"left\"",
         "on = \"top_left\"",
         {},
         2,
         {"on = \"top_left\": these are nodes, needed: boundary; there are:"}},
        {fixed,
         "type = \"fixed\"\nvalue = [\"free\", 0]",
         {},
         2,
         {"key `boundary[0].value`: only for `type` = \"displacement\", \"velocity\", here `type` is \"fixed\""}},
        {"density = 1000.0",
         "density = 1000.0\nregion = \"rock\"",
         {},
         2,
         {"the mesh has no region `rock`; it has: solid"}},
        {"density = 1000.0", "density = 1000.0\nin_situ_stress = [1e6, 1e6, 0]", {}, 2, {"only for `form` = \"hypo\""}},
        {"",
         "[[wall]]\npoint = [0, -1]\nnormal = [0, 1]\n",
         {},
         2,
         {"key `wall`: has no effect without `contact.method`"}},
        {"",
         "[[boundary]]\non = \"right\"\ntype = \"displacement\"\nvalue = [0.1, 0]\n",
         {},
         2,
         {"prescribes another x motion than [[boundary]] 1 on \"right\""}},
        {"", "[[boundary]]\non = \"right\"\ntype = \"absorbing\"\n", {}, 0, {"nothing is absorbed on \"right\""}},
        {"", "", {"--set", "integrator.type=central-difference"}, 2, {"did you mean `central_difference`?"}},
        {"",
         "",
         {"--set", "integrator.type=newmark"},
         2,
         {"integrator.dt: missing: give `dt` for fixed steps, or `adaptive = true`"}},
        {"",
         "",
         {"--set", "integrator.type=bathe"},
         2,
         {"key `integrator.dt`: missing, must be a number > 0 s: `bathe` takes fixed steps"}},
        {"",
         "[integrator]\nsafety = 0.5\n",
         {"--set", "integrator.type=cvode"},
         0,
         {"warning: case.toml:17:10: key `integrator.safety`: left out, only for"}},
        {"",
         "[integrator]\ntype = \"cvode\"\nsafety = 0.5\n",
         {},
         2,
         {"only for `type` = \"central_difference\"",
          "delete it, or leave the deck as it was and exchange the word by --set"}},
        {"", "", {"--set", "integrator.dt=1e-3"}, 3, {"the fixed step dt = 0.001 s exceeds the critical step"}},
        {"", "", {"--set", "t_end=1"}, 2, {"--set t_end=1: key `t_end`: unknown, it belongs to [run]"}},
        {"", "", {"--set", "run.t_end", "1"}, 2, {"--set run.t_end: must be key=value without blanks"}},
        {"", "", {"--set", "contact.method=potential"}, 2, {"key `contact.friction`: missing"}},
        {"",
         "",
         {"--set", "fracture.method=extrinsic"},
         2,
         {"[[material]] 1: `strength` is missing, which [fracture] needs"}},
        {"at = [0.5, 0.5]",
         "at = [5, 5]",
         {},
         2,
         {"output.probes `p`: the point (5, 5) m lies 5.66 m outside the solid"}},
        {fixed,
         "type = \"displacement\"\nvalue = [0, \"free\"]",
         {"--set", "integrator.type=quasi_static"},
         2,
         {"too few supports for a static solution, which leaves free the solid: translation in y"}},
        {"",
         "",
         {"--restart", "checkpoint.h5"},
         2,
         {"checkpoint.h5: no such checkpoint; a run leaves checkpoint.h5 among its results"}},
        {"",
         "",
         {"--set", "load.0.value=1e9"},
         3,
         {" m of region `solid` is inverted at t = ", "likely cause: [[load]] 1, pressure on \"left\""}},
        {"",
         "[[load]]\ntype = \"body_force\"\nvalue = [0, -9.81]\n",
         {},
         0,
         {"the weight is density times gravity, -9810 N/m3"}},
    };
    for (const Mistake& mistake : mistakes) {
        std::string deck = small_deck;
        if (mistake.what.empty()) {
            deck += mistake.by;
        } else {
            const std::size_t at = deck.find(mistake.what);
            ASSERT_NE(at, std::string::npos) << mistake.what;
            deck.replace(at, mistake.what.size(), mistake.by);
        }
        put("case.toml", deck);
        std::filesystem::remove_all(folder / "results");
        std::vector<std::string> arguments{"run", "case.toml", "--threads", "1"};
        arguments.insert(arguments.end(), mistake.arguments.begin(), mistake.arguments.end());
        const Ended ended = gneiss(arguments);
        EXPECT_EQ(ended.code, mistake.code) << mistake.by << testing::PrintToString(mistake.arguments) << ended.err;
        for (const std::string& told : mistake.told)
            EXPECT_THAT(ended.err, HasSubstr(told)) << mistake.by << testing::PrintToString(mistake.arguments);
    }
}

}  // namespace
}  // namespace gneiss
