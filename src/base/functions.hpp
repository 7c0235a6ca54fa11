#pragma once
// Functions of the standard library under one name for double, pack and dual number.

#include <cmath>

#include "base/dual.hpp"
#include "base/pack.hpp"

namespace gneiss {

template <class T>
T exponential(const T& x) {
    using std::exp;
    using xsimd::exp;
    return exp(x);
}

template <class T>
T exponential_minus_1(const T& x) {
    using std::expm1;
    using xsimd::expm1;
    return expm1(x);
}

template <class T>
T square_root(const T& x) {
    using std::sqrt;
    using xsimd::sqrt;
    return sqrt(x);
}

}  // namespace gneiss
