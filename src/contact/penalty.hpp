#pragma once
// The contact penalty from the stiffness and the size of what touches.

#include <cmath>
#include <string>

#include "base/errors.hpp"

namespace gneiss {

/// What one side of a contact is made of.
struct ContactSide {
    double modulus;  ///< Pa, > 0: the largest of rho c^2 over all directions, M_v + max(M_alpha, M_beta)
    double size;     ///< m, > 0: element size at the boundary
};

/// Penalty p_n = factor / (h_1/M_1 + h_2/M_2), Pa/m: `factor` times the stiffness of one layer of elements on either
/// side, in series. Where both sides are contactor and target, as everywhere here, two flat faces that overlap by d
/// press with 2 p_n d. With factor 1 the joint gives way as much as the two layers do; larger factors overlap less and
/// cost steps once p_n outweighs the elements.
/// @throws InputError if an argument is not finite and > 0; the message gives it
inline double penalty_of(const ContactSide& one, const ContactSide& other, double factor) {
    const auto require = [](double value, const char* what, const char* unit) {
        if (!(value > 0 && std::isfinite(value)))
            throw InputError("", std::string("contact penalty: ") + what + " = " + std::to_string(value) + " " + unit +
                                     ", must be finite and > 0");
    };
    for (const ContactSide& side : {one, other}) {
        require(side.modulus, "modulus", "Pa");
        require(side.size, "element size", "m");
    }
    require(factor, "factor", "(no unit)");
    return factor / (one.size / one.modulus + other.size / other.modulus);
}

}  // namespace gneiss
