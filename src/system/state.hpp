#pragma once
// The state of a semi-discrete system, and a trial state in which its forces can be evaluated.

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace gneiss {

/// Energies that depend on the path and are accumulated step by step, J. Work done on the solid and dissipation are
/// counted positive.
struct PathEnergies {
    double external_work = 0;  ///< loads
    double support_work = 0;   ///< reactions of prescribed motion
    double damping = 0;        ///< dissipated by mass-proportional damping
    double viscous = 0;        ///< dissipated by viscous stress in the material
    double absorbing = 0;      ///< carried away through absorbing boundaries
    double friction = 0;       ///< dissipated by friction
    double fracture = 0;       ///< dissipated by damage of cohesive edges
    double contact = 0;        ///< dissipated in contact by restitution
    double leaked = 0;         ///< carried away by gas that leaks
    double dampers = 0;        ///< dissipated by dampers of lumped models
    double splitting = 0;      ///< that events of topology have put in, counted positive: springs that came into being
                               ///< under load, jumps of the contact potential; they are no work and no dissipation
    double viscous_power = 0;  ///< W, rate of `viscous` at the last accepted state

    friend bool operator==(const PathEnergies&, const PathEnergies&) = default;

    /// All of them in a fixed order.
    std::array<double*, 12> members() {
        return {&external_work, &support_work, &damping, &viscous, &absorbing, &friction,
                &fracture,      &contact,      &leaked,  &dampers, &splitting, &viscous_power};
    }
};

/// The last accepted state. Evaluations never change it; integrators and events do.
struct State {
    double t = 0;                                                  ///< time, s
    double last_event = -std::numeric_limits<double>::infinity();  ///< switches at or before this time have happened, s
    std::vector<double> u;        ///< displacement, m, shape (2 n_nodes), x and y of each node in turn
    std::vector<double> v;        ///< velocity, m/s, same shape
    std::vector<double> z;        ///< internal variables that have a rate, units of each law
    std::vector<double> history;  ///< memory without a rate, units of each law
    PathEnergies path;

    friend bool operator==(const State&, const State&) = default;
};

/// A state to evaluate forces in. Where z is empty it follows from u: the exact update from the last accepted state;
/// where it is given (ODE solvers) it is taken as it is.
struct Trial {
    double t = 0;                  ///< s
    double last_event = 0;         ///< as in State
    std::span<const double> u, v;  ///< shape (2 n_nodes)
    std::span<const double> z = {};

    static Trial of(const State& state) { return {state.t, state.last_event, state.u, state.v, {}}; }
};

}  // namespace gneiss
