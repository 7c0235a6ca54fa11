// VERIFICATION 11 to 13: the decks of studies/fracture on contact, and what must be kept in it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <span>

#include "app/build_case.hpp"
#include "io/deck/deck.hpp"
#include "support/eps.hpp"
#include "support/one_thread.hpp"
#include "support/touching_solids.hpp"
#include "verification/run_solid.hpp"

namespace gneiss {
namespace {

using test::eps;

constexpr double gravity = 9.81;

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

TEST(Incline, FlatterThanFriction_SticksOnceTheStartHasDiedOut) {
    // with a fifth of E over the first frequency as viscosity; with a third of that the block rattles on (decision 029)
    Case built = case_of("incline.toml", {"load.0.value=[\"9.81*2000*sin(20*pi/180)\", \"-9.81*2000*cos(20*pi/180)\"]",
                                          "material.0.viscosity={shear=900.0, bulk=900.0}"});
    const SolidSystem& system = *built.system;
    const Body block(*built.mesh, system, "block");
    std::vector<double> before;
    const double t_end = 0.2;
    const test::SolidRun run = test::run_solid(system, t_end, *built.integrator, [&](const State& state) {
        if (before.empty() && state.t > 0.75 * t_end) before = state.u;
    });
    const double drift = block.mean(system, run.state.u, 0) - block.mean(system, before, 0);
    EXPECT_LT(std::abs(drift) / (0.25 * t_end), 1e-6);  // m/s; at 35 degrees it would be at 0.3 m/s by now
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

/// A block of 1 m that falls, or is thrown, onto a wall, and shakes as it comes back.
constexpr const char* thrown_block = R"(
mesh = { generator = "rectangle", width = 1.0, height = 1.0, origin = [-0.5, 0.01], cells = [4, 4] }
solid = { plane = "strain" }
material = [{ density = 1000.0, constants = { E = 1e8, nu = 0.2 } }]
initial = [{ velocity = [0.0, -1.0] }]
load = [{ type = "body_force", value = [0.0, -9810.0] }]
contact = { method = "potential" }
wall = [{ point = [0.0, 0.0], normal = [0.0, 1.0] }]
run = { t_end = 1.0 }
)";

TEST(ThrownBlock, AnyBodySkinSpeedAndStep_NoExplicitRunIsLost) {
    // the largest motion since pairs were searched stands still and starts anew as a body shakes: nothing can be told
    // from it about the next step
    const std::array<std::string, 6> schemes{R"(type = "central_difference")",
                                             R"(type = "verlet")",
                                             R"(type = "verlet", form = "position")",
                                             R"(type = "verlet", composition = "mclachlan_5")",
                                             R"(type = "noh_bathe")",
                                             R"(type = "mri")"};
    std::mt19937 random(14);
    const auto between = [&](double low, double high) {  // evenly in the logarithm
        return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random));
    };
    for (int i = 0; i < 24; ++i) {
        const std::string& scheme = schemes[static_cast<std::size_t>(i) % schemes.size()];
        const double modulus = between(1e6, 1e10), c = std::sqrt(modulus / 1000), safety = between(0.1, 0.9);
        const double speed = between(1e-3, 0.05) * c, skin = between(0.01, 1), t_end = 0.01 / speed + 20 / c;
        const std::string step = scheme.find("mri") == std::string::npos ? fmt::format("safety = {}", safety)
                                                                         : fmt::format("dt = {}", 0.05 / c);
        const std::vector<std::string> set{fmt::format("material.0.constants.E={}", modulus),
                                           fmt::format("initial.0.velocity=[{}, {}]", 0.3 * speed, -speed),
                                           fmt::format("load.0.value=[0, {}]", -200 * speed * speed),
                                           fmt::format("contact.skin={}", skin),
                                           fmt::format("contact.friction={}", i % 2 == 0 || i % 6 == 3 ? 0.0 : 0.4),
                                           fmt::format("solid.element=\"{}\"", i % 4 < 2 ? "cst" : "compt"),
                                           fmt::format("run.t_end={}", t_end),
                                           fmt::format("integrator={{ {}, {} }}", scheme, step)};
        Case built = build_case(parse_deck(thrown_block, "thrown_block", set));
        SCOPED_TRACE(fmt::format("{}", fmt::join(set, " ")));
        try {
            const test::SolidRun run = test::run_solid(*built.system, t_end, *built.integrator);
            EXPECT_LT(run.ledger.balance_error(), 0.05);
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

/// A block under stress in situ whose sides nothing pulls at.
constexpr const char* stressed_block = R"(
mesh = { generator = "rectangle", width = 1.0, height = 1.0, cells = [4, 4] }
solid = { plane = "strain" }
run = { t_end = 1e-3 }
[[material]]
form = "hypo"
density = 2700.0
constants = { E = 30e9, nu = 0.3 }
in_situ_stress = [-30e6, -5e6, 1e6]
strength = { tensile = 1e6, cohesion = 20e6, friction = 0.8, residual_friction = 0.8, G_I = 200.0, G_II = 4000.0 }
)";
constexpr const char* held = R"(
[[boundary]]
on = "outer"
type = "fixed"
)";
constexpr const char* walled = R"(
contact = { method = "potential", friction = 0.5 }
wall = [{ point = [0.0, 0.0], normal = [0.0, 1.0] }, { point = [1.0, 0.0], normal = [-1.0, 0.0] },
        { point = [0.0, 1.0], normal = [0.0, -1.0] }, { point = [0.0, 0.0], normal = [1.0, 0.0] }]
)";

