#include "model/make_blocks.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "base/errors.hpp"
#include "mesh/measure.hpp"
#include "support/one_thread.hpp"
#include "support/small_solids.hpp"
#include "unit/model/tiny_mesh.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

MaterialOptions of(std::vector<std::string> regions) {
    MaterialOptions material = test::rock(0);
    material.regions = std::move(regions);
    return material;
}

std::vector<std::string> messages(const std::vector<MaterialOptions>& materials, const SolidOptions& solid = {},
                                  const Mesh& mesh = test::rectangle_mesh()) {
    try {
        make_blocks(mesh, solid, materials);
    } catch (const InputError& error) {
        std::vector<std::string> all;
        for (const Problem& problem : error.problems()) all.push_back(problem.where + ": " + problem.message);
        return all;
    }
    return {};
}

// ---- what there is
// -------------------------------------------------------------------------------------------------------

TEST(MakeBlocks, OneMaterialPerRegion_EachElement_IsInItsBlock) {
    const auto blocks = make_blocks(test::rectangle_mesh(), {}, {of({"clay"}), of({"rock"})});
    ASSERT_EQ(blocks.size(), 2u);
    EXPECT_EQ(blocks[0]->n_elements(), 1u);
    EXPECT_EQ(blocks[0]->element(0), 1);
    EXPECT_EQ(blocks[1]->element(0), 0);
}

TEST(MakeBlocks, MaterialWithoutRegions_TakesTheRest) {
    const auto blocks = make_blocks(test::rectangle_mesh(), {}, {of({}), of({"rock"})});
    ASSERT_EQ(blocks.size(), 2u);
    EXPECT_EQ(blocks[0]->element(0), 1);
    EXPECT_EQ(make_blocks(test::rectangle_mesh(), {}, {of({})})[0]->n_elements(), 2u);
}

TEST(MakeBlocks, MaterialThatHasNoElements_GetsNoBlock) {
    EXPECT_EQ(make_blocks(test::rectangle_mesh(), {}, {of({"rock", "clay"}), of({})}).size(), 1u);
}

TEST(MakeBlocks, Constants_DensityAndAxes_ReachTheBlock) {
    MaterialOptions material = of({});
    material.axes.angle = 0.25;
    material.density = 1234;
    const auto blocks = make_blocks(test::rectangle_mesh(), {}, {material});
    EXPECT_EQ(blocks[0]->axis_angle(1), 0.25);
    EXPECT_EQ(blocks[0]->density(), 1234);
    EXPECT_EQ(blocks[0]->tangent_constants(0), material.constants);
    EXPECT_FALSE(blocks[0]->viscous());
    material.bulk_viscosity = 1;
    EXPECT_TRUE(make_blocks(test::rectangle_mesh(), {}, {material})[0]->viscous());
}

TEST(MakeBlocks, StressInSitu_OfPosition_IsWhatTheElementsCarry) {
    SolidOptions solid;
    for (const StressMap map : {StressMap::conjugate, StressMap::direct}) {
        MaterialOptions material = of({});
        material.form = Form::hypo;
        material.stress_map = map;
        material.axes.angle = 0.6;
        material.in_situ_stress = {Formula("-1e6 - 1e5*y"), Formula("-2e6"), Formula("3e5*x")};
        for (const bool compt : {false, true}) {
            const test::Solid built =
                test::make_solid(test::rectangle(compt, 2, 1, {2, 1}), {solid, {material}, {}, {}, {}, 0});
            const State state = built.system->initial_state();
            const auto centroids = element_centroids(built.mesh);
            for (std::size_t e = 0; e < centroids.size(); ++e)
                for (const PointFields& fields : built.system->point_fields(state, static_cast<std::int32_t>(e))) {
                    constexpr double round_off = 1e-13 * 2e6;
                    EXPECT_NEAR(fields.cauchy[0], -1e6 - 1e5 * centroids[e][1], round_off);
                    EXPECT_NEAR(fields.cauchy[1], -2e6, round_off);
                    EXPECT_NEAR(fields.cauchy[2], 3e5 * centroids[e][0], round_off);
                }
        }
    }
}

// ---- what is wrong
// -------------------------------------------------------------------------------------------------------

TEST(MakeBlocks, UnknownRegion_IsReportedWithThoseThereAre) {
    EXPECT_THAT(messages({of({}), of({"sand"})}),
                ElementsAre("[[material]] 2: the mesh has no region `sand`; it has: rock, clay"));
}

TEST(MakeBlocks, RegionOfTwoMaterials_IsReported) {
    EXPECT_THAT(messages({of({"rock"}), of({"rock", "clay"})}),
                ElementsAre("[[material]] 2: region `rock` belongs to material 1 already"));
}

