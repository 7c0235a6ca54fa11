#include "materials/neo_hookean.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/deformation.hpp"
#include "support/eps.hpp"

namespace gneiss {
namespace {

using test::eps;

constexpr double E = 1e9, nu = 0.3;
const LameConstants lame = lame_constants(E, nu);
constexpr double round_off = 100 * eps * E;
constexpr PointMemory<double, 0, 0> no_memory{};

/// w per initial volume as it stands in textbooks, J/m3.
double written_energy(const Eigen::Matrix2d& f, double s_z) {
    const double log_j = std::log(f.determinant() * s_z);
    return lame.mu / 2 * (f.squaredNorm() + s_z * s_z - 3 - 2 * log_j) + lame.lambda / 2 * log_j * log_j;
}

/// s_z for which the stress out of the plane vanishes, by bisection.
double free_thickness(const Eigen::Matrix2d& f) {
    double low = 0.2, high = 5;
    for (int i = 0; i < 200; ++i) {
        const double s_z = 0.5 * (low + high);
        const double stress = lame.mu * (s_z * s_z - 1) + lame.lambda * std::log(f.determinant() * s_z);
        (stress < 0 ? low : high) = s_z;
    }
    return 0.5 * (low + high);
}

template <bool plane_stress>
double energy(const Tensor<double>& h) {
    const NeoHookean<plane_stress> law{lame.mu, lame.lambda};
    const auto point = point_at(h, 0.3);
    return law.energy_density(point, law.volume(point.area_strain));
}

TEST(NeoHookean, PlaneStrain_EnergyAndStress_AreThoseOfTheTextbook) {
    const NeoHookean<false> law{lame.mu, lame.lambda};
    for (const Tensor<double>& h : finite_deformations()) {
        const Eigen::Matrix2d f = Eigen::Matrix2d::Identity() + matrix(h);
        EXPECT_NEAR(energy<false>(h), written_energy(f, 1), round_off);
        const Eigen::Matrix2d p =
            lame.mu * (f - f.inverse().transpose()) + lame.lambda * std::log(f.determinant()) * f.inverse().transpose();
        EXPECT_LE((matrix(first_piola(law, h, 0.3, no_memory)) - p).cwiseAbs().maxCoeff(), round_off);
    }
}

TEST(NeoHookean, PlaneStress_EnergyAndStress_AreThoseOfAFreeThickness) {
    const NeoHookean<true> law{lame.mu, lame.lambda};
    for (const Tensor<double>& h : finite_deformations()) {
        const Eigen::Matrix2d f = Eigen::Matrix2d::Identity() + matrix(h);
        const double s_z = free_thickness(f);
        EXPECT_NEAR(energy<true>(h), written_energy(f, s_z), round_off);
        const Eigen::Matrix2d p = lame.mu * (f - f.inverse().transpose()) +
                                  lame.lambda * std::log(f.determinant() * s_z) * f.inverse().transpose();
        EXPECT_LE((matrix(first_piola(law, h, 0.3, no_memory)) - p).cwiseAbs().maxCoeff(), round_off);
    }
}

TEST(NeoHookean, PlaneStress_AtLargeChangesOfArea_FindsItsThickness) {
    const NeoHookean<true> law{lame.mu, lame.lambda};
    for (const double log_area : {-1.9, -1.0, -0.1, 0.5, 1.9}) {
        const auto volume = law.volume(std::expm1(log_area));
        const double left =
            lame.mu * std::expm1(2 * volume.log_thickness) + lame.lambda * (log_area + volume.log_thickness);
        EXPECT_LE(std::abs(left), round_off) << "ln s_v = " << log_area;
    }
}

TEST(NeoHookean, UniaxialTension_PlaneStress_HasYoungsModulusAndPoissonsRatio) {
    // second-order terms of a strain of 1e-6 are below 1e-5 of the stress
    constexpr double strain = 1e-6, second_order = 1e-5;
    const NeoHookean<true> law{lame.mu, lame.lambda};
    const auto p = first_piola(law, Tensor<double>{strain, 0, 0, -nu * strain}, 0.3, no_memory);
    EXPECT_NEAR(p[0], E * strain, second_order * E * strain);
    EXPECT_NEAR(p[3], 0, second_order * E * strain);
}

TEST(NeoHookean, CompositesVolume_ScalesF_AndLeavesItsShapeAlone) {
    // a law without a split sees F scaled by (s_v/det F)^(1/2)  [FORMULATION 3]
    const NeoHookean<false> law{lame.mu, lame.lambda};
    for (const Tensor<double>& h : finite_deformations()) {
        const auto point = point_at(h, 0.3);
        const double s_v = 1.15;
        const Eigen::Matrix2d f = (Eigen::Matrix2d::Identity() + matrix(h)) * std::sqrt(s_v / point.jacobian());
        EXPECT_NEAR(law.energy_density(point, law.volume(s_v - 1)), written_energy(f, 1), round_off);
    }
}

TEST(NeoHookean, TinyStrain_ChangeOfAreaAlone_KeepsItsDigits) {
    const NeoHookean<false> law{lame.mu, lame.lambda};
    for (const double size : {1e-9, 1e-12, 1e-15}) {
        const auto p = first_piola(law, Tensor<double>{size, 0, 0, size}, 0.3, no_memory);
        const double hooke = 2 * (lame.lambda + lame.mu) * size;
        EXPECT_NEAR(p[0], hooke, (16 * eps + 4 * size) * hooke) << "strain " << size;
    }
}

}  // namespace
}  // namespace gneiss
