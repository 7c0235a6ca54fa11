#pragma once
// One point of an interface, led along a path.

#include "fracture/cohesion_properties.hpp"

namespace gneiss {

/// Round numbers of a rock joint: o_p = 1e-6 m, s_p = 2e-6 m, B_I = 0.06, B_II = 0.04.
inline CohesionProperties<double> rock_joint() {
    return {.tensile_strength = 3e6,
            .cohesion = 6e6,
            .tan_phi_initial = 0.8,
            .tan_phi_residual = 0.5,
            .fracture_energy_i = 50,
            .fracture_energy_ii = 300,
            .penalty = 3e12};
}
inline constexpr double peak_opening = 1e-6, peak_slip = 2e-6;  ///< o_p, s_p of rock_joint, m

/// Accepts every point that it is led to, and measures the work of the traction by the trapezoidal rule.
template <class Law>
struct LoadedPoint {
    CohesionProperties<double> properties = rock_joint();
    typename Law::template History<double> history{};
    double opening = 0, slip = 0;
    double work_normal = 0, work_shear = 0;  ///< J/m2

    Traction<double> traction() const { return Law::traction(properties, history, opening, slip); }
    double stored() const { return Law::stored_energy(properties, history, opening, slip); }
    double work() const { return work_normal + work_shear; }

    void move_to(double o, double s) {
        const Traction<double> before = traction();
        history = Law::advance(properties, history, o, s);
        const double d_o = o - opening, d_s = s - slip;
        opening = o;
        slip = s;
        const Traction<double> after = traction();
        work_normal += 0.5 * (before.normal + after.normal) * d_o;
        work_shear += 0.5 * (before.shear + after.shear) * d_s;
    }

    /// Straight, in n equal steps.
    void move_to(double o, double s, int n) {
        const double o_0 = opening, s_0 = slip;
        for (int i = 1; i < n; ++i) move_to(o_0 + (o - o_0) * i / n, s_0 + (s - s_0) * i / n);
        move_to(o, s);
    }
};

}  // namespace gneiss
