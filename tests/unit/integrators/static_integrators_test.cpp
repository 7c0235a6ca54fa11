// What every static integrator has to do: equilibria of small solids against dense solutions, closed forms, and the
// forces themselves.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "integrators/dynamic_relaxation.hpp"
#include "integrators/quasi_static.hpp"
#include "support/one_thread.hpp"
#include "unit/integrators/static_cases.hpp"

namespace gneiss {
namespace {

using test::held;
using test::is_fixed;
using test::loaded;
using test::out_of_balance;
using test::run;
using test::sheared;
using test::Solution;
using test::with_options;
using testing::HasSubstr;

template <class T>
class StaticIntegrator : public testing::Test {};
using StaticIntegrators = testing::Types<QuasiStatic, DynamicRelaxation>;
TYPED_TEST_SUITE(StaticIntegrator, StaticIntegrators);

TYPED_TEST(StaticIntegrator, SmallLoad_IsTheDenseLinearSolution) {
    for (const bool compt : {false, true}) {
        const test::Solid solid = test::distorted_solid(compt, sheared(1e3));
        auto integrator = with_options<TypeParam>({});
        const Solution found = run(*solid.system, integrator);
        // K u = p by dense differences at rest
        const State rest = solid.system->initial_state();
        Eigen::MatrixXd stiffness = test::dense_stiffness(*solid.system, rest);
        Trial full = Trial::of(rest);
        full.t = 1;
        full.last_event = 0;
        std::vector<double> p(rest.u.size());
        solid.system->force(rest, full, p);
        const std::vector<bool> fixed = is_fixed(*solid.system);
        for (Eigen::Index i = 0; i < stiffness.rows(); ++i) {
            if (!fixed[static_cast<std::size_t>(i)]) continue;
            stiffness.row(i).setZero();
            stiffness(i, i) = 1;
            p[static_cast<std::size_t>(i)] = 0;
        }
        const Eigen::VectorXd u =
            stiffness.partialPivLu().solve(Eigen::Map<Eigen::VectorXd>(p.data(), stiffness.rows()));
        // strains of 1e-6: nonlinear terms, and the differences' own error, times the condition of a few thousand
        const double scale = u.cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < u.size(); ++i)
            EXPECT_NEAR(found.state.u[static_cast<std::size_t>(i)], u[i], 2e-5 * scale);
        EXPECT_EQ(found.n_steps, 1u);
        EXPECT_EQ(found.state.v, rest.v);
    }
}

TYPED_TEST(StaticIntegrator, FiniteLoad_EveryLawAndLoad_IsInEquilibrium) {
    for (const test::FiniteLoad& c : test::finite_loads()) {
        const test::Solid solid = test::distorted_solid(c.compt, c.what);
        auto integrator = with_options<TypeParam>({.tolerance = 1e-10, .step = 0.25});
        const Solution found = run(*solid.system, integrator);
        EXPECT_LE(out_of_balance(*solid.system, found.state), 1e-9);
        const auto [lowest, highest] = std::ranges::minmax(found.state.u);
        EXPECT_GT(highest - lowest, 0.02) << "a finite deformation";
    }
}

TYPED_TEST(StaticIntegrator, Reactions_BalanceTheLoad) {
    const test::Solid solid = test::distorted_solid(true, sheared(1e8));
    auto integrator = with_options<TypeParam>({.step = 0.5});
    const Solution found = run(*solid.system, integrator);
    double x = 0, y = 0;
    const auto reactions = integrator.reactions(*solid.system, found.state);
    for (std::size_t k = 0; k < reactions.size(); ++k)
        (solid.system->constraints()[k].dof % 2 == 0 ? x : y) += reactions[k];
    // traction times the width of 2 m, thickness 1 m; out of balance by 1e-9 at some dozen nodes
    EXPECT_NEAR(x, -2e8, 1e-7 * 2e8);
    EXPECT_NEAR(y, 0.6e8, 1e-7 * 2e8);
}

TYPED_TEST(StaticIntegrator, PrescribedStretch_IsUniformAndStoresItsWork) {
    // sides on rollers, pulled by 10 %: H = diag(0.1, h_yy) with no stress across, the same everywhere
    test::SolidDescription what;
    what.materials[0] = test::rock(0);
    what.boundaries = {held("left", 0, {}), held("bottom", {}, 0), held("right", 0.2, {})};
    const test::Solid solid = test::distorted_solid(true, what);
    auto integrator = with_options<TypeParam>({.tolerance = 1e-10, .longest = 0.02});
    const Solution found = run(*solid.system, integrator);
    EXPECT_EQ(found.state.t, 1);
    const auto fields = solid.system->point_fields(found.state);
    for (const PointFields& point : fields) {
        EXPECT_NEAR(point.cauchy[0], fields[0].cauchy[0], 1e-8 * std::abs(fields[0].cauchy[0]));
        EXPECT_NEAR(point.cauchy[1], 0, 1e-8 * std::abs(fields[0].cauchy[0]));
    }
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node)
        EXPECT_NEAR(found.state.u[2 * node], 0.1 * solid.mesh.nodes[node][0], 1e-9);
    // the trapezoidal rule over fifty steps of a force that bends by 10 %: 0.1/50^2 of the work at most
    const double stored = solid.system->stored_energies(found.state).sum();
    EXPECT_EQ(found.n_steps, 50u);
    EXPECT_NEAR(found.state.path.support_work, stored, 4e-5 * stored);
    EXPECT_GT(stored, 1e5);
}

