#include "fracture/envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fracture/cohesion_law.hpp"
#include "support/eps.hpp"
#include "unit/fracture/loaded_point.hpp"

namespace gneiss {
namespace {

using test::eps;
using Law = MixedModeLaw<Insertion::extrinsic>;

constexpr double round_off = 16 * eps;  // relative: a dozen operations

TEST(Envelope, Index_OfTheThreeStrengths_IsOne) {
    const auto p = rock_joint();
    EXPECT_DOUBLE_EQ(envelope_index(p, p.tensile_strength, 0.0), 1);
    for (const double sign : {1.0, -1.0}) {
        EXPECT_DOUBLE_EQ(envelope_index(p, 0.0, sign * p.cohesion), 1);
        const double pressure = 10e6;  // Mohr-Coulomb: c_0 + tan phi_i times it
        EXPECT_NEAR(envelope_index(p, -pressure, sign * (p.cohesion + 0.8 * pressure)), 1, 4 * round_off);
    }
    EXPECT_NEAR(envelope_index(p, 0.6 * p.tensile_strength, 0.8 * p.cohesion), 1, round_off);
    EXPECT_EQ(envelope_index(p, -1e9, 0.0), 0);
}

/// Tractions on the envelope, beyond and below: tension, mixed, under pressure with friction at its limit and below.
constexpr double tractions[][2] = {{3e6, 0},       {1.8e6, -4.8e6}, {-5e6, 10e6}, {-5e6, -10.4e6},
                                   {3.1e6, 0.5e6}, {-20e6, 3e6},    {2e6, 1e6}};

TEST(InsertedPoint, AtRest_HasTheTractionOfTheEdge) {
    for (const auto& [normal, shear] : tractions) {
        const auto p = rock_joint();
        const InsertedPoint<double> point = insert_point(p, normal, shear);
        LoadedPoint<Law> joint{.properties = p, .history = point.history};
        joint.properties.tensile_strength *= point.strength_factor;
        joint.properties.cohesion *= point.strength_factor;
        EXPECT_NEAR(joint.traction().normal, normal, round_off * std::abs(normal));
        EXPECT_NEAR(joint.traction().shear, shear, round_off * std::abs(shear));
        EXPECT_NEAR(joint.stored(), point.offset_energy, round_off * point.offset_energy);
        EXPECT_EQ(point.strength_factor > 1 + eps, envelope_index(p, normal, shear) > 1 + 4 * eps);
    }
}

// 3 MPa on 3e12 Pa/m hold 1.5 J/m2.
TEST(InsertedPoint, InTension_HasTheOffsetAndTheEnergyOfItsStrength) {
    const auto p = rock_joint();
    const InsertedPoint<double> point = insert_point(p, 3e6, 0.0);
    EXPECT_DOUBLE_EQ(point.history.opening_offset, peak_opening);
    EXPECT_DOUBLE_EQ(point.offset_energy, 1.5);
    EXPECT_EQ(point.history.slip_offset, 0);
    EXPECT_EQ(point.history.slider, 0);
}

TEST(InsertedPoint, UnderPressure_PartsShearIntoFrictionAtItsLimitAndTheRest) {
    const InsertedPoint<double> point = insert_point(rock_joint(), -5e6, -10e6);
    EXPECT_DOUBLE_EQ(point.history.slip_offset, -6e6 / 3e12);
    EXPECT_DOUBLE_EQ(point.history.slider, 4e6 / 3e12);
    EXPECT_DOUBLE_EQ(point.history.opening_offset, -5e6 / 3e12);
    EXPECT_DOUBLE_EQ(point.offset_energy, 0.5 * (25 + 36 + 16) / 3);
}

TEST(InsertedPoint, FoundBeyondTheEnvelope_GetsTheStrengthThatItHad) {
    EXPECT_NEAR(insert_point(rock_joint(), 3.3e6, 0.0).strength_factor, 1.1, round_off);
    EXPECT_EQ(insert_point(rock_joint(), 2e6, 0.0).strength_factor, 1);
}

}  // namespace
}  // namespace gneiss
