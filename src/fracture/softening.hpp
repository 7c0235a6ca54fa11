#pragma once
// Softening of a cohesive crack with damage D from 0 to 1, and its integral in closed form
// [FORMULATION 7; Munjiza, Andrews and White, Int. J. Numer. Meth. Engng 44 (1999) 41-57].
//
//   z(D) = [1 - C exp(kappa D)] [a (1 - D) + b (1 - D)^c],   a = 0.63, b = 1.8, c = 6
//   C = (a + b - 1)/(a + b),  kappa = (a + c b)/((a + b)(1 - a - b)) < 0;   z(0) = 1, z'(0) = 0, z(1) = 0
//
// The integral: with u = 1 - D and P(u) = a u + b u^c, exp(-kappa u) P(u) is the derivative of exp(-kappa u) Q(u) if
// Q' - kappa Q = P, which fixes a polynomial Q. Hence
//
//   I(D) = integral of z from 0 to D = a (1 - u^2)/2 + b (1 - u^7)/7 - C [Q(1) - exp(kappa D) Q(u)]

#include <array>

#include "base/functions.hpp"

namespace gneiss {
namespace softening {

inline constexpr double a = 0.63, b = 1.8;
inline constexpr int c = 6;
inline constexpr double C = (a + b - 1) / (a + b);
inline constexpr double kappa = (a + c * b) / ((a + b) * (1 - a - b));

/// Coefficients of Q, of u^0 .. u^c, from the highest down: -kappa Q_i = P_i - (i + 1) Q_(i+1).
inline constexpr std::array<double, c + 1> Q = [] {
    std::array<double, c + 1> p{}, q{};
    p[1] = a;
    p[c] = b;
    for (int i = c; i >= 0; --i) q[i] = (p[i] - (i < c ? (i + 1) * q[i + 1] : 0.0)) / -kappa;
    return q;
}();

constexpr double sum(const std::array<double, c + 1>& coefficients) {
    double total = 0;
    for (const double coefficient : coefficients) total += coefficient;
    return total;
}
inline constexpr double Q_of_1 = sum(Q);

template <class T>
T decay(const T& damage) {
    return exponential(T(kappa * damage));
}

template <class T>
T value(const T& damage, const T& decay) {
    const T u = T(1.0) - damage, u2 = u * u;
    return (T(1.0) - C * decay) * (a * u + b * (u2 * u2 * u2));
}

template <class T>
T integral(const T& damage, const T& decay) {
    const T u = T(1.0) - damage, u2 = u * u;
    T q(Q[c]);
    for (int i = c - 1; i >= 0; --i) q = q * u + T(Q[i]);
    return (0.5 * a) * (T(1.0) - u2) + (b / 7) * (T(1.0) - u2 * u2 * u2 * u) - C * (T(Q_of_1) - decay * q);
}

}  // namespace softening

/// z(D), -, 1 to 0.  @param damage  D, 0 to 1
template <class T>
T softening_value(const T& damage) {
    return softening::value(damage, softening::decay(damage));
}

/// z and I at one damage: one exponential for both.
template <class T>
struct Softening {
    T value;     ///< z(D)
    T integral;  ///< integral of z from 0 to D
};
template <class T>
Softening<T> softening_and_integral(const T& damage) {
    const T decay = softening::decay(damage);
    return {softening::value(damage, decay), softening::integral(damage, decay)};
}

/// Z, the integral of z from 0 to 1: 0.3863073. At u = 0 the bracket is Q(1) - exp(kappa) Q(0); exp(kappa) to 17 digits
/// because no library function is a constant expression.
inline constexpr double softening_integral =
    softening::a / 2 + softening::b / 7 - softening::C * (softening::Q_of_1 - 0.037279813595301154 * softening::Q[0]);

}  // namespace gneiss
