#include "fracture/interface_strength.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/errors.hpp"

namespace gneiss {
namespace {

/// The finaliser of SplitMix64 [Steele, Lea and Flood, OOPSLA 2014, 453-472]: every bit of the answer depends on every
/// bit of x.
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

/// Uniform in (0, 1), neither end included.
double uniform(std::uint64_t seed, std::uint64_t number) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
    const std::uint64_t bits = mixed(mixed(seed + golden) + (number + 1) * golden);
    return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

}  // namespace

CohesionProperties<double> InterfaceStrength::properties(const Vec2<double>& edge, const Vec2<double>& alpha,
                                                         double penalty) const {
    const double sine = cross(alpha, edge), cosine = dot(alpha, edge);
    const double s = sine * sine / (sine * sine + cosine * cosine);
    return {tensile_strength.at(s),
            cohesion.at(s),
            tan_phi_initial.at(s),
            tan_phi_residual.at(s),
            fracture_energy_i.at(s),
            fracture_energy_ii.at(s),
            penalty};
}

void WeibullScatter::validate() const {
    if (!(modulus > 0 && std::isfinite(modulus)))
        throw InputError("", fmt::format("Weibull modulus is {:.6g}, must be > 0", modulus));
}

double WeibullScatter::factor(std::uint64_t edge) const {
    return std::pow(-std::log1p(-uniform(seed, edge)), 1 / modulus) / std::tgamma(1 + 1 / modulus);
}

CohesionProperties<double> scaled_strength(CohesionProperties<double> properties, double factor) {
    properties.tensile_strength *= factor;
    properties.cohesion *= factor;
    return properties;
}

}  // namespace gneiss
