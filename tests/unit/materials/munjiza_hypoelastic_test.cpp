#include "materials/munjiza_hypoelastic.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "materials/munjiza_hyperelastic.hpp"
#include "support/deformation.hpp"
#include "support/eps.hpp"
#include "support/finite_differences.hpp"
#include "support/laws.hpp"
#include "support/packs.hpp"

namespace gneiss {
namespace {

using test::eps;

constexpr double round_off = 100 * eps * modulus;

// ---- VERIFICATION 10
// -------------------------------------------------------------------------------------------------

template <class Direct>
class HypoAgainstHyper : public testing::Test {};
using BothMaps = testing::Types<std::false_type, std::true_type>;
TYPED_TEST_SUITE(HypoAgainstHyper, BothMaps);

TYPED_TEST(HypoAgainstHyper, ConstantModuli_AlongARandomPath_GiveTheSameStresses) {
    constexpr bool direct = TypeParam::value;
    const MunjizaHyperelastic<direct> hyper{anisotropic};
    const MunjizaHypoelastic<direct> hypo{anisotropic, {}};
    constexpr int steps = 5000;
    // Each step rounds a stress of at most 0.3 * 1.6e9 Pa once: eps/2 each, at worst all in one direction; and the
    // strains.
    constexpr double tolerance = 1e-12 * modulus;
    static_assert(steps * 0.5 * eps * 0.5 < 1e-12);
    std::mt19937 random(10);
    std::normal_distribution<double> normal(0, 1);
    for (const double axis : axis_angles_under_test) {
        auto memory = memory_at_rest(hypo, axis);
        const auto hyper_memory = memory_at_rest(hyper, axis);
        Tensor<double> h{};
        double angle = 0, largest = 0;
        for (int step = 0; step < steps; ++step) {
            for (double& x : h) x = 0.98 * x + 0.02 * normal(random);  // stays near 0.1
            angle += 0.1 * normal(random);                             // turns as it likes
            const Tensor<double> moved = rotated(angle, h);
            const auto p = first_piola(hypo, moved, axis, memory);
            const auto expected = first_piola(hyper, moved, axis, hyper_memory);
            ASSERT_LE((matrix(p) - matrix(expected)).cwiseAbs().maxCoeff(), tolerance) << "step " << step;
            largest = std::max(largest, matrix(p).cwiseAbs().maxCoeff());
            memory = updated(hypo, moved, axis, memory);
        }
        EXPECT_GT(largest, 0.05 * modulus) << "the path went nowhere";
    }
}

TYPED_TEST(HypoAgainstHyper, ConstantModuli_LedgerOfAnOpenPath_IsTheStoredEnergy) {
    if constexpr (!TypeParam::value) {
        const MunjizaHyperelastic<false> hyper{anisotropic};
        const MunjizaHypoelastic<false> hypo{anisotropic, {}};
        for (const Tensor<double>& end : finite_deformations()) {
            auto memory = memory_at_rest(hypo, 0.4);
            for (const double s : {0.3, 0.9, 0.5, 1.0}) memory = updated(hypo, scaled(s, end), 0.4, memory);
            const auto point = point_at(end, 0.4);
            EXPECT_NEAR(memory.z[4], hyper.energy_density(point, hyper.volume(point.area_strain)), round_off);
        }
    }
}

// ---- stress in situ
// --------------------------------------------------------------------------------------------------

TYPED_TEST(HypoAgainstHyper, StressInSitu_OnAnyAxes_IsTheCauchyStressAtRest) {
    constexpr bool direct = TypeParam::value;
    Eigen::Matrix2d sigma{{-8e6, 3e6}, {3e6, -21e6}};
    for (const Stiffening& stiffening : {Stiffening{}, stiffening_rock}) {
        const MunjizaHypoelastic<direct> law{anisotropic, stiffening};
        for (const double axis : axis_angles_under_test) {
            const Eigen::Matrix2d on_axes = rotation(axis).transpose() * sigma * rotation(axis);
            auto memory = law.initial_memory({on_axes(0, 0), on_axes(1, 1), on_axes(0, 1)});
            // one update without a step, as a block does
            memory = updated(law, at_rest, axis, memory);
            EXPECT_LE((cauchy_of(first_piola(law, at_rest, axis, memory), at_rest) - sigma).cwiseAbs().maxCoeff(),
                      20 * eps * sigma.cwiseAbs().maxCoeff());
            EXPECT_EQ(memory.z[4], 0) << "stress that is there from the start has done no work";
            // a rigid rotation takes it along
            const Tensor<double> turned_h = rigid_rotation(1.2);
            const Eigen::Matrix2d turned_sigma = rotation(1.2) * sigma * rotation(1.2).transpose();
            EXPECT_LE(
                (cauchy_of(first_piola(law, turned_h, axis, memory), turned_h) - turned_sigma).cwiseAbs().maxCoeff(),
                round_off);
        }
    }
}

// ---- stiffening
// ------------------------------------------------------------------------------------------------------

const Stiffening laws[] = {{2, 5e7, 0.5}, {2, 5e7, 1}, {0.3, 1e6, 0.1}, {10, 1e8, 0.9}};
const double start_pressures[] = {-3e7, -1.0, 0, 1.0, 2e7, 4e8};
const double pressure_steps[] = {6e7, -6e7, 1e8, -5e8, 3e6, -2.0, 1e-3, -1e-6, 1e-12};

/// How far p goes on dp/ds = g(p) pi, s from 0 to 1: quadrature up to p = 0, from there on its own side.
long double integrated_step(const Stiffening& law, long double start, long double pi) {
    const auto g = [&](long double p) {
        return p > 0 ? std::pow(1 + law.k * p / law.p_ref, static_cast<long double>(law.n)) : 1.0L;
    };
    constexpr int n = 2000;
    long double s = 0, gone = 0;
    if (start * pi < 0) {
        // s at p = 0 from ds = dp/(g pi), Simpson
        long double integral = 0;
        for (int i = 0; i < n; ++i) {
            const long double a = start * i / n, b = start * (i + 1) / n;
            integral += (b - a) / 6 * (1 / g(a) + 4 / g((a + b) / 2) + 1 / g(b));
        }
        const long double to_zero = -integral / pi;
        if (to_zero < 1) {
            s = to_zero;
            gone = -start;
        }
    }
    const long double ds = (1 - s) / n;
    const auto rate = [&](long double step) { return g(start + step) * pi; };
    for (int i = 0; i < n; ++i) {  // classical Runge-Kutta on the step itself: small against p, it keeps its digits
        const long double k1 = rate(gone), k2 = rate(gone + ds / 2 * k1), k3 = rate(gone + ds / 2 * k2);
        const long double k4 = rate(gone + ds * k3);
        gone += ds / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return gone;
}

// Order 4 in 2000 steps of a function that varies over a hundredth of the path: 1e-11; around p = 0 the midpoint rule
// of tiny steps is off by n kappa pi/4, at most 2.5e-9.
constexpr double integration_error = 1e-10;
constexpr double midpoint_error = 2.5e-9;

TEST(Stiffening, MeanFactor_OfAnyStep_IsTheIntegralAlongIt) {
    for (const Stiffening& law : laws) {
        for (const double p : start_pressures) {
            for (const double pi : pressure_steps) {
                if (std::abs(pi) < 1e-9 * std::abs(p)) continue;  // below what even extended precision resolves
                const double expected = static_cast<double>(integrated_step(law, p, pi) / pi);
                EXPECT_NEAR(law.mean_factor(p, pi), expected, (integration_error + midpoint_error) * expected)
                    << "k " << law.k << ", n " << law.n << ", p " << p << ", step " << pi;
            }
        }
    }
}

TEST(Stiffening, MeanFactor_OfAVanishingStep_IsTheFactorItself) {
    for (const Stiffening& law : laws)
        for (const double p : start_pressures)
            for (const double pi : {0.0, 1e-300, -1e-300, 1e-20})
                EXPECT_NEAR(law.mean_factor(p, pi), law.factor(p), 4 * eps * law.factor(p)) << "p " << p;
}

TEST(Stiffening, MeanFactor_OfSmallSteps_KeepsItsDigitsAndThoseOfItsDerivative) {
    // Away from p = 0: mean = g + g g' pi/2 + O((kappa pi)^2) for kappa pi up to 1e-4, derivative g g'/2 + O(kappa^2
    // pi).
    const Stiffening law = stiffening_rock;
    const double p = 3e7, kappa = law.k / law.p_ref;
    const double g = std::sqrt(1 + kappa * p), slope = 0.5 * kappa / g;
    for (double pi = 1e-12; kappa * pi < 1e-4; pi *= 3) {
        for (const double step : {pi, -pi}) {
            const auto mean = law.mean_factor(Dual<1>(p), Dual<1>::variable(step, 0));
            const double x = kappa * pi;
            EXPECT_NEAR(mean.value, g + 0.5 * g * slope * step, (4 * eps + x * x) * g) << step;
            // the derivative of a quotient loses eps/x, from where the midpoint rule takes over at x = 1e-8
            EXPECT_NEAR(mean.derivative[0], 0.5 * g * slope, (8 * eps / std::max(x, 1e-8) + x) * kappa * g) << step;
        }
    }
}

TEST(Stiffening, OneStep_EqualsTwoHalfSteps) {
    for (const Stiffening& law : laws) {
        for (const double p : start_pressures) {
            for (const double pi : pressure_steps) {
                const double whole = law.mean_factor(p, pi) * pi;
                const double first = law.mean_factor(p, pi / 2) * (pi / 2);
                const double second = law.mean_factor(p + first, pi / 2) * (pi / 2);
                // the sum p + first is rounded, and g answers with n kappa times that
                const double rounded = 4 * eps * (std::abs(whole) + law.k / law.p_ref * std::abs(p) * std::abs(whole));
                EXPECT_NEAR(first + second, whole, rounded + midpoint_error * (std::abs(p) <= 1 ? std::abs(whole) : 0))
                    << "n " << law.n << ", p " << p << ", step " << pi;
            }
        }
    }
}

TEST(Stiffening, LoadingAndUnloading_ReturnToTheStart) {
    for (const Stiffening& law : laws) {
        for (const double p : start_pressures) {
            for (const double pi : {6e7, -6e7, 3e8}) {
                const double there = p + law.mean_factor(p, pi) * pi;
                const double back = there - law.mean_factor(there, -pi) * pi;
                EXPECT_NEAR(back, p, 100 * eps * std::max(std::abs(there), std::abs(p)));
            }
        }
    }
}

TEST(Stiffening, Factor_AtKnownPressures_IsThePowerLaw) {
    const Stiffening law{3, 1e6, 0.5};
    EXPECT_DOUBLE_EQ(law.factor(1e6), 2);
    EXPECT_DOUBLE_EQ(law.factor(5e6), 4);
    EXPECT_EQ(law.factor(0.0), 1);
    EXPECT_EQ(law.factor(-1e6), 1) << "tension neither stiffens nor softens";
    EXPECT_FALSE(Stiffening{}.active());
    EXPECT_FALSE((Stiffening{2, 1, 0}.active()));
    EXPECT_TRUE(law.active());
}

TEST(Stiffening, Packs_OfMixedLanes_AgreeWithScalars) {
    for (const Stiffening& law : laws) {
        for (std::size_t shift = 0; shift < std::size(pressure_steps); ++shift) {
            const Pack p = pack_of([](std::size_t lane) { return start_pressures[lane % std::size(start_pressures)]; });
            const Pack pi =
                pack_of([&](std::size_t lane) { return pressure_steps[(lane + shift) % std::size(pressure_steps)]; });
            const auto mean = lanes(law.mean_factor(p, pi));
            for (std::size_t lane = 0; lane < pack_width; ++lane) {
                const double expected = law.mean_factor(lanes(p)[lane], lanes(pi)[lane]);
                EXPECT_NEAR(mean[lane], expected, 50 * eps * expected) << lanes(p)[lane] << ", " << lanes(pi)[lane];
            }
        }
    }
}

TEST(Stiffening, TangentConstants_UnderPressure_GrowByTheFactor) {
    const MunjizaHypoelastic<false> law{anisotropic, {3, 1e6, 0.5}};
    const auto memory = law.initial_memory({0, 0, 5e5});
    EXPECT_EQ(law.tangent_constants(memory), anisotropic) << "shear alone makes no pressure";
    MunjizaHypoelastic<false>::Memory<double> pressed{};
    pressed.z = {-5e5, -3e5, -7e5, 1e5, 0};  // p = 1e6
    const auto constants = law.tangent_constants(pressed);
    EXPECT_DOUBLE_EQ(constants.M_v, 2 * anisotropic.M_v);
    EXPECT_DOUBLE_EQ(constants.M_alpha, 2 * anisotropic.M_alpha);
    EXPECT_DOUBLE_EQ(constants.M_beta, 2 * anisotropic.M_beta);
    EXPECT_DOUBLE_EQ(constants.M_psi, 2 * anisotropic.M_psi);
}

TEST(Stiffening, ConfinedCompression_StepByStep_FollowsItsClosedForm) {
    // e_v = e_alpha = e, e_beta = e_psi = 0: p' = -g (M_v + M_alpha/2) e', for n = 1/2: sqrt(1 + kappa p) = 1 + kappa/2
    // |.|
    const MunjizaHypoelastic<false> law{anisotropic, stiffening_rock};
    const double kappa = stiffening_rock.k / stiffening_rock.p_ref;
    auto memory = memory_at_rest(law, 0.0);
    for (const double stretch : {0.99, 0.9, 0.95, 0.8}) {  // unloads once on the way
        memory = updated(law, {stretch - 1, 0, 0, 0}, 0.0, memory);
        const double e = std::log(stretch);
        const double root = 1 - 0.5 * kappa * (anisotropic.M_v + 0.5 * anisotropic.M_alpha) * e;
        const double p = (root * root - 1) / kappa;
        const double share = p / (anisotropic.M_v + 0.5 * anisotropic.M_alpha);
        EXPECT_NEAR(memory.z[0], -anisotropic.M_v * share, round_off);
        EXPECT_NEAR(memory.z[1], -anisotropic.M_alpha * share, round_off);
        EXPECT_NEAR(memory.z[2], 0, round_off);
        EXPECT_NEAR(memory.z[3], 0, round_off);
    }
}

TEST(Stiffening, ClosedCycle_LedgerIsTheWorkOfItsStressesByIndependentQuadrature) {
    // A square in (e_alpha, shear) would keep p straight; an ellipse in (e_alpha, e_beta) without rotation does not.
    const MunjizaHypoelastic<false> law{anisotropic, stiffening_rock};
    constexpr double size = 0.05;
    const auto strain = [](double s) { return std::array{-size * (1 - std::cos(s)), 0.7 * size * std::sin(s)}; };
    const auto h_at = [&](double s) {
        return Tensor<double>{std::expm1(strain(s)[0]), 0, 0, std::expm1(strain(s)[1])};
    };
    // m' = g(p) M e', work' = m . e' with e_v = e_alpha + e_beta: Runge-Kutta, all in this test
    const auto rate = [&](double s, const std::array<double, 4>& y) {
        const double a = -size * std::sin(s), b = 0.7 * size * std::cos(s), v = a + b;
        const double p = -(y[0] + 0.5 * (y[1] + y[2]));
        const double g = p > 0 ? std::sqrt(1 + stiffening_rock.k * p / stiffening_rock.p_ref) : 1;
        return std::array{g * anisotropic.M_v * v, g * anisotropic.M_alpha * a, g * anisotropic.M_beta * b,
                          y[0] * v + y[1] * a + y[2] * b};
    };
    std::array<double, 4> y{};
    constexpr int fine = 20000;
    const double ds = 2 * std::numbers::pi / fine;
    const auto moved = [](std::array<double, 4> x, double f, const std::array<double, 4>& dx) {
        for (std::size_t k = 0; k < 4; ++k) x[k] += f * dx[k];
        return x;
    };
    for (int i = 0; i < fine; ++i) {
        const auto k1 = rate(i * ds, y), k2 = rate((i + 0.5) * ds, moved(y, ds / 2, k1));
        const auto k3 = rate((i + 0.5) * ds, moved(y, ds / 2, k2)), k4 = rate((i + 1) * ds, moved(y, ds, k3));
        y = moved(moved(moved(moved(y, ds / 6, k1), ds / 3, k2), ds / 3, k3), ds / 6, k4);
    }
    const auto ledger = [&](int steps) {
        auto memory = memory_at_rest(law, 0.0);
        for (int i = 1; i <= steps; ++i) memory = updated(law, h_at(2 * std::numbers::pi * i / steps), 0.0, memory);
        return memory.z[4];
    };
    const double work = y[3], coarse = ledger(500) - work, half = ledger(1000) - work;
    EXPECT_GT(std::abs(work), 1e-2 * modulus * size * size) << "this cycle creates or loses nothing";
    EXPECT_NEAR(observed_order(std::abs(coarse), std::abs(half)), 2, 0.15);
    EXPECT_LE(std::abs(half), 1e-3 * std::abs(work));
}

}  // namespace
}  // namespace gneiss
