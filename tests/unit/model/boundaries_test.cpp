#include "model/boundaries.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "base/errors.hpp"
#include "unit/model/amplitude_options.hpp"
#include "unit/model/tiny_mesh.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using BoundaryKind = BoundaryOptions::Kind;

constexpr double no_event = -std::numeric_limits<double>::infinity();

BoundaryOptions entry(BoundaryKind kind, std::string on, std::optional<Formula> x, std::optional<Formula> y,
                      AmplitudeOptions amplitude = {}) {
    return {kind, std::move(on), {std::move(x), std::move(y)}, std::move(amplitude)};
}

std::vector<std::size_t> dofs(const ConstraintSet& set) {
    std::vector<std::size_t> all;
    for (const Constraint& constraint : set.constraints()) all.push_back(constraint.dof);
    return all;
}

std::vector<double> values(const ConstraintSet& set, double t, double last_event) {
    std::vector<double> out(set.constraints().size(), -99.0);
    set.values(t, last_event, out);
    return out;
}

std::string message_of(const std::vector<BoundaryOptions>& options) {
    try {
        make_constraints(test::rectangle_mesh(), options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(Constraints, None_NoEntries_PrescribeNothing) {
    const ConstraintSet set = make_constraints(test::rectangle_mesh(), {});
    EXPECT_THAT(set.constraints(), IsEmpty());
    EXPECT_THAT(set.switch_times(), IsEmpty());
}

TEST(Constraints, Entries_SeveralBoundaries_GiveAscendingDegreesOfFreedom) {
    const ConstraintSet set = make_constraints(test::rectangle_mesh(),
                                               {entry(BoundaryKind::velocity, "right", Formula(5), std::nullopt),
                                                entry(BoundaryKind::displacement, "left", Formula(0), std::nullopt),
                                                entry(BoundaryKind::displacement, "corner", std::nullopt, Formula(0))});
    EXPECT_THAT(dofs(set), ElementsAre(0, 2, 4, 5, 6));
    EXPECT_EQ(set.constraints()[0].kind, Constraint::Kind::displacement);
    EXPECT_EQ(set.constraints()[1].kind, Constraint::Kind::velocity);
    EXPECT_THAT(values(set, 0, no_event), ElementsAre(0, 5, 5, 0, 0));
}

TEST(Constraints, Values_PatternTimesAmplitude_IsTheValue) {
    const ConstraintSet set =
        make_constraints(test::rectangle_mesh(),
                         {entry(BoundaryKind::displacement, "top", Formula("2*x"), Formula("-1"), test::ramp(0, 4))});
    // nodes 2 at (2, 1) and 3 at (0, 1)
    EXPECT_THAT(values(set, 1, 0), ElementsAre(1, -0.25, 0, -0.25));
    EXPECT_THAT(set.switch_times(), ElementsAre(0, 4));
}

TEST(Constraints, Values_AmplitudeOfPosition_IsTakenAtTheNode) {
    const AmplitudeOptions wave = test::expression("t + 10*x");
    const ConstraintSet set = make_constraints(test::rectangle_mesh(),
                                               {entry(BoundaryKind::velocity, "top", Formula(2), std::nullopt, wave)});
    EXPECT_THAT(values(set, 3, no_event), ElementsAre(46, 6));
}

TEST(Constraints, Values_VelocityJump_HappensWithTheEvent) {
    const ConstraintSet set =
        make_constraints(test::rectangle_mesh(),
                         {entry(BoundaryKind::velocity, "corner", Formula(3), std::nullopt, test::heaviside(1))});
    EXPECT_THAT(values(set, 1, no_event), ElementsAre(0));
    EXPECT_THAT(values(set, 1, 1), ElementsAre(3));
}

TEST(Constraints, SwitchTimes_SeveralEntries_AreMergedAscending) {
    const ConstraintSet set = make_constraints(
        test::rectangle_mesh(), {entry(BoundaryKind::velocity, "left", Formula(3), std::nullopt, test::heaviside(2)),
                                 entry(BoundaryKind::velocity, "right", Formula(3), std::nullopt, test::ramp(0, 2))});
    EXPECT_THAT(set.switch_times(), ElementsAre(0, 2));
}

TEST(Constraints, Overlap_SamePrescriptionTwice_IsKeptOnce) {
    const ConstraintSet fixed =
        make_constraints(test::rectangle_mesh(),
                         {entry(BoundaryKind::displacement, "left", Formula(0), Formula(0)),
                          entry(BoundaryKind::displacement, "bottom", Formula("0*x"), Formula(0), test::ramp(0, 1))});
    EXPECT_THAT(dofs(fixed), ElementsAre(0, 1, 2, 3, 6, 7));
    const ConstraintSet moving = make_constraints(
        test::rectangle_mesh(), {entry(BoundaryKind::velocity, "top", Formula("x"), std::nullopt, test::ramp(0, 1)),
                                 entry(BoundaryKind::velocity, "right", Formula(2), std::nullopt, test::ramp(0, 1))});
    EXPECT_THAT(dofs(moving), ElementsAre(2, 4, 6));
    EXPECT_THAT(values(moving, 0.5, 0), ElementsAre(1, 1, 0));
}

TEST(Constraints, Overlap_DifferentValues_AreRefusedNamingBothBoundaries) {
    EXPECT_EQ(
        message_of({entry(BoundaryKind::displacement, "left", Formula(0), Formula(0)),
                    entry(BoundaryKind::displacement, "top", std::nullopt, Formula(1e-3))}),
        "[[boundary]] 2: on = \"top\" prescribes another y motion than [[boundary]] 1 on \"left\" at 1 node: node "
        "14 at (0, 1)");
}

TEST(Constraints, Overlap_DifferentKindsOrAmplitudes_AreRefusedWithACount) {
    EXPECT_EQ(message_of({entry(BoundaryKind::displacement, "left", Formula(0), std::nullopt),
                          entry(BoundaryKind::velocity, "outer", Formula(0), std::nullopt)}),
              "[[boundary]] 2: on = \"outer\" prescribes another x motion than [[boundary]] 1 on \"left\" at 2 nodes, "
              "among them: node 11 at (0, 0)");
    EXPECT_THAT(message_of({entry(BoundaryKind::velocity, "left", Formula(1), std::nullopt, test::ramp(0, 1)),
                            entry(BoundaryKind::velocity, "top", Formula(1), std::nullopt, test::ramp(0, 2))}),
                HasSubstr("another x motion"));
}

TEST(Constraints, BadInput_EveryProblem_IsReportedAtOnce) {
    const AmplitudeOptions empty_table = test::table({}, {});
    const std::string all =
        message_of({entry(BoundaryKind::displacement, "lef", Formula("x*"), Formula(0), empty_table),
                    entry(BoundaryKind::velocity, "top", std::nullopt, std::nullopt),
                    entry(BoundaryKind::displacement, "left", Formula("1/x"), std::nullopt)});
    EXPECT_THAT(all,
                HasSubstr("[[boundary]] 1: on = \"lef\": the mesh has no boundary or nodes of this name; there are: "
                          "\"bottom\", \"corner\", \"left\", \"outer\", \"right\", \"top\"; did you mean \"left\"?"));
    EXPECT_THAT(all, HasSubstr("[[boundary]] 1: a table needs at least one time"));
    EXPECT_THAT(all, HasSubstr("[[boundary]] 1: expression \"x*\""));
    EXPECT_THAT(all, HasSubstr("[[boundary]] 2: on = \"top\" prescribes neither x nor y"));
    EXPECT_THAT(all, HasSubstr("[[boundary]] 3: expression \"1/x\""));
}

TEST(Constraints, BadInput_DisplacementThatJumps_IsRefused) {
    EXPECT_EQ(
        message_of({entry(BoundaryKind::displacement, "top", std::nullopt, Formula(1e-3), test::heaviside(0))}),
        "[[boundary]] 1: on = \"top\": a displacement cannot jump, its velocity would be infinite; use a ramp, or "
        "prescribe a velocity");
    EXPECT_EQ(message_of({entry(BoundaryKind::displacement, "top", Formula(0), Formula(0), test::heaviside(0))}),
              "no error");
}

TEST(AbsorbingEdges, Entries_EdgesNamedTwice_AreTakenOnce) {
    const Mesh mesh = test::rectangle_mesh();
    const std::vector<BoundaryOptions> options{entry(BoundaryKind::absorbing, "left", std::nullopt, std::nullopt),
                                               entry(BoundaryKind::displacement, "top", Formula(0), Formula(0)),
                                               entry(BoundaryKind::absorbing, "outer", std::nullopt, std::nullopt)};
    std::vector<std::int32_t> starts;
    for (const BoundaryEdge& edge : absorbing_edges(mesh, options)) starts.push_back(edge.a);
    EXPECT_THAT(starts, ElementsAre(3, 0, 1, 2));
    EXPECT_THAT(dofs(make_constraints(mesh, options)), ElementsAre(4, 5, 6, 7));
}

TEST(AbsorbingEdges, BadInput_EveryUnknownBoundary_IsReported) {
    try {
        absorbing_edges(test::rectangle_mesh(), {entry(BoundaryKind::absorbing, "corner", std::nullopt, std::nullopt),
                                                 entry(BoundaryKind::absorbing, "rigth_", std::nullopt, std::nullopt)});
        FAIL();
    } catch (const InputError& error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[1].where, "[[boundary]] 2");
        EXPECT_THAT(error.problems()[0].message, HasSubstr("these are nodes, needed: boundary"));
    }
}

}  // namespace
}  // namespace gneiss
