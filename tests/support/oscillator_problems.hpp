#pragma once
// Damped, loaded, non-autonomous problems with internal variables and moving supports: what every integrator has to
// solve at its order.

#include <cmath>
#include <string>
#include <vector>

#include "support/oscillator.hpp"
#include "system/march.hpp"

namespace gneiss::test {

constexpr double oscillator_end = 2.0;  ///< s
/// Order 4 with 7500 steps per period of the fastest mode: errors of about 3e-13.
constexpr double oscillator_reference_step = 1e-4;
/// Errors of the reference, of the motion of supports that an integrator differentiates, and round-off.
constexpr double oscillator_floor = 4e-13;

/// Two nodes in the plane, unequal masses, all four degrees of freedom coupled: 2.7 to 8.4 rad/s.
OscillatorModel two_nodes();

Vector smooth_load(double t, bool);

/// sin is convenient: the motion of degree of freedom `dof` starts with a velocity.
PrescribedMotion moving(std::size_t dof, Constraint::Kind kind, double start);

struct OscillatorProblem {
    const char* name;
    OscillatorModel (*model)();
};

void PrintTo(const OscillatorProblem& problem, std::ostream* out);

const std::vector<OscillatorProblem>& oscillator_problems();

/// Distance of two states: displacements, velocities over 5 rad/s, internal forces over 20 N/m.
double distance(const State& p, const State& q);

/// Solves the problem up to oscillator_end with stops on the way, between which there are whole steps of 0.2 s or any
/// half of that.
State march_oscillator(const Oscillator& system, Integrator& integrator, std::size_t* n_steps = nullptr);

}  // namespace gneiss::test
