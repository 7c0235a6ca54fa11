#include "materials/elastic_constants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "materials/small_strain_stiffness.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;

// Inverting a 3 x 3 compliance whose condition number is below 100 in these examples costs a few hundred eps.
constexpr double round_off = 1e-13;
constexpr double GPa = 1e9;

/// Bedded rocks and two artificial materials, chosen so that no two constants coincide. Pa.
const TransverselyIsotropic materials[] = {
    {20 * GPa, 10 * GPa, 0.30, 0.20, 4.5 * GPa},  // a shale
    {44 * GPa, 30 * GPa, 0.22, 0.13, 13 * GPa},   // a gneiss
    {5 * GPa, 40 * GPa, 0.05, 0.35, 3 * GPa},     // stiff across the bedding
    {10 * GPa, 12 * GPa, -0.10, -0.20, 7 * GPa},  // auxetic
};

/// Compliance of the normal strains (alpha, beta, out of plane) written out entry by entry, 1/Pa, shape (3, 3).
Eigen::Matrix3d compliance(double E_a, double E_b, double E_p, double nu_ab, double nu_ap, double nu_bp) {
    Eigen::Matrix3d s;
    s << 1 / E_a, -nu_ab / E_a, -nu_ap / E_a,  //
        -nu_ab / E_a, 1 / E_b, -nu_bp / E_b,   //
        -nu_ap / E_a, -nu_bp / E_b, 1 / E_p;
    return s;
}

/// alpha and the out-of-plane direction span the plane of isotropy.
Eigen::Matrix3d compliance_bedding_along_alpha(const TransverselyIsotropic& m) {
    return compliance(m.E_alpha, m.E_beta, m.E_alpha, m.nu_alpha_beta, m.nu_p_alpha, m.nu_beta_alpha());
}

/// The other reading: beta and the out-of-plane direction span the plane of isotropy, with nu_p_alpha in it.
Eigen::Matrix3d compliance_bedding_along_beta(const TransverselyIsotropic& m) {
    return compliance(m.E_alpha, m.E_beta, m.E_beta, m.nu_alpha_beta, m.nu_alpha_beta, m.nu_p_alpha);
}

Eigen::Matrix2d plane_strain(const Eigen::Matrix3d& s) { return s.inverse().topLeftCorner<2, 2>(); }
Eigen::Matrix2d plane_stress(const Eigen::Matrix3d& s) { return s.topLeftCorner<2, 2>().inverse(); }
double difference(const Eigen::Matrix2d& a, const Eigen::Matrix2d& b) { return (a - b).norm() / b.norm(); }

void expect_near_relative(const MunjizaConstants& a, const MunjizaConstants& b, double tolerance) {
    const double scale = std::abs(b.M_alpha);
    EXPECT_NEAR(a.M_v, b.M_v, tolerance * scale);
    EXPECT_NEAR(a.M_alpha, b.M_alpha, tolerance * scale);
    EXPECT_NEAR(a.M_beta, b.M_beta, tolerance * scale);
    EXPECT_NEAR(a.M_psi, b.M_psi, tolerance * scale);
}

TEST(TransverselyIsotropic, PlaneStress_InvertsTheCompliance) {
    for (const auto& m : materials) {
        const auto c = transversely_isotropic_plane_stress(m);
        EXPECT_LT(difference(normal_stiffness(c), plane_stress(compliance_bedding_along_alpha(m))), round_off);
        EXPECT_DOUBLE_EQ(c.M_psi, 2 * m.G);
    }
}

TEST(TransverselyIsotropic, PlaneStrain_InvertsTheComplianceWithBeddingAlongAlpha) {
    for (const auto& m : materials) {
        const auto c = transversely_isotropic_plane_strain(m);
        EXPECT_LT(difference(normal_stiffness(c), plane_strain(compliance_bedding_along_alpha(m))), round_off);
        EXPECT_DOUBLE_EQ(c.M_psi, 2 * m.G);
    }
}

TEST(TransverselyIsotropic, PlaneStrain_IsNotBeddingAlongBeta) {
    for (const auto& m : materials) {
        const Eigen::Matrix2d c = normal_stiffness(transversely_isotropic_plane_strain(m));
        EXPECT_GT(difference(c, plane_strain(compliance_bedding_along_beta(m))), 1e-3);
    }
}

TEST(TransverselyIsotropic, BothFormsOfMv_Agree) {
    for (const auto& m : materials) {
        const double d = 1 - m.nu_alpha_beta * m.nu_beta_alpha();
        const double other = m.nu_alpha_beta * m.E_beta / d;  // second form of the first line of (17)
        EXPECT_NEAR(transversely_isotropic_plane_stress(m).M_v, other, round_off * std::abs(other));
    }
}

