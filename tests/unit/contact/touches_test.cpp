// When bodies meet and part.

#include "contact/touches.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "support/one_thread.hpp"
#include "support/touching_solids.hpp"
#include "verification/run_solid.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;

/// A square of 1 m above another one, which stands on a wall; the upper one comes down with 2 m/s.
struct Falling {
    static constexpr double gap = 3e-4, wall_gap = 1e-4, speed = 2;
    Mesh mesh = test::together(test::rectangle(false, 1, 1, {2, 2}),
                               test::moved(test::rectangle(false, 1, 1, {3, 3}), 0.1, 1 + gap));
    const Contact* contact = nullptr;
    Touches* touches = nullptr;
    test::Solid solid;

    Falling() {
        test::SolidDescription what;
        what.initial = {{"solid2", {Formula(0.0), Formula(-speed)}}};
        const Mesh copy = mesh;
        const Walls* walls = nullptr;
        ContactOptions options;
        options.skin = 0.02;
        solid = test::make_solid(mesh, what, [&](SolidSystem::Parts& parts) {
            auto bodies = make_contact({copy}, parts.blocks, what.solid, options, false);
            contact = bodies.get();
            auto made = make_walls(
                *bodies, {{.point = {0, -wall_gap}, .normal = {0, 1}, .velocity = {0, 0}, .friction = {}}}, 0);
            walls = made.get();
            parts.interactions.push_back(std::move(bodies));
            parts.interactions.push_back(std::move(made));
        });
        auto event = std::make_unique<Touches>(*contact, walls);
        touches = event.get();
        solid.system->add_event(std::move(event));
    }
    /// The upper square as low as this, the lower one as it stands.
    State lowered(double way) const {
        State state = solid.system->initial_state();
        for (std::size_t node = 0; node < mesh.n_nodes(); ++node)
            if (mesh.nodes[node][1] > 1 + 0.5 * gap) state.u[2 * node + 1] = -way;
        apply_due_events(*solid.system, state);
        return state;
    }
};

TEST(Touches, Gaps_AreDistancesOutsideAndDepthsInside) {
    const Falling falling;
    for (const double way : {0.0, 1e-4, 2.9e-4, 3.5e-4, 1e-3}) {
        const State state = falling.lowered(way);
        const Gaps gaps = falling.contact->gaps(state.u);
        ASSERT_EQ(gaps.size(), 1U);
        EXPECT_EQ(gaps.begin()->first, Touching(0, 1));
        // positions of about 2 m; inside it is the potential, a distance in the reference shape of straight edges
        EXPECT_NEAR(gaps.begin()->second, Falling::gap - way, 1e-15) << way;
    }
}

TEST(Touches, Indicator_RisesToZeroWhereTheyMeet_AndWhereTheyPart) {
    Falling falling;
    const auto at = [&](double way) { return falling.touches->indicator(falling.lowered(way)); };
    EXPECT_LT(at(2.9e-4), 0);
    EXPECT_GT(at(2.9e-4), at(1e-4));
    State together = falling.lowered(4e-4);
    EXPECT_THAT(falling.touches->touching(), ElementsAre(Touching(0, 1)));
    EXPECT_LT(falling.touches->indicator(together), 0);
    State apart = together;
    for (std::size_t i = 0; i < apart.u.size(); ++i) apart.u[i] *= 0.5;
    EXPECT_GT(falling.touches->indicator(apart), 0);
    EXPECT_EQ(falling.touches->look(apart), EventOutcome::reinitialise);
    EXPECT_EQ(falling.touches->look(apart), EventOutcome::none);
    EXPECT_TRUE(falling.touches->touching().empty());
    // three times down and up again
    EXPECT_EQ(falling.touches->record().n_touched, 1U);
    EXPECT_EQ(falling.touches->record().n_parted, 1U);
}

TEST(Touches, FreeFlight_MeetsWhenGapOverSpeedHasPassed) {
    Falling falling;
    State state = falling.solid.system->initial_state();
    CentralDifference integrator({});
    March march;
    march.t_end = 2 * Falling::gap / Falling::speed;
    march.event_tolerance = 1e-10;
    march.run(*falling.solid.system, integrator, state, false);
    ASSERT_TRUE(falling.touches->record().first_touch);
    const double late = *falling.touches->record().first_touch - Falling::gap / Falling::speed;
    // rounding of positions of 2 m at that speed
    EXPECT_GE(late, -1e-15);
    EXPECT_LE(late, march.event_tolerance);
    // below, meanwhile, nothing has moved but by the wave of the impact, which has not come to the wall
    EXPECT_THAT(falling.touches->touching(), ElementsAre(Touching(0, 1)));
}

TEST(Touches, Wall_IsMetToo) {
    Falling falling;
    State state = falling.solid.system->initial_state();
    const auto lower = [&](double way) {
        for (std::size_t i = 1; i < state.u.size(); i += 2) state.u[i] = -way;
        apply_due_events(*falling.solid.system, state);
        return falling.touches->touching();
    };
    EXPECT_TRUE(lower(0.9 * Falling::wall_gap).empty());
    EXPECT_THAT(lower(1.1 * Falling::wall_gap), ElementsAre(Touching(-1, 0)));
}

TEST(Touches, Saved_IsTakenUp) {
    Falling falling, other;
    falling.lowered(4e-4);
    other.touches->load(falling.touches->save());
    EXPECT_EQ(other.touches->touching(), falling.touches->touching());
    EXPECT_EQ(other.touches->record().first_touch, falling.touches->record().first_touch);
    EXPECT_EQ(other.touches->record().n_touched, 1U);
    EXPECT_THROW(other.touches->load({1, 2, 3}), InputError);
}

}  // namespace
}  // namespace gneiss
