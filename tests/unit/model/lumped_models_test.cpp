// Lumped models as parts of a solid: unknowns, forces, tangents, bounds, energies, and what follows a crack.

#include "model/lumped_models.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/errors.hpp"
#include "support/one_thread.hpp"
#include "support/plate_with_hole.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

LumpedOptions gas_in_the_hole(bool changing) {
    LumpedOptions options;
    options.name = "gas";
    options.on = "hole";
    options.pressure = 2e7;
    if (changing) {
        options.leak = 100;
        options.burn = BurnOptions{.energy = 1e8, .time = 2e-3, .exponent = 0.5, .reference_pressure = 2e7};
    }
    return options;
}
LumpedOptions falling_hammer() {
    LumpedOptions options;
    options.kind = LumpedOptions::Kind::mass;
    options.name = "hammer";
    options.on = "top";
    options.direction = {0, -1};
    options.stiffness = 5e9;
    options.damping = 1e6;
    options.mass = 2000;
    options.velocity = 2;
    return options;
}

test::Solid solid(bool compt, std::vector<LumpedOptions> lumped, Form form = Form::hyper) {
    test::SolidDescription what;
    what.materials[0].form = form;
    what.solid.thickness = 0.5;
    what.lumped = std::move(lumped);
    return test::make_solid(test::plate_with_hole(compt), what);
}

State moved(const test::Solid& solid, double size) {
    State state = solid.system->initial_state();
    for (std::size_t i = 0; i < state.u.size(); ++i) {
        state.u[i] = size * std::sin(0.7 * static_cast<double>(i) + 0.3);
        state.v[i] = 3 * std::cos(static_cast<double>(i));
    }
    // a hammer, if there is one: it presses some nodes and not others; its second component does not move
    state.u[state.u.size() - 2] = 0.5 * size;
    state.u.back() = 0;
    return state;
}

TEST(LumpedModels, Layout_PointsStandBehindNodesAndTheirZBehindThatOfElements) {
    const test::Solid with = solid(true, {gas_in_the_hole(true), falling_hammer()}, Form::hypo);
    const test::Solid without = solid(true, {}, Form::hypo);
    const Layout layout = with.system->layout(), plain = without.system->layout();
    EXPECT_EQ(layout.n_dof, plain.n_dof + 2);
    EXPECT_EQ(layout.n_internal, plain.n_internal + 2);
    EXPECT_EQ(with.system->lumped_mass().back(), 2000);
    const State state = with.system->initial_state();
    EXPECT_EQ(state.v[layout.n_dof - 2], 2);
    EXPECT_EQ(state.z[plain.n_internal], 2e7);
    std::vector<std::string> names;
    for (const auto& quantity : with.system->models().quantities(state)) names.push_back(quantity.name);
    EXPECT_THAT(names, ElementsAre("gas.pressure", "gas.volume", "gas.energy", "gas.charge", "hammer.displacement",
                                   "hammer.velocity", "hammer.force"));
    EXPECT_TRUE(with.system->force_depends_on_velocity());
    EXPECT_FALSE(solid(true, {gas_in_the_hole(true)}).system->force_depends_on_velocity());
    std::vector<double> weights(layout.n_internal);
    with.system->internal_weights(weights);
    EXPECT_EQ(weights.back(), 1);
}

TEST(LumpedModels, Force_IsThatOfTheSolidAndThatOfTheModels) {
    const test::Solid with = solid(false, {gas_in_the_hole(false), falling_hammer()}), without = solid(false, {});
    const State state = moved(with, 0.01);
    State plain = state;
    plain.u.resize(plain.u.size() - 2);
    plain.v.resize(plain.v.size() - 2);
    std::vector<double> f(state.u.size(), 1e300), expected(plain.u.size());
    with.system->force(state, Trial::of(state), f);
    without.system->force(plain, Trial::of(plain), expected);
    expected.resize(f.size(), 0.0);
    for (std::size_t i = 0; i < 2; ++i) with.system->models()[i].add_force(Trial::of(state), expected);
    EXPECT_EQ(f, expected);
    // what comes from outside is in no model
    with.system->external_force(Trial::of(state), f);
    EXPECT_THAT(f, testing::Each(0.0));
}

class TangentWithModels : public testing::TestWithParam<bool> {};

