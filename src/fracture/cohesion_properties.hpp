#pragma once
// Strengths, energies and penalty of a point of an interface, their ranges, and what a point of any cohesion law
// returns  [FORMULATION 7].

#include <array>

namespace gneiss {

/// Where a crack may open. One set per point, because strengths may depend on direction and scatter.
/// @tparam V  double or Pack
template <class V>
struct CohesionProperties {
    V tensile_strength;    ///< f_t, Pa, > 0
    V cohesion;            ///< c_0, Pa, > 0, strength in shear without normal traction
    V tan_phi_initial;     ///< tan phi_i, -, >= 0: internal friction of the intact edge
    V tan_phi_residual;    ///< tan phi_r, -, >= 0: friction at D = 1
    V fracture_energy_i;   ///< G_I, J/m2, > 0
    V fracture_energy_ii;  ///< G_II, J/m2, > 0
    V penalty;             ///< k = p_f/h_e, Pa/m, > 0: stiffness of the elastic branch and in compression

    /// For loops over all of them.
    static constexpr std::array<V CohesionProperties::*, 7> members{&CohesionProperties::tensile_strength,
                                                                    &CohesionProperties::cohesion,
                                                                    &CohesionProperties::tan_phi_initial,
                                                                    &CohesionProperties::tan_phi_residual,
                                                                    &CohesionProperties::fracture_energy_i,
                                                                    &CohesionProperties::fracture_energy_ii,
                                                                    &CohesionProperties::penalty};
};

/// Traction of the side with the outward normal against opening: tension positive; shear against slip.
template <class T>
struct Traction {
    T normal, shear;  ///< Pa
};

/// @name f_t^2/(k G_I) and c_0^2/(k G_II): twice the elastic part of the fracture energy, relative; < 2 or the law
/// cannot dissipate as little as G.
///@{
template <class V>
V elastic_ratio_i(const CohesionProperties<V>& p) {
    return p.tensile_strength * p.tensile_strength / (p.penalty * p.fracture_energy_i);
}
template <class V>
V elastic_ratio_ii(const CohesionProperties<V>& p) {
    return p.cohesion * p.cohesion / (p.penalty * p.fracture_energy_ii);
}
///@}

/// Everything that is wrong with the properties of a point of `MixedModeLaw`, all at once.
/// @throws InputError  strengths, energies or penalty not positive, friction negative, elastic ratio 2 or more; its
///                     problems have no place
void validate_mixed_mode(const CohesionProperties<double>& properties);

/// The same for `YCodeLaw`, which needs 3 G/f >= 2 f_p with f_p = 2 f/k the opening (slip) at the peak.
/// @throws InputError
void validate_y_code(const CohesionProperties<double>& properties);

/// l_ch = G E/f_t^2, m: the length over which a crack softens, up to a factor near 1 that depends on the shape of
/// softening (Hillerborg, Modeer and Petersson 1976). Meshes with h above it cannot resolve the crack.
/// @param fracture_energy   G, J/m2
/// @param young             E across the crack, Pa; E/(1 - nu^2) in plane strain
/// @param tensile_strength  f_t, Pa, > 0
double cohesion_length(double fracture_energy, double young, double tensile_strength);

}  // namespace gneiss