TEST(TransverselyIsotropic, IsotropicInput_GivesTheIsotropicFormulas) {
    for (double nu : {-0.4, 0.0, 0.25, 0.45}) {
        const double E = 3 * GPa;
        const TransverselyIsotropic m{E, E, nu, nu, E / (2 * (1 + nu))};
        expect_near_relative(transversely_isotropic_plane_stress(m), isotropic_plane_stress(E, nu), round_off);
        expect_near_relative(transversely_isotropic_plane_strain(m), isotropic_plane_strain(E, nu), round_off);
    }
}

TEST(Isotropic, PlaneStrain_IsLame) {
    const auto c = isotropic_plane_strain(60 * GPa, 0.25);
    const auto lame = lame_constants(60 * GPa, 0.25);
    EXPECT_DOUBLE_EQ(c.M_v, lame.lambda);
    EXPECT_DOUBLE_EQ(c.M_alpha, 2 * lame.mu);
    EXPECT_DOUBLE_EQ(lame.lambda, 24 * GPa);
    EXPECT_DOUBLE_EQ(lame.mu, 24 * GPa);
}

// The constants printed in Lei et al. 2016; half a unit of the last printed digit.
TEST(Isotropic, PublishedConstants_AreReproduced) {
    constexpr double printed = 0.0005 * GPa;
    const auto c25 = isotropic_plane_stress(1 * GPa, 0.5);
    EXPECT_NEAR(c25.M_v, 0.667 * GPa, printed);
    EXPECT_NEAR(c25.M_alpha, 0.667 * GPa, printed);
    EXPECT_NEAR(c25.M_psi, 0.667 * GPa, printed);
    const auto c26 = isotropic_plane_strain(1 * GPa, 0.4999);
    EXPECT_NEAR(c26.M_v, 1666.4 * GPa, 0.05 * GPa);
    EXPECT_NEAR(c26.M_alpha, 0.667 * GPa, printed);
    const auto c22 = isotropic_plane_stress(1 * GPa, 0.25);
    EXPECT_NEAR(c22.M_v, 0.267 * GPa, printed);
    EXPECT_NEAR(c22.M_alpha, 0.8 * GPa, printed);
    EXPECT_NEAR(c22.M_psi, 0.8 * GPa, printed);
}

TEST(Stiffness, OnAxes_HoldsTheFourConstants) {
    const MunjizaConstants c{1, 2, 3, 4};
    Eigen::Matrix3d expected;
    expected << 3, 1, 0, 1, 4, 0, 0, 0, 2;
    EXPECT_EQ(small_strain_stiffness(c), expected);
    EXPECT_EQ(normal_stiffness(c), (expected.topLeftCorner<2, 2>()));
}

TEST(Admissibility, SoundConstants_HaveNoReason) {
    EXPECT_EQ(inadmissibility({0, 1, 1, 1}), "");
    EXPECT_EQ(inadmissibility({1, -0.4, 1, 1}), "");  // M_alpha may be negative: [[0.6, 1], [1, 2]]
    for (const auto& m : materials) EXPECT_TRUE(is_admissible(transversely_isotropic_plane_strain(m)));
}

TEST(Admissibility, UnsoundConstants_SayWhy) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(
        inadmissibility({1, -0.6, 1, 1}),
        "the stiffness [[M_v + M_alpha, M_v], [M_v, M_v + M_beta]] = [[0.4, 1], [1, 2]] Pa is not positive definite");
    EXPECT_THAT(inadmissibility({-1, 0.5, 0.5, 1}),
                HasSubstr("not positive definite"));                                   // determinant alone is negative
    EXPECT_THAT(inadmissibility({1, -3, -3, 1}), HasSubstr("not positive definite"));  // determinant alone is positive
    EXPECT_THAT(inadmissibility({nan, 1, 1, 1}), HasSubstr("not positive definite"));
    EXPECT_EQ(inadmissibility({0, 1, 1, 0}), "M_psi = 0 Pa, must be > 0 Pa");
    EXPECT_THAT(inadmissibility({0, 1, 1, nan}), HasSubstr("M_psi"));
    EXPECT_FALSE(is_admissible(isotropic_plane_strain(1 * GPa, 0.5)));  // incompressible: M_v is infinite
    EXPECT_FALSE(is_admissible(transversely_isotropic_plane_strain({1 * GPa, 1 * GPa, 0.6, 0.5, GPa})));
}

}  // namespace
}  // namespace gneiss
