// Both ways in: their law, their energies. What every law must fulfil is in law_contract_test.cpp.

#include "fracture/cohesion_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fracture/envelope.hpp"
#include "support/eps.hpp"
#include "support/finite_differences.hpp"
#include "unit/fracture/loaded_point.hpp"

namespace gneiss {
namespace {

using test::eps;

// Relative to strengths and energies: some tens of operations, and damage summed over up to a thousand steps.
constexpr double round_off = 1e-12;

/// A path of constant mix omega: where it meets the envelope, and in which direction it goes on.
struct Mix {
    double omega;
    double x() const { return std::sqrt(omega); }
    double y() const { return std::sqrt(1 - omega); }
};
constexpr double mixes[] = {1, 0, 0.5, 0.1, 0.9};

/// The law on a constant mix, from FORMULATION 7 by hand: traction relative to the elastic one.
double law(Insertion insertion, double omega, double lambda_max) {
    const double b = 0.06 * omega + 0.04 * (1 - omega), Z = softening_integral;
    const double q = insertion == Insertion::extrinsic ? Z * b : Z * b / (1 - b / 2);
    const double d = std::min(1.0, q * (lambda_max - 1));
    return softening_value(d) / lambda_max;
}

template <class Law>
struct Ways;
template <>
struct Ways<MixedModeLaw<Insertion::extrinsic>> {
    static constexpr Insertion insertion = Insertion::extrinsic;
    /// At the envelope: offsets in place of opening and slip.
    static LoadedPoint<MixedModeLaw<insertion>> at_envelope(Mix mix) {
        const auto p = rock_joint();
        return {.history = insert_point(p, mix.x() * p.tensile_strength, mix.y() * p.cohesion).history};
    }
    static double opening_of(Mix mix, double lambda) { return (lambda - 1) * mix.x() * peak_opening; }
    static double slip_of(Mix mix, double lambda) { return (lambda - 1) * mix.y() * peak_slip; }
};
template <>
struct Ways<MixedModeLaw<Insertion::intrinsic>> {
    static constexpr Insertion insertion = Insertion::intrinsic;
    static LoadedPoint<MixedModeLaw<insertion>> at_envelope(Mix) { return {}; }
    static double opening_of(Mix mix, double lambda) { return lambda * mix.x() * peak_opening; }
    static double slip_of(Mix mix, double lambda) { return lambda * mix.y() * peak_slip; }
};

template <class Law>
class BothWays : public testing::Test {
protected:
    using Way = Ways<Law>;
    static LoadedPoint<Law> start(Mix mix) { return Way::at_envelope(mix); }
    static void move(LoadedPoint<Law>& joint, Mix mix, double lambda, int n) {
        joint.move_to(Way::opening_of(mix, lambda), Way::slip_of(mix, lambda), n);
    }
};
using Laws = testing::Types<MixedModeLaw<Insertion::extrinsic>, MixedModeLaw<Insertion::intrinsic>>;
TYPED_TEST_SUITE(BothWays, Laws);

// Softening ends near lambda = 1/(Z B) = 40 to 66; cycles of unloading to the origin of o*, s* and reloading on the
// way.
TYPED_TEST(BothWays, ConstantMix_WithUnloadingCycles_FollowsTheLaw) {
    for (const double omega : mixes) {
        for (const int n : {1, 7, 100}) {
            const Mix mix{omega};
            auto joint = this->start(mix);
            double lambda_max = 1;
            for (const double lambda : {1.0, 0.4, 5.0, 2.0, 12.0, 0.0, 6.0, 30.0, 29.0, 45.0, 10.0, 80.0, 3.0}) {
                this->move(joint, mix, lambda, n);
                lambda_max = std::max(lambda_max, lambda);
                const double expected = lambda * law(Ways<TypeParam>::insertion, omega, lambda_max);
                EXPECT_NEAR(joint.traction().normal, expected * mix.x() * 3e6, round_off * 3e6)
                    << omega << " " << lambda;
                EXPECT_NEAR(joint.traction().shear, expected * mix.y() * 6e6, round_off * 6e6)
                    << omega << " " << lambda;
            }
            EXPECT_EQ(joint.history.damage, 1);
        }
    }
}

TYPED_TEST(BothWays, PureModes_InStepsOfAnySize_DissipateGExactly) {
    for (const double omega : {1.0, 0.0}) {
        const double G = omega == 1 ? 50 : 300;
        for (const int n : {1, 2, 3, 17, 1000}) {
            auto joint = this->start({omega});
            const double offset_energy = joint.stored();
            this->move(joint, {omega}, 90, n);
            EXPECT_NEAR(joint.history.fracture() - offset_energy, G, round_off * G) << n << " steps, omega " << omega;
            EXPECT_EQ(joint.stored(), 0);
            EXPECT_EQ(joint.history.friction, 0);
        }
    }
}

// Work by mode: z depends on lambda alone, so that W_I : W_II = f_t o_p omega : c_0 s_p (1 - omega).
TYPED_TEST(BothWays, ConstantMix_InStepsOfAnySize_FulfilsTheSumOfWorks) {
    for (const double omega : {0.5, 0.1, 0.9}) {
        for (const int n : {1, 2, 3, 17, 1000}) {
            auto joint = this->start({omega});
            const double offset_energy = joint.stored();
            this->move(joint, {omega}, 90, n);
            const double work = joint.history.fracture() - offset_energy;
            const double share = 3 * omega / (3 * omega + 12 * (1 - omega));
            EXPECT_NEAR(work * share / 50 + work * (1 - share) / 300, 1, round_off) << n << " steps, omega " << omega;
            EXPECT_NEAR(joint.history.fracture_i / joint.history.fracture(), share, round_off) << n << " " << omega;
        }
    }
}

// The same from tractions alone. Trapezoidal rule with 4000 steps over 90 o_p: h^2/12 times the jump of the slope where
// softening begins, and kinks of the elastic branch and at D = 1 within a step: below 1e-4; VERIFICATION 14 asks for
// 1e-3.
TYPED_TEST(BothWays, Work_MeasuredByTractions_FulfilsTheSumOfWorks) {
    for (const double omega : mixes) {
        auto joint = this->start({omega});
        this->move(joint, {omega}, 90, 4000);
        EXPECT_NEAR(joint.work_normal / 50 + joint.work_shear / 300, 1, 1e-4) << omega;
    }
}

TYPED_TEST(BothWays, UnloadingCycles_DissipateNothing) {
    for (const double omega : mixes) {
        auto joint = this->start({omega});
        this->move(joint, {omega}, 20, 3);
        const double fracture = joint.history.fracture();
        this->move(joint, {omega}, 0, 5);
        this->move(joint, {omega}, 20 * (1 - eps), 5);
        EXPECT_NEAR(joint.history.fracture(), fracture, round_off * fracture);
    }
}

TYPED_TEST(BothWays, ClosedAfterFailure_HasNoCohesionButCompression) {
    auto joint = this->start({1.0});
    this->move(joint, {1.0}, 90, 10);
    ASSERT_EQ(joint.history.damage, 1);
    const double offset = joint.history.opening_offset;
    joint.move_to(20e-6, 7e-6);
    EXPECT_EQ(joint.traction().normal, 0);
    EXPECT_EQ(joint.traction().shear, 0);
    joint.move_to(0, 7e-6);
    EXPECT_EQ(joint.traction().normal, 0);
    joint.move_to(-offset - 2e-6, 7e-6);
    EXPECT_NEAR(joint.traction().normal, -6e6, round_off * 6e6);
    EXPECT_EQ(joint.traction().shear, 0);
    joint.move_to(-offset - 2e-6, 20e-6);
    EXPECT_NEAR(joint.traction().shear, 0.5 * 6e6, round_off * 6e6);  // tan phi_r times the pressure
}

TYPED_TEST(BothWays, Compression_OfAnyDamage_IsElasticWithThePenalty) {
    for (const double lambda : {1.0, 10.0, 90.0}) {
        auto joint = this->start({1.0});
        this->move(joint, {1.0}, lambda, 4);
        const double fracture = joint.history.fracture(), offset = joint.history.opening_offset;
        joint.move_to(-offset - 5e-6, 0, 3);
        EXPECT_NEAR(joint.traction().normal, -15e6, round_off * 15e6);
        EXPECT_NEAR(joint.stored(), 0.5 * 15e6 * 5e-6, round_off * 75);
        EXPECT_EQ(joint.history.fracture(), fracture);
    }
}

/// Pressure 5 MPa, then shear to 200 s_p: peak c_0 + 0.8 p = 10 MPa, rest 0.5 p.
template <class Law>
LoadedPoint<Law> pressed(CohesionProperties<double> properties);
template <>
LoadedPoint<MixedModeLaw<Insertion::extrinsic>> pressed(CohesionProperties<double> properties) {
    return {.properties = properties, .history = insert_point(properties, -5e6, 10e6).history};
}
template <>
LoadedPoint<MixedModeLaw<Insertion::intrinsic>> pressed(CohesionProperties<double> properties) {
    LoadedPoint<MixedModeLaw<Insertion::intrinsic>> joint{.properties = properties};
    joint.move_to(-5e6 / 3e12, 0);
    joint.move_to(-5e6 / 3e12, 10e6 / 3e12);  // elastic with k up to the peak
    EXPECT_NEAR(joint.traction().shear, 10e6, round_off * 10e6);
    return joint;
}

TYPED_TEST(BothWays, ShearUnderPressure_StartsAtMohrCoulombAndEndsAtResidualFriction) {
    auto joint = pressed<TypeParam>(rock_joint());
    const double o = joint.opening, s = joint.slip;
    EXPECT_NEAR(joint.traction().shear, 10e6, round_off * 10e6);
    for (int i = 1; i <= 100; ++i) {
        const double further = 2e-6 * i;
        joint.move_to(o, s + further);
        const double lambda = 1 + further / peak_slip;
        const double z = lambda * law(Ways<TypeParam>::insertion, 0, lambda);
        const double friction = (0.8 - 0.3 * joint.history.damage) * 5e6;
        EXPECT_NEAR(joint.traction().shear, z * 6e6 + friction, round_off * 10e6) << further;
    }
    EXPECT_EQ(joint.history.damage, 1);
    joint.move_to(o, 400e-6);
    EXPECT_NEAR(joint.traction().shear, 0.5 * 5e6, round_off * 10e6);
    EXPECT_NEAR(joint.traction().normal, -5e6, round_off * 5e6);
}

// With one coefficient of friction the limit is constant. Friction takes limit times slip since the parting, and an
// intrinsic joint on top the limit times c_0/k that it books where shear is parted; G_II is what it was.
TYPED_TEST(BothWays, ShearUnderPressure_InStepsOfAnySize_KeepsFrictionAndFractureApart) {
    CohesionProperties<double> properties = rock_joint();
    properties.tan_phi_residual = properties.tan_phi_initial;
    for (const int n : {1, 2, 50}) {
        auto joint = pressed<TypeParam>(properties);
        const double o = joint.opening, s = joint.slip;
        const double offset_energy = 0.5 * joint.history.slip_offset * joint.history.slip_offset * 3e12;
        const bool extrinsic = Ways<TypeParam>::insertion == Insertion::extrinsic;
        const double parting = extrinsic ? 0 : 4e6 * 2e-6;
        joint.move_to(o, s + 300e-6, n);
        const double G = extrinsic ? 300 + offset_energy : 300;
        EXPECT_NEAR(joint.history.friction, 4e6 * 300e-6 + parting, round_off * 1200) << n;
        EXPECT_NEAR(joint.history.fracture(), G, round_off * 300) << n;
    }
}

// From the elastic branch beyond the envelope under pressure in one step or in many: the same traction and the same
// energies, although shear is parted within a step. While D < 1 the limit of friction falls linearly with slip, which
// the slider follows exactly.
TEST(IntrinsicJoint, PartedWithinAStep_EndsWhereManyStepsEnd) {
    using Joint = LoadedPoint<MixedModeLaw<Insertion::intrinsic>>;
    for (const double sign : {1.0, -1.0}) {
        Joint at_once, by_steps;
        for (Joint* joint : {&at_once, &by_steps}) joint->move_to(-2e-6, 0);
        at_once.move_to(-2e-6, sign * 50e-6);
        by_steps.move_to(-2e-6, sign * 50e-6, 377);
        EXPECT_NEAR(at_once.traction().shear, by_steps.traction().shear, round_off * 10e6);
        EXPECT_NEAR(at_once.history.fracture(), by_steps.history.fracture(), round_off * 300);
        EXPECT_NEAR(at_once.history.friction, by_steps.history.friction, round_off * 300);
        EXPECT_NEAR(at_once.stored(), by_steps.stored(), round_off * 300);
    }
}

TEST(IntrinsicJoint, BelowTheEnvelope_RemembersNothing) {
    LoadedPoint<MixedModeLaw<Insertion::intrinsic>> joint;
    for (const auto& [o, s] : {std::pair{0.7e-6, 1.3e-6}, {-5e-6, 5.9e-6}, {-9e-6, -9e-6}, {0.99e-6, 0.0}}) {
        joint.move_to(o, s);
        EXPECT_DOUBLE_EQ(joint.traction().normal, 3e12 * o);
        EXPECT_DOUBLE_EQ(joint.traction().shear, 3e12 * s);
        EXPECT_DOUBLE_EQ(joint.stored(), 1.5e12 * (o * o + s * s));
        for (const auto member : joint.history.members) EXPECT_EQ(joint.history.*member, 0);
    }
}

/// Damage after a quarter of an ellipse from mode I to mode II, growing, in n steps.
template <class Law>
double damage_on_turning_path(LoadedPoint<Law> joint, int n) {
    for (int i = 0; i <= n; ++i) {
        const double part = static_cast<double>(i) / n, angle = 1.5 * part, lambda = 1.5 + 20 * part;
        joint.move_to(lambda * std::cos(angle) * peak_opening - joint.history.opening_offset,
                      lambda * std::sin(angle) * peak_slip);
    }
    return joint.history.damage;
}

// Where the mix changes, damage is of order 2 in the step.
TYPED_TEST(BothWays, TurningMix_WithSmallerSteps_ConvergesWithOrderTwo) {
    const auto joint = this->start({1.0});
    const double reference = damage_on_turning_path(joint, 4096);
    double error = std::abs(damage_on_turning_path(joint, 16) - reference);
    EXPECT_LT(error, 1e-3);  // h^2/12 times a second derivative of q over its range, (1.5/16)^2/12 0.4
    for (const int n : {32, 64, 128}) {
        const double finer = std::abs(damage_on_turning_path(joint, n) - reference);
        EXPECT_NEAR(observed_order(error, finer), 2, 0.15) << n;
        error = finer;
    }
}

}  // namespace
}  // namespace gneiss
