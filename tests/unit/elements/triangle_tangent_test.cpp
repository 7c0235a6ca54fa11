// Element matrices put together from the derivatives of the law, against dual numbers through the whole force.

#include "elements/triangle_tangent.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "element_cases.hpp"

namespace gneiss {
namespace {

// Two ways through the same products, of some hundred operations each.
constexpr double round_off = 500 * std::numeric_limits<double>::epsilon();
constexpr double axis = 0.4;  ///< rad

template <class Case>
class TriangleTangent : public testing::Test {};
TYPED_TEST_SUITE(TriangleTangent, Elements);

template <class Element>
Eigen::MatrixXd dense(const ElementMatrix<Element, double>& rows) {
    const auto n = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            matrix(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    return matrix;
}

double largest_entry(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

/// What the law offers in the element.
template <class Element, class Law>
std::vector<Sampling> samplings() {
    if (Element::n_sub > 1 && Law::offers_centre) return {Sampling::mean, Sampling::centre};
    return {Sampling::mean};
}

TYPED_TEST(TriangleTangent, AnyLawAndSampling_IsTheDerivativeByDualNumbers) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    std::mt19937 random(5);
    for_each_law([&]<class Case>() {
        using Law = typename Case::Law;
        const Law law = Case::law();
        for (const Sampling sampling : samplings<Element, Law>()) {
            const auto memory = led_to<Element>(law, noisy<Element>(x, {0.03, 0.02, -0.01, 0.04}, random), geometry,
                                                element_at_rest<Element>(law, geometry, sampling), sampling);
            for (const Tensor<double>& h : finite_deformations()) {
                const auto u = noisy<Element>(x, h, random);
                ElementMatrix<Element, double> rows{};
                add_law_tangent<Element, false>(law, triangle_kinematics<Element>(u, geometry, sampling), geometry,
                                                memory, -2.0, sampling, rows);
                const Eigen::MatrixXd expected = 2 * stiffness<Element>(law, u, geometry, memory, sampling);
                EXPECT_LE(largest_entry(dense<Element>(rows) - expected), round_off * largest_entry(expected))
                    << testing::internal::GetTypeName<Case>();
            }
        }
    });
}

TYPED_TEST(TriangleTangent, GivenStress_IsTheDerivativeAtFixedStress) {
    using Element = typename TypeParam::Element;
    using Law = MunjizaHypoelastic<false>;
    constexpr int n = 2 * Element::n_nodes;
    const Law law = StiffeningHypoelastic<false>::law();
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    std::mt19937 random(6);
    const auto memory = led_to<Element>(law, noisy<Element>(x, {0.03, 0.02, -0.01, 0.04}, random), geometry,
                                        element_at_rest<Element>(law, geometry, Sampling::mean), Sampling::mean);
    const auto u = noisy<Element>(x, {-0.02, 0.05, 0.01, -0.03}, random);
    ElementMatrix<Element, double> rows{};
    add_law_tangent<Element, true>(law, triangle_kinematics<Element>(u, geometry, Sampling::mean), geometry, memory,
                                   1.0, MeanSampling{}, rows);
    Nodal<Element, Dual<n>> variable, f;
    for (int node = 0; node < Element::n_nodes; ++node) {
        const auto at = static_cast<std::size_t>(node);
        variable[at] = {Dual<n>::variable(u[at].x, 2 * node), Dual<n>::variable(u[at].y, 2 * node + 1)};
    }
    const auto kinematics = triangle_kinematics<Element>(variable, geometry, Sampling::mean);
    triangle_force(kinematics, geometry, triangle_stress<Element, true>(law, kinematics, geometry, memory), f);
    double size = 0, error = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double expected = (i % 2 == 0 ? f[i / 2].x : f[i / 2].y).derivative[j];
            size = std::max(size, std::abs(expected));
            error = std::max(error, std::abs(rows[i][j] - expected));
        }
    }
    EXPECT_LE(error, round_off * size);
}

TYPED_TEST(TriangleTangent, ViscousForce_ByDisplacementsAndVelocities_IsTheDerivativeByDualNumbers) {
    using Element = typename TypeParam::Element;
    constexpr int n = 2 * Element::n_nodes;
    using D = Dual<2 * n>;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    const ViscousStress viscosity{2e6, 5e6};
    constexpr double c_u = 0.3, c_v = -1.7;
    std::mt19937 random(7);
    const auto check = [&](Sampling sampling) {
        for (const Tensor<double>& h : finite_deformations()) {
            const auto u = noisy<Element>(x, h, random), v = noisy<Element>(x, {0.5, -1.0, 2.0, 0.7}, random, 0.5);
            const auto kinematics = triangle_kinematics<Element>(u, geometry, sampling);
            ElementMatrix<Element, double> rows{};
            add_viscous_tangent<Element>(viscosity, kinematics,
                                         triangle_rates<Element>(v, kinematics, geometry, sampling), geometry, c_u, c_v,
                                         sampling, rows);
            Nodal<Element, D> by_u, by_v, f{};
            for (int node = 0; node < Element::n_nodes; ++node) {
                const auto at = static_cast<std::size_t>(node);
                by_u[at] = {D::variable(u[at].x, 2 * node), D::variable(u[at].y, 2 * node + 1)};
                by_v[at] = {D::variable(v[at].x, n + 2 * node), D::variable(v[at].y, n + 2 * node + 1)};
            }
            const auto dual = triangle_kinematics<Element>(by_u, geometry, sampling);
            add_viscous_force<Element>(viscosity, dual, triangle_rates<Element>(by_v, dual, geometry, sampling),
                                       geometry, f);
            double size = 0, error = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const D& force = i % 2 == 0 ? f[i / 2].x : f[i / 2].y;
                for (std::size_t j = 0; j < n; ++j) {
                    const double expected = c_u * force.derivative[j] + c_v * force.derivative[n + j];
                    size = std::max(size, std::abs(expected));
                    error = std::max(error, std::abs(rows[i][j] - expected));
                }
            }
            EXPECT_LE(error, round_off * size);
        }
    };
    check(Sampling::mean);
    if (Element::n_sub > 1) check(Sampling::centre);
}

}  // namespace
}  // namespace gneiss
