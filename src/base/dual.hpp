#pragma once
// Forward-mode dual numbers of fixed size over doubles or packs: the exact tangent of whatever a kernel computes.
// Eigen's AutoDiffScalar lacks log1p, atan and functions of two duals, hence our own.

#include <array>
#include <cmath>
#include <type_traits>

#include "base/pack.hpp"

namespace gneiss {

/// A value and its N partial derivatives. V is double or Pack.
template <int N, class V = double>
struct Dual {
    V value;
    std::array<V, N> derivative;

    Dual() : Dual(V(0.0)) {}
    Dual(const V& constant) : value(constant) { derivative.fill(V(0.0)); }  // NOLINT: constants convert on purpose
    Dual(double constant)                                                   // NOLINT
        requires(!std::is_same_v<V, double>)
        : Dual(V(constant)) {}

    /// The k-th independent variable.
    static Dual variable(const V& value, int k) {
        Dual x(value);
        x.derivative[static_cast<std::size_t>(k)] = V(1.0);
        return x;
    }

    /// y with dy = slope dx: the chain rule for a function of one variable.
    friend Dual chain(const V& value, const V& slope, const Dual& x) {
        Dual y(value);
        for (int k = 0; k < N; ++k) y.derivative[k] = slope * x.derivative[k];
        return y;
    }

    friend Dual operator+(Dual a, const Dual& b) { return a += b; }
    friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
    friend Dual operator*(const Dual& a, const Dual& b) {
        Dual c(a.value * b.value);
        for (int k = 0; k < N; ++k) c.derivative[k] = a.derivative[k] * b.value + a.value * b.derivative[k];
        return c;
    }
    // Constants carry no derivatives: scaling by one costs N products, not 2 N.
    friend Dual operator*(double s, const Dual& a) { return chain(V(s) * a.value, V(s), a); }
    friend Dual operator*(const Dual& a, double s) { return s * a; }
    friend Dual operator*(const V& s, const Dual& a) requires(!std::is_same_v<V, double>) {
        return chain(s * a.value, s, a);
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        const V reciprocal = V(1.0) / b.value;
        Dual c(a.value * reciprocal);
        for (int k = 0; k < N; ++k) c.derivative[k] = (a.derivative[k] - c.value * b.derivative[k]) * reciprocal;
        return c;
    }
    friend Dual operator-(const Dual& a) { return chain(-a.value, V(-1.0), a); }

    Dual& operator+=(const Dual& b) {
        value += b.value;
        for (int k = 0; k < N; ++k) derivative[k] += b.derivative[k];
        return *this;
    }
    Dual& operator-=(const Dual& b) {
        value -= b.value;
        for (int k = 0; k < N; ++k) derivative[k] -= b.derivative[k];
        return *this;
    }
    Dual& operator*=(const Dual& b) { return *this = *this * b; }
};

template <int N, class V>
Dual<N, V> sqrt(const Dual<N, V>& x) {
    using std::sqrt;
    using xsimd::sqrt;
    const V root = sqrt(x.value);
    return chain(root, V(0.5) / root, x);
}

template <int N, class V>
Dual<N, V> exp(const Dual<N, V>& x) {
    using std::exp;
    using xsimd::exp;
    const V value = exp(x.value);
    return chain(value, value, x);
}

template <int N, class V>
Dual<N, V> expm1(const Dual<N, V>& x) {
    using std::expm1;
    using xsimd::expm1;
    const V value = expm1(x.value);
    return chain(value, value + V(1.0), x);
}

template <int N, class V>
Dual<N, V> log1p(const Dual<N, V>& x) {
    using std::log1p;
    using xsimd::log1p;
    return chain(V(log1p(x.value)), V(1.0) / (V(1.0) + x.value), x);
}

template <int N, class V>
Dual<N, V> atan(const Dual<N, V>& x) {
    using std::atan;
    using xsimd::atan;
    return chain(V(atan(x.value)), V(1.0) / (V(1.0) + x.value * x.value), x);
}

/// x^p with a constant exponent, x > 0.
template <int N, class V>
Dual<N, V> pow(const Dual<N, V>& x, double p) {
    using std::pow;
    using xsimd::pow;
    const V value = pow(x.value, V(p));
    return chain(value, V(p) * value / x.value, x);
}

// ---- comparison and selection, the same words for double, pack and dual -------------------------------------------

/// The plain number inside: of a dual its value.
inline double plain(double x) { return x; }
inline const Pack& plain(const Pack& x) { return x; }
template <int N, class V>
const V& plain(const Dual<N, V>& x) {
    return x.value;
}

/// condition ? a : b, lane by lane for packs. Both branches are evaluated.
inline double choose(bool condition, double a, double b) { return condition ? a : b; }
inline Pack choose(const Pack::batch_bool_type& condition, const Pack& a, const Pack& b) {
    return xsimd::select(condition, a, b);
}
template <class Condition, int N, class V>
Dual<N, V> choose(const Condition& condition, const Dual<N, V>& a, const Dual<N, V>& b) {
    Dual<N, V> c(choose(condition, a.value, b.value));
    for (int k = 0; k < N; ++k) c.derivative[k] = choose(condition, a.derivative[k], b.derivative[k]);
    return c;
}

/// True if the condition holds in any (in every) lane.
inline bool any_lane(bool condition) { return condition; }
inline bool any_lane(const Pack::batch_bool_type& condition) { return xsimd::any(condition); }
inline bool every_lane(bool condition) { return condition; }
inline bool every_lane(const Pack::batch_bool_type& condition) { return xsimd::all(condition); }

}  // namespace gneiss
