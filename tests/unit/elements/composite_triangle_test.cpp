// What only the composite triangle has: one volume for four sub-triangles  [FORMULATION 2].

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "element_cases.hpp"
#include "support/eps.hpp"

namespace gneiss {
namespace {

using test::eps;

constexpr double axis = 0.4;
using Compt = CompositeTriangle;
constexpr int n_dof = 2 * Compt::n_nodes;

/// b of s_v - 1 = b . u at rest, 1/m, node by node.
Eigen::VectorXd volume_gradient(const Nodal<Compt, double>& x, Sampling sampling) {
    using D = Dual<n_dof>;
    Nodal<Compt, D> u;
    for (int n = 0; n < Compt::n_nodes; ++n)
        u[static_cast<std::size_t>(n)] = {D::variable(0.0, 2 * n), D::variable(0.0, 2 * n + 1)};
    const auto kinematics = triangle_kinematics<Compt>(u, geometry_of<Compt>(x, axis), sampling);
    return Eigen::Map<const Eigen::VectorXd>(kinematics.volume_strain.derivative.data(), n_dof);
}

TEST(CompositeTriangle, WithoutVolumetricModulus_IsItsFourConstantStrainTriangles) {
    // The same operations in the same order, up to the sums at shared nodes and the compiler's choice of fused
    // multiplications: strains differ by eps |H|, |H| up to 2, and so stresses by some eps M.
    constexpr double tolerance = 4 * eps * modulus;
    MunjizaConstants constants = anisotropic;
    constants.M_v = 0;
    const auto x = CompositeCase::distorted();
    const auto geometry = geometry_of<Compt>(x, axis);
    std::mt19937 random(21);
    const auto check = [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        for (const Tensor<double>& h : finite_deformations()) {
            const auto u = noisy<Compt>(x, h, random);
            const auto whole =
                forces<Compt>(law, u, geometry, element_at_rest<Compt>(law, geometry, Sampling::mean), Sampling::mean);
            Nodal<Compt, double> parts{};
            for (const SubTriangle& abc : Compt::sub_triangles) {
                const SubTriangle nodes = counter_clockwise(abc);
                Nodal<Cst, double> x_part, u_part;
                for (std::size_t k = 0; k < 3; ++k) {
                    x_part[k] = x[static_cast<std::size_t>(nodes[k])];
                    u_part[k] = u[static_cast<std::size_t>(nodes[k])];
                }
                const auto part_geometry = geometry_of<Cst>(x_part, axis);
                const ElementMemory<Cst, Law, double> memory = element_at_rest<Cst>(law, part_geometry, Sampling::mean);
                const auto f = forces<Cst>(law, u_part, part_geometry, memory, Sampling::mean);
                for (std::size_t k = 0; k < 3; ++k) parts[static_cast<std::size_t>(nodes[k])] += f[k];
            }
            for (std::size_t n = 0; n < whole.size(); ++n) {
                EXPECT_NEAR(whole[n].x, parts[n].x, tolerance);
                EXPECT_NEAR(whole[n].y, parts[n].y, tolerance);
            }
        }
    };
    check(MunjizaHyperelastic<false>{constants});
    check(MunjizaHyperelastic<true>{constants});
    check(MunjizaHypoelastic<false>{constants, stiffening_rock});
    check(MunjizaHypoelastic<true>{constants, {}});
}

void expect_straight_equals_general(Sampling sampling) {
    using Straight = StraightCompositeTriangle;
    const auto x = StraightCompositeCase::distorted();
    const auto general = geometry_of<Compt>(x, axis);
    const auto straight = geometry_of<Straight>(x, axis);
    std::mt19937 random(24);
    for_each_law([&]<class Case>() {
        using Law = typename Case::Law;
        if (sampling == Sampling::mean || Law::offers_centre) {
            const Law law = Case::law();
            const auto rest = element_at_rest<Compt>(law, general, sampling);
            for (const Tensor<double>& h : finite_deformations()) {
                const auto u = noisy<Compt>(x, h, random), v = noisy<Compt>(x, {0.5, -0.9, 0.7, 0.3}, random, 0.3);
                const auto f = forces<Compt>(law, u, general, rest, sampling);
                const auto g = forces<Straight>(law, u, straight, rest, sampling);
                // K of the other sub-triangles differs by some eps from the one that is stored; stiffness a few M
                constexpr double tolerance = 200 * eps * modulus;
                for (std::size_t n = 0; n < f.size(); ++n) {
                    EXPECT_NEAR(f[n].x, g[n].x, tolerance) << testing::internal::GetTypeName<Case>();
                    EXPECT_NEAR(f[n].y, g[n].y, tolerance) << testing::internal::GetTypeName<Case>();
                }
                const auto rates =
                    triangle_rates<Compt>(v, triangle_kinematics<Compt>(u, general, sampling), general, sampling);
                const auto same = triangle_rates<Straight>(v, triangle_kinematics<Straight>(u, straight, sampling),
                                                           straight, sampling);
                for (std::size_t s = 0; s < rates.size(); ++s) {
                    EXPECT_NEAR(rates[s].alpha.x, same[s].alpha.x, 100 * eps);
                    EXPECT_NEAR(rates[s].beta.y, same[s].beta.y, 100 * eps);
                    EXPECT_NEAR(rates[s].volume, same[s].volume, 100 * eps);
                }
            }
        }
    });
}

TEST(StraightCompositeTriangle, AnyLawAndSampling_IsTheGeneralCompositeOnStraightSides) {
    expect_straight_equals_general(Sampling::mean);
    expect_straight_equals_general(Sampling::centre);
}

TEST(CompositeTriangle, WithVolumetricModulus_IsNotItsFourConstantStrainTriangles) {
    // the volumes of the four parts differ, the composite has one: the test above could fail
    const auto x = CompositeCase::distorted();
    const auto geometry = geometry_of<Compt>(x, axis);
    std::mt19937 random(22);
    const auto u = noisy<Compt>(x, finite_deformations()[0], random);
    const auto kinematics = triangle_kinematics<Compt>(u, geometry, Sampling::mean);
    for (const auto& point : kinematics.point)
        EXPECT_GT(std::abs(point.area_strain - kinematics.volume_strain), 1e-3) << "of the order of the noise, 0.03";
}

TEST(CompositeTriangle, StraightSides_CentreSamplesTwiceTheMidSidesAndNoCorner) {
    const auto x = StraightCompositeCase::distorted();
    const Eigen::VectorXd mean = volume_gradient(x, Sampling::mean), centre = volume_gradient(x, Sampling::centre);
    const double round_off = 32 * eps * mean.cwiseAbs().maxCoeff();
    for (int dof = 0; dof < n_dof; ++dof) {
        const bool mid_side = dof / 2 % 2 == 1;
        EXPECT_NEAR(centre(dof), mid_side ? 2 * mean(dof) : 0, round_off) << "node " << dof / 2;
        EXPECT_NE(mean(dof), 0) << "nothing to compare";
    }
}

TEST(CompositeTriangle, AnySides_CentreLeavesCornersOut) {
    const Eigen::VectorXd centre = volume_gradient(CompositeCase::distorted(), Sampling::centre);
    for (const int corner : {0, 2, 4}) {
        EXPECT_EQ(centre(2 * corner), 0);
        EXPECT_EQ(centre(2 * corner + 1), 0);
    }
}

TEST(CompositeTriangle, TangentAtRest_OfCentre_HasTheUnsymmetricPartOfTheTheory) {
    // K_centre - K_mean = A h M_v b_mean^T (b_centre - b_mean)
    const MunjizaHyperelastic<true> law{anisotropic};
    const auto x = CompositeCase::distorted();
    const auto geometry = geometry_of<Compt>(x, axis);
    const Nodal<Compt, double> rest{};
    const auto memory = element_at_rest<Compt>(law, geometry, Sampling::mean);
    const Eigen::MatrixXd mean = stiffness<Compt>(law, rest, geometry, memory, Sampling::mean);
    const Eigen::MatrixXd centre = stiffness<Compt>(law, rest, geometry, memory, Sampling::centre);
    const Eigen::VectorXd b_mean = volume_gradient(x, Sampling::mean), b_centre = volume_gradient(x, Sampling::centre);
    const Eigen::MatrixXd theory = anisotropic.M_v / geometry.inverse_volume * b_mean * (b_centre - b_mean).transpose();
    const double round_off = 200 * eps * mean.cwiseAbs().maxCoeff();
    EXPECT_LE((centre - mean - theory).cwiseAbs().maxCoeff(), round_off);
    EXPECT_LE((mean - mean.transpose()).cwiseAbs().maxCoeff(), round_off);
    EXPECT_GT((centre - centre.transpose()).cwiseAbs().maxCoeff(), 0.05 * anisotropic.M_v);
}

TEST(CompositeTriangle, Centre_TakesTheVolumeOfTheCentralSubTriangle) {
    const auto x = CompositeCase::distorted();
    const auto geometry = geometry_of<Compt>(x, axis);
    std::mt19937 random(23);
    const auto u = noisy<Compt>(x, finite_deformations()[1], random);
    const auto v = noisy<Compt>(x, {0.5, -0.9, 0.7, 0.3}, random, 0.3);
    const auto kinematics = triangle_kinematics<Compt>(u, geometry, Sampling::centre);
    EXPECT_EQ(kinematics.volume_strain, kinematics.point[3].area_strain);
    const auto rates = triangle_rates<Compt>(v, kinematics, geometry, Sampling::centre);
    const auto& central = kinematics.point[3];
    const double rate =
        (cross(rates[3].alpha, central.beta()) + cross(central.alpha(), rates[3].beta)) / central.jacobian();
    for (const auto& of_sub : rates) EXPECT_NEAR(of_sub.volume, rate, 32 * eps * std::abs(rate));
}

TEST(CompositeTriangle, Centre_NotANumberAtACorner_IsNotUpright) {
    // the volumetric stretch does not see the corners: the sub-triangles have to
    const auto geometry = geometry_of<Compt>(CompositeCase::distorted(), axis);
    for (std::size_t n = 0; n < Compt::n_nodes; ++n) {
        Nodal<Compt, double> u{};
        u[n].x = std::numeric_limits<double>::quiet_NaN();
        EXPECT_FALSE(is_upright(triangle_kinematics<Compt>(u, geometry, Sampling::centre))) << "node " << n;
    }
}

TEST(CompositeTriangle, Centre_UnderRigidMotionAndConstantStrain_IsTheMean) {
    const MunjizaHyperelastic<true> law{anisotropic};
    const auto x = CompositeCase::distorted();
    const auto geometry = geometry_of<Compt>(x, axis);
    const auto memory = element_at_rest<Compt>(law, geometry, Sampling::centre);
    const double round_off = 200 * eps * modulus;
    EXPECT_LE(
        largest<Compt>(forces<Compt>(law, affine<Compt>(x, rigid_rotation(2.5)), geometry, memory, Sampling::centre)),
        round_off);
    for (const Tensor<double>& h : finite_deformations()) {
        const auto u = affine<Compt>(x, h);
        const auto centre = forces<Compt>(law, u, geometry, memory, Sampling::centre);
        const auto mean = forces<Compt>(law, u, geometry, memory, Sampling::mean);
        for (std::size_t n = 0; n < mean.size(); ++n) {
            EXPECT_NEAR(centre[n].x, mean[n].x, round_off);
            EXPECT_NEAR(centre[n].y, mean[n].y, round_off);
        }
    }
}

}  // namespace
}  // namespace gneiss
