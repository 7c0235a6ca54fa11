// VERIFICATION 11 to 13: the decks of studies/fracture on contact, and what must be kept in it.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "app/build_case.hpp"
#include "io/deck/deck.hpp"
#include "support/one_thread.hpp"
#include "support/touching_solids.hpp"
#include "verification/run_solid.hpp"

namespace gneiss {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon(), gravity = 9.81;

Case case_of(const std::string& deck, const std::vector<std::string>& set = {}) {
    return build_case(read_deck(std::filesystem::path(GNEISS_DECKS) / deck, set));
}

/// Nodes of a region, with their masses: the bodies share none.
struct Body {
    std::vector<std::size_t> nodes;
    double mass = 0;

    Body(const Mesh& mesh, const SolidSystem& system, const std::string& region) {
        std::vector<bool> mine(mesh.n_nodes(), false);
        for (std::size_t e = 0; e < mesh.n_elements(); ++e)
            if (mesh.region_names[static_cast<std::size_t>(mesh.region[e])] == region)
                for (int k = 0; k < mesh.nodes_per_element(); ++k)
                    mine[static_cast<std::size_t>(mesh.element(e)[k])] = true;
        for (std::size_t node = 0; node < mine.size(); ++node) {
            if (!mine[node]) continue;
            nodes.push_back(node);
            mass += system.lumped_mass()[2 * node];
        }
    }
    double mean(const SolidSystem& system, const std::vector<double>& values, std::size_t component) const {
        double sum = 0;
        for (const std::size_t node : nodes) sum += system.lumped_mass()[2 * node] * values[2 * node + component];
        return sum / mass;
    }
};

TEST(SlidingBlock, ComesToRestAfterVSquaredOverTwoMuG) {
    for (const double v : {0.5, 1.0, 2.0}) {
        Case built = case_of("sliding_block.toml", {"initial.0.velocity=[" + std::to_string(v) + ", 0]"});
        const SolidSystem& system = *built.system;
        const Body block(*built.mesh, system, "block");
        const double mu = built.options.contact.friction;
        const test::SolidRun run = test::run_solid(system, v / (mu * gravity) + 0.05, *built.integrator);
        const double way = v * v / (2 * mu * gravity);
        EXPECT_NEAR(block.mean(system, run.state.u, 0), way, 0.02 * way) << v;  // VERIFICATION 12
        RecordProperty("way_over_exact_" + std::to_string(v), std::to_string(block.mean(system, run.state.u, 0) / way));
        EXPECT_LT(std::abs(block.mean(system, run.state.v, 0)), 0.02 * v) << v;
        EXPECT_LT(run.ledger.balance_error(), 1e-3) << v;
    }
}

TEST(Incline, AcceleratesWithGSinMinusMuCos) {
    Case built = case_of("incline.toml");
    const SolidSystem& system = *built.system;
    const Body block(*built.mesh, system, "block");
    const double t = built.options.run.t_end, angle = 35 * std::numbers::pi / 180;
    const test::SolidRun run = test::run_solid(system, t, *built.integrator);
    const double a = gravity * (std::sin(angle) - built.options.contact.friction * std::cos(angle));
    EXPECT_NEAR(block.mean(system, run.state.v, 0) / t, a, 0.01 * a);  // VERIFICATION 12
    RecordProperty("a_over_exact", std::to_string(block.mean(system, run.state.v, 0) / t / a));
}

TEST(DiscPair, KeepsEnergyAndMomentum_RestitutionIsElastic) {
    Case built = case_of("disc_pair.toml");
    const SolidSystem& system = *built.system;
    const Body left(*built.mesh, system, "left"), right(*built.mesh, system, "right");
    double stored = 0;
    const test::SolidRun run =
        test::run_solid(system, built.options.run.t_end, *built.integrator,
                        [&](const State& state) { stored = std::max(stored, system.stored_energies(state).contact); });
    const double apart = right.mean(system, run.state.v, 0) - left.mean(system, run.state.v, 0);
    EXPECT_GT(stored, 0.01 * run.ledger.initial) << "they have met";
    EXPECT_LT(run.ledger.balance_error(), 1e-3);
    EXPECT_GE(apart, 0.975);
    EXPECT_LE(apart, 1.0);
    const double momentum =
        left.mass * left.mean(system, run.state.v, 0) + right.mass * right.mean(system, run.state.v, 0);
    const double initial = 0.5 * (left.mass - right.mass);
    EXPECT_NEAR(momentum, initial, 1e-12 * left.mass * 0.5);  // VERIFICATION 13
    EXPECT_EQ(system.stored_energies(run.state).contact, 0) << "they are apart again";
    RecordProperty("balance_error", std::to_string(run.ledger.balance_error()));
    RecordProperty("restitution", std::to_string(apart));
    RecordProperty("momentum_error", std::to_string((momentum - initial) / (0.5 * left.mass) / eps) + " eps");
}

/// Two blocks of 10 kg that fly at each other, flat, at 1 m/s each.
test::Solid colliding(const ContactOptions& contact, double offset = 0.013, double speed = 1) {
    Mesh one = test::rectangle(true, 0.1, 0.1, {3, 3}), two = test::rectangle(true, 0.1, 0.1, {2, 2});
    test::SolidDescription what;
    what.initial = {{"", {Formula("(x < 0.10001 ? 1 : -1)*" + std::to_string(speed)), Formula(0.0)}}};
    return test::touching_solid(test::together(std::move(one), test::moved(std::move(two), 0.1002, offset)), contact,
                                what);
}

TEST(CollidingBlocks, Balance_EnergyAndMomenta) {
    for (const double friction : {0.0, 0.4}) {
        ContactOptions contact;
        contact.friction = friction;
        const test::Solid solid = colliding(contact);
        const test::SolidRun run = test::run_solid(*solid.system, 1e-3, {.safety = 0.4});
        EXPECT_LT(run.ledger.balance_error(), 2e-3) << friction;
        double x = 0, y = 0, turn = 0, size = 0;
        const State start = solid.system->initial_state();
        for (const auto& [state, sign] : {std::pair(&run.state, 1.0), std::pair(&start, -1.0)})
            for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
                const double m = sign * solid.system->lumped_mass()[2 * node];
                const double vx = state->v[2 * node], vy = state->v[2 * node + 1];
                x += m * vx;
                y += m * vy;
                turn += m * ((solid.mesh.nodes[node][0] + state->u[2 * node]) * vy -
                             (solid.mesh.nodes[node][1] + state->u[2 * node + 1]) * vx);
                size += 0.5 * std::abs(m);
            }
        const double steps = std::sqrt(static_cast<double>(run.n_steps));
        EXPECT_NEAR(x, 0, 30 * steps * eps * size) << friction;
        EXPECT_NEAR(y, 0, 30 * steps * eps * size) << friction;
        EXPECT_NEAR(turn, 0, 30 * steps * eps * size) << friction;
    }
}

