#include "io/deck/deck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/errors.hpp"
#include "materials/out_of_plane.hpp"

namespace gneiss {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

const std::string sample = R"toml(title = "pressure step in a borehole"
[mesh]
generator = "plate_with_hole"
side = 40.0
radius = 1.0
size = [0.1, 0.5]
[solid]
element = "compt"
plane = "stress"
thickness = 1.0
[[material]]
region = "rock"
law = "munjiza"
form = "hyper"
density = 1000.0
constants = { M_v = 0.267e9, M_alpha = 0.8e9, M_beta = 1.6e9, M_psi = 0.8e9 }
axes = { angle = "0.2*sin(x/5)" }
[[load]]
on = "hole"
type = "pressure"
value = 1e6
amplitude = "heaviside"
[[boundary]]
on = "outer"
type = "absorbing"
[integrator]
type = "central_difference"
safety = 0.8
[run]
t_end = 0.02
[output]
fields = 2e-4
history = 1e-5
probes = [{ at = [5.0, 0.0], name = "p0", about = [0.0, 0.0] }]
)toml";

std::vector<Problem> problems_of(const std::string& text, const std::vector<std::string>& set = {}) {
    try {
        parse_deck(text, "case.toml", set);
    } catch (const InputError& error) {
        return error.problems();
    }
    return {};
}

TEST(Deck, SampleOfTheDesign_IsReadWhole) {
    const CaseOptions c = parse_deck(sample, "case.toml");
    EXPECT_EQ(c.title, "pressure step in a borehole");
    EXPECT_EQ(c.mesh.source, MeshOptions::Source::plate_with_hole);
    EXPECT_EQ(c.mesh.side, 40.0);
    EXPECT_EQ(c.mesh.size, (std::array{0.1, 0.5}));
    EXPECT_TRUE(c.solid.compt);
    EXPECT_EQ(c.solid.plane, Plane::stress);
    ASSERT_EQ(c.materials.size(), 1u);
    EXPECT_EQ(c.materials[0].regions, std::vector<std::string>{"rock"});
    EXPECT_EQ(c.materials[0].constants, (MunjizaConstants{0.267e9, 0.8e9, 1.6e9, 0.8e9}));
    EXPECT_EQ(c.materials[0].axes.kind, AxesOptions::Kind::angle);
    EXPECT_EQ(c.materials[0].axes.angle.text, "0.2*sin(x/5)");
    EXPECT_FALSE(c.materials[0].axes.angle.constant.has_value());
    ASSERT_EQ(c.loads.size(), 1u);
    EXPECT_EQ(c.loads[0].kind, LoadOptions::Kind::pressure);
    EXPECT_EQ(c.loads[0].on, "hole");
    EXPECT_EQ(c.loads[0].value[0].constant, 1e6);
    EXPECT_EQ(c.loads[0].amplitude.kind, AmplitudeOptions::Kind::heaviside);
    EXPECT_EQ(c.loads[0].amplitude.start, 0.0);
    ASSERT_EQ(c.boundaries.size(), 1u);
    EXPECT_EQ(c.boundaries[0].kind, BoundaryOptions::Kind::absorbing);
    EXPECT_EQ(c.run.t_end, 0.02);
    EXPECT_EQ(c.output.fields, 2e-4);
    EXPECT_EQ(c.output.probes[0].name, "p0");
    EXPECT_EQ(c.output.probes[0].about, (std::array{0.0, 0.0}));
}

