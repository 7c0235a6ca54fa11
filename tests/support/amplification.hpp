#pragma once
// The amplification matrix of an integrator on one undamped mass and spring, measured by its own steps.

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "support/oscillator.hpp"
#include "system/integrator.hpp"

namespace gneiss::test {

using MakeIntegrator = std::function<std::unique_ptr<Integrator>(double dt)>;

/// Of (u, v/omega) over a step of x'' = -omega^2 x, with dt = 1.
/// @param interactions  part of omega^2 that stands for them
Eigen::Matrix2d amplification(const MakeIntegrator& make, double omega, double interactions = 0);

double spectral_radius(const Eigen::Matrix2d& matrix);

/// omega dt from which on steps grow: by bisection after a scan upwards, so that it is the first such one.
/// @param least  growth of a step that counts: a double eigenvalue of the unit circle is known to sqrt(eps)
double stability_limit(const MakeIntegrator& make, double largest, double least = 1e-6, double interactions = 0);

/// The largest |u_x| + |u_y| that 4000 critical steps end with, of two oscillators with every kind of damping in turn,
/// viscous, by mass, absorbing, at rates far below and far above the frequencies.
/// @param make  an integrator that takes its steps from the bound
double largest_under_damping(const std::function<std::unique_ptr<Integrator>()>& make);

}  // namespace gneiss::test
