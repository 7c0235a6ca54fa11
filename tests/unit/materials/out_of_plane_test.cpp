// Stress across the plane: Hooke's law in three dimensions at small strain, gradients of energies at finite strain.

#include "materials/out_of_plane.hpp"

#include <gtest/gtest.h>

#include "support/deformation.hpp"
#include "support/eps.hpp"
#include "support/finite_differences.hpp"
#include "support/laws.hpp"

namespace gneiss {
namespace {

using test::eps;

constexpr double E = 1.2e9, nu = 0.3;                                      // Pa, -
constexpr TransverselyIsotropic bedded{2.0e9, 1.1e9, 0.28, 0.17, 0.45e9};  // a shale, Pa
constexpr Tensor<double> small{1e-6, -0.4e-6, 0.9e-6, -0.7e-6};            // laws differ from Hooke's by its square
constexpr double small_strain = 20 * 1e-6 * 1e-6 * modulus;
constexpr double difference_error = 1e-10 * modulus;  // as in material_contract_test.cpp

template <class Law>
double across(const Law& law, const Tensor<double>& h, double axis, const typename Law::template Memory<double>& from) {
    const auto point = point_at(h, axis);
    const auto volume = law.volume(point.area_strain);
    return law.stress_across(point, volume, from, law.stress(point, volume, from).q);
}

/// sigma_alpha and sigma_beta, Pa.
template <class Law>
Eigen::Matrix2d on_axes(const Law& law, const Tensor<double>& h, double axis,
                        const typename Law::template Memory<double>& from) {
    const auto point = point_at(h, axis);
    const auto stress = law.stress(point, law.volume(point.area_strain), from);
    const auto sigma = cauchy_stress(point, stress, stress.q);
    const Eigen::Matrix2d r = rotation(axis);
    return r.transpose() * Eigen::Matrix2d{{sigma.xx, sigma.xy}, {sigma.xy, sigma.yy}} * r;
}

/// From rest, and from a stress in situ of the same size as what the small strain adds.
template <class Law>
std::vector<typename Law::template Memory<double>> starts(const Law& law) {
    std::vector<typename Law::template Memory<double>> memories{memory_at_rest(law, 0.0)};
    if constexpr (requires { law.initial_memory({}); }) memories.push_back(law.initial_memory({-900, -300, 200}));
    return memories;
}

TEST(StressAcross, ConstantOfTransverseIsotropy_InvertsTheCompliance) {
    const double E_a = bedded.E_alpha, nu_ab = bedded.nu_alpha_beta, nu_p = bedded.nu_p_alpha;
    Eigen::Matrix3d compliance;                         // alpha, beta, out of plane
    compliance << 1 / E_a, -nu_ab / E_a, -nu_p / E_a,   //
        -nu_ab / E_a, 1 / bedded.E_beta, -nu_ab / E_a,  //
        -nu_p / E_a, -nu_ab / E_a, 1 / E_a;
    const Eigen::Matrix3d c = compliance.inverse();
    const double M_v = transversely_isotropic_plane_strain(bedded).M_v;
    const double round_off = 1000 * eps * modulus;  // of the inverse
    EXPECT_NEAR(M_v + transversely_isotropic_across(bedded), c(0, 2), round_off);
    EXPECT_NEAR(M_v, c(1, 2), round_off);
    EXPECT_NEAR(transversely_isotropic_across({E, E, nu, nu, E / (2 * (1 + nu))}), 0, round_off);
}

TEST(StressAcross, IsotropicAtSmallStrain_IsNuTimesTheTrace) {
    const auto check = [](const auto& law, const char* name) {
        for (const double axis : axis_angles_under_test)
            for (const auto& start : starts(law))
                EXPECT_NEAR(across(law, small, axis, start), nu * on_axes(law, small, axis, start).trace(),
                            small_strain)
                    << name;
    };
    const MunjizaConstants constants = isotropic_plane_strain(E, nu);
    const Stiffening stiffening{2, 1000, 0.5};  // by a factor of order 1 at these stresses
    check(MunjizaHyperelastic<false>{constants}, "hyper, conjugate");
    check(MunjizaHyperelastic<true>{constants}, "hyper, direct");
    check(MunjizaHypoelastic<false>{constants, {}}, "hypo, conjugate");
    check(MunjizaHypoelastic<true>{constants, {}}, "hypo, direct");
    check(MunjizaHypoelastic<false>{constants, stiffening}, "stiffening, conjugate");
    check(MunjizaHypoelastic<true>{constants, stiffening}, "stiffening, direct");
    const auto [mu, lambda] = lame_constants(E, nu);
    check(NeoHookean<false>{mu, lambda}, "neo-Hookean");
}

TEST(StressAcross, TransverselyIsotropicAtSmallStrain_IsThatWithoutStrainAcross) {
    // 0 = E_alpha eps_z = sigma_z - nu_p sigma_alpha - nu_alpha_beta sigma_beta
    const auto check = [](const auto& law, const char* name) {
        for (const double axis : axis_angles_under_test)
            for (const auto& start : starts(law)) {
                const Eigen::Matrix2d sigma = on_axes(law, small, axis, start);
                const double expected = bedded.nu_p_alpha * sigma(0, 0) + bedded.nu_alpha_beta * sigma(1, 1);
                EXPECT_NEAR(across(law, small, axis, start), expected, small_strain) << name << ", axis " << axis;
            }
    };
    const MunjizaConstants constants = transversely_isotropic_plane_strain(bedded);
    const double M_z = transversely_isotropic_across(bedded);
    ASSERT_GT(std::abs(M_z), 0.01 * modulus);
    const Stiffening stiffening{2, 1000, 0.5};
    check(MunjizaHyperelastic<false>{constants, M_z}, "hyper, conjugate");
    check(MunjizaHyperelastic<true>{constants, M_z}, "hyper, direct");
    check(MunjizaHypoelastic<false>{constants, {}, M_z}, "hypo, conjugate");
    check(MunjizaHypoelastic<true>{constants, {}, M_z}, "hypo, direct");
    check(MunjizaHypoelastic<false>{constants, stiffening, M_z}, "stiffening, conjugate");
    check(MunjizaHypoelastic<true>{constants, stiffening, M_z}, "stiffening, direct");
}

TEST(StressAcross, ConjugateAtFiniteStrain_IsTheGradientOfTheEnergyByTheThickness) {
    // w(e_v + y, e_alpha, ...) + M_z e_alpha y, y = ln s_z: the energy of FORMULATION 3
    const double M_z = transversely_isotropic_across(bedded);
    const MunjizaHyperelastic<false> law{transversely_isotropic_plane_strain(bedded), M_z};
    const MunjizaHypoelastic<false> hypo{law.constants, {}, M_z};
    for (const double axis : axis_angles_under_test)
        for (const Tensor<double>& h : finite_deformations()) {
            const auto point = point_at(h, axis);
            const double e_alpha = 0.5 * std::log1p(munjiza_stretches(point).alpha_squared_minus_1);
            const double gradient = derivative_at_zero([&](double y) {
                return law.energy_density(point, law.volume(point.jacobian() * std::exp(y) - 1)) + M_z * e_alpha * y;
            });
            EXPECT_NEAR(across(law, h, axis, {}), gradient / point.jacobian(), difference_error);
            EXPECT_NEAR(across(hypo, h, axis, {}), gradient / point.jacobian(), difference_error);
        }
}

TEST(StressAcross, NeoHookeanAtFiniteStrain_IsTheGradientOfTheEnergyByTheThickness) {
    const auto [mu, lambda] = lame_constants(E, nu);
    for (const Tensor<double>& h : finite_deformations()) {
        const double J = point_at(h, 0.0).jacobian();
        const double gradient = derivative_at_zero([&](double y) {  // |F|^2 does not change with s_z
            const double log_volume = std::log(J) + y;
            return 0.5 * mu * (std::exp(2 * y) - 2 * log_volume) + 0.5 * lambda * log_volume * log_volume;
        });
        EXPECT_NEAR(across(NeoHookean<false>{mu, lambda}, h, 0.0, {}), gradient / J, difference_error);
        EXPECT_NEAR(across(NeoHookean<true>{mu, lambda}, h, 0.0, {}), 0, 100 * eps * modulus) << "plane stress";
    }
}

}  // namespace
}  // namespace gneiss