TEST(Deck, KeysLeftOut_TakeTheStructsDefaults) {
    const CaseOptions c = parse_deck(R"toml(
mesh = { file = "a.msh" }
solid = { plane = "strain" }
material = [{ density = 1, constants = { M_v = 0, M_alpha = 1, M_beta = 2, M_psi = 3 } }]
boundary = [{ on = "left", type = "velocity", value = [1, "free"] }]
run = { t_end = 1 }
)toml",
                                     "case.toml");
    const MaterialOptions material;
    EXPECT_TRUE(c.materials[0].regions.empty());
    EXPECT_EQ(c.materials[0].law, material.law);
    EXPECT_EQ(c.materials[0].form, material.form);
    EXPECT_EQ(c.materials[0].stress_map, material.stress_map);
    EXPECT_EQ(c.materials[0].axes.angle.text, material.axes.angle.text);
    EXPECT_EQ(c.materials[0].stiffening.k, material.stiffening.k);
    EXPECT_EQ(c.materials[0].stiffening.p_ref, material.stiffening.p_ref);
    EXPECT_EQ(c.mesh.curved, MeshOptions{}.curved);
    EXPECT_EQ(c.solid.thickness, SolidOptions{}.thickness);
    EXPECT_EQ(c.boundaries[0].amplitude.kind, AmplitudeOptions{}.kind);
    EXPECT_EQ(c.integrator.safety, IntegratorOptions{}.safety);
    EXPECT_EQ(c.integrator.type, IntegratorOptions{}.type);
    EXPECT_EQ(c.output.history, OutputOptions{}.history);
}

TEST(Deck, Fixed_IsZeroDisplacement) {
    const CaseOptions c = parse_deck(sample +
                                         "[[boundary]]\non = \"top\"\ntype = \"fixed\"\n[[boundary]]\non = "
                                         "\"left\"\ntype = \"displacement\"\nvalue = [\"free\", \"0.1*x\"]\n",
                                     "case.toml");
    EXPECT_EQ(c.boundaries[1].kind, BoundaryOptions::Kind::displacement);
    ASSERT_TRUE(c.boundaries[1].value[0] && c.boundaries[1].value[1]);
    EXPECT_TRUE(c.boundaries[1].value[0]->is_zero() && c.boundaries[1].value[1]->is_zero());
    EXPECT_FALSE(c.boundaries[2].value[0].has_value());
    EXPECT_EQ(c.boundaries[2].value[1]->text, "0.1*x");
}

TEST(Deck, EngineeringConstants_FollowThePlane) {
    const auto constants = [](const std::string& plane, const std::string& given) {
        return parse_deck(sample, "case.toml", {"solid.plane=" + plane, "material.0.constants=" + given})
            .materials[0]
            .constants;
    };
    EXPECT_EQ(constants("stress", "{ E = 1e9, nu = 0.5 }"), isotropic_plane_stress(1e9, 0.5));
    EXPECT_EQ(constants("strain", "{ E = 1e9, nu = 0.25 }"), isotropic_plane_strain(1e9, 0.25));
    const TransverselyIsotropic rock{20e9, 10e9, 0.3, 0.2, 4.5e9};
    const std::string given = "{ E_alpha = 20e9, E_beta = 10e9, nu_p_alpha = 0.2, G = 4.5e9, ";
    EXPECT_EQ(constants("stress", given + "nu_alpha_beta = 0.3 }"), transversely_isotropic_plane_stress(rock));
    EXPECT_EQ(constants("strain", given + "nu_alpha_beta = 0.3 }"), transversely_isotropic_plane_strain(rock));
    EXPECT_EQ(constants("strain", given + "nu_beta_alpha = 0.15 }"), transversely_isotropic_plane_strain(rock));
    const std::string bedded = "material.0.constants=" + given + "nu_alpha_beta = 0.3 }";
    EXPECT_EQ(parse_deck(sample, "case.toml", {"solid.plane=strain", bedded}).materials[0].across,
              transversely_isotropic_across(rock));
    EXPECT_EQ(parse_deck(sample, "case.toml", {"solid.plane=stress", bedded}).materials[0].across, 0);
}