TEST_P(TangentWithModels, FromTheAcceptedState_IsTheDerivativeOfTheForce) {
    for (const bool given : {false, true}) {
        const test::Solid with = solid(GetParam(), {gas_in_the_hole(true), falling_hammer()});
        const State accepted = moved(with, 0.01);
        State at = moved(with, 0.02);
        at.t = 1e-4;
        const auto trial = [&] {
            Trial now = Trial::of(at);
            if (given) now.z = at.z;
            return now;
        };
        const Tangent& tangent = *with.system->tangent();
        EXPECT_TRUE(tangent.symmetric());
        for (const bool by_velocity : {false, true}) {
            const auto n = static_cast<Eigen::Index>(at.u.size());
            Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(n, n);
            std::vector<double>& x = by_velocity ? at.v : at.u;
            const double size = by_velocity ? 1 : 1e-5;
            Eigen::VectorXd f(n);
            for (Eigen::Index j = 0; j < n; ++j) {
                const double before = x[static_cast<std::size_t>(j)];
                for (const auto& [step, weight] : {std::pair(-2, 1.0), {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
                    x[static_cast<std::size_t>(j)] = before + step * size;
                    with.system->force(accepted, trial(), {f.data(), at.u.size()});
                    expected.col(j) -= weight / (12 * size) * f;
                }
                x[static_cast<std::size_t>(j)] = before;
            }
            const Tangent::Factors factors{.stiffness = by_velocity ? 0.0 : 1.0, .velocity = by_velocity ? 1.0 : 0.0};
            const Eigen::MatrixXd matrix = test::dense(tangent, accepted, trial(), factors);
            // as in solid_tangent_test.cpp
            EXPECT_LE((matrix - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
            std::vector<double> diagonal(at.u.size());
            tangent.assemble_diagonal(accepted, trial(), factors, diagonal);
            for (Eigen::Index i = 0; i < n; ++i)
                EXPECT_NEAR(diagonal[static_cast<std::size_t>(i)], matrix(i, i), 1e-14 * matrix.cwiseAbs().maxCoeff());
        }
        EXPECT_EQ(tangent.beside(accepted, trial(), {.stiffness = 1}).dyads.size(), 1u) << "the gas alone";
    }
}

INSTANTIATE_TEST_SUITE_P(Elements, TangentWithModels, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "Compt" : "Cst"; });

TEST(LumpedModels, FrequencyBound_IsAboveTheLargestFrequency) {
    // so stiff, and so heavy, that one of them rules
    LumpedOptions pressed = gas_in_the_hole(false);
    pressed.pressure = 1e11;
    LumpedOptions stiff = falling_hammer();
    stiff.stiffness = 1e13;
    for (const LumpedOptions& options : {pressed, stiff}) {
        const test::Solid with = solid(true, {options}), without = solid(true, {});
        State state = with.system->initial_state();
        if (options.kind == LumpedOptions::Kind::mass) state.u[state.u.size() - 2] = 1e-3;  // in touch
        const double bound = with.system->frequency_bound(state).omega;
        EXPECT_GE(bound, test::dense_frequencies(*with.system, state).maxCoeff());
        EXPECT_GT(bound, without.system->frequency_bound(without.system->initial_state()).omega);
    }
}

TEST(LumpedModels, OneAndTwoThreads_SameBits) {
    const test::Solid with = solid(true, {gas_in_the_hole(true), falling_hammer()});
    const State state = moved(with, 0.01);
    std::vector<double> one(state.u.size()), two(one.size());
    with.system->force(state, Trial::of(state), one);
    omp_set_num_threads(2);
    with.system->force(state, Trial::of(state), two);
    omp_set_num_threads(1);
    EXPECT_EQ(one, two);
}

TEST(MakeLumped, EveryProblem_IsReportedWithItsPlace) {
    LumpedOptions nowhere = gas_in_the_hole(false), outside = gas_in_the_hole(false);
    nowhere.on = "hle";
    outside.on = "outer";
    try {
        make_lumped(test::plate_with_hole(false), {gas_in_the_hole(false), nowhere, outside}, 1);
        FAIL();
    } catch (const InputError& error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[0].where, "[[lumped]] 2");
        EXPECT_THAT(error.problems()[0].message, HasSubstr("did you mean \"hole\"?"));
        EXPECT_EQ(error.problems()[1].where, "[[lumped]] 3");
        EXPECT_THAT(error.problems()[1].message, HasSubstr("the solid lies inside of it"));
    }
}

}  // namespace
}  // namespace gneiss
