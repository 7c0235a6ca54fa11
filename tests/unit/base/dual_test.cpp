#include "base/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/functions.hpp"
#include "base/series.hpp"
#include "support/eps.hpp"
#include "support/finite_differences.hpp"
#include "support/packs.hpp"

namespace gneiss {
namespace {

using test::eps;

// A function and its derivative take a handful of operations on numbers near 1.
constexpr double round_off = 8 * eps;
// Truncation and round-off of the central difference, see difference_step; fifth derivatives below are up to some tens.
constexpr double difference_error = 1e-10;

/// A value type: how to make a value that is different in every lane, and how to look at all of it.
template <class V>
struct Values;
template <>
struct Values<double> {
    static double near(double x, double) { return x; }
    static std::array<double, 1> all(double x) { return {x}; }
};
template <>
struct Values<Pack> {
    static Pack near(double x, double spread) {
        return pack_of([&](std::size_t lane) { return x + spread * static_cast<double>(lane); });
    }
    static std::array<double, pack_width> all(const Pack& x) { return lanes(x); }
};

template <class V>
class DualOf : public testing::Test {};
using ValueTypes = testing::Types<double, Pack>;
TYPED_TEST_SUITE(DualOf, ValueTypes);

template <class V>
void expect_near(const V& a, const V& b, double relative, const char* what) {
    const auto x = Values<V>::all(a), y = Values<V>::all(b);
    for (std::size_t lane = 0; lane < x.size(); ++lane)
        EXPECT_NEAR(x[lane], y[lane], relative * (1 + std::abs(y[lane]))) << what << ", lane " << lane;
}

/// f(x, y) as a dual against f on plain numbers, and its derivatives against central differences of them.
template <class V, class Function>
void expect_derivatives(const char* what, Function f) {
    using D = Dual<2, V>;
    const V x = Values<V>::near(0.6, 0.013), y = Values<V>::near(-0.3, -0.021);
    const D z = f(D::variable(x, 0), D::variable(y, 1));
    expect_near<V>(z.value, f(x, y), round_off, what);
    const V by_x = derivative_at_zero([&](double h) { return V(f(V(x + V(h)), y)); });
    const V by_y = derivative_at_zero([&](double h) { return V(f(x, V(y + V(h)))); });
    expect_near<V>(z.derivative[0], by_x, difference_error, what);
    expect_near<V>(z.derivative[1], by_y, difference_error, what);
}

TYPED_TEST(DualOf, Operators_OfTwoVariables_HaveTheDerivativesOfTheirDifferences) {
    using V = TypeParam;
    expect_derivatives<V>("x + y", [](auto x, auto y) { return x + y; });
    expect_derivatives<V>("x - y", [](auto x, auto y) { return x - y; });
    expect_derivatives<V>("x * y", [](auto x, auto y) { return x * y; });
    expect_derivatives<V>("x / y", [](auto x, auto y) { return x / y; });
    expect_derivatives<V>("-(x y)", [](auto x, auto y) { return -(x * y); });
    expect_derivatives<V>("x += y", [](auto x, auto y) { return x += y; });
    expect_derivatives<V>("x -= y", [](auto x, auto y) { return x -= y; });
    expect_derivatives<V>("x *= y", [](auto x, auto y) { return x *= y; });
    expect_derivatives<V>("x *= x", [](auto x, auto) { return x *= x; });
    expect_derivatives<V>("2 x - y 3", [](auto x, auto y) { return 2.0 * x - y * 3.0; });
    expect_derivatives<V>("x + constant", [](auto x, auto y) { return x * (y + decltype(x)(1.5)); });
    const V s = Values<V>::near(1.7, -0.1);
    expect_derivatives<V>("value times dual", [&](auto x, auto y) { return s * (x * y); });
}

TYPED_TEST(DualOf, Functions_OfTwoVariables_HaveTheDerivativesOfTheirDifferences) {
    using V = TypeParam;
    using std::atan, std::exp, std::expm1, std::log1p, std::pow, std::sqrt;
    using xsimd::atan, xsimd::exp, xsimd::expm1, xsimd::log1p, xsimd::sqrt;
    expect_derivatives<V>("sqrt", [](auto x, auto y) { return decltype(x)(sqrt(decltype(x)(x * x + y * y))); });
    expect_derivatives<V>("exp", [](auto x, auto y) { return decltype(x)(exp(decltype(x)(x * y))); });
    expect_derivatives<V>("expm1", [](auto x, auto y) { return decltype(x)(expm1(decltype(x)(x * y))); });
    expect_derivatives<V>("log1p", [](auto x, auto y) { return decltype(x)(log1p(decltype(x)(x * y))); });
    expect_derivatives<V>("atan", [](auto x, auto y) { return decltype(x)(atan(decltype(x)(x + y))); });
    expect_derivatives<V>("exponential", [](auto x, auto y) { return exponential(decltype(x)(x * y)); });
    expect_derivatives<V>("exponential_minus_1",
                          [](auto x, auto y) { return exponential_minus_1(decltype(x)(x * y)); });
    expect_derivatives<V>("square_root", [](auto x, auto y) { return square_root(decltype(x)(x * x + y * y)); });
    expect_derivatives<V>("ln1p", [](auto x, auto y) { return ln1p(decltype(x)(x * y)); });
    expect_derivatives<V>("ln1p, small", [](auto x, auto y) { return ln1p(decltype(x)(0.01 * x * y)); });
    expect_derivatives<V>("angular_strain", [](auto x, auto y) { return angular_strain(decltype(x)(x + y)).strain; });
    expect_derivatives<V>("angular ratio", [](auto x, auto y) { return angular_strain(decltype(x)(x + y)).ratio; });
    expect_derivatives<V>("angular_response", [](auto x, auto y) { return angular_response(decltype(x)(x * y)); });
    expect_derivatives<V>("angular_response, small",
                          [](auto x, auto y) { return angular_response(decltype(x)(0.02 * x * y)); });
}

TYPED_TEST(DualOf, Power_OfAConstantExponent_HasItsTextbookDerivative) {
    using V = TypeParam;
    const V x = Values<V>::near(0.6, 0.2);
    for (const double p : {0.5, 2.0, -1.0, 1.7}) {
        const Dual<1, V> y = pow(Dual<1, V>::variable(x, 0), p);
        const auto base = Values<V>::all(x), value = Values<V>::all(y.value), slope = Values<V>::all(y.derivative[0]);
        for (std::size_t lane = 0; lane < base.size(); ++lane) {
            EXPECT_NEAR(value[lane], std::pow(base[lane], p), round_off * value[lane]);
            const double expected = p * std::pow(base[lane], p - 1);
            EXPECT_NEAR(slope[lane], expected, round_off * std::abs(expected));
        }
    }
}

TYPED_TEST(DualOf, Functions_AtKnownPlaces_HaveTheirTextbookDerivatives) {
    using V = TypeParam;
    const auto slope = [](auto f, double x) {
        return Values<V>::all(f(Dual<1, V>::variable(V(x), 0)).derivative[0])[0];
    };
    using D = Dual<1, V>;
    EXPECT_NEAR(slope([](const D& x) { return sqrt(x); }, 4.0), 0.25, round_off);
    EXPECT_NEAR(slope([](const D& x) { return exp(x); }, 1.0), std::exp(1.0), 4 * round_off);
    EXPECT_NEAR(slope([](const D& x) { return expm1(x); }, 0.0), 1.0, round_off);
    EXPECT_NEAR(slope([](const D& x) { return log1p(x); }, 1.0), 0.5, round_off);
    EXPECT_NEAR(slope([](const D& x) { return atan(x); }, 1.0), 0.5, round_off);
    EXPECT_NEAR(slope([](const D& x) { return D(1.0) / x; }, 2.0), -0.25, round_off);
}

TYPED_TEST(DualOf, Constants_InAnyPlace_HaveNoDerivative) {
    using V = TypeParam;
    using D = Dual<3, V>;
    for (const D& x : {D(), D(V(2.0)), D(1.5), D(V(2.0)) * D(3.0), sqrt(D(4.0))})
        for (const V& derivative : x.derivative) expect_near<V>(derivative, V(0.0), 0, "constant");
}

TYPED_TEST(DualOf, Choose_ByCondition_TakesValueAndDerivativesOfOneBranch) {
    using V = TypeParam;
    using D = Dual<1, V>;
    const V x = Values<V>::near(-0.35, 0.1);  // of both signs in a pack
    const D d = D::variable(x, 0);
    const D y = choose(plain(d) > 0.0, D(2.0 * d), D(-3.0 * d));
    const auto at = Values<V>::all(x), value = Values<V>::all(y.value), slope = Values<V>::all(y.derivative[0]);
    for (std::size_t lane = 0; lane < at.size(); ++lane) {
        const double expected = at[lane] > 0 ? 2 : -3;
        EXPECT_EQ(value[lane], expected * at[lane]);
        EXPECT_EQ(slope[lane], expected);
    }
}

TEST(AnyLane, OneLaneOfAPack_DecidesBetweenAnyAndEvery) {
    const Pack x = pack_of([](std::size_t lane) { return lane == pack_width - 1 ? 1.0 : -1.0; });
    EXPECT_TRUE(any_lane(x > 0.0));
    EXPECT_FALSE(every_lane(x > 0.0));
    EXPECT_TRUE(every_lane(x > -2.0));
    EXPECT_FALSE(any_lane(x > 2.0));
    EXPECT_TRUE(any_lane(true) && every_lane(true));
    EXPECT_FALSE(any_lane(false) || every_lane(false));
}

}  // namespace
}  // namespace gneiss
