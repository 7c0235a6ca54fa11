// Bad decks, each with its whole message. Every case lays --set arguments over a sound deck; the messages of one case
// are given in order, without their place. Places are the concern of deck_test.cpp.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "io/deck/deck.hpp"

namespace gneiss {
namespace {

const std::string sound = R"toml(
[mesh]
generator = "rectangle"
width = 1
height = 1
cells = [1, 1]
[solid]
plane = "strain"
[[material]]
density = 1000.0
constants = { M_v = 0, M_alpha = 1, M_beta = 1, M_psi = 1 }
[[load]]
on = "top"
type = "traction"
value = [0, 1]
[[boundary]]
on = "bottom"
type = "fixed"
[run]
t_end = 0.02
[output]
probes = [{ at = [0, 0], name = "a" }, { at = [0, 1], name = "b" }]
)toml";

struct Bad {
    std::vector<std::string> set;
    std::vector<std::string> messages;
};

std::vector<std::string> messages_of(const std::vector<std::string>& set) {
    std::vector<std::string> messages;
    try {
        parse_deck(sound, "case.toml", set);
    } catch (const InputError& error) {
        for (const Problem& problem : error.problems()) messages.push_back(problem.message);
    }
    return messages;
}

void expect_messages(const std::vector<Bad>& table) {
    EXPECT_THAT(messages_of({}), testing::IsEmpty());
    for (const Bad& bad : table) EXPECT_EQ(messages_of(bad.set), bad.messages) << testing::PrintToString(bad.set);
}

/// What follows where one word of the table could be exchanged by --set.
const std::string way_out =
    "; delete it, or leave the deck as it was and exchange the word by --set, which leaves such keys out";

const std::string units_of_load = "must be an array of 2 numbers or expressions, [x, y] (Pa)";

TEST(DeckErrors, TypesAndRanges) {
    expect_messages({
        {{"run.t_end=inf"}, {"key `run.t_end`: given inf, must be > 0 s"}},
        {{"run.t_end=0"}, {"key `run.t_end`: given 0, must be > 0 s"}},
        {{"run.t_end=soon"}, {"key `run.t_end`: given \"soon\" (a string), must be a number > 0 s"}},
        {{"run.t_end=1979-05-27"}, {"key `run.t_end`: given 1979-05-27 (a date or time), must be a number > 0 s"}},
        {{"run=3"}, {"key `run`: given 3, must be a table"}},
        {{"integrator.safety=nan"}, {"key `integrator.safety`: given nan, must be in (0, 1]"}},
        {{"material={}"},
         {"key `material`: given one table, must be an array of tables: [[material]], with two brackets each"}},
        {{"material=[]"}, {"key `material`: given none, must be at least one [[material]]"}},
        {{"material=[3]"}, {"key `material[0]`: given 3, must be a table"}},
        {{"mesh.cells=[1.5, 2]"}, {"key `mesh.cells[0]`: given 1.5 (a number), must be an integer ≥ 1"}},
        {{"mesh.cells=[2.0, 2]"},
         {"key `mesh.cells[0]`: given 2.0 (a number), must be an integer ≥ 1: write 2, what has a point is no integer "
          "in TOML"}},
        {{"mesh.cells=[5000000000, 2]"}, {"key `mesh.cells[0]`: given 5000000000, must be an integer of 32 bits"}},
        {{"mesh.cells=[1, 2, 3]"}, {"key `mesh.cells`: given [1, 2, 3], must be an array of 2 integers ≥ 1"}},
        {{"mesh.origin=[0, nan]"}, {"key `mesh.origin[1]`: given nan, must be finite (m)"}},
        {{"mesh.origin=0"}, {"key `mesh.origin`: given 0 (an integer), must be an array of 2 numbers (m)"}},
        {{"title=''"}, {"key `title`: given \"\", must not be empty"}},
        {{"output.field_times=[0.01, -1]"}, {"key `output.field_times[1]`: given -1, must be ≥ 0 s"}},
        {{"output.field_times=[0.02, 0.03]"},
         {"key `output.field_times[1]`: given 0.03, must be <= 0.02 s, where the run ends: `run.t_end`"}},
        {{"output.history=-1e-3"}, {"key `output.history`: given -0.001, must be ≥ 0 s"}},
        {{"output.rows=step"},
         {"key `output.rows`: given \"step\", must be one of \"times\", \"steps\", did you mean `steps`?"}},
        {{"run.most_energy_gained=1"}, {"key `run.most_energy_gained`: given 1, must be in [0, 1)"}},
    });
}

TEST(DeckErrors, CracksAndInterfaces) {
    const std::string strength =
        "strength={ tensile = 1, cohesion = 1, friction = 0, residual_friction = 0, G_I = 1, G_II = 1 }";
    const std::string method = "fracture.method=intrinsic";
    expect_messages({
        {{"interface=[{ on = \"a\", " + strength + " }]"},
         {"key `interface`: has no effect without `fracture.method`: elements stay together"}},
        {{method, "interface=[{ " + strength + " }]"},
         {"key `interface[0].on`: missing (or `between`), must be a string"}},
        {{method, "interface=[{ on = \"a\", between = [\"a\", \"b\"], " + strength + " }]"},
         {"key `interface[0].between`: given together with `on`, an interface is found in one way"}},
        {{method, "interface=[{ between = [\"a\", \"a\"], " + strength + " }]"},
         {"key `interface[0].between`: given \"a\" twice, must be different regions"}},
        {{"crack=[{}]"}, {"key `crack[0].on`: missing, must be a string"}},
        {{"mesh.lines=[{ name = \"a\", from = [0, 0] }]"},
         {"key `mesh.lines[0].to`: missing, must be an array of 2 numbers (m)"}},
    });
}

TEST(DeckErrors, LumpedModels) {
    const std::string gas = "type = \"gas\", name = \"a\", on = \"top\", pressure = 1",
                      platen = "name = \"a\", on = \"top\", direction = [0, 1], stiffness = 1";
    expect_messages({
        {{"lumped=[{ " + gas + " }, { " + gas + " }]"},
         {"key `lumped[1].name`: given \"a\", which is the name of lumped[0] already"}},
        {{"lumped=[{ type = \"gas\", name = \"a b\", on = \"top\", pressure = -1, gamma = 1 }]"},
         {"key `lumped[0].name`: given \"a b\", must be free of blanks, commas and quotes: it heads columns of "
          "history.csv",
          "key `lumped[0].pressure`: given -1, must be > 0 Pa", "key `lumped[0].gamma`: given 1, must be > 1"}},
        {{"lumped=[{ " + gas + ", burn = { energy = 1, time = 1, exponent = 0.5 } }]"},
         {"key `lumped[0].burn.reference_pressure`: missing, needed with exponent = 0.5: what the pressure is measured "
          "against"}},
        {{"lumped=[{ " + gas + ", burn = { energy = 1, time = 1, reference_pressure = 1 } }]"},
         {"key `lumped[0].burn.reference_pressure`: has no effect: with exponent = 0 the pressure does not matter"}},
        {{"lumped=[{ type = \"mass\", " + platen + " }]"}, {"key `lumped[0].mass`: missing, must be a number > 0 kg"}},
        {{"lumped=[{ type = \"mass\", mass = 1, amplitude = \"heaviside\", " + platen + " }]"},
         {"key `lumped[0].amplitude`: has no effect without `force`"}},
        {{"lumped=[{ type = \"actuator\", displacement = 1, amplitude = { type = \"ramp\", end = 1 }, damping = 1, " +
          platen + " }]"},
         {"key `lumped[0].damping`: only for `type` = \"mass\", here `type` is \"actuator\""}},
        {{"lumped=[{ type = \"actuator\", displacement = 1, bonded = true, gap = 1, " + platen + " }]"},
         {"key `lumped[0].gap`: must be 0 where `bonded` is true: the bond would pull from the start",
          "key `lumped[0].amplitude`: missing or constant, must begin at 0: the actuator would stand at its "
          "displacement at the start"}},
        {{"lumped=[{ type = \"actuator\", displacement = 0, name = \"a\", on = \"top\", direction = [0, 0], "
          "stiffness = 1 }]"},
         {"key `lumped[0].direction`: has no length"}},
    });
}

TEST(DeckErrors, UnknownKeysAndWords) {
    expect_messages({
        {{"slid.plane=stress"}, {"key `slid`: unknown, did you mean `solid`?"}},
        {{"run.tend=1"}, {"key `run.tend`: unknown, did you mean `t_end`?"}},
        {{"run.safety=1"}, {"key `run.safety`: unknown, it belongs to [integrator]"}},
        {{"run.zzzzzzz=1"},
         {"key `run.zzzzzzz`: unknown, allowed: `t_end`, `checkpoint`, `mass_damping`, `event_tolerance`, "
          "`most_energy_gained`"}},
        {{"solid.element=compound"}, {"key `solid.element`: given \"compound\", must be one of \"compt\", \"cst\""}},
        {{"solid.element=CTS"},
         {"key `solid.element`: given \"CTS\", must be one of \"compt\", \"cst\", did you mean `cst`?"}},
        {{"integrator.type=rk4"},
         {"key `integrator.type`: given \"rk4\", must be one of \"central_difference\", \"verlet\", \"noh_bathe\", "
          "\"generalized_alpha\", \"newmark\", \"hht_alpha\", \"bathe\", \"cvode\", \"arkode\", \"mri\", \"ida\", "
          "\"quasi_static\", \"dynamic_relaxation\""}},
        {{"integrator.type=quasi_static", "integrator.safety=0.5"},
         {"key `integrator.safety`: only for `type` = \"central_difference\", \"verlet\", \"noh_bathe\", here `type` "
          "is \"quasi_static\"" +
          way_out}},
        {{"integrator.tolerance=1e-6"},
         {"key `integrator.tolerance`: only for `type` = \"quasi_static\", \"dynamic_relaxation\", "
          "\"generalized_alpha\", \"newmark\", "
          "\"hht_alpha\", \"bathe\", "
          "here `type` is \"central_difference\"" +
          way_out}},
        {{"integrator.type=newmark", "integrator.dt=1e-3", "integrator.rtol=1e-3"},
         {"key `integrator.rtol`: it has no effect: steps are fixed without `adaptive = true`" + way_out}},
        {{"integrator.type=hht_alpha", "integrator.longest=1", "integrator.displacement_scale=1"},
         {"key `integrator.displacement_scale`: it has no effect: steps are fixed without `adaptive = true`" + way_out,
          "key `integrator.longest`: it has no effect: steps are fixed without `adaptive = true`" + way_out}},
        {{"integrator.type=newmark", "integrator.adaptive=true", "integrator.rtol=1e-3"}, {}},
        {{"integrator.type=cvode", "integrator.iteration=functional", "integrator.solver=klu"},
         {"key `integrator.solver`: it has no effect: with iteration = \"functional\", no linear systems are solved" +
          way_out}},
        {{"integrator.type=arkode", "integrator.solver=klu"},
         {"key `integrator.solver`: it has no effect: with table = \"dormand_prince_7_4_5\", no linear systems are "
          "solved" +
          way_out}},
        {{"integrator.type=dynamic_relaxation", "integrator.tolerance=0"},
         {"key `integrator.tolerance`: given 0, must be in (0, 0.01]"}},
        {{"solid.plane=1"}, {"key `solid.plane`: given 1, must be one of \"stress\", \"strain\""}},
    });
}

TEST(DeckErrors, Mesh) {
    const std::string plate = "mesh={ generator = 'plate_with_hole', ",
                      quadrilateral = "mesh={ generator = 'quadrilateral', ";
    expect_messages({
        {{"mesh={}"},
         {"key `mesh.generator`: missing (or `file`), must be one of \"rectangle\", \"quadrilateral\", "
          "\"plate_with_hole\""}},
        {{"mesh={ file = 'a.stl' }"},
         {"key `mesh.file`: given \"a.stl\", must be a file of Gmsh, ending in .msh or .geo, or of Abaqus, ending in "
          ".inp"}},
        {{"mesh.file=a.msh"}, {"key `mesh.file`: given together with `generator`, a mesh comes from one of them"}},
        {{"mesh.radius=1"},
         {"key `mesh.radius`: only for `generator` = \"plate_with_hole\", here `generator` is \"rectangle\""}},
        {{"mesh.curved=true"},
         {"key `mesh.curved`: only for `generator` = \"plate_with_hole\" or `file`, here `generator` is "
          "\"rectangle\""}},
        {{"mesh={ file = 'a.msh', width = 1 }"},
         {"key `mesh.width`: only for `generator` = \"rectangle\", here `generator` is not given"}},
        {{quadrilateral + "corners = [[0, 0], [48, 44], [48, 60]], cells = [2, 2] }"},
         {"key `mesh.corners`: given [[0, 0], [48, 44], [48, 60]], must be an array of 4 points [x, y]"}},
        {{quadrilateral + "corners = [[0, 0], [48, 44], [48, 60], 44], cells = [2, 2] }"},
         {"key `mesh.corners[3]`: given 44 (an integer), must be an array of 2 numbers (m)"}},
        {{quadrilateral + "corners = [[0, 0], [4, 0], [1, 1], [0, 4]], cells = [2, 2] }"},
         {"key `mesh.corners[2]`: does not turn left: the quadrilateral must be convex and its corners "
          "counter-clockwise, bottom left, bottom right, top right, top left"}},
        {{"mesh.corners=[[0, 0], [4, 0], [1, 1], [0, 4]]"},
         {"key `mesh.corners`: only for `generator` = \"quadrilateral\", here `generator` is \"rectangle\""}},
        {{"mesh.parameters={ lc = 1 }"}, {"key `mesh.parameters`: only for `file`, here `file` is not given"}},
        {{"mesh={ file = 'a.geo', parameters = { lc = 'x' } }"},
         {"key `mesh.parameters.lc`: given \"x\" (a string), must be a number"}},
        {{plate + "side = 2, radius = 1, size = [1, 1] }"},
         {"key `mesh.side`: given 2, must be > 2 m, twice the radius"}},
        {{plate + "raduis = 1, side = 4, size = [1, 1], curved = 1 }"},
         {"key `mesh.raduis`: unknown, did you mean `radius`?", "key `mesh.curved`: given 1, must be true or false"}},
    });
}

TEST(DeckErrors, Constants) {
    const std::string c = "material.0.constants=", rock = c + "{ E_alpha = 2, E_beta = 1, G = 1, ";
    const std::string sets =
        "must be { M_v, M_alpha, M_beta, M_psi } or { E, nu } or { E_alpha, E_beta, nu_alpha_beta or "
        "nu_beta_alpha, G, and nu_p_alpha in plane strain } for law \"munjiza\"";
    const std::string k = "key `material[0].constants";
    expect_messages({
        {{c + "{}"}, {k + "`: gives none, " + sets}},
        {{c + "3"}, {k + "`: given 3, must be a table"}},
        {{c + "{ mu = 1, lambda = 1 }"}, {k + "`: gives another set, " + sets}},
        {{"material.0.constants.E=1"}, {k + "`: mixes several sets, " + sets}},
        {{c + "{ E = 1 }"}, {k + "`: `nu` is missing, must be { E, nu }"}},
        {{c + "{ E = 1, nu = -1 }"}, {k + ".nu`: given -1, must be in (-1, 0.5]"}},
        {{c + "{ E = 1, nu = 0.5 }"}, {k + ".nu`: given 0.5, must be < 0.5 in plane strain"}},
        {{c + "{ M_v = 0, M_alhpa = 1, M_beta = 1, M_psi = 1 }"}, {k + ".M_alhpa`: unknown, did you mean `M_alpha`?"}},
        {{"material.0.constants.M_psi=0"}, {k + ".M_psi`: given 0, must be > 0 Pa"}},
        {{"material.0.constants.M_v=-0.6"},
         {k + "`: inadmissible, the stiffness [[M_v + M_alpha, M_v], [M_v, M_v + M_beta]] = [[0.4, -0.6], [-0.6, 0.4]] "
              "Pa is "
              "not positive definite"}},
        {{rock + "nu_p_alpha = 0 }"}, {k + "`: `nu_alpha_beta` or `nu_beta_alpha` is missing"}},
        {{rock + "nu_alpha_beta = 0.3 }"}, {k + "`: `nu_p_alpha` is missing, needed in plane strain"}},
        {{rock + "nu_alpha_beta = 0.3, nu_beta_alpha = 0.2, nu_p_alpha = 0 }"},
         {k + ".nu_beta_alpha`: given 0.2, but nu_alpha_beta E_beta / E_alpha = 0.15: the compliance must be "
              "symmetric, give "
              "one of the two ratios"}},
        {{"material.0.law=neo_hookean"},
         {k + "`: gives another set, must be { E, nu } or { mu, lambda } for law \"neo_hookean\""}},
        {{"material.0.law=neo_hookean", c + "{ mu = 3, lambda = -2 }"},
         {k + ".lambda`: given -2, must be > -2 Pa, -2/3 of mu: the bulk modulus is positive"}},
        {{"material.0.law=neo_hookean", c + "{ E = 1, nu = 0.5 }"},
         {k + ".nu`: given 0.5, must be < 0.5 for law \"neo_hookean\""}},
        {{"solid.plane=flat", c + "{ E = 1, nu = 0.2 }"},  // one mistake, one message
         {"key `solid.plane`: given \"flat\", must be one of \"stress\", \"strain\""}},
    });
}

TEST(DeckErrors, Material) {
    const std::string k = "key `material[0].", neo = "material.0.law=neo_hookean",
                      mu = "material.0.constants={ mu = 1, lambda = 1 }";
    const std::string material = "{ density = 1, constants = { E = 1, nu = 0 }";
    const std::string not_symmetric =
        " with solid.volumetric = \"centre\", where the tangent is not symmetric and no energy is stored";
    expect_messages({
        {{"material.0.stiffening={ k = 1, p_ref = 1, n = 1 }"},
         {k + "stiffening`: only for `form` = \"hypo\", here `form` is \"hyper\""}},
        {{"material.0.in_situ_stress=[1, 1, 0]"},
         {k + "in_situ_stress`: only for `form` = \"hypo\", here `form` is \"hyper\""}},
        {{"material.0.form=hypo", "material.0.stiffening={ k = -1, p_ref = 0, n = 2 }"},
         {k + "stiffening.k`: given -1, must be ≥ 0", k + "stiffening.p_ref`: given 0, must be > 0 Pa",
          k + "stiffening.n`: given 2, must be in [0, 1]"}},
        {{"material.0.form=hypo", "material.0.in_situ_stress=[1, 'y*t', nan]"},
         {k + "in_situ_stress[1]`: expression \"y*t\": unknown name `t` at character 3, allowed: x, y, pi, e and "
              "functions",
          k + "in_situ_stress[2]`: given nan, must be finite (Pa)"}},
        {{neo, mu, "material.0.form=hypo", "material.0.in_situ_stress=[1, 1, 0]"},
         {k + "form`: only for `law` = \"munjiza\", here `law` is \"neo_hookean\""}},
        {{neo, mu, "material.0.axes={ angle = 1 }"},
         {k + "axes`: only for `law` = \"munjiza\", here `law` is \"neo_hookean\""}},
        {{"solid.volumetric=centre"}, {k + "stress_map`: is \"conjugate\", must be \"direct\"" + not_symmetric}},
        {{neo, mu, "solid.volumetric=centre"},
         {k + "law`: given \"neo_hookean\", must be \"munjiza\"" + not_symmetric}},
        {{"solid.element=cst", "solid.volumetric=mean"},
         {"key `solid.volumetric`: only for `element` = \"compt\", here `element` is \"cst\""}},
        {{"material.0.axes={ angle = 1, data = 'a' }"},
         {k + "axes.data`: given together with `angle`, axes are given in one way"}},
        {{"material.0.axes={ bedding = [] }"},
         {k + "axes.bedding`: given [], must be at least one polyline [[x, y], [x, y], …]"}},
        {{"material.0.axes={ bedding = [[[0, 0]], [[0, 0], [0, 0]]] }"},
         {k + "axes.bedding[0]`: given [[0, 0]], must be at least 2 points [x, y]",
          k + "axes.bedding[1][1]`: equal to the point before it"}},
        {{"material.0.axes={ angle = '1 +' }"},
         {k + "axes.angle`: expression \"1 +\": ends too early, at character 4"}},
        {{"material.0.axes={ angle = true }"},
         {k + "axes.angle`: given true (a boolean), must be a number or an expression"}},
        {{"material.0.viscosity={ shear = -1 }"}, {k + "viscosity.shear`: given -1, must be ≥ 0 Pa s"}},
        {{"material.0.region=[]"}, {k + "region`: given [], must be at least one region"}},
        {{"material.0.region=1"}, {k + "region`: given 1, must be a string or an array of strings"}},
        {{"material.0.region=['a', 'a']"}, {k + "region`: \"a\" is given twice, first to material[0]"}},
        {{"material=[" + material + "}, " + material + "}]"},
         {"key `material[1].region`: missing, and material[0] takes all other regions already"}},
        {{"material=[" + material + ", region = 'a'}, " + material + ", region = ['b', 'a']}]"},
         {"key `material[1].region`: \"a\" is given twice, first to material[0]"}},
    });
}

TEST(DeckErrors, Loads) {
    const std::string k = "key `load[0].", a = "load.0.amplitude=";
    expect_messages({
        {{"load.0.type=pressure"}, {k + "value`: given [0, 1], must be one number or expression (Pa) for a pressure"}},
        {{"load.0.value=3"}, {k + "value`: given 3, " + units_of_load}},
        {{"load.0.value=[0, '2*z']"},
         {k + "value[1]`: expression \"2*z\": unknown name `z` at character 3, allowed: x, y, pi, e and functions"}},
        {{"load.0={ type = 'traction' }"},
         {k + "on`: missing, must be a string",
          k + "value`: missing, must be a number or an expression, or an array of 2 (N, Pa or N/m³)"}},
        {{a + "heavyside"},
         {k + "amplitude.type`: given \"heavyside\", must be one of \"constant\", \"heaviside\", \"ramp\", \"table\", "
              "\"expression\", did you mean `heaviside`?"}},
        {{a + "{ type = 'table', file = 'signal.csv', times = [0], values = [1] }"},
         {k + "amplitude.file`: unknown: no file is read here, its numbers belong into the deck: type = \"table\", "
              "times = […], values = […]"}},
        {{a + "{ type = 'constant', frequency = 50 }"},
         {k + "amplitude.frequency`: unknown: type = \"expression\", expression = \"sin(2*pi*50*t)\""}},
        {{"load.0.value=[0, 'x**2']"}, {k + "value[1]`: expression \"x**2\": `**`: a power is `a^b`, at character 2"}},
        {{"load.0.value=['0.2<y<0.8 ? 1e6 : 0', 0]"},
         {k + "value[0]`: expression \"0.2<y<0.8 ? 1e6 : 0\": a chained comparison compares a truth, 0 or 1, with the "
              "last number: write `0.2 < y && y < 0.8`, at character 6"}},
        {{a + "3"}, {k + "amplitude`: given 3, must be the name of an amplitude or a table { type = …, … }"}},
        {{a + "ramp"}, {k + "amplitude.end`: missing, must be a number (s)"}},
        {{a + "{ type = 'ramp', start = 1, end = 1 }"}, {k + "amplitude.end`: given 1, must be > 1 s, the start"}},
        {{a + "{ type = 'constant', start = 1 }"},
         {k + "amplitude.start`: only for `type` = \"heaviside\", \"ramp\", here `type` is \"constant\""}},
        {{a + "{ type = 'table', times = [0, 2, 1], values = [0, 1, 2] }"},
         {k + "amplitude.times`: 1 s after 2 s, must ascend"}},
        {{a + "{ type = 'table', times = [0, 1, 1, 1], values = [0, 1, 2, 3] }"},
         {k + "amplitude.times`: 1 s more than twice, two equal times make a jump"}},
        {{a + "{ type = 'table', times = [0, 1], values = [0] }"},
         {k + "amplitude.values`: given 1 values, must be as many as times, 2"}},
        {{a + "{ type = 'table', times = [], values = [] }"},
         {k + "amplitude.times`: given [], must be at least one time"}},
        {{a + "{ type = 'expression', expression = 'sin(t' }"},
         {k + "amplitude.expression`: expression \"sin(t\": ends too early: `)` is missing, at character 6"}},
    });
}

TEST(DeckErrors, BoundariesAndProbes) {
    const std::string k = "key `boundary[0].";
    expect_messages({
        {{"boundary.0.value=[0, 0]"},
         {k + "value`: only for `type` = \"displacement\", \"velocity\", here `type` is \"fixed\""}},
        {{"boundary.0.type=velocity"},
         {k + "value`: missing, must be an array of 2 numbers, expressions or \"free\" (m or m/s)"}},
        {{"boundary.0.type=velocity", "boundary.0.value=['free', 'free']"},
         {k + "value`: given [\"free\", \"free\"], must be a value in at least one component"}},
        {{"boundary.0.type=velocity", "boundary.0.value=['fre', 0]"},
         {k + "value[0]`: expression \"fre\": unknown name `fre` at character 1, allowed: x, y, pi, e and functions"}},
        {{"initial=[{ on = 'a' }]"},
         {"key `initial[0].velocity`: missing, must be an array of 2 numbers or expressions (m/s)"}},
        {{"output.probes.1.name=a"},
         {"key `output.probes[1].name`: given \"a\", which is the name of output.probes[0] already"}},
        {{"output.probes.1.name=a b"},
         {"key `output.probes[1].name`: given \"a b\", must be free of blanks, commas and quotes: it heads columns of "
          "probes.csv"}},
        {{"output.probes=[{}]"},
         {"key `output.probes[0].name`: missing, must be a string",
          "key `output.probes[0].at`: missing, must be an array of 2 numbers (m)"}},
    });
}

TEST(DeckErrors, Set) {
    expect_messages({
        {{"foo"}, {"must be of the form key=value, as in run.t_end=0.01"}},
        {{"=3"}, {"must be of the form key=value, as in run.t_end=0.01"}},
        {{"run.t_end.x=3"}, {"key `run.t_end.x`: `run.t_end` holds a single value, nothing can be set inside it"}},
        {{"material.1.density=3"}, {"key `material[1]`: there is none, `material` has 1 element"}},
        {{"material.x.density=3"}, {"key `material[x]`: there is none, `material` has 1 element"}},
    });
    try {
        parse_deck(sound, "case.toml", {"run.t_end=-1", "title=\"a"});
        FAIL() << "bad arguments were taken";
    } catch (const InputError& error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[0].where, "--set title=\"a");
        EXPECT_EQ(error.problems()[1].where, "--set run.t_end=-1");
    }
}

}  // namespace
}  // namespace gneiss