TYPED_TEST(StaticIntegrator, EverythingPrescribed_FollowsTheMotion) {
    Mesh mesh = test::rectangle(false, 1, 1, {1, 1});
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh.n_nodes()); ++node)
        mesh.node_sets["all"].push_back(node);
    test::SolidDescription what;
    what.boundaries = {held("all", Formula("0.1*x"), Formula("-0.05*y*y"))};
    const test::Solid solid = test::make_solid(std::move(mesh), what);
    auto integrator = with_options<TypeParam>({});
    const Solution found = run(*solid.system, integrator);
    ASSERT_EQ(integrator.reactions(*solid.system, found.state).size(), found.state.u.size());
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        const auto& [x, y] = solid.mesh.nodes[node];
        EXPECT_DOUBLE_EQ(found.state.u[2 * node], 0.1 * x);
        EXPECT_DOUBLE_EQ(found.state.u[2 * node + 1], -0.05 * y * y);
    }
    EXPECT_LT(integrator.matrix_bytes(), 1e5) << "there is nothing to solve for";
}

TYPED_TEST(StaticIntegrator, PrescribedVelocity_IsIntegratedWhateverTheLoadSteps) {
    test::SolidDescription what = sheared(0);
    BoundaryOptions moved = held("top", 0.1, {});
    moved.kind = BoundaryOptions::Kind::velocity;
    what.boundaries.push_back(moved);  // 0.1 t m/s until t = 1
    what.loads.clear();
    const test::Solid solid = test::distorted_solid(true, what);
    auto integrator = with_options<TypeParam>({});
    const Solution found = run(*solid.system, integrator);
    EXPECT_EQ(found.n_steps, 1u);
    for (const Constraint& constraint : solid.system->constraints()) {
        if (constraint.kind == Constraint::Kind::displacement) continue;
        EXPECT_NEAR(found.state.u[constraint.dof], 0.05, 1e-15);
    }
}

TYPED_TEST(StaticIntegrator, InitialVelocityUnderViscosity_DissipatesNothing) {
    test::SolidDescription what = sheared(1e6);
    what.materials[0].shear_viscosity = 1e6;
    InitialOptions initial;
    initial.velocity = {Formula("y"), Formula("x")};
    what.initial = {initial};
    const test::Solid solid = test::distorted_solid(true, what);
    auto integrator = with_options<TypeParam>({.step = 0.5});
    EXPECT_EQ(run(*solid.system, integrator).state.path.viscous, 0);
}