TEST(StressInSitu, InEquilibrium_NothingMoves_WithJointsAndWallsAsWithoutThem) {
    for (const std::string element : {"cst", "compt"})
        for (const std::string method : {"none", "intrinsic", "y_code"})
            for (const bool walls : {false, true}) {
                const std::string deck =
                    walls ? std::string(walled) + stressed_block : std::string(stressed_block) + held;
                Case built =
                    build_case(parse_deck(deck, "stressed_block",
                                          {"fracture.method=\"" + method + "\"", "solid.element=\"" + element + "\""}));
                SCOPED_TRACE(element + " " + method + (walls ? " walls" : ""));
                const test::SolidRun run = test::run_solid(*built.system, 1e-3, *built.integrator);
                double largest = 0;
                for (const double u : run.state.u) largest = std::max(largest, std::abs(u));
                // a block that were let go would move by 1e-3 m; round-off of some forces is shaken for 500 steps
                EXPECT_LT(largest, 1e-15);
                EXPECT_NEAR(run.ledger.path.friction, 0, 1e-9);  // springs at walls hold 1e3 J
                EXPECT_EQ(run.ledger.path.fracture, 0);
                EXPECT_LT(run.ledger.kinetic, 1e-20);
            }
}

/// Two blocks, the upper one of which turns about the left end of their seam.
constexpr const char* book = R"(
mesh = { generator = "rectangle", width = 0.01, height = 0.02, origin = [0.0, -0.01], cells = [1, 2], lines = [{ name = "seam", from = [0.0, 0.0], to = [0.01, 0.0] }] }
solid = { plane = "stress" }
contact = { method = "potential", friction = 0.0 }
run = { t_end = 1e-2 }
[[material]]
density = 2500.0
constants = { E = 30e9, nu = 0.0 }
strength = { tensile = 1e9, cohesion = 5e9, friction = 0.6, residual_friction = 0.6, G_I = 1e6, G_II = 3e6 }
[[interface]]
on = "seam"
strength = { tensile = 3e6, cohesion = 15e6, friction = 0.6, residual_friction = 0.6, G_I = 10.0, G_II = 30.0 }
)";

/// The state that follows when the upper block stands at an angle, and what cracks make of it.
State opened_by(const Case& built, const State& before, double angle) {
    const Mesh& mesh = *built.mesh;
    State state = before;
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        const std::span nodes(mesh.element(e), static_cast<std::size_t>(mesh.nodes_per_element()));
        if (std::ranges::none_of(nodes, [&](std::int32_t k) { return mesh.nodes[static_cast<std::size_t>(k)][1] > 0; }))
            continue;  // of the lower block
        for (const std::int32_t k : nodes) {
            const auto node = static_cast<std::size_t>(k);
            const auto [x, y] = mesh.nodes[node];
            state.u[2 * node] = x * (std::cos(angle) - 1) - y * std::sin(angle);
            state.u[2 * node + 1] = x * std::sin(angle) + y * (std::cos(angle) - 1);
        }
    }
    std::vector<double> f(state.u.size());
    built.system->force_and_update(before, Trial::of(state), f, state.z, state.history);
    built.cracking->look(state);
    return state;
}

TEST(Book, OpenedPastAHalfTurnAboutASideThatHoldsItsHinge_TouchesThereFirst_FromZero) {
    for (const std::string element : {"cst", "compt"})
        for (const std::string method : {"intrinsic", "y_code"}) {
            SCOPED_TRACE(element + " " + method);
            const Case built = build_case(
                parse_deck(book, "book", {"fracture.method=\"" + method + "\"", "solid.element=\"" + element + "\""}));
            const double degree = std::numbers::pi / 180;
            State state = built.system->initial_state();
            for (int angle = 1; angle < 180; ++angle) {
                state = opened_by(built, state, angle * degree);
                // the hinge touches, to round-off of positions: 1e-17 m
                ASSERT_LT(built.system->stored_energies(state).contact, 1e-15) << angle << " degrees";
            }
            // the left faces meet at 180 degrees; then they overlap in proportion to the angle
            const double one = built.system->stored_energies(opened_by(built, state, 181 * degree)).contact,
                         two = built.system->stored_energies(opened_by(built, state, 182 * degree)).contact;
            EXPECT_GT(one, 10);                   // J; at 3.3 degrees the deck stores 1e3 J here and in the blocks
            EXPECT_NEAR(two / one, 4, 4 * 0.01);  // sines, and the ends of faces that leave their first triangle
        }
}

}  // namespace
}  // namespace gneiss