TEST(Deck, NeoHookean_TakesLameConstants) {
    const std::string deck =
        "mesh = { file = \"a.msh\" }\nsolid = { plane = \"stress\" }\nrun = { t_end = 1 }\n"
        "material = [{ law = \"neo_hookean\", density = 1, constants = { E = 60e9, nu = 0.25 } }]\n";
    const CaseOptions c = parse_deck(deck, "case.toml");
    EXPECT_DOUBLE_EQ(c.materials[0].shear_modulus, 24e9);
    EXPECT_DOUBLE_EQ(c.materials[0].lame_lambda, 24e9);
    const auto set = parse_deck(deck, "case.toml", {"material.0.constants={ mu = 2, lambda = -1 }"});
    EXPECT_EQ(set.materials[0].shear_modulus, 2.0);
    EXPECT_EQ(set.materials[0].lame_lambda, -1.0);
}

TEST(Deck, Quadrilateral_HasItsCorners) {
    const std::string mesh =
        "mesh={ generator = 'quadrilateral', corners = [[0, 0], [48, 44], [48, 60], [0, 44]], cells = [2, 3], "
        "pattern = 'crossed' }";
    const CaseOptions c = parse_deck(sample, "case.toml", {mesh, "mesh.corners.2=[48.0, 61.5]"});
    EXPECT_EQ(c.mesh.source, MeshOptions::Source::quadrilateral);
    EXPECT_EQ(c.mesh.corners[1], (std::array{48.0, 44.0}));
    EXPECT_EQ(c.mesh.corners[2], (std::array{48.0, 61.5}));
    EXPECT_EQ(c.mesh.cells, (std::array{2, 3}));
    EXPECT_EQ(c.mesh.pattern, MeshOptions::Pattern::crossed);
}

TEST(Deck, SetValues_LieOverTheDeck) {
    const CaseOptions c =
        parse_deck(sample, "case.toml",
                   {"run.t_end=0.01", "run.mass_damping=3", "material.0.constants.M_v=1e9", " integrator.safety = 0.5 ",
                    "integrator.bound=lanczos", "material[0].axes.angle=0.1*x",
                    "load.0.amplitude={ type = \"ramp\", end = 1e-3 }", "load.0.amplitude.end=2e-3", "mesh.size.1=2",
                    "title=a \"b\" \\c", "output.probes.0.name='p 1'", "output.probes.0.name=p-1"});
    EXPECT_EQ(c.run.t_end, 0.01);
    EXPECT_EQ(c.run.mass_damping, 3.0);
    EXPECT_EQ(c.materials[0].constants.M_v, 1e9);
    EXPECT_EQ(c.materials[0].constants.M_alpha, 0.8e9);
    EXPECT_EQ(c.integrator.safety, 0.5);
    EXPECT_TRUE(c.integrator.lanczos);
    EXPECT_EQ(c.materials[0].axes.angle.text, "0.1*x");
    EXPECT_EQ(c.loads[0].amplitude.kind, AmplitudeOptions::Kind::ramp);
    EXPECT_EQ(c.loads[0].amplitude.end, 2e-3);
    EXPECT_EQ(c.mesh.size, (std::array{0.1, 2.0}));
    EXPECT_EQ(c.title, "a \"b\" \\c");
    EXPECT_EQ(c.output.probes[0].name, "p-1");
}

TEST(Deck, File_IsReadAndItsMeshFoundBesideIt) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "gneiss_deck_test";
    std::filesystem::create_directories(folder / "meshes");
    std::ofstream(folder / "meshes/a.msh") << "\n";
    std::ofstream(folder / "case.toml")
        << "mesh = { file = \"meshes/a.msh\" }\nsolid = { plane = \"stress\" }\n"
           "material = [{ density = 1, constants = { E = 1, nu = 0 } }]\nrun = { t_end = 1 }\n";
    EXPECT_EQ(read_deck(folder / "case.toml").mesh.file, (folder / "meshes/a.msh").string());
    try {
        read_deck(folder / "none.toml");
        FAIL() << "a missing deck was read";
    } catch (const InputError& error) {
        EXPECT_EQ(error.problems().front().where, (folder / "none.toml").string());
        EXPECT_EQ(error.problems().front().message, "no such deck, or not readable");
    }
    EXPECT_THROW(read_deck(folder), InputError);
    std::filesystem::remove_all(folder);
}

