#include "materials/elastic_constants.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gneiss {

MunjizaConstants isotropic_plane_stress(double E, double nu) {
    const double M = E / (1 + nu);
    return {nu * E / (1 - nu * nu), M, M, M};
}

MunjizaConstants isotropic_plane_strain(double E, double nu) {
    const double M = E / (1 + nu);
    return {nu * E / ((1 + nu) * (1 - 2 * nu)), M, M, M};
}

MunjizaConstants transversely_isotropic_plane_stress(const TransverselyIsotropic& given) {
    const double nu_ab = given.nu_alpha_beta, nu_ba = given.nu_beta_alpha();
    const double d = 1 - nu_ab * nu_ba;
    return {nu_ba * given.E_alpha / d, (1 - nu_ba) * given.E_alpha / d, (1 - nu_ab) * given.E_beta / d, 2 * given.G};
}

MunjizaConstants transversely_isotropic_plane_strain(const TransverselyIsotropic& given) {
    const double nu_ab = given.nu_alpha_beta, nu_ba = given.nu_beta_alpha(), nu_p = given.nu_p_alpha;
    const double d = 1 - nu_p - 2 * nu_ab * nu_ba;
    return {nu_ba * given.E_alpha / d, (1 - nu_ba - nu_ab * nu_ba - nu_p * nu_ba) * given.E_alpha / ((1 + nu_p) * d),
            (1 - nu_ab - nu_p * nu_p - nu_p * nu_ab) * given.E_beta / ((1 + nu_p) * d), 2 * given.G};
}

LameConstants lame_constants(double E, double nu) { return {E / (2 * (1 + nu)), nu * E / ((1 + nu) * (1 - 2 * nu))}; }

std::string inadmissibility(const MunjizaConstants& c) {
    const double aa = c.M_v + c.M_alpha, bb = c.M_v + c.M_beta, det = aa * bb - c.M_v * c.M_v;
    const bool finite = std::isfinite(c.M_v) && std::isfinite(c.M_alpha) && std::isfinite(c.M_beta);
    if (!(finite && aa > 0 && bb > 0 && det > 0)) {
        return fmt::format(
            "the stiffness [[M_v + M_alpha, M_v], [M_v, M_v + M_beta]] = [[{0:.6g}, {1:.6g}], [{1:.6g}, "
            "{2:.6g}]] Pa is not positive definite",
            aa, c.M_v, bb);
    }
    if (!(std::isfinite(c.M_psi) && c.M_psi > 0)) return fmt::format("M_psi = {:.6g} Pa, must be > 0 Pa", c.M_psi);
    return {};
}

}  // namespace gneiss
