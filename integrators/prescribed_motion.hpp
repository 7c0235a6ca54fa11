#pragma once
// Displacement, velocity and acceleration of the supports at any instant, from the one of them that is prescribed.
//
// A prescribed displacement is differentiated along the polynomial through five values a small part of the fastest
// period apart; a prescribed velocity is integrated from the last accepted state by the Gauss rule of order 10. Both
// are far more accurate than any scheme that uses them, and look at no instant before the last accepted one, where a
// load may have jumped, unless they are asked for such an instant.

#include <array>
#include <span>
#include <vector>

#include "system/integrator.hpp"

namespace gneiss {

/// Adds the displacements that prescribed velocities make between two instants: the Gauss rule of order 10.
/// @param scratch     overwritten, shape (constraints)
/// @param[in,out] u   m, shape (constraints)
void add_travel(const SemiDiscrete& system, double t0, double t, double last_event, std::span<double> scratch,
                std::span<double> u);

/// Adds to to.path the work of supports along a step, by the trapezoidal rule.
/// @param before, after  reactions at its two ends, N, shape (constraints)
void add_support_work(const SemiDiscrete& system, std::span<const double> before, std::span<const double> after,
                      const State& from, State& to);

class PrescribedMotion {
public:
    /// @param omega  upper bound of the natural frequencies, rad/s
    void bind(const SemiDiscrete& system, double omega);

    /// Instants up to the next call are counted from this accepted state.
    void step_from(const SemiDiscrete& system, const State& accepted);
    /// Puts position and velocity of the supports at state.t into a state in which an integrator starts, and its z
    /// where they strain the solid; steps count from there.
    /// @return how often it has evaluated forces
    std::size_t hold(const SemiDiscrete& system, State& state, StartReason why);

    /// Finds displacement and velocity at t, s; earlier than accepted.t only of motion that is smooth there.
    void evaluate(const SemiDiscrete& system, double t);
    std::span<const double> displacement() const { return u_; }  ///< m, shape (constraints)
    std::span<const double> velocity() const { return v_; }      ///< m/s
    /// m/s2, at the instant of the last evaluate().
    std::span<const double> acceleration(const SemiDiscrete& system);
    /// Writes displacement and velocity into the vectors of all degrees of freedom.
    void put(const SemiDiscrete& system, std::span<double> u, std::span<double> v) const;

    /// Forces of the supports M a + C v - f, N, in a state of which the motion has been evaluated.
    /// @param f  of all degrees of freedom in that state, without C v
    /// @param[out] reactions  shape (constraints)
    void reactions(const SemiDiscrete& system, std::span<const double> v, std::span<const double> f,
                   std::span<double> reactions);

    /// Accelerations M^-1 (f - C v), m/s2, and those of the supports where they are, in a state of which the motion has
    /// been evaluated.
    /// @param[in,out] f  N, without C v, which is subtracted
    /// @param[out] a     shape of f
    void accelerations(const SemiDiscrete& system, std::span<const double> v, std::span<double> f, std::span<double> a);
    /// Writes the supports' accelerations into the vector of all degrees of freedom.
    void put_acceleration(const SemiDiscrete& system, std::span<double> a);

private:
    static constexpr std::size_t n_points = 5;
    /// values_ around t; returns t's place among them in units of their spacing.
    double sample(const SemiDiscrete& system, double t);

    double spacing_ = 0;  ///< s
    double t0_ = 0, last_event_ = 0, t_ = 0;
    std::vector<double> start_, u_, v_, a_, scratch_, net_;
    std::array<std::vector<double>, n_points> values_;
};

}  // namespace gneiss
