// Motion of supports: against the derivatives and integrals of closed forms.

#include "integrators/prescribed_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/oscillator_problems.hpp"

namespace gneiss {
namespace {

/// u = start + 0.2 sin 4t, given as a displacement at degree of freedom 1 and as a velocity at 2.
struct Supports {
    Supports() {
        test::OscillatorModel model = test::two_nodes();
        model.prescribed = {test::moving(1, Constraint::Kind::displacement, -0.2),
                            test::moving(2, Constraint::Kind::velocity, 0.15)};
        system = std::make_unique<test::Oscillator>(model);
        motion.bind(*system, omega);
    }
    State at(double t) const {
        State state = system->initial_state();
        state.t = t;
        state.u[1] = -0.2 + 0.2 * std::sin(4 * t);
        state.u[2] = 0.15 + 0.2 * std::sin(4 * t);
        return state;
    }
    static constexpr double omega = 8;
    std::unique_ptr<test::Oscillator> system;
    PrescribedMotion motion;
};

// (3e-3 4/8)^4 of the velocity, and round-off over the spacing
constexpr double velocity_error = 1e-11;
// one power of the spacing less, and round-off over its square
constexpr double acceleration_error = 1e-7;

TEST(PrescribedMotion, AnyInstantOfAStep_HasDisplacementVelocityAcceleration) {
    Supports supports;
    for (const double start : {0.0, 0.7}) {
        supports.motion.step_from(*supports.system, supports.at(start));
        // from the very start, where the polynomial looks ahead, to far from it, where it looks back
        for (const double dt : {0.0, 1e-6, 1e-3, 0.05, 0.2}) {
            const double t = start + dt;
            supports.motion.evaluate(*supports.system, t);
            const auto u = supports.motion.displacement(), v = supports.motion.velocity();
            EXPECT_NEAR(u[0], -0.2 + 0.2 * std::sin(4 * t), 1e-15);
            EXPECT_NEAR(u[1], 0.15 + 0.2 * std::sin(4 * t), 1e-12);  // order 10 over a sixth of a period
            EXPECT_NEAR(v[0], 0.8 * std::cos(4 * t), velocity_error);
            EXPECT_NEAR(v[1], 0.8 * std::cos(4 * t), 1e-15);
            const auto a = supports.motion.acceleration(*supports.system);
            EXPECT_NEAR(a[0], -3.2 * std::sin(4 * t), acceleration_error);
            EXPECT_NEAR(a[1], -3.2 * std::sin(4 * t), acceleration_error);
        }
    }
}

TEST(PrescribedMotion, Hold_PutsSupportsInPlace_AndBooksAJumpOfTheirVelocity) {
    Supports supports;
    State state = supports.system->initial_state();
    state.u[1] = 7;
    state.v[1] = 7;
    supports.motion.hold(*supports.system, state, StartReason::fresh);
    EXPECT_DOUBLE_EQ(state.u[1], -0.2);
    EXPECT_NEAR(state.v[1], 0.8, velocity_error);
    EXPECT_EQ(state.path.support_work, 0);
    state.v[1] = 0;
    supports.motion.hold(*supports.system, state, StartReason::reinitialise);
    EXPECT_NEAR(state.path.support_work, 0.5 * supports.system->lumped_mass()[1] * 0.64, velocity_error);
}

}  // namespace
}  // namespace gneiss
