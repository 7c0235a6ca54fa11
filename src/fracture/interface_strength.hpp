#pragma once
// Properties of an interface as a user gives them: with the direction of the edge relative to the material axes, and
// with scatter from edge to edge.

#include <cstdint>

#include "base/vec2.hpp"
#include "fracture/cohesion_properties.hpp"

namespace gneiss {

/// A property of edges that lie along the material axis alpha (the bedding) and across it; in between
/// along cos^2 theta + across sin^2 theta, theta the angle from alpha to the edge: the variable cohesion
/// A - B cos 2 theta of Jaeger (Geological Magazine 97, 1960, 65-72), for all properties alike.
struct DirectionalValue {
    double along = 0;   ///< in the unit of the property
    double across = 0;  ///< equal to `along`: no direction

    /// @param sine_squared  sin^2 theta, 0 to 1
    double at(double sine_squared) const { return along + (across - along) * sine_squared; }
};

/// Strengths and energies of a material or an interface. Physical constants: no defaults.
struct InterfaceStrength {
    DirectionalValue tensile_strength;    ///< f_t, Pa, > 0
    DirectionalValue cohesion;            ///< c_0, Pa, > 0
    DirectionalValue tan_phi_initial;     ///< tan phi_i, -, >= 0
    DirectionalValue tan_phi_residual;    ///< tan phi_r, -, >= 0
    DirectionalValue fracture_energy_i;   ///< G_I, J/m2, > 0
    DirectionalValue fracture_energy_ii;  ///< G_II, J/m2, > 0

    /// Properties of an edge.
    /// @param edge     from one end to the other, m, not zero; its sense does not matter
    /// @param alpha    material axis, of any length but zero; its sense does not matter
    /// @param penalty  k, Pa/m
    CohesionProperties<double> properties(const Vec2<double>& edge, const Vec2<double>& alpha, double penalty) const;
};

/// Weibull scatter of strengths: a factor of mean 1 for f_t and c_0 of each edge; energies and friction do not scatter.
struct WeibullScatter {
    double modulus;      ///< m, -, > 0: the larger the narrower; 10 scatters by 12 %
    std::uint64_t seed;  ///< another seed, another sample

    /// @throws InputError  modulus not positive or not finite
    void validate() const;

    /// (-ln(1 - U))^(1/m) / Gamma(1 + 1/m), -, > 0. U is a hash of seed and edge: the factor of an edge depends on its
    /// number alone, not on the order in which edges are asked for.
    double factor(std::uint64_t edge) const;
};

/// f_t and c_0 times the factor.
CohesionProperties<double> scaled_strength(CohesionProperties<double> properties, double factor);

}  // namespace gneiss