TEST(MakeBlocks, GroupsThatOverlap_GoByThoseThatMaterialsName) {
    Mesh mesh = test::rectangle_mesh();
    mesh.region_names = {"rock & source", "clay & source"};
    EXPECT_EQ(make_blocks(mesh, {}, {of({"rock"}), of({"clay"})}).size(), 2u);
    EXPECT_EQ(make_blocks(mesh, {}, {of({"source"})}).size(), 1u);
    EXPECT_THAT(
        messages({of({"rock"}), of({"source"})}, {}, mesh),
        ElementsAre("[[material]] 2: region `source` overlaps with others: `rock & source` belongs to material 1 "
                    "already; materials may name those groups only that share no element"));
    EXPECT_THAT(messages({of({"rock"})}, {}, mesh),
                ElementsAre("[[material]]: no material for region `clay & source`"));
}

TEST(MakeBlocks, TwoMaterialsForTheRest_AreReported) {
    EXPECT_THAT(messages({of({}), of({})}), ElementsAre("[[material]] 2: names no region, like material 1: only one "
                                                        "material can take all regions that no other names"));
}

TEST(MakeBlocks, RegionWithoutMaterial_IsReported) {
    EXPECT_THAT(messages({of({"rock"})}), ElementsAre("[[material]]: no material for region `clay`"));
    EXPECT_THAT(messages({}), ElementsAre("[[material]]: no material for region `rock`",
                                          "[[material]]: no material for region `clay`"));
}

TEST(MakeBlocks, ValuesOutOfRange_AreReportedAtOnce) {
    SolidOptions solid;
    solid.thickness = 0;
    MaterialOptions material = of({});
    material.density = -1;
    material.shear_viscosity = std::numeric_limits<double>::quiet_NaN();
    material.stiffening = {1, 0, 2};
    EXPECT_THAT(messages({material}, solid),
                ElementsAre("[[material]] 1: thickness: given 0, must be > 0 m",
                            "[[material]] 1: density: given -1, must be > 0 kg/m3",
                            "[[material]] 1: viscosity.shear: given nan, must be >= 0 Pa s",
                            "[[material]] 1: stiffening.p_ref: given 0, must be > 0 Pa",
                            "[[material]] 1: stiffening.n: given 2, must be in [0, 1]",
                            "[[material]] 1: form: stress in situ and stiffening need form = \"hypo\""));
    material = of({});
    material.law = LawKind::neo_hookean;
    material.shear_modulus = 1;
    material.lame_lambda = -1;
    EXPECT_THAT(messages({material}), ElementsAre("[[material]] 1: constants.lambda: given -1, must be > -2/3 mu"));
}

TEST(MakeBlocks, CentreVolume_WithALawThatHasAStoredEnergy_IsReported) {
    SolidOptions solid;
    solid.volumetric = Volumetric::centre;
    const std::string expected =
        "[[material]] 1: volumetric = \"centre\" has no stored energy and goes only with law = "
        "\"munjiza\" and stress_map = \"direct\"";
    MaterialOptions material = of({});
    EXPECT_THAT(messages({material}, solid, test::composite_mesh()), ElementsAre(expected));
    material.law = LawKind::neo_hookean;
    material.shear_modulus = material.lame_lambda = 1e9;
    material.stress_map = StressMap::direct;
    EXPECT_THAT(messages({material}, solid, test::composite_mesh()), ElementsAre(expected));
    material.law = LawKind::munjiza;
    EXPECT_THAT(messages({material}, solid, test::composite_mesh()), ElementsAre());
    material.stress_map = StressMap::conjugate;  // a CST is its own centre
    EXPECT_THAT(messages({material}, solid), ElementsAre());
}

TEST(MakeBlocks, FaultyAxesAndStressInSitu_OfSeveralMaterials_AreAllReported) {
    MaterialOptions rock = of({"rock"}), clay = of({"clay"});
    rock.axes.angle = Formula("x +");
    clay.axes.kind = AxesOptions::Kind::data;
    clay.axes.data = "dip";
    clay.form = Form::hypo;
    clay.in_situ_stress[2] = Formula("q");
    EXPECT_THAT(messages({rock, clay}),
                ElementsAre(StartsWith("[[material]] 1: axes.angle: "),
                            "[[material]] 2: axes.data: the mesh file has no element data `dip`; it has: none",
                            testing::AllOf(StartsWith("[[material]] 2: in_situ_stress: "), HasSubstr("`q`"))));
}

TEST(MakeBlocks, MaterialWithStraightAndCurvedComposites_Fault_IsReportedOnce) {
    Mesh mesh = test::rectangle(true, 1, 1, {2, 2});
    mesh.nodes[static_cast<std::size_t>(mesh.element(0)[1])][0] += 0.01;
    MaterialOptions material = of({});
    EXPECT_EQ(make_blocks(mesh, {}, {material}).size(), 2u);
    material.axes.angle = Formula("z");
    EXPECT_EQ(messages({material}, {}, mesh).size(), 1u);
}

}  // namespace
}  // namespace gneiss
