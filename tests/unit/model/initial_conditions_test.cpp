#include "model/initial_conditions.hpp"

#include <gmock/gmock.h>

#include "base/errors.hpp"
#include "unit/model/tiny_mesh.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(InitialVelocity, NoEntries_Everything_IsAtRest) {
    EXPECT_THAT(initial_velocity(test::rectangle_mesh(), {}), ElementsAre(0, 0, 0, 0, 0, 0, 0, 0));
}

TEST(InitialVelocity, RegionAndNodes_Formulas_AreTakenAtTheNodes) {
    const std::vector<InitialOptions> options{{"clay", {Formula("3*y"), Formula(-1)}},
                                              {"right", {0, Formula("x - 3")}}};
    // nodes 0, 2, 3 by "clay", 1 and 2 by "right": at node 2, (2, 1), they differ
    EXPECT_THROW(initial_velocity(test::rectangle_mesh(), options), InputError);
    EXPECT_THAT(initial_velocity(test::rectangle_mesh(), {options[0]}), ElementsAre(0, -1, 0, 0, 3, -1, 3, -1));
    EXPECT_THAT(initial_velocity(test::rectangle_mesh(), {options[1]}), ElementsAre(0, 0, 0, -1, 0, -1, 0, 0));
}

TEST(InitialVelocity, EmptyName_Everything_Moves) {
    EXPECT_THAT(initial_velocity(test::rectangle_mesh(), {{"", {2, Formula("-x")}}}),
                ElementsAre(2, 0, 2, -2, 2, -2, 2, 0));
}

TEST(InitialVelocity, Overlap_EqualVelocities_AreFine) {
    EXPECT_THAT(initial_velocity(test::rectangle_mesh(), {{"rock", {1, 0}}, {"clay", {1, 0}}}),
                ElementsAre(1, 0, 1, 0, 1, 0, 1, 0));
}

TEST(InitialVelocity, Overlap_DifferentVelocities_AreRefusedNamingBoth) {
    try {
        initial_velocity(test::rectangle_mesh(), {{"rock", {1, 0}}, {"", {1, 0}}, {"left", {2, 0}}});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(
            error.what(),
            "[[initial]] 3: on \"left\" gives another velocity than [[initial]] 1 on \"rock\" at 1 node: node 11 "
            "at (0, 0)\n"
            "[[initial]] 3: on \"left\" gives another velocity than [[initial]] 2 on everything at 1 node: node "
            "14 at (0, 1)");
    }
}

TEST(InitialVelocity, BadInput_EveryProblem_IsReportedAtOnce) {
    try {
        initial_velocity(test::rectangle_mesh(),
                         {{"roc", {Formula("x +"), Formula("t")}}, {"left", {Formula("1/x"), 0}}});
        FAIL();
    } catch (const InputError& error) {
        ASSERT_EQ(error.problems().size(), 4u) << error.what();
        EXPECT_EQ(error.problems()[0].where, "[[initial]] 1");
        EXPECT_THAT(error.problems()[0].message, HasSubstr("did you mean \"rock\"?"));
        EXPECT_THAT(error.problems()[1].message, HasSubstr("x +"));
        EXPECT_THAT(error.problems()[2].message, HasSubstr("`t`"));
        EXPECT_EQ(error.problems()[3].where, "[[initial]] 2");
        EXPECT_THAT(error.problems()[3].message, HasSubstr("1/x"));
    }
}

}  // namespace
}  // namespace gneiss