TEST(Deck, SyntaxError_ComesAloneWithItsPlace) {
    const auto problems = problems_of("title = 3\nmesh = [1,\n", {"run.t_end=-1"});
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].where, "case.toml:2:12");
    EXPECT_THAT(problems[0].message, testing::StartsWith("no valid TOML: "));
}

TEST(Deck, SeveralErrors_AreReportedAtOnceInTheOrderOfTheFile) {
    const auto problems = problems_of(R"toml(title = 3
[run]
t_end = nan
[mesh]
generator = "rectangle"
width = "2"
height = 1
cells = [2, 0]
[solid]
thikness = 1.0
[[material]]
density = -5
constants = { E = 1e9, nu = 0.2 }
)toml",
                                      {"integrator.safety=2"});
    const std::vector<std::pair<std::string, std::string>> expected{
        {"case.toml:1:9", "key `title`: given 3 (an integer), must be a string"},
        {"case.toml:3:9", "key `run.t_end`: given nan, must be > 0 s"},
        {"case.toml:6:9", "key `mesh.width`: given \"2\" (a string), must be a number > 0 m"},
        {"case.toml:8:13", "key `mesh.cells[1]`: given 0, must be ≥ 1"},
        {"case.toml:9:1", "key `solid.plane`: missing, must be one of \"stress\", \"strain\""},
        {"case.toml:10:1", "key `solid.thikness`: unknown, did you mean `thickness`?"},
        {"case.toml:12:11", "key `material[0].density`: given -5, must be > 0 kg/m³"},
        {"--set integrator.safety=2", "key `integrator.safety`: given 2, must be in (0, 1]"}};
    ASSERT_EQ(problems.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(problems[i].where, expected[i].first);
        EXPECT_EQ(problems[i].message, expected[i].second);
    }
}

TEST(Deck, EmptyDeck_NamesWhatIsRequired) {
    const auto problems = problems_of("");
    std::vector<std::string> messages;
    for (const Problem& problem : problems) messages.push_back(problem.where + ": " + problem.message);
    EXPECT_THAT(messages, testing::ElementsAre("case.toml:1:1: key `mesh`: missing, must be a table",
                                               "case.toml:1:1: key `solid`: missing, must be a table",
                                               "case.toml:1:1: key `material`: missing, must be an array of tables",
                                               "case.toml:1:1: key `run`: missing, must be a table"));
}

DeckNotes notes_of(const std::string& text, const std::vector<std::string>& set) {
    DeckNotes notes;
    parse_deck(text, "case.toml", set, std::nullopt, &notes);
    return notes;
}

TEST(Deck, SchemeExchangedBySet_KeysOfTheOther_AreLeftOutWithANote) {
    EXPECT_THAT(notes_of(sample, {"integrator.type=cvode"}).on_case,
                ElementsAre("case.toml:28:10: key `integrator.safety`: left out, only for `type` = "
                            "\"central_difference\", \"verlet\", \"noh_bathe\", here `type` is \"cvode\""));
    EXPECT_THAT(notes_of(sample, {"integrator.type=verlet"}).on_case, IsEmpty());
    // what is set beside it has been thought of
    EXPECT_THAT(problems_of(sample, {"integrator.type=cvode", "integrator.safety=0.5"}), SizeIs(1));
    // and in the deck itself it is a mistake
    std::string edited = sample;
    EXPECT_THAT(problems_of(edited.replace(edited.find("\"central_difference\""), 20, "\"cvode\"")), SizeIs(1));
}