TYPED_TEST(StaticIntegrator, LoadInOneStepOrMany_SameEquilibrium) {
    const test::Solid solid = test::distorted_solid(true, sheared(1e8));
    auto one = with_options<TypeParam>({.tolerance = 1e-11});
    auto many = with_options<TypeParam>({.tolerance = 1e-11, .step = 0.05});
    const Solution coarse = run(*solid.system, one), fine = run(*solid.system, many);
    EXPECT_LT(coarse.n_steps, fine.n_steps);
    for (std::size_t i = 0; i < coarse.state.u.size(); ++i)
        EXPECT_NEAR(coarse.state.u[i], fine.state.u[i], 1e-9 * solid.system->smallest_length());
}

TYPED_TEST(StaticIntegrator, SavedAndLoaded_GoesOnWithTheSameBits) {
    test::SolidDescription what = sheared(1e8);
    what.materials[0].form = Form::hypo;
    const test::Solid solid = test::distorted_solid(true, what);
    auto integrator = with_options<TypeParam>({.step = 0.125});
    auto other = with_options<TypeParam>({.step = 0.125});
    test::expect_other_goes_on_with_the_same_bits(*solid.system, integrator, other);
}

TYPED_TEST(StaticIntegrator, WatcherThatHasEnough_EndsTheStepAndLeavesNoTrace) {
    const test::Solid solid = test::distorted_solid(true, sheared(1e8));
    auto integrator = with_options<TypeParam>({.step = 0.125});
    auto undisturbed = with_options<TypeParam>({.step = 0.125});
    const Solution whole = run(*solid.system, undisturbed);
    State state = solid.system->initial_state();
    int calls_in_step = 0;
    March march;
    march.t_end = 1;
    march.after_step = [&](const StepReport&) { return calls_in_step = 0, true; };
    march.within_step = [&](const StepProgress& progress) {
        EXPECT_GT(progress.t, state.t);
        EXPECT_GE(progress.unbalanced, 0);
        return !(progress.t > 0.5 && ++calls_in_step == 3);
    };
    EXPECT_EQ(march.run(*solid.system, integrator, state, false), MarchOutcome::interrupted);
    EXPECT_GT(state.t, 0);
    EXPECT_LT(state.t, 1);
    march.within_step = {};
    EXPECT_EQ(march.run(*solid.system, integrator, state, true), MarchOutcome::finished);
    EXPECT_EQ(state, whole.state);
    EXPECT_EQ(integrator.save(), undisturbed.save());
}

TYPED_TEST(StaticIntegrator, FailedStep_LeavesStateAndMemory) {
    // squeezed to less than nothing
    test::SolidDescription what;
    what.boundaries = {held("bottom", 0, 0), held("top", 0, -1.2)};
    const test::Solid solid = test::distorted_solid(true, what);
    auto integrator = with_options<TypeParam>({.step = 0.05, .shortest = 0.1});
    State state = solid.system->initial_state(), last = state;
    integrator.start(*solid.system, state, StartReason::fresh);
    IntegratorMemory memory;
    try {
        while (state.t < 1) {
            last = state;
            memory = integrator.save();
            integrator.advance(*solid.system, state, 1);
        }
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), HasSubstr(fmt::format("no equilibrium found after load time t = {:.9g} s", last.t)));
    }
    EXPECT_EQ(state, last);
    EXPECT_EQ(integrator.save(), memory);
}

TYPED_TEST(StaticIntegrator, Options_AllProblemsAtOnce) {
    try {
        auto integrator =
            with_options<TypeParam>({.tolerance = 0, .step = -1, .longest = -1, .shortest = 1, .most_iterations = -1});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.problems().size(), 5u);
        EXPECT_THAT(error.what(), HasSubstr("integrator.tolerance"));
        EXPECT_THAT(error.what(), HasSubstr("must be in (0, 0.01]"));
    }
}

}  // namespace
}  // namespace gneiss
