#include "materials/viscous_stress.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "support/deformation.hpp"
#include "support/eps.hpp"

namespace gneiss {
namespace {

using test::eps;

constexpr ViscousStress viscosity{3.0, 7.0};  // Pa s
// Some tens of operations on rates near 1/s.
constexpr double round_off = 200 * eps;

Eigen::Matrix2d deformation_gradient(const Tensor<double>& h) { return Eigen::Matrix2d::Identity() + matrix(h); }

/// Cauchy stress, Pa, under the velocity gradient L.
Eigen::Matrix2d viscous_cauchy(const Tensor<double>& h, double axis, const Eigen::Matrix2d& velocity_gradient) {
    const auto point = point_at(h, axis);
    const auto rates = rates_at(point, tensor(velocity_gradient * deformation_gradient(h)));
    const auto stress = viscosity.stress(point, rates);
    EXPECT_EQ(stress.q, 0) << "the volume's rate is the composite's already";
    return cauchy_of(on_xy(point, stress.p_alpha, stress.p_beta), h);
}

const Eigen::Matrix2d velocity_gradients[] = {
    Eigen::Matrix2d{{1, 0}, {0, 0}}, Eigen::Matrix2d{{0.2, 0.9}, {-0.4, -0.7}}, Eigen::Matrix2d{{-1, 0.3}, {0.3, -1}}};

TEST(ViscousStress, AnyDeformationAndRate_IsThatOfANewtonianFluid) {
    for (const double axis : axis_angles_under_test) {
        for (const Tensor<double>& h : finite_deformations()) {
            for (const Eigen::Matrix2d& l : velocity_gradients) {
                const Eigen::Matrix2d d = 0.5 * (l + l.transpose()), one = Eigen::Matrix2d::Identity();
                const Eigen::Matrix2d sigma =
                    2 * viscosity.shear * (d - 0.5 * d.trace() * one) + viscosity.bulk * d.trace() * one;
                const Eigen::Matrix2d computed = viscous_cauchy(h, axis, l);
                EXPECT_LE((computed - sigma).cwiseAbs().maxCoeff(), round_off * viscosity.bulk);
                EXPECT_NEAR(computed(0, 1), computed(1, 0), round_off * viscosity.bulk);
                EXPECT_GE(computed.cwiseProduct(d).sum(), 0) << "creates energy";
            }
        }
    }
}

TEST(ViscousStress, KnownRates_GiveShearAndBulkViscosity) {
    const Eigen::Matrix2d shear = viscous_cauchy(at_rest, 0.4, Eigen::Matrix2d{{0, 2}, {0, 0}});
    EXPECT_NEAR(shear(0, 1), viscosity.shear * 2, round_off * viscosity.bulk) << "tau = eta gamma'";
    const Eigen::Matrix2d swelling = viscous_cauchy(at_rest, 0.4, Eigen::Matrix2d{{0.5, 0}, {0, 0.5}});
    EXPECT_NEAR(swelling(0, 0), viscosity.bulk, round_off * viscosity.bulk) << "zeta tr d";
    EXPECT_NEAR(swelling(1, 1), viscosity.bulk, round_off * viscosity.bulk);
}

TEST(ViscousStress, RigidSpin_OfADeformedState_HasNoStress) {
    for (const Tensor<double>& h : finite_deformations())
        EXPECT_LE(viscous_cauchy(h, -1.3, Eigen::Matrix2d{{0, -4}, {4, 0}}).cwiseAbs().maxCoeff(),
                  4 * round_off * viscosity.bulk);
}

TEST(ViscousStress, IsActive_WithEitherViscosity) {
    EXPECT_FALSE(ViscousStress{}.active());
    EXPECT_TRUE((ViscousStress{1, 0}.active()));
    EXPECT_TRUE((ViscousStress{0, 1}.active()));
}

}  // namespace
}  // namespace gneiss