TEST(Deck, SchemeExchangedBySet_WhatDependsOnAKeyLeftOut_GoesToo) {
    std::string text = sample;
    const std::string solver =
        "type = \"quasi_static\"\nsolver = \"pcg\"\npreconditioner = \"diagonal\"\nlinear_tolerance = 1e-6\n";
    text.replace(text.find("type = \"central_difference\"\nsafety = 0.8\n"), 41, solver);
    EXPECT_THAT(notes_of(text, {}).on_case, IsEmpty());
    EXPECT_THAT(
        notes_of(text, {"integrator.type=central_difference"}).on_case,
        ElementsAre(HasSubstr("`integrator.solver`: left out"), HasSubstr("`integrator.preconditioner`: left out"),
                    HasSubstr("`integrator.linear_tolerance`: left out")));
    EXPECT_THAT(notes_of(text, {"integrator.solver=klu"}).on_case, SizeIs(2));
    EXPECT_THAT(notes_of(text, {"integrator.type=arkode"}).on_case,
                ElementsAre(HasSubstr("`integrator.solver`: left out, it has no effect: with table"),
                            HasSubstr("`integrator.preconditioner`"), HasSubstr("`integrator.linear_tolerance`")));
}

TEST(Deck, MethodSwitchedOffBySet_ItsKeysAndTables_AreLeftOutWithANote) {
    const std::string text = sample +
                             "[contact]\nmethod = \"potential\"\nfriction = 0.5\n[[wall]]\npoint = [0, -30]\nnormal = "
                             "[0, 1]\n[fracture]\nmethod = \"intrinsic\"\npenalty = 30.0\n";
    DeckNotes notes;
    const CaseOptions c =
        parse_deck(text, "case.toml", {"contact.method=none", "fracture.method=none"}, std::nullopt, &notes);
    EXPECT_THAT(notes.on_case, UnorderedElementsAre(HasSubstr("`contact.friction`: left out"),
                                                    HasSubstr("`fracture.penalty`: left out"),
                                                    HasSubstr("`wall`: left out, it has no effect without")));
    EXPECT_TRUE(c.walls.empty());
}

TEST(Deck, CompareWithAListOfTypes_KeysThatFitSome_AreLeftOutForTheOthers) {
    const std::string compare =
        "[compare]\nreference = { type = \"verlet\" }\n[[compare.scheme]]\nname = \"both\"\nintegrator = { type = "
        "[\"central_difference\", \"cvode\"], safety = 0.5 }\n";
    DeckNotes notes;
    const CaseOptions c = parse_deck(sample + compare, "case.toml", {}, std::nullopt, &notes);
    EXPECT_THAT(notes.on_case, IsEmpty());
    EXPECT_THAT(notes.on_compare, ElementsAre(HasSubstr("key `compare.scheme[0].integrator.safety`: left out")));
    const auto& variants = c.compare->schemes[0].variants;
    EXPECT_THAT(variants[0].toml, HasSubstr("safety = 0.5"));
    EXPECT_THAT(variants[1].toml, Not(HasSubstr("safety")));
    std::string none = compare;
    EXPECT_THAT(problems_of(sample + none.replace(none.find("safety = 0.5"), 12, "rho_inf = 0.5")),
                Contains(Field(&Problem::message, HasSubstr("`rho_inf` fits none of the values of `type`"))));
}

TEST(Deck, MeshFileThatIsMissing_IsToldWithItsLineAndWhatThereIs) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gneiss_deck_missing_mesh";
    std::filesystem::create_directories(folder);
    for (const char* name : {"plate.msh", "block.geo", "notes.txt"}) std::ofstream(folder / name) << "\n";
    std::string text = sample;
    const std::size_t mesh = text.find("generator"), solid = text.find("[solid]");
    std::ofstream(folder / "case.toml") << text.replace(mesh, solid - mesh, "file = \"plaet.msh\"\n");
    const auto message = [&](const std::vector<std::string>& set) -> std::string {
        try {
            read_deck(folder / "case.toml", set);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(message({}),
                AllOf(HasSubstr("case.toml:3:8: key `mesh.file`: given \"plaet.msh\": no such file in " +
                                folder.string() + ", which has block.geo, plate.msh, did you mean `plate.msh`?")));
    EXPECT_THAT(message({"mesh.file=meshes/plate.msh"}), HasSubstr("there is no folder"));
    EXPECT_THAT(message({"mesh.file=plate.msh"}), "");
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace gneiss
