// Observed order of central difference on damped, loaded, non-autonomous problems with internal variables.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "integrators/central_difference.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

using test::Matrix;
using test::Oscillator;
using test::OscillatorModel;
using test::PrescribedMotion;
using test::Vector;

constexpr double t_end = 2.0;
/// STYLE: |p_obs - p| < 0.15 over three halvings.
constexpr double order_tolerance = 0.15;
/// Order 4 with 8000 steps per period of the fastest mode: errors of 1e-12 against the 1e-5 that is measured.
constexpr double reference_step = 1e-4;

/// Two nodes in the plane, unequal masses, all four degrees of freedom coupled: 2.7 to 8.4 rad/s.
OscillatorModel two_nodes() {
    OscillatorModel model;
    model.mass = Vector{{2.0, 2.0, 0.7, 0.7}};
    model.stiffness = Matrix{{60, -9, -25, 4}, {-9, 50, 3, -20}, {-25, 3, 32, -5}, {4, -20, -5, 41}};
    model.initial_u = Vector{{0.1, -0.2, 0.15, 0.05}};
    model.initial_v = Vector{{0.5, 0.3, -1.0, 0.4}};
    return model;
}

Vector smooth_load(double t, bool) {
    return Vector{{10 * std::sin(3 * t), 5 * t, -4 * std::cos(5 * t), 8 * std::exp(-t)}};
}

/// sin is convenient: the motion of degree of freedom `dof` starts with a velocity.
PrescribedMotion moving(std::size_t dof, Constraint::Kind kind, double start) {
    const double amplitude = 0.2, omega = 4;
    return {{dof, kind},
            [=](double t) { return start + amplitude * std::sin(omega * t); },
            [=](double t) { return amplitude * omega * std::cos(omega * t); },
            [=](double t) { return -amplitude * omega * omega * std::sin(omega * t); }};
}

struct Problem {
    const char* name;
    OscillatorModel (*model)();
};

const Problem problems[] = {
    {"Undamped", [] { return two_nodes(); }},
    {"Loaded",
     [] {
         OscillatorModel model = two_nodes();
         model.load = smooth_load;
         return model;
     }},
    {"MassDamping",
     [] {
         OscillatorModel model = two_nodes();
         model.damping.mass_proportional = 1.5;
         return model;
     }},
    {"AbsorbingBlocks",
     [] {
         OscillatorModel model = two_nodes();
         model.damping.blocks = {{0, 3.0, 1.2, 5.0}, {1, 2.0, -0.8, 1.0}};
         return model;
     }},
    {"ForceJumpAtAnEvent",
     [] {
         OscillatorModel model = two_nodes();
         model.switch_time = 0.7123;
         model.load = [](double t, bool switched) {
             return Vector(smooth_load(t, switched) + (switched ? 40.0 : 0.0) * Vector{{1, -1, 0.5, 2}});
         };
         return model;
     }},
    {"InternalVariables",
     [] {
         OscillatorModel model = two_nodes();
         model.maxwell = Matrix{{1, 0, -1, 0}, {0.5, 1, 0, -1}, {0, 0, 1, 1}};
         model.maxwell_stiffness = 20;
         model.relaxation_time = 0.4;
         return model;
     }},
    {"Viscous",
     [] {
         OscillatorModel model = two_nodes();
         model.viscosity = Matrix{{3, -1, -1, 0}, {-1, 2, 0, 0}, {-1, 0, 2, 0.5}, {0, 0, 0.5, 1}};
         return model;
     }},
    {"PrescribedDisplacement",
     [] {
         OscillatorModel model = two_nodes();
         model.prescribed = {moving(1, Constraint::Kind::displacement, -0.2)};
         return model;
     }},
    {"PrescribedVelocity",
     [] {
         OscillatorModel model = two_nodes();
         model.prescribed = {moving(2, Constraint::Kind::velocity, 0.15)};
         return model;
     }},
    {"ViscousWithMovingSupports",
     [] {
         OscillatorModel model = two_nodes();
         model.viscosity = Matrix{{3, -1, -1, 0}, {-1, 2, 0, 0}, {-1, 0, 2, 0.5}, {0, 0, 0.5, 1}};
         model.prescribed = {moving(0, Constraint::Kind::displacement, 0.1),
                             moving(3, Constraint::Kind::velocity, 0.05)};
         return model;
     }},
    {"AbsorbingNodeWithOneComponentPrescribed",
     [] {
         OscillatorModel model = two_nodes();
         model.damping.blocks = {{0, 3.0, 1.2, 5.0}, {1, 2.0, -0.8, 1.0}};
         model.prescribed = {moving(0, Constraint::Kind::velocity, 0.1),
                             moving(3, Constraint::Kind::displacement, 0.05)};
         return model;
     }},
    {"EverythingAtOnce", [] {
         OscillatorModel model = two_nodes();
         model.damping.mass_proportional = 0.8;
         model.damping.blocks = {{0, 3.0, 1.2, 5.0}};
         model.switch_time = 0.7123;
         model.load = [](double t, bool switched) {
             return Vector(smooth_load(t, switched) + (switched ? 40.0 : 0.0) * Vector{{1, -1, 0.5, 2}});
         };
         model.maxwell = Matrix{{1, 0, -1, 0}, {0, 1, 0, -1}};
         model.maxwell_stiffness = 20;
         model.relaxation_time = 0.4;
         model.viscosity = Matrix{{1, 0, -1, 0}, {0, 1, 0, -1}, {-1, 0, 1, 0}, {0, -1, 0, 1}};
         model.prescribed = {moving(3, Constraint::Kind::displacement, 0.05)};
         return model;
     }}};

/// Distance of two states: displacements, velocities over 5 rad/s, internal forces over 20 N/m.
double distance(const State& p, const State& q) {
    const auto squared = [](const std::vector<double>& a, const std::vector<double>& b) {
        return (Oscillator::vector(a) - Oscillator::vector(b)).squaredNorm();
    };
    double sum = squared(p.u, q.u) + squared(p.v, q.v) / 25;
    if (!p.z.empty()) sum += squared(p.z, q.z) / 400;
    return std::sqrt(sum);
}

State march(const OscillatorModel& model, double dt) {
    const Oscillator system(model);
    CentralDifference integrator({.safety = 1.0, .dt = dt});
    State state = system.initial_state();
    March march;
    march.t_end = t_end;
    // stops at irregular times, so that steps of different length follow each other
    march.next_stop = [](double t) {
        for (const double stop : {0.31, 0.6, 1.13, 1.7})
            if (stop > t) return stop;
        return t_end;
    };
    march.run(system, integrator, state, false);
    EXPECT_EQ(state.t, t_end);
    return state;
}

class CentralDifferenceOrder : public testing::TestWithParam<Problem> {};

TEST_P(CentralDifferenceOrder, ThreeHalvings_WholeState_IsTwo) {
    const OscillatorModel model = GetParam().model();
    const State exact = runge_kutta(Oscillator(model), t_end, reference_step);
    double before = distance(march(model, 0.01), exact);
    for (const double dt : {0.005, 0.0025, 0.00125}) {
        const double error = distance(march(model, dt), exact);
        EXPECT_NEAR(std::log2(before / error), 2.0, order_tolerance) << "dt = " << dt << ", error " << error;
        before = error;
    }
    EXPECT_LT(before, 1e-4);  // and it is the right solution
}

INSTANTIATE_TEST_SUITE_P(Problems, CentralDifferenceOrder, testing::ValuesIn(problems),
                         [](const auto& problem) { return std::string(problem.param.name); });

}  // namespace
}  // namespace gneiss
