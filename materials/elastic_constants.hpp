#pragma once
// From engineering constants to the Munjiza elastic constants, and to the stiffness they mean at small strain.
// Equation numbers are those of Lei et al. 2016.

#include <string>

namespace gneiss {

/// Munjiza elastic constants, Pa: moduli of the volume, of the edges along alpha and beta, and of the angle (14).
struct MunjizaConstants {
    double M_v = 0, M_alpha = 0, M_beta = 0, M_psi = 0;
    friend bool operator==(const MunjizaConstants&, const MunjizaConstants&) = default;
};

/// Engineering constants of a material with one symmetry axis in the plane.
///
/// nu_alpha_beta is the contraction along beta per stretch along alpha under stress along alpha, nu_beta_alpha the
/// other way round; nu_alpha_beta / E_alpha = nu_beta_alpha / E_beta, so one of them is kept.
/// nu_p_alpha acts in the plane spanned by alpha and the out-of-plane direction. (18) holds when this is the plane of
/// isotropy, as in bedded rock with alpha along the bedding: out of the plane the modulus is E_alpha and the
/// contraction under stress along beta is nu_beta_alpha. Compliance of the three normal strains (alpha, beta, out of
/// plane):
///     1/E_alpha                -nu_alpha_beta/E_alpha   -nu_p_alpha/E_alpha
///     -nu_alpha_beta/E_alpha    1/E_beta                -nu_alpha_beta/E_alpha
///     -nu_p_alpha/E_alpha      -nu_alpha_beta/E_alpha    1/E_alpha
struct TransverselyIsotropic {
    double E_alpha = 0, E_beta = 0;  ///< Young's moduli, Pa, > 0
    double nu_alpha_beta = 0;
    double nu_p_alpha = 0;  ///< used in plane strain only
    double G = 0;           ///< shear modulus between alpha and beta, Pa, > 0

    double nu_beta_alpha() const { return nu_alpha_beta * E_beta / E_alpha; }
};

/// Three-dimensional Lamé constants, Pa.
struct LameConstants {
    double mu = 0, lambda = 0;
};

// No function below checks its arguments: constants outside the admissible range come out as what the formula gives
// (possibly infinite), and inadmissibility() says so.

MunjizaConstants isotropic_plane_stress(double E, double nu);                              ///< (15); E in Pa
MunjizaConstants isotropic_plane_strain(double E, double nu);                              ///< (16); E in Pa
MunjizaConstants transversely_isotropic_plane_stress(const TransverselyIsotropic& given);  ///< (17)
MunjizaConstants transversely_isotropic_plane_strain(const TransverselyIsotropic& given);  ///< (18)

LameConstants lame_constants(double E, double nu);  ///< E in Pa, nu in (-1, 0.5)

/// Why these constants store no positive energy, empty if they do [FORMULATION 3]: all finite,
/// [[M_v + M_alpha, M_v], [M_v, M_v + M_beta]] positive definite and M_psi > 0.
std::string inadmissibility(const MunjizaConstants& constants);
inline bool is_admissible(const MunjizaConstants& constants) { return inadmissibility(constants).empty(); }

}  // namespace gneiss
