// Elements in levels: which level they have, and that levels together are the whole.

#include "model/element_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

constexpr int many = 6;

/// Columns that grow from 0.05 to 0.8 m.
test::Solid graded_solid(bool compt, Form form = Form::hyper) {
    test::SolidDescription what;
    what.materials[0].form = form;
    return test::make_solid(test::graded(compt, {24, 12}, 0.05, 1.128, 9.6), what);
}

TEST(ElementLevels, GradedMesh_HasAllItsElementsInNestedLevels) {
    for (const bool compt : {false, true}) {
        const test::Solid solid = graded_solid(compt);
        const auto levels = solid.system->levels(many);
        ASSERT_NE(levels, nullptr);
        EXPECT_GE(levels->finest(), 2);
        std::size_t n_elements = 0;
        for (int k = 0; k <= levels->finest(); ++k) {
            EXPECT_GT(levels->n_elements(k), 0u) << k;
            n_elements += levels->n_elements(k);
        }
        EXPECT_EQ(n_elements, solid.mesh.n_elements());
        for (int k = 2; k <= levels->finest(); ++k)
            EXPECT_TRUE(std::ranges::includes(levels->nodes(k - 1), levels->nodes(k))) << k;
        // no more levels than asked for
        const auto two = solid.system->levels(2);
        EXPECT_TRUE(two == nullptr || two->finest() == 1);
        EXPECT_EQ(solid.system->levels(1), nullptr);
    }
}

TEST(ElementLevels, NarrowColumnBetweenWideOnes_HasLevelsAroundIt) {
    // packs hold eight neighbours: long columns, so that there are enough of them
    Mesh mesh = test::rectangle(false, 12, 40, {12, 40});
    for (auto& node : mesh.nodes)  // the sixth column: an eighth as wide
        node[0] = node[0] < 5 ? node[0] : node[0] < 6 ? 5 + (node[0] - 5) / 8 : node[0] - 1 + 0.125;
    const test::Solid solid = test::make_solid(std::move(mesh), {});
    const auto levels = solid.system->levels(many);
    ASSERT_NE(levels, nullptr);
    ASSERT_GE(levels->finest(), 2);
    for (int k = 0; k <= levels->finest(); ++k) EXPECT_GT(levels->n_elements(k), 0u) << k;
}

TEST(ElementLevels, ForcesOfAllLevels_AreThoseOfTheWhole) {
    for (const bool compt : {false, true}) {
        for (const Form form : {Form::hyper, Form::hypo}) {
            const test::Solid solid = graded_solid(compt, form);
            const auto levels = solid.system->levels(many);
            State state = solid.system->initial_state();
            // where level 0 is far away: finite strains, up to 20 %
            double largest = 0;
            for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
                const auto [x, y] = solid.mesh.nodes[node];
                const double bump = 0.02 * std::pow(std::max(0.0, 1 - x / 0.34), 2);
                state.u[2 * node] = bump * std::sin(3 * y);
                state.u[2 * node + 1] = bump * std::cos(2 * y);
            }
            std::vector<double> whole(state.u.size()), sum(state.u.size(), 0.0);
            solid.system->force(solid.system->initial_state(), Trial::of(state), whole);
            for (int k = 1; k <= levels->finest(); ++k) {
                const auto nodes = levels->nodes(k);
                std::vector<double> u, f(2 * nodes.size(), 1e300);
                for (const std::int32_t node : nodes)
                    for (std::size_t c = 0; c < 2; ++c) u.push_back(state.u[2 * static_cast<std::size_t>(node) + c]);
                levels->force(k, solid.system->initial_state(), Trial::of(state), u, f);
                for (std::size_t i = 0; i < f.size(); ++i)
                    sum[2 * static_cast<std::size_t>(nodes[i / 2]) + i % 2] += f[i];
            }
            for (const double f : whole) largest = std::max(largest, std::abs(f));
            ASSERT_GT(largest, 0);
            constexpr double round_off = 1e-14;  // of sums of a dozen elements at a node
            for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(sum[i], whole[i], round_off * largest) << i;
        }
    }
}

TEST(ElementLevels, Bound_IsThatOfTheFinestLevelsSteps) {
    const test::Solid solid = graded_solid(false);
    const auto levels = solid.system->levels(many);
    const State state = solid.system->initial_state();
    const double whole = solid.system->frequency_bound(state).omega;
    EXPECT_NEAR(levels->bound(state).omega, std::ldexp(whole, -levels->finest()), 1e-9 * whole);
}

TEST(ElementLevels, InvertedElement_IsNamed) {
    const test::Solid solid = graded_solid(true);
    const auto levels = solid.system->levels(many);
    const State state = solid.system->initial_state();
    const int finest = levels->finest();
    std::vector<double> u(2 * levels->nodes(finest).size(), 0.0), f(u.size());
    u[0] = 10;
    u[1] = -10;
    try {
        levels->force(finest, state, Trial::of(state), u, f);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_NE(std::string(error.what()).find("is inverted in a local step at t = 0 s"), std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace gneiss
