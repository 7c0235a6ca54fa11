#pragma once
// Positive part, magnitude and sign, the same words for double, pack and dual number.

#include "base/dual.hpp"

namespace gneiss {

/// <x>: x where it is positive, else 0.
template <class T>
T positive_part(const T& x) {
    return choose(plain(x) > 0.0, x, T(0.0));
}

template <class T>
T magnitude(const T& x) {
    return choose(plain(x) < 0.0, T(-x), x);
}

/// y where x is not negative, else -y.
template <class T, class S>
T with_sign_of(const S& x, const T& y) {
    return choose(plain(x) < 0.0, T(-y), y);
}

}  // namespace gneiss
