#include "fracture/softening.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/eps.hpp"
#include "support/finite_differences.hpp"

namespace gneiss {
namespace {

using test::eps;

// a dozen operations on numbers near 1
constexpr double round_off = 16 * eps;

/// z as Munjiza, Andrews and White (1999) print it.
double printed(double d) {
    const double a = 0.63, b = 1.8, c = 6;
    return (1 - (a + b - 1) / (a + b) * std::exp(d * (a + c * b) / ((a + b) * (1 - a - b)))) *
           (a * (1 - d) + b * std::pow(1 - d, c));
}

TEST(Softening, Value_OverTheRange_IsThePrintedFormula) {
    for (double d = 0; d <= 1; d += 1.0 / 64) EXPECT_NEAR(softening_value(d), printed(d), round_off) << d;
    EXPECT_NEAR(softening_value(0.0), 1, round_off);
    EXPECT_EQ(softening_value(1.0), 0);
}

TEST(Softening, Value_WithGrowingDamage_StartsFlatAndNeverRises) {
    const auto at_zero = softening_value(Dual<1>::variable(0.0, 0));
    EXPECT_NEAR(at_zero.derivative[0], 0, 16 * round_off);  // sum of terms near 5
    for (double d = 1.0 / 64; d <= 1; d += 1.0 / 64)
        EXPECT_LT(softening_value(Dual<1>::variable(d, 0)).derivative[0], 0) << d;
}

TEST(Softening, Integral_Derived_IsTheValue) {
    for (double d = 1.0 / 64; d < 1; d += 1.0 / 64) {
        const auto at = softening_and_integral(Dual<1>::variable(d, 0));
        EXPECT_NEAR(at.integral.derivative[0], at.value.value, 4 * round_off) << d;
        EXPECT_NEAR(at.value.value, softening_value(d), round_off);
    }
    EXPECT_NEAR(softening_and_integral(0.0).integral, 0, round_off);
}

// Simpson's rule, n = 2^12: truncation h^4/180 times a fourth derivative of some thousands is below 1e-13.
TEST(Softening, Integral_OverTheRange_IsZ) {
    constexpr int n = 4096;
    constexpr double truncation = 1e-12;
    double sum = printed(0) + printed(1);
    for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4 : 2) * printed(static_cast<double>(i) / n);
    EXPECT_NEAR(softening_integral, sum / (3 * n), truncation);
    EXPECT_NEAR(softening_integral, 0.3863073, 0.5e-7);  // FORMULATION 7, to all digits it shows
    EXPECT_NEAR(softening_and_integral(1.0).integral, softening_integral, round_off);
}

}  // namespace
}  // namespace gneiss
