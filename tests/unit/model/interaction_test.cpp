// A solid of two halves that an interaction with a memory holds together.

#include "model/interaction.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/one_thread.hpp"
#include "support/sliders.hpp"

namespace gneiss {
namespace {

/// Displacements of some millimetres that differ from node to node; the upper half is moved along x by `shift`.
State moved(const test::Solid& solid, double shift) {
    State state = solid.system->initial_state();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-2e-3, 2e-3);
    for (double& u : state.u) u = uniform(random);
    for (std::size_t e = 0; e < solid.mesh.n_elements(); ++e) {
        double y = 0;
        for (int k = 0; k < solid.mesh.nodes_per_element(); ++k)
            y += solid.mesh.nodes[static_cast<std::size_t>(solid.mesh.element(e)[k])][1] /
                 solid.mesh.nodes_per_element();
        if (y < 0.5) continue;
        for (int k = 0; k < solid.mesh.nodes_per_element(); ++k)
            state.u[2 * static_cast<std::size_t>(solid.mesh.element(e)[k])] += shift;
    }
    return state;
}

constexpr double no_limit = 1e12, limit = 1e7;

class InteractionOf : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Elements, InteractionOf, testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(InteractionOf, Tangent_IsTheDerivativeOfTheForce_StuckAndSliding) {
    for (const double shift : {0.0, 0.1}) {
        const test::Solid solid = test::cut_solid(GetParam(), limit);
        State state = moved(solid, shift);
        const Eigen::MatrixXd expected = test::dense_stiffness(*solid.system, state);
        const Eigen::MatrixXd matrix = test::dense(*solid.system->tangent(), state, Trial::of(state), {.stiffness = 1});
        // differences of 1e-6 of an edge, see dense_stiffness()
        EXPECT_LE((matrix - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
        std::vector<double> diagonal(state.u.size());
        solid.system->tangent()->assemble_diagonal(state, Trial::of(state), {.stiffness = 1}, diagonal);
        for (std::size_t i = 0; i < diagonal.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(i);
            EXPECT_NEAR(diagonal[i], matrix(k, k), 1e-14 * matrix.cwiseAbs().maxCoeff());
        }
        EXPECT_TRUE(solid.system->tangent()->symmetric());
    }
}

TEST_P(InteractionOf, FrequencyBound_IsAboveTheHighestFrequency) {
    const test::Solid solid = test::cut_solid(GetParam(), no_limit), free = test::cut_solid(GetParam(), 0);
    const State state = solid.system->initial_state();
    const double bound = solid.system->frequency_bound(state).omega;
    const double exact = test::dense_frequencies(*solid.system, state).maxCoeff();
    EXPECT_GE(bound, exact);
    EXPECT_LE(bound, 2 * exact) << "a sum of two bounds, each of which is at most a third too high";
}

TEST_P(InteractionOf, StiffnessBound_IsAboveTheStiffness) {
    const test::Solid solid = test::cut_solid(GetParam(), no_limit);
    const State state = solid.system->initial_state();
    std::vector<double> bound(state.u.size(), 0.0);
    solid.system->stiffness_bound(state, Trial::of(state), bound);
    const auto n = static_cast<Eigen::Index>(bound.size());
    const Eigen::VectorXd scale = Eigen::Map<const Eigen::VectorXd>(bound.data(), n).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd stiffness = test::dense(*solid.system->tangent(), state, Trial::of(state), {.stiffness = 1});
    const Eigen::MatrixXd scaled = scale.asDiagonal() * stiffness * scale.asDiagonal();
    EXPECT_LE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues().maxCoeff(), 1 + 1e-12);
}

TEST_P(InteractionOf, History_MovesWhenATrialIsAcceptedAndNotBefore) {
    const test::Solid solid = test::cut_solid(GetParam(), limit);
    const State rest = solid.system->initial_state();
    ASSERT_EQ(rest.history.size(), solid.system->layout().n_history);
    const State far = moved(solid, 0.1);
    std::vector<double> f(rest.u.size()), again(f), z(rest.z.size()), history(rest.history.size(), 1e300);
    solid.system->force(rest, Trial::of(far), f);
    solid.system->force_and_update(rest, Trial::of(far), again, z, history);
    EXPECT_EQ(f, again);
    State accepted = far;
    accepted.history = history;
    // the elastic part of the slip is left: the force is the same from the accepted state, and less on the way back
    solid.system->force(accepted, Trial::of(far), again);
    double largest = 0, change = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        largest = std::max(largest, std::abs(f[i]));
        change = std::max(change, std::abs(again[i] - f[i]));
    }
    EXPECT_LE(change, 1e-12 * largest);
    const State back = moved(solid, 0.09);
    std::vector<double> from_rest(f), from_far(f);
    solid.system->force(rest, Trial::of(back), from_rest);
    solid.system->force(accepted, Trial::of(back), from_far);
    EXPECT_NE(from_rest, from_far);
}

TEST_P(InteractionOf, Energies_StandInTheirColumns) {
    const test::Solid solid = test::cut_solid(GetParam(), limit);
    State from = solid.system->initial_state(), to = moved(solid, 0.1);
    std::vector<double> f(from.u.size()), z(from.z.size()), history(from.history.size());
    solid.system->force_and_update(from, Trial::of(to), f, z, history);
    to.history = history;
    solid.system->add_path_energies(from, to);
    EXPECT_GT(solid.system->stored_energies(to).joints, 0);
    EXPECT_GT(to.path.friction, 0);
    EXPECT_EQ(to.path.fracture, 0);
}

}  // namespace
}  // namespace gneiss
