#pragma once
// The two functions of one variable that Munjiza's strains are made of, accurate to round-off for small arguments:
//
//   ln1p(x)           ln(1 + x)                                    e_v, e_alpha, e_beta
//   angular_strain(c) e_psi = ln(1 - (2/pi) atan c), orthogonal axes    [FORMULATION 3, Precision]
//
// Where every lane of a pack is small, short series replace the library functions; both agree to round-off, so how
// elements are grouped into packs does not matter beyond it.

#include <array>
#include <cmath>
#include <numbers>

#include "base/dual.hpp"
#include "base/pack.hpp"

namespace gneiss {
namespace series {

/// Below this magnitude a polynomial of this degree has a relative truncation error below 1e-17: (1/64)^9 / 10 for
/// ln1p.
inline constexpr double limit = 1.0 / 64.0;
inline constexpr int degree = 9;

using Coefficients = std::array<double, degree + 1>;  ///< of x^0 .. x^degree

constexpr Coefficients product(const Coefficients& a, const Coefficients& b) {
    Coefficients c{};
    for (int i = 0; i <= degree; ++i)
        for (int j = 0; i + j <= degree; ++j) c[i + j] += a[i] * b[j];
    return c;
}

/// sum over n >= 1 of weight(n) t^n, cut at the degree, for t without a constant term.
template <class Weight>
constexpr Coefficients compose(const Coefficients& t, Weight weight) {
    Coefficients sum{}, power{};
    power[0] = 1;
    for (int n = 1; n <= degree; ++n) {
        power = product(power, t);
        for (int i = 0; i <= degree; ++i) sum[i] += weight(n) * power[i];
    }
    return sum;
}

/// t = (2/pi) atan c
constexpr Coefficients scaled_atan() {
    Coefficients t{};
    for (int n = 1; n <= degree; n += 2) t[n] = (n % 4 == 1 ? 2.0 : -2.0) / (std::numbers::pi * n);
    return t;
}

inline constexpr Coefficients ln1p = [] {
    Coefficients c{};
    for (int n = 1; n <= degree; ++n) c[n] = (n % 2 == 1 ? 1.0 : -1.0) / n;
    return c;
}();
/// ln(1 - t) = -sum t^n / n
inline constexpr Coefficients angular_strain = compose(scaled_atan(), [](int n) { return -1.0 / n; });
/// 1/(1 - t) - 1 = sum t^n
inline constexpr Coefficients angle_ratio_minus_1 = compose(scaled_atan(), [](int) { return 1.0; });
/// ln(1 - t) / (1 - t)
inline constexpr Coefficients angular_response = [] {
    Coefficients ratio = angle_ratio_minus_1;
    ratio[0] += 1;
    return product(angular_strain, ratio);
}();

/// c_1 x + c_2 x^2 + ..., by Estrin's scheme: half the latency of Horner's, which is what a pack waits for.
inline Pack evaluate(const Coefficients& c, const Pack& x) {
    static_assert(degree == 9);
    const auto pair = [&](int n, const Pack& at) { return xsimd::fma(Pack(c[n + 1]), at, Pack(c[n])); };
    const Pack x2 = x * x, x4 = x2 * x2;
    const Pack low = xsimd::fma(pair(3, x), x2, pair(1, x)), high = xsimd::fma(pair(7, x), x2, pair(5, x));
    return x * xsimd::fma(xsimd::fma(Pack(c[9]), x4, high), x4, low);
}

// The library functions stay out of line: a kernel that inlines them at every use has no registers left for itself.
[[gnu::noinline, gnu::cold]] inline Pack library_log1p(const Pack& x) { return xsimd::log1p(x); }
[[gnu::noinline, gnu::cold]] inline Pack library_atan(const Pack& x) { return xsimd::atan(x); }

inline bool all_small(const Pack& x) { return xsimd::all(xsimd::abs(x) < Pack(limit)); }

}  // namespace series

inline double ln1p(double x) { return std::log1p(x); }
inline Pack ln1p(const Pack& x) {
    if (series::all_small(x)) [[likely]]
        return series::evaluate(series::ln1p, x);
    return series::library_log1p(x);
}
template <int N, class V>
Dual<N, V> ln1p(const Dual<N, V>& x) {
    return chain(ln1p(x.value), V(1.0) / (V(1.0) + x.value), x);
}

/// The angle between axes that were orthogonal, in the measure of (11)-(13).
template <class T>
struct AngularStrain {
    T strain;  ///< e_psi = ln(psi / (pi/2))
    T ratio;   ///< (pi/2) / psi
};

/// @param c cotangent of the current angle, (alpha . beta)/(alpha x beta)
template <class T>
AngularStrain<T> angular_strain(const T& c) {
    T t;
    if constexpr (std::is_same_v<T, Pack>) {
        if (series::all_small(c)) [[likely]]
            return {series::evaluate(series::angular_strain, c),
                    T(1.0) + series::evaluate(series::angle_ratio_minus_1, c)};
        t = (2.0 / std::numbers::pi) * series::library_atan(c);
    } else {
        using std::atan;
        t = (2.0 / std::numbers::pi) * T(atan(c));
    }
    return {ln1p(T(-t)), T(1.0) / (T(1.0) - t)};
}

/// e_psi (pi/2)/psi in one go: all that the conjugate map needs.
template <class T>
T angular_response(const T& c) {
    if constexpr (std::is_same_v<T, Pack>) {
        if (series::all_small(c)) [[likely]]
            return series::evaluate(series::angular_response, c);
    }
    const AngularStrain<T> angle = angular_strain(c);
    return angle.strain * angle.ratio;
}

}  // namespace gneiss
