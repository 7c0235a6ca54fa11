// Bodies against rigid walls.

#include "contact/walls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "support/one_thread.hpp"
#include "support/touching_solids.hpp"
#include "system/march.hpp"
#include "verification/run_solid.hpp"

namespace gneiss {
namespace {

test::Solid walled(const ContactOptions& contact, const std::vector<WallOptions>& walls,
                   const test::SolidDescription& what = {}) {
    Mesh mesh = test::rectangle(true, 1, 0.5, {3, 2});
    test::distort(mesh, 0.12, 0.2, 5);
    const Mesh copy = mesh;
    return test::make_solid(std::move(mesh), what, [&](SolidSystem::Parts& parts) {
        auto bodies = make_contact({copy}, parts.blocks, what.solid, contact, false);
        auto made = make_walls(*bodies, walls, contact.friction);
        parts.interactions.push_back(std::move(bodies));
        parts.interactions.push_back(std::move(made));
    });
}

std::vector<WallOptions> corner(std::array<double, 2> velocity = {0, 0}) {
    return {{.point = {0.2, 0}, .normal = {0, 2}, .velocity = velocity, .friction = {}},
            {.point = {-1e-9, 0.2}, .normal = {1, 0}, .velocity = {0, 0}, .friction = 0.3}};
}

TEST(Walls, Tangent_IsTheDerivativeOfTheForceWithHistory) {
    for (const double friction : {0.0, 0.4}) {
        ContactOptions contact;
        contact.friction = friction;
        contact.restitution = friction > 0 ? 0.8 : 1;
        const test::Solid solid = walled(contact, corner({0.1, 0.2}));
        State state = solid.system->initial_state();
        state.t = 0.01;
        for (std::size_t i = 0; i < state.u.size(); ++i) state.u[i] = -4e-3 + 1e-3 * std::sin(7.0 * i);
        apply_due_events(*solid.system, state);
        if (friction > 0) {
            std::vector<double> f(state.u.size()), z(state.z.size()), history(state.history.size());
            solid.system->force_and_update(state, Trial::of(state), f, z, history);
            state.history = history;
            for (std::size_t i = 0; i < state.u.size(); ++i) state.u[i] += 3e-4 * std::cos(5.0 * i);
        }
        const Eigen::MatrixXd expected = test::dense_stiffness(*solid.system, state);
        const Eigen::MatrixXd matrix = test::dense(*solid.system->tangent(), state, Trial::of(state), {.stiffness = 1});
        EXPECT_LE((matrix - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff());
        const double bound = solid.system->frequency_bound(state).omega;
        EXPECT_GE(bound, test::dense_frequencies(*solid.system, state).maxCoeff());
    }
}

TEST(Walls, ThrownIntoACorner_EnergyBalances_AndLeavesItAgain) {
    for (const double e : {1.0, 0.6}) {
        ContactOptions contact;
        contact.friction = 0.4;
        contact.restitution = e;
        test::SolidDescription what;
        what.initial = {{"", {Formula(-1.0), Formula(-2.0)}}};
        const test::Solid solid = walled(contact, corner(), what);
        const test::SolidRun run = test::run_solid(*solid.system, 5e-3);
        EXPECT_LT(run.ledger.balance_error(), 5e-3) << e;
        EXPECT_GT(run.ledger.path.friction, 0);
        EXPECT_EQ(run.ledger.path.support_work, 0);
        EXPECT_EQ(run.ledger.path.contact > 0.1 * run.ledger.initial, e < 1);
    }
}

TEST(Walls, MovingWall_DoesTheWorkThatTheBodyGains) {
    ContactOptions contact;
    contact.friction = 0.4;
    const test::Solid solid = walled(contact, corner({0.5, 1.0}));
    const test::SolidRun run = test::run_solid(*solid.system, 5e-3);
    EXPECT_GT(run.ledger.path.support_work, 0.1 * run.ledger.kinetic);
    EXPECT_LT(run.ledger.balance_error(), 5e-3);
}

TEST(Walls, WallIsAMirror) {
    // against a wall as against the mirror image, up to what is lost where points change triangles
    test::SolidDescription what;
    what.initial = {{"", {Formula("x < 1.0000000005 ? 1 : -1"), Formula(0.0)}}};
    ContactOptions contact;
    contact.skin = 0.1;
    Mesh left = test::rectangle(true, 1, 0.5, {4, 2}, MeshOptions::Pattern::crossed);
    const test::Solid pair =
        test::touching_solid(test::together(Mesh(left), test::moved(Mesh(left), 1 + 1e-9, 0)), contact, what);
    const Mesh copy = left;
    const test::Solid single = test::make_solid(std::move(left), what, [&](SolidSystem::Parts& parts) {
        auto bodies = make_contact({copy}, parts.blocks, what.solid, contact, false);
        auto made =
            make_walls(*bodies, {{.point = {1 + 0.5e-9, 0}, .normal = {-1, 0}, .velocity = {0, 0}, .friction = {}}}, 0);
        parts.interactions.push_back(std::move(bodies));
        parts.interactions.push_back(std::move(made));
    });
    const CentralDifference::Options fixed{.dt = 2e-5};
    const State one = test::run_solid(*single.system, 2e-3, fixed).state,
                two = test::run_solid(*pair.system, 2e-3, fixed).state;
    // of the whole: at the corners of the mirror image the potential gives way, a wall does not
    double mass = 0, speed = 0, mirrored = 0;
    for (std::size_t i = 0; i < one.v.size(); i += 2) {
        const double m = single.system->lumped_mass()[i];
        mass += m;
        speed += m * one.v[i];
        mirrored += m * two.v[i];
    }
    EXPECT_LT(speed / mass, -0.5);
    EXPECT_NEAR(speed / mass, mirrored / mass, 0.03);
}

TEST(Walls, BodyInsideAWall_IsBadInput) {
    try {
        walled({}, {{.point = {0, 0.01}, .normal = {0, 1}, .velocity = {0, 0}, .friction = {}}});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("a body reaches 0.01 m into the wall at the start"));
    }
}

}  // namespace
}  // namespace gneiss
