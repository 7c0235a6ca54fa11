// What every law must fulfil. A new one joins by one line in support/laws.hpp.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "materials/small_strain_stiffness.hpp"
#include "support/deformation.hpp"
#include "support/eps.hpp"
#include "support/finite_differences.hpp"
#include "support/laws.hpp"

namespace gneiss {
namespace {

using test::eps;

// Some hundred operations on strains up to 0.3 and moduli up to 2e9 Pa.
constexpr double round_off = 100 * eps * modulus;
// Round-off eps M e/h and truncation h^4/30 times a fifth derivative (up to 1e3 M) of a central difference.
constexpr double difference_error = 1e-10 * modulus;

double distance(const Tensor<double>& a, const Tensor<double>& b) {
    return (matrix(a) - matrix(b)).cwiseAbs().maxCoeff();
}

template <class Case>
class MaterialContract : public testing::Test {
protected:
    using Memory = typename Case::Law::template Memory<double>;
    const typename Case::Law law = Case::law();

    /// Where a law with memory may start from: rest, and a state it has been led to in two steps.
    std::array<Memory, 2> memories(double axis) const {
        const Memory rest = memory_at_rest(law, axis);
        return {rest,
                updated(law, {-0.06, 0.02, 0.03, -0.04}, axis, updated(law, {-0.03, 0.04, -0.01, 0.01}, axis, rest))};
    }
};
TYPED_TEST_SUITE(MaterialContract, Laws);

// ---- stresses ------------------------------------------------------------------------------------------------------

TYPED_TEST(MaterialContract, AtRest_HasNoStress) {
    for (const double axis : axis_angles_under_test)
        EXPECT_EQ(first_piola(this->law, at_rest, axis, memory_at_rest(this->law, axis)), at_rest) << "P = 0";
}

TYPED_TEST(MaterialContract, FiniteRotationFromRest_HasNoStress) {
    for (const double axis : axis_angles_under_test)
        for (const double angle : {1e-9, 0.3, std::numbers::pi / 2, -2.2, std::numbers::pi, 3.1, 100.0})
            EXPECT_LE(
                distance(first_piola(this->law, rigid_rotation(angle), axis, memory_at_rest(this->law, axis)), at_rest),
                round_off)
                << "rotation by " << angle;
}

TYPED_TEST(MaterialContract, FiniteRotationOfADeformedState_RotatesItsStresses) {
    for (const double axis : axis_angles_under_test) {
        for (const auto& memory : this->memories(axis)) {
            for (const Tensor<double>& h : finite_deformations()) {
                const double angle = 1.9;
                const Tensor<double> turned_h = rotated(angle, h);
                const auto p = first_piola(this->law, h, axis, memory);
                const auto turned_p = first_piola(this->law, turned_h, axis, memory);
                const Eigen::Matrix2d r = rotation(angle);
                EXPECT_LE((matrix(turned_p) - r * matrix(p)).cwiseAbs().maxCoeff(), round_off) << "P";
                EXPECT_LE((cauchy_of(turned_p, turned_h) - r * cauchy_of(p, h) * r.transpose()).cwiseAbs().maxCoeff(),
                          round_off)
                    << "sigma";
            }
        }
    }
}

TYPED_TEST(MaterialContract, RotationOfTheSolidWithItsAxes_RotatesItsStresses) {
    // F R^T with the axes turned by R: the same solid in another frame of the reference shape
    const double angle = 0.7;
    const Eigen::Matrix2d r = rotation(angle);
    for (const double axis : axis_angles_under_test) {
        for (const Tensor<double>& h : finite_deformations()) {
            const auto p = first_piola(this->law, h, axis, memory_at_rest(this->law, axis));
            const auto turned_h = tensor(r * matrix(h) * r.transpose());
            const auto turned_p =
                first_piola(this->law, turned_h, axis + angle, memory_at_rest(this->law, axis + angle));
            EXPECT_LE((matrix(turned_p) - r * matrix(p) * r.transpose()).cwiseAbs().maxCoeff(), round_off);
        }
    }
}

TYPED_TEST(MaterialContract, CauchyStress_OfAnyState_IsSymmetric) {
    for (const double axis : axis_angles_under_test) {
        for (const auto& memory : this->memories(axis)) {
            for (const Tensor<double>& h : finite_deformations()) {
                const Eigen::Matrix2d sigma = cauchy_of(first_piola(this->law, h, axis, memory), h);
                EXPECT_NEAR(sigma(0, 1), sigma(1, 0), round_off);
                // and the symmetric tensor that output takes is the same
                const auto point = point_at(h, axis);
                const auto stress = this->law.stress(point, this->law.volume(point.area_strain), memory);
                const auto reported = cauchy_stress(point, stress, stress.q);
                const Eigen::Matrix2d same{{reported.xx, reported.xy}, {reported.xy, reported.yy}};
                EXPECT_LE((same - sigma).cwiseAbs().maxCoeff(), round_off);
            }
        }
    }
}

// ---- stored energy
// ---------------------------------------------------------------------------------------------------

TYPED_TEST(MaterialContract, StoredEnergy_InFAndInVolume_HasTheStressAsItsGradient) {
    using Law = typename TypeParam::Law;
    if constexpr (Law::has_stored_energy) {
        const Law& elastic = this->law;
        const typename Law::template Memory<double> none{};
        for (const double axis : axis_angles_under_test) {
            for (const Tensor<double>& h : finite_deformations()) {
                const auto point = point_at(h, axis);
                // a composite's volume is not that of its sub-triangle
                const double volume_strain = 0.5 * point.area_strain + 0.03;
                const auto volume = elastic.volume(volume_strain);
                const auto stress = elastic.stress(point, volume, none);
                const Tensor<double> p = on_xy(point, stress.p_alpha, stress.p_beta);
                for (std::size_t k = 0; k < 4; ++k) {
                    const double by_f = derivative_at_zero([&](double step) {
                        Tensor<double> moved = h;
                        moved[k] += step;
                        return elastic.energy_density(point_at(moved, axis), volume);
                    });
                    EXPECT_NEAR(p[k], by_f, difference_error) << "component " << k;
                }
                const double by_volume = derivative_at_zero(
                    [&](double step) { return elastic.energy_density(point, elastic.volume(volume_strain + step)); });
                EXPECT_NEAR(stress.q, by_volume, difference_error);
            }
        }
    }
}

TYPED_TEST(MaterialContract, StoredEnergy_IsZeroAtRestAndUnderRotation_AndPositiveElsewhere) {
    using Law = typename TypeParam::Law;
    if constexpr (Law::has_stored_energy) {
        const auto energy = [&](const Tensor<double>& h) {
            const auto point = point_at(h, 0.4);
            return this->law.energy_density(point, this->law.volume(point.area_strain));
        };
        EXPECT_EQ(energy({}), 0);
        EXPECT_LE(std::abs(energy(rigid_rotation(2.2))), round_off);
        for (const Tensor<double>& h : finite_deformations()) EXPECT_GT(energy(h), 1e-4 * modulus);
    }
}

// ---- tangents
// --------------------------------------------------------------------------------------------------------

/// C_ijkl of a stiffness on the axes, shape (4, 4): dsigma_ij = C_ijkl dH_kl.
Eigen::Matrix4d full_stiffness(const Eigen::Matrix3d& on_axes, double axis) {
    Eigen::Matrix4d c = Eigen::Matrix4d::Zero();
    const Eigen::Matrix2d r = rotation(axis);
    for (int k = 0; k < 4; ++k) {
        Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
        h(k / 2, k % 2) = 1;
        const Eigen::Matrix2d e = r.transpose() * (0.5 * (h + h.transpose())) * r;
        const Eigen::Vector3d s = on_axes * Eigen::Vector3d(e(0, 0), e(1, 1), 2 * e(0, 1));
        const Eigen::Matrix2d sigma = r * Eigen::Matrix2d{{s(0), s(2)}, {s(2), s(1)}} * r.transpose();
        for (int i = 0; i < 4; ++i) c(i, k) = sigma(i / 2, i % 2);
    }
    return c;
}

TYPED_TEST(MaterialContract, TangentAtRest_OnAnyAxes_IsHookesLaw) {
    for (const double axis : axis_angles_under_test) {
        const Eigen::Matrix4d a = tangent(this->law, at_rest, axis, memory_at_rest(this->law, axis));
        const Eigen::Matrix4d c = full_stiffness(TypeParam::stiffness(), axis);
        EXPECT_LE((a - c).cwiseAbs().maxCoeff(), round_off) << "axis " << axis;
    }
}

TYPED_TEST(MaterialContract, TangentConstantsAtRest_MeanTheSameStiffness) {
    const auto constants = this->law.tangent_constants(memory_at_rest(this->law, 0.0));
    EXPECT_LE((small_strain_stiffness(constants) - TypeParam::stiffness()).cwiseAbs().maxCoeff(), round_off);
}

TYPED_TEST(MaterialContract, SmallStrain_FollowsHookesLawToFirstOrder) {
    // |P - C H| <= curvature M |H|^2; stiffening adds k n M/p_ref = 20, times the 1.6 M of the largest modulus
    constexpr double curvature = TypeParam::cycle == Cycle::path_dependent ? 40 : 10;
    for (const double axis : axis_angles_under_test) {
        const Eigen::Matrix4d c = full_stiffness(TypeParam::stiffness(), axis);
        for (const Tensor<double>& direction : finite_deformations()) {
            for (const double size : {1e-3, 1e-6, 1e-12}) {
                const Tensor<double> h = scaled(size, direction);
                const auto p = first_piola(this->law, h, axis, memory_at_rest(this->law, axis));
                const double norm = matrix(h).norm();
                const Eigen::Vector4d hooke = c * Eigen::Map<const Eigen::Vector4d>(h.data());
                const double error = (Eigen::Map<const Eigen::Vector4d>(p.data()) - hooke).cwiseAbs().maxCoeff();
                EXPECT_LE(error, curvature * modulus * norm * norm + round_off * norm) << "strain " << size;
            }
        }
    }
}

TYPED_TEST(MaterialContract, Tangent_ByDualNumbers_IsThatOfFiniteDifferences) {
    // stiffening varies over strains of p_ref/(k M), a fortieth
    constexpr double h_difference = TypeParam::cycle == Cycle::path_dependent ? difference_step / 5 : difference_step;
    for (const double axis : axis_angles_under_test) {
        for (const auto& memory : this->memories(axis)) {
            for (const Tensor<double>& h : finite_deformations()) {
                const Eigen::Matrix4d a = tangent(this->law, h, axis, memory);
                for (int k = 0; k < 4; ++k) {
                    const auto moved = [&](double step) -> Eigen::Matrix2d {
                        Tensor<double> there = h;
                        there[static_cast<std::size_t>(k)] += step;
                        return matrix(first_piola(this->law, there, axis, memory));
                    };
                    const Eigen::Matrix2d by_h = derivative_at_zero(moved, h_difference);
                    for (int i = 0; i < 4; ++i) EXPECT_NEAR(a(i, k), by_h(i / 2, i % 2), difference_error);
                }
            }
        }
    }
}

TYPED_TEST(MaterialContract, Tangent_AtFiniteStrain_IsSymmetricExactlyWhereStressesAreAGradient) {
    double asymmetry = 0;
    for (const double axis : axis_angles_under_test) {
        for (const Tensor<double>& h : finite_deformations()) {
            const Eigen::Matrix4d a = tangent(this->law, h, axis, memory_at_rest(this->law, axis));
            asymmetry = std::max(asymmetry, (a - a.transpose()).cwiseAbs().maxCoeff());
        }
    }
    if (TypeParam::cycle == Cycle::free)
        EXPECT_LE(asymmetry, round_off);
    else
        EXPECT_GT(asymmetry, 1e-3 * modulus) << "this law would have a stored energy";
}

TYPED_TEST(MaterialContract, PlaneWavesAtRest_HaveTheSpeedsOfTheChristoffelMatrix) {
    const double density = 1000;
    const Eigen::Matrix3d c = TypeParam::stiffness();
    for (const double axis : axis_angles_under_test) {
        const Eigen::Matrix4d a = tangent(this->law, at_rest, axis, memory_at_rest(this->law, axis));
        for (double normal = 0; normal < std::numbers::pi; normal += 0.2) {
            // from the tangent: Gamma_ik = dP_ij/dF_kl n_j n_l
            const Eigen::Vector2d n(std::cos(normal), std::sin(normal));
            Eigen::Matrix2d gamma = Eigen::Matrix2d::Zero();
            for (int i = 0; i < 2; ++i)
                for (int k = 0; k < 2; ++k)
                    for (int j = 0; j < 2; ++j)
                        for (int l = 0; l < 2; ++l) gamma(i, k) += a(2 * i + j, 2 * k + l) * n(j) * n(l);
            const Eigen::Vector2d rho_v2 = gamma.selfadjointView<Eigen::Lower>().eigenvalues();
            // closed form on the axes  [FORMULATION 9]
            const double x = std::cos(normal - axis), y = std::sin(normal - axis);
            const double g11 = c(0, 0) * x * x + c(2, 2) * y * y, g22 = c(1, 1) * y * y + c(2, 2) * x * x;
            const double g12 = (c(0, 1) + c(2, 2)) * x * y;
            const double mean = 0.5 * (g11 + g22), radius = std::hypot(0.5 * (g11 - g22), g12);
            EXPECT_NEAR(std::sqrt(rho_v2(1) / density), std::sqrt((mean + radius) / density), 1e-12 * 1e3);
            EXPECT_NEAR(std::sqrt(rho_v2(0) / density), std::sqrt((mean - radius) / density), 1e-12 * 1e3);
        }
    }
}

// ---- work and memory
// -------------------------------------------------------------------------------------------------

/// A closed, smooth path of strain and rotation that starts at rest and encloses an area of size^2.
Tensor<double> on_cycle(double size, double s) {
    const double x = size * (1 - std::cos(s)), y = size * std::sin(s), z = size * std::sin(2 * s);
    return {x - 0.3 * z, 0.8 * y + 0.5 * x, -0.2 * y + 0.9 * z, -0.7 * x + 0.6 * y};
}
Tensor<double> cycle_rate(double size, double s) {
    const double x = size * std::sin(s), y = size * std::cos(s), z = 2 * size * std::cos(2 * s);
    return {x - 0.3 * z, 0.8 * y + 0.5 * x, -0.2 * y + 0.9 * z, -0.7 * x + 0.6 * y};
}

/// The work per initial volume, J/m3, and the memory after one cycle in n steps.
/// The trapezoidal rule converges faster than any power of n for a stress that is a smooth function of F.
template <class Law>
auto one_cycle(const Law& law, double axis, double size, int n) {
    auto memory = memory_at_rest(law, axis);
    double work = 0;
    const double ds = 2 * std::numbers::pi / n;
    for (int i = 1; i <= n; ++i) {
        const Tensor<double> h = on_cycle(size, i * ds);
        work += (matrix(first_piola(law, h, axis, memory)).cwiseProduct(matrix(cycle_rate(size, i * ds)))).sum() * ds;
        memory = updated(law, h, axis, memory);
    }
    return std::pair(work, memory);
}

TYPED_TEST(MaterialContract, ClosedStrainCycle_CostsNothingOrAThirdOrder) {
    constexpr int steps = 128;  // round-off for the functions of F at hand, checked with 64
    const auto work = [&](double size, double axis) { return one_cycle(this->law, axis, size, steps).first; };
    for (const double axis : axis_angles_under_test) {
        if (TypeParam::cycle == Cycle::free) {
            EXPECT_LE(std::abs(work(0.08, axis)), round_off);
        } else if (TypeParam::cycle == Cycle::third_order) {
            const double coarse = std::abs(work(0.01, axis)), fine = std::abs(work(0.005, axis));
            EXPECT_GT(fine, 1e3 * eps * modulus) << "nothing to measure";
            EXPECT_NEAR(observed_order(coarse, fine), 3, 0.15);
        }
    }
}

/// z at the end of the cycle by the classical Runge-Kutta method on z' = g: what an ODE solver would find.
template <class Law>
auto cycle_by_rates(const Law& law, double axis, double size, int n) {
    auto memory = memory_at_rest(law, axis);
    const double ds = 2 * std::numbers::pi / n;
    const auto rate = [&](double s, const auto& z) {
        auto given = memory;
        given.z = z;
        const auto point = point_at(on_cycle(size, s), axis);
        const auto volume = law.volume(point.area_strain);
        PointStress<double> stress;
        if constexpr (requires { law.stress_at(point, volume, given); })
            stress = law.stress_at(point, volume, given);
        else
            stress = law.stress(point, volume, given);
        return law.rate(point, volume, rates_at(point, cycle_rate(size, s)), stress, stress.q, given);
    };
    const auto moved = [](auto z, double factor, const auto& dz) {
        for (std::size_t k = 0; k < z.size(); ++k) z[k] += factor * dz[k];
        return z;
    };
    for (int i = 0; i < n; ++i) {
        const double s = i * ds;
        const auto k1 = rate(s, memory.z);
        const auto k2 = rate(s + ds / 2, moved(memory.z, ds / 2, k1));
        const auto k3 = rate(s + ds / 2, moved(memory.z, ds / 2, k2));
        const auto k4 = rate(s + ds, moved(memory.z, ds, k3));
        memory.z = moved(moved(moved(moved(memory.z, ds / 6, k1), ds / 3, k2), ds / 3, k3), ds / 6, k4);
    }
    return memory.z;
}

TYPED_TEST(MaterialContract, InternalVariables_StepByStep_ConvergeToTheirRatesIntegral) {
    using Law = typename TypeParam::Law;
    if constexpr (Law::n_internal > 0) {
        constexpr double size = 0.08, axis = 0.4;
        // Order 4, of order 1.5 near the kink of the stiffening at p = 0: 1e-8 at this number of steps.
        constexpr double reference_error = 1e-8 * modulus * size;
        // The trapezoidal rule and chords instead of arcs: ds^2/12 times second derivatives, some units of M size.
        constexpr double constant = 3 * modulus * size;
        const auto reference = cycle_by_rates(this->law, axis, size, 4000);
        for (const int n : {100, 200, 400, 800}) {
            const auto z = one_cycle(this->law, axis, size, n).second.z;
            const double ds = 2 * std::numbers::pi / n;
            for (std::size_t k = 0; k < Law::n_internal; ++k)
                EXPECT_NEAR(z[k], reference[k], constant * ds * ds + reference_error)
                    << "z " << k << ", " << n << " steps";
        }
        if (TypeParam::cycle == Cycle::path_dependent) {
            EXPECT_GT(std::abs(reference[Law::n_internal - 1]), 1e3 * reference_error)
                << "the ledger shows what a closed cycle creates or loses";
        }
    }
}

TYPED_TEST(MaterialContract, Ledger_OfAClosedCycle_HasTheWorkOfTheStresses) {
    using Law = typename TypeParam::Law;
    if constexpr (Law::n_internal > 0) {
        constexpr double size = 0.08, axis = -1.3;
        constexpr int n = 2000;
        const auto [work, memory] = one_cycle(this->law, axis, size, n);
        const double ds = 2 * std::numbers::pi / n;
        // ledger and quadrature differ by chords against arcs, ds^2/6, and kinks in the stiffening, of the same order
        EXPECT_NEAR(memory.z[Law::n_internal - 1], work, modulus * size * size * ds * ds);
    }
}

TYPED_TEST(MaterialContract, Rates_AtAnyState_AreTheDerivativesOfTheUpdate) {
    using Law = typename TypeParam::Law;
    if constexpr (Law::n_internal > 0) {
        const Tensor<double> velocity{-0.7, 0.4, 0.9, -0.2};
        for (const double axis : axis_angles_under_test) {
            for (const Tensor<double>& h : finite_deformations()) {
                const auto accepted = updated(this->law, h, axis, this->memories(axis)[1]);
                const auto point = point_at(h, axis);
                const auto volume = this->law.volume(point.area_strain);
                const auto stress = this->law.stress(point, volume, accepted);
                const auto rate = this->law.rate(point, volume, rates_at(point, velocity), stress, stress.q, accepted);
                for (std::size_t k = 0; k < Law::n_internal; ++k) {
                    const double by_time = derivative_at_zero(
                        [&](double t) { return updated(this->law, sum(h, scaled(t, velocity)), axis, accepted).z[k]; });
                    EXPECT_NEAR(rate[k], by_time, difference_error) << "z " << k;
                }
            }
        }
    }
}

TYPED_TEST(MaterialContract, GivenInternalVariables_ThatTheUpdateFound_GiveTheSameStress) {
    using Law = typename TypeParam::Law;
    for (const double axis : axis_angles_under_test) {
        for (const Tensor<double>& h : finite_deformations()) {
            const auto accepted = this->memories(axis)[1];
            const auto point = point_at(h, axis);
            const auto volume = this->law.volume(point.area_strain);
            if constexpr (requires { this->law.stress_at(point, volume, accepted); }) {
                const auto stress = this->law.stress(point, volume, accepted);
                const auto given = this->law.stress_at(point, volume, updated(this->law, h, axis, accepted));
                EXPECT_NEAR(given.p_alpha.x, stress.p_alpha.x, round_off);
                EXPECT_NEAR(given.p_alpha.y, stress.p_alpha.y, round_off);
                EXPECT_NEAR(given.p_beta.x, stress.p_beta.x, round_off);
                EXPECT_NEAR(given.p_beta.y, stress.p_beta.y, round_off);
                EXPECT_NEAR(given.q, stress.q, round_off);
            } else {
                EXPECT_LE(Law::n_internal, 1u) << "z holds no stress";
            }
        }
    }
}

TYPED_TEST(MaterialContract, Evaluation_OfATrialState_LeavesTheAcceptedMemoryAlone) {
    const auto before = this->memories(0.4)[1];
    const auto accepted = before;
    (void)updated(this->law, finite_deformations()[1], 0.4, accepted);
    const auto again = first_piola(this->law, finite_deformations()[2], 0.4, accepted);
    EXPECT_EQ(again, first_piola(this->law, finite_deformations()[2], 0.4, before)) << "a trial has no memory";
}

}  // namespace
}  // namespace gneiss