TEST(CollidingBlocks, FastOnes_AreNotMissed) {
    // a tenth of the wave speed: nodes use up the skin in a few steps
    ContactOptions contact;
    contact.friction = 0.4;
    const test::Solid solid = colliding(contact, 0.013, 50);
    const test::SolidRun run = test::run_solid(*solid.system, 5e-4);
    EXPECT_LT(run.ledger.balance_error(), 2e-2);
    double left = 0, right = 0;
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node)
        (solid.mesh.nodes[node][0] < 0.10001 ? left : right) +=
            solid.system->lumped_mass()[2 * node] * run.state.v[2 * node];
    EXPECT_LT(left, -100);  // 10 kg that came with 50 m/s
    EXPECT_GT(right, 100);
}

TEST(CollidingBlocks, Restitution_ReturnsItsSquareOfTheEnergy) {
    // so soft a contact that the blocks are rigid beside it: one mass on one spring
    for (const double e : {1.0, 0.7, 0.4}) {
        ContactOptions contact;
        contact.restitution = e;
        contact.penalty = 1e8;
        contact.potential_cap = 20;
        const test::Solid solid = colliding(contact, 0);
        const test::SolidRun run = test::run_solid(*solid.system, 12e-3);
        EXPECT_EQ(run.ledger.stored.contact, 0) << e;
        const double before = run.ledger.initial;
        EXPECT_NEAR(run.ledger.path.contact, (1 - e * e) * before, 0.02 * before) << e;
        EXPECT_LT(run.ledger.balance_error(), 2e-3) << e;
    }
}

}  // namespace
}  // namespace gneiss
