#include "base/series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/eps.hpp"
#include "support/packs.hpp"

namespace gneiss {
namespace {

using test::eps;

constexpr long double pi = 3.14159265358979323846264338327950288L;
// A polynomial of degree 9 whose first term dominates, or a library function good to some units in the last place.
constexpr double round_off = 4 * eps;
// Three functions on top of one another, of moderate condition numbers below |c| = 2.
constexpr double chained_round_off = 10 * eps;

long double exact_ln1p(double x) { return std::log1p(static_cast<long double>(x)); }
long double exact_strain(double c) { return std::log1p(-2 / pi * std::atan(static_cast<long double>(c))); }
long double exact_ratio(double c) { return 1 / (1 - 2 / pi * std::atan(static_cast<long double>(c))); }
long double exact_response(double c) { return exact_strain(c) * exact_ratio(c); }

double relative_error(double computed, long double exact) {
    if (exact == 0) return computed == 0 ? 0 : 1;
    return static_cast<double>(std::abs((computed - exact) / exact));
}

/// Arguments of both signs and all sizes up to `largest`, with the limit of the series and its neighbours.
std::vector<double> arguments(double smallest, double largest) {
    std::vector<double> x;
    for (double size = smallest; size < largest; size *= 1.01) {
        x.push_back(size);
        x.push_back(-size);
    }
    for (const double at : {series::limit, std::nextafter(series::limit, 0.0), std::nextafter(series::limit, 1.0)}) {
        if (at >= largest) continue;
        x.push_back(at);
        x.push_back(-at);
    }
    return x;
}

struct Case {
    const char* name;
    double (*scalar)(double);
    Pack (*pack)(const Pack&);
    long double (*exact)(double);
    double tolerance;
};
const Case cases[] = {
    {"ln1p", [](double x) { return ln1p(x); }, [](const Pack& x) { return ln1p(x); }, exact_ln1p, round_off},
    {"angular_strain", [](double c) { return angular_strain(c).strain; },
     [](const Pack& c) { return angular_strain(c).strain; }, exact_strain, chained_round_off},
    {"angle ratio", [](double c) { return angular_strain(c).ratio; },
     [](const Pack& c) { return angular_strain(c).ratio; }, exact_ratio, chained_round_off},
    {"angular_response", [](double c) { return angular_response(c); },
     [](const Pack& c) { return angular_response(c); }, exact_response, chained_round_off},
};

TEST(Series, EveryLaneSmall_AgreesWithExtendedPrecision) {
    for (const Case& f : cases)
        for (const double x : arguments(1e-300, series::limit))
            for (const double y : lanes(f.pack(Pack(x))))
                ASSERT_LE(relative_error(y, f.exact(x)), f.tolerance) << f.name << " at " << x;
}

TEST(Series, EveryLaneLarge_AgreesWithExtendedPrecision) {
    for (const Case& f : cases)
        for (const double x : arguments(series::limit / 2, 0.9))
            for (const double y : lanes(f.pack(Pack(x))))
                ASSERT_LE(relative_error(y, f.exact(x)), f.tolerance) << f.name << " at " << x;
}

TEST(Series, SmallAndLargeLanesMixed_AgreesWithExtendedPrecisionInEach) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> exponent(-18, 0), sign(-1, 1);
    for (int trial = 0; trial < 2000; ++trial) {
        const Pack x = pack_of([&](std::size_t lane) {
            if (lane == 0) return 0.5;  // keeps the whole pack off the series
            return 0.9 * std::copysign(std::pow(10.0, exponent(random)), sign(random));
        });
        const auto at = lanes(x);
        for (const Case& f : cases) {
            const auto y = lanes(f.pack(x));
            for (std::size_t lane = 0; lane < pack_width; ++lane)
                ASSERT_LE(relative_error(y[lane], f.exact(at[lane])), f.tolerance) << f.name << " at " << at[lane];
        }
    }
}

TEST(Series, ScalarTwin_AgreesWithExtendedPrecision) {
    for (const Case& f : cases)
        for (const double x : arguments(1e-300, 0.9))
            ASSERT_LE(relative_error(f.scalar(x), f.exact(x)), f.tolerance) << f.name << " at " << x;
}

TEST(Series, AcrossTheLimit_SeriesAndLibraryMeet) {
    for (const Case& f : cases) {
        for (const double sign : {1.0, -1.0}) {
            const double below = sign * std::nextafter(series::limit, 0.0), at = sign * series::limit;
            const double step = std::abs(lanes(f.pack(Pack(at)))[0] - lanes(f.pack(Pack(below)))[0]);
            EXPECT_LE(step, 2 * f.tolerance * std::abs(static_cast<double>(f.exact(at)))) << f.name;
        }
    }
}

TEST(Series, AtZero_IsExactlyZero) {
    for (const Case& f : cases) {
        if (f.exact == exact_ratio) continue;
        EXPECT_EQ(lanes(f.pack(Pack(0.0)))[0], 0.0) << f.name;
        EXPECT_EQ(f.scalar(0.0), 0.0) << f.name;
    }
    EXPECT_EQ(angular_strain(0.0).ratio, 1.0);
    EXPECT_EQ(lanes(angular_strain(Pack(0.0)).ratio)[0], 1.0);
}

}  // namespace
}  // namespace gneiss
