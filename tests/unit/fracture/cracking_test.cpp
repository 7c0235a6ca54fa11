// Sides that open where they reach their strength: what an event keeps, and what it leaves.

#include "fracture/cracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fracture/envelope.hpp"
#include "support/cracking_solid.hpp"

namespace gneiss {
namespace {

constexpr double tensile = 3e6;

test::SolidDescription rock_that_cracks() {
    test::SolidDescription what;
    what.materials[0].strength =
        StrengthOptions{{tensile, tensile}, {8e6, 8e6}, {0.6, 0.6}, {0.4, 0.4}, {300, 300}, {900, 900}};
    return what;
}

/// Displacements of a body stretched along x, every node somewhat off.
std::vector<double> stretched(const Mesh& mesh, double strain, double off, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-off, off);
    std::vector<double> u;
    for (const auto& node : mesh.nodes) {
        u.push_back(strain * node[0] + uniform(random));
        u.push_back(uniform(random));
    }
    return u;
}

class Cracks : public testing::TestWithParam<bool> {
protected:
    static Mesh mesh() {
        Mesh mesh = test::rectangle(GetParam(), 2, 1, {4, 2});
        test::distort(mesh, 0.25, 0.2, 3);
        return mesh;
    }
    test::CrackingSolid solid = test::cracking_solid(mesh(), rock_that_cracks());
    SolidSystem& system = *solid.system;

    std::vector<double> acceleration(const State& state) const {
        std::vector<double> a(state.u.size());
        system.force(state, Trial::of(state), a);
        for (std::size_t i = 0; i < a.size(); ++i) a[i] /= system.lumped_mass()[i];
        return a;
    }
    /// The mean stress of 0.8 to 1.6 times the strength: some sides are beyond, others not.
    State partly_beyond() {
        State state = solid.at(stretched(*solid.mesh, 3.2e-3, 2e-5, 7));
        std::mt19937 random(11);
        std::normal_distribution<double> normal;
        for (double& v : state.v) v = normal(random);
        return state;
    }
};

INSTANTIATE_TEST_SUITE_P(Elements, Cracks, testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(Cracks, BelowTheStrength_NothingHappens) {
    State state = solid.at(stretched(*solid.mesh, 1e-4, 1e-6, 7));
    const State before = state;
    EXPECT_EQ(solid.cracking->look(state), EventOutcome::none);
    EXPECT_EQ(state, before);
}

TEST_P(Cracks, Opening_KeepsMassVelocityAndAcceleration) {
    State state = partly_beyond();
    const std::size_t n_before = solid.mesh->n_nodes();
    const std::vector<double> a_before = acceleration(state), v_before = state.v;
    const std::vector<double> mass_before(system.lumped_mass().begin(), system.lumped_mass().end());
    ASSERT_EQ(solid.cracking->look(state), EventOutcome::resize);
    const std::size_t n = solid.mesh->n_nodes();
    ASSERT_GT(n, n_before);
    ASSERT_EQ(state.u.size(), 2 * n);
    ASSERT_EQ(state.history.size(), system.layout().n_history);

    const std::vector<double> a = acceleration(state);
    double largest = 0;
    for (const double value : a_before) largest = std::max(largest, std::abs(value));
    const double round_off = 1e-11 * largest;  // forces of a hundred times the mean go into the sums
    std::vector<double> mass(mass_before.size(), 0.0);
    for (std::size_t node = 0; node < n; ++node) {
        // a copy stands where its original does
        std::size_t original = 0;
        while (solid.mesh->nodes[original] != solid.mesh->nodes[node]) ++original;
        ASSERT_LT(original, n_before);
        for (std::size_t c = 0; c < 2; ++c) {
            EXPECT_EQ(state.v[2 * node + c], v_before[2 * original + c]);
            EXPECT_NEAR(a[2 * node + c], a_before[2 * original + c], round_off) << node;
            mass[2 * original + c] += system.lumped_mass()[2 * node + c];
        }
    }
    for (std::size_t i = 0; i < mass.size(); ++i) EXPECT_NEAR(mass[i], mass_before[i], 1e-14 * mass_before[i]);
}

TEST_P(Cracks, Opening_BooksTheEnergyOfItsSprings) {
    State state = partly_beyond();
    const StoredEnergies before = system.stored_energies(state);
    ASSERT_EQ(solid.cracking->look(state), EventOutcome::resize);
    const StoredEnergies after = system.stored_energies(state);
    EXPECT_GT(after.joints, 0);
    EXPECT_NEAR(after.joints - before.joints, state.path.splitting, 1e-13 * after.joints);
    EXPECT_NEAR(after.material, before.material, 1e-13 * before.material);
}

TEST_P(Cracks, Replay_ComesToTheSameMesh) {
    State state = partly_beyond();
    solid.cracking->look(state);
    for (double& u : state.u) u *= 1.5;
    std::vector<double> f(state.u.size());
    State next = state;
    system.force_and_update(state, Trial::of(state), f, next.z, next.history);
    solid.cracking->look(next);
    test::CrackingSolid other = test::cracking_solid(mesh(), rock_that_cracks());
    other.cracking->replay(solid.cracking->save());
    EXPECT_EQ(other.cracking->overshoot(next).largest, solid.cracking->overshoot(next).largest);
    EXPECT_EQ(other.cracking->first_opening(), solid.cracking->first_opening());
    EXPECT_TRUE(other.cracking->first_opening());
    EXPECT_EQ(other.mesh->connectivity, solid.mesh->connectivity);
    EXPECT_EQ(other.mesh->n_nodes(), solid.mesh->n_nodes());
    ASSERT_EQ(other.system->layout().n_history, next.history.size());
    const auto own = system.lumped_mass(), others = other.system->lumped_mass();
    EXPECT_TRUE(std::ranges::equal(own, others));
    std::vector<double> force(next.u.size()), same(next.u.size());
    system.force(next, Trial::of(next), force);
    other.system->force(next, Trial::of(next), same);
    EXPECT_EQ(force, same);
    EXPECT_THROW(other.cracking->replay({0, -1, 1, 1e6}), InputError);
    EXPECT_THROW(other.cracking->replay({0}), InputError);
}

TEST(StrengthWatch, Index_IsNeverBelowTheEnvelopeOfAnyDirection) {
    const CohesionProperties<double> p{2e6, 5e6, 0.7, 0.4, 1, 1, 1};
    StrengthWatch watch;
    watch.per_tensile_strength = 1 / p.tensile_strength;
    watch.per_cohesion = 1 / p.cohesion;
    watch.tan_phi = p.tan_phi_initial;
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 5e6);
    constexpr double round_off = 1e-12;
    int close = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Symmetric2<double> stress{normal(random), normal(random), normal(random)};
        const double bound = watch.index(stress);
        double largest = 0;
        for (int k = 0; k < 360; ++k) {
            const double angle = std::numbers::pi * k / 360, c = std::cos(angle), s = std::sin(angle);
            const double sigma = c * c * stress.xx + s * s * stress.yy + 2 * s * c * stress.xy;
            const double tau = s * c * (stress.yy - stress.xx) + (c * c - s * s) * stress.xy;
            largest = std::max(largest, envelope_index(p, sigma, tau));
        }
        EXPECT_LE(largest, bound * (1 + round_off));
        close += largest > 0.5 * bound ? 1 : 0;
    }
    EXPECT_GT(close, 50);  // a bound that nothing comes near would be of no use
}

}  // namespace
}  // namespace gneiss
