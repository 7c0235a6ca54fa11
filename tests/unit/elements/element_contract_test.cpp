// What every element must fulfil, with every law. A new one joins by one line in element_cases.hpp.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <numbers>

#include "element_cases.hpp"
#include "support/eps.hpp"
#include "support/finite_differences.hpp"
#include "support/packs.hpp"

namespace gneiss {
namespace {

using test::eps;

// Forces are stresses of up to 1e9 Pa on lengths and a thickness near 1 m; some hundred operations.
constexpr double force_scale = modulus;
constexpr double round_off = 200 * eps * force_scale;
// Central difference of an energy of up to 1e8 J: truncation h^4/30 times a fifth derivative, round-off eps w/h.
constexpr double difference_error = 1e-10 * force_scale;

constexpr double axis = 0.4;  ///< angle of alpha, rad, without relation to any side

template <class Case>
class ElementContract : public testing::Test {};
TYPED_TEST_SUITE(ElementContract, Elements);

// ---- geometry
// --------------------------------------------------------------------------------------------------------

/// Area inside the nodes, which all elements number counter-clockwise around their boundary, m2.
template <class Element>
double enclosed_area(const Nodal<Element, double>& x) {
    double twice = 0;
    for (std::size_t n = 0; n < x.size(); ++n) twice += cross(x[n], x[(n + 1) % x.size()]);
    return 0.5 * twice;
}

TYPED_TEST(ElementContract, Nodes_AsDrawn_GiveTheSubTrianglesOfTheDrawing) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::drawn();
    const auto geometry = geometry_of<Element>(x, axis);
    const auto centres = TypeParam::sub_centres();
    for (std::size_t s = 0; s < centres.size(); ++s) {
        const auto& [a, b, c] = Element::sub_triangles[s];
        const Vec2<double> centre = (1.0 / 3) * (x[a] + x[b] + x[c]);
        EXPECT_NEAR(centre.x, centres[s].x, 4 * eps) << "sub-triangle " << s;
        EXPECT_NEAR(centre.y, centres[s].y, 4 * eps) << "sub-triangle " << s;
        EXPECT_NEAR(geometry.of(static_cast<int>(s)).volume, thickness_under_test * 0.5 / Element::n_sub, 4 * eps);
    }
}

TYPED_TEST(ElementContract, Volumes_OfADistortedElement_FillItsBoundary) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    double volume = 0;
    for (int s = 0; s < Element::n_sub; ++s) {
        EXPECT_GT(geometry.of(s).volume, 0);
        volume += geometry.of(s).volume;
    }
    EXPECT_NEAR(volume, thickness_under_test * enclosed_area<Element>(x), 8 * eps);
    EXPECT_NEAR(geometry.inverse_volume * volume, 1, 8 * eps);
}

TYPED_TEST(ElementContract, Mass_AThirdOfEachSubTriangleToItsNodes_IsAllOfIt) {
    using Element = typename TypeParam::Element;
    const auto geometry = geometry_of<Element>(TypeParam::distorted(), axis);
    std::array<double, Element::n_nodes> share{};
    double volume = 0;
    for (std::size_t s = 0; s < Element::n_sub; ++s) {
        volume += geometry.of(static_cast<int>(s)).volume;
        for (const int node : Element::sub_triangles[s])
            share[static_cast<std::size_t>(node)] += geometry.of(static_cast<int>(s)).volume / 3;
    }
    double total = 0;
    for (const double part : share) {
        EXPECT_GT(part, 0) << "a node without mass";
        total += part;
    }
    EXPECT_NEAR(total, volume, 8 * eps);
}

TYPED_TEST(ElementContract, AffineDisplacement_OnAnyAxes_GivesItsGradientInEverySubTriangle) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    for (const double angle : axis_angles_under_test) {
        const auto geometry = geometry_of<Element>(x, angle);
        for (const Tensor<double>& h : finite_deformations()) {
            const auto kinematics = triangle_kinematics<Element>(affine<Element>(x, h), geometry, Sampling::mean);
            const auto expected = point_at(h, angle);
            for (const auto& point : kinematics.point) {
                EXPECT_NEAR(point.h_alpha.x, expected.h_alpha.x, 50 * eps);
                EXPECT_NEAR(point.h_alpha.y, expected.h_alpha.y, 50 * eps);
                EXPECT_NEAR(point.h_beta.x, expected.h_beta.x, 50 * eps);
                EXPECT_NEAR(point.h_beta.y, expected.h_beta.y, 50 * eps);
                EXPECT_NEAR(point.area_strain, expected.area_strain, 100 * eps);
            }
            EXPECT_NEAR(kinematics.volume_strain, expected.area_strain, 100 * eps);
        }
    }
}

TYPED_TEST(ElementContract, VolumetricStretch_OfAnyDisplacement_IsTheRatioOfAreas) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    std::mt19937 random(4);
    for (const Tensor<double>& h : finite_deformations()) {
        const auto u = noisy<Element>(x, h, random);
        auto moved = x;
        for (std::size_t n = 0; n < x.size(); ++n) moved[n] += u[n];
        const auto kinematics = triangle_kinematics<Element>(u, geometry, Sampling::mean);
        EXPECT_NEAR(1 + kinematics.volume_strain, enclosed_area<Element>(moved) / enclosed_area<Element>(x), 50 * eps);
    }
}

// ---- forces
// ----------------------------------------------------------------------------------------------------------

TYPED_TEST(ElementContract, FiniteRigidMotion_AnyLaw_HasNoForce) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    for_each_law([&]<class Case>() {
        const auto law = Case::law();
        const auto memory = element_at_rest<Element>(law, geometry, Sampling::mean);
        for (const double angle : {1e-9, 0.3, std::numbers::pi / 2, std::numbers::pi, -2.5, 40.0}) {
            auto u = affine<Element>(x, rigid_rotation(angle));
            for (Vec2<double>& value : u) value += Vec2<double>{1.5, -0.7};
            const auto f = forces<Element>(law, u, geometry, memory, Sampling::mean);
            EXPECT_LE(largest<Element>(f), round_off) << testing::internal::GetTypeName<Case>() << ", angle " << angle;
        }
    });
}

TYPED_TEST(ElementContract, ConstantStrain_AnyLaw_GivesTheTractionsOnItsSides) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    for_each_law([&]<class Case>() {
        const auto law = Case::law();
        const auto memory = element_at_rest<Element>(law, geometry, Sampling::mean);
        for (const Tensor<double>& h : finite_deformations()) {
            const auto f = forces<Element>(law, affine<Element>(x, h), geometry, memory, Sampling::mean);
            const auto p = first_piola(law, h, axis, memory[0]);
            // each side, from node to node around the boundary, hands half of its resultant P N h to both ends
            Nodal<Element, double> resultant{};
            for (std::size_t n = 0; n < x.size(); ++n) {
                const std::size_t next = (n + 1) % x.size();
                const Vec2<double> normal = -turned(x[next] - x[n]);
                const Vec2<double> half =
                    (0.5 * thickness_under_test) *
                    Vec2<double>{p[0] * normal.x + p[1] * normal.y, p[2] * normal.x + p[3] * normal.y};
                resultant[n] += half;
                resultant[next] += half;
            }
            for (std::size_t n = 0; n < x.size(); ++n) {
                EXPECT_NEAR(f[n].x, -resultant[n].x, round_off) << testing::internal::GetTypeName<Case>();
                EXPECT_NEAR(f[n].y, -resultant[n].y, round_off) << testing::internal::GetTypeName<Case>();
            }
        }
    });
}

TYPED_TEST(ElementContract, Forces_OfAnyState_AreInBalance) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    for_each_law([&]<class Case>() {
        const auto law = Case::law();
        const auto memory = element_at_rest<Element>(law, geometry, Sampling::mean);
        std::mt19937 random(5);
        for (const Tensor<double>& h : finite_deformations()) {
            const auto u = noisy<Element>(x, h, random);
            const auto f = forces<Element>(law, u, geometry, memory, Sampling::mean);
            Vec2<double> sum{0, 0};
            double moment = 0;
            for (std::size_t n = 0; n < x.size(); ++n) {
                sum += f[n];
                moment += cross(x[n] + u[n], f[n]);
            }
            EXPECT_NEAR(sum.x, 0, round_off) << testing::internal::GetTypeName<Case>();
            EXPECT_NEAR(sum.y, 0, round_off) << testing::internal::GetTypeName<Case>();
            EXPECT_NEAR(moment, 0, round_off) << testing::internal::GetTypeName<Case>();
        }
    });
}

template <class Element, class Law>
double stored_energy(const Law& law, const Nodal<Element, double>& u,
                     const TriangleGeometry<Element, double>& geometry) {
    const auto kinematics = triangle_kinematics<Element>(u, geometry, Sampling::mean);
    const auto volume = law.volume(kinematics.volume_strain);
    double energy = 0;
    for (std::size_t s = 0; s < Element::n_sub; ++s)
        energy += geometry.of(static_cast<int>(s)).volume * law.energy_density(kinematics.point[s], volume);
    return energy;
}

TYPED_TEST(ElementContract, Forces_OfLawsWithStoredEnergy_AreItsNegativeGradient) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    for_each_law([&]<class Case>() {
        if constexpr (Case::Law::has_stored_energy) {
            const auto law = Case::law();
            std::mt19937 random(6);
            for (const Tensor<double>& h : finite_deformations()) {
                const auto u = noisy<Element>(x, h, random);
                const auto f = forces<Element>(law, u, geometry, {}, Sampling::mean);
                for (std::size_t n = 0; n < x.size(); ++n) {
                    for (const bool along_y : {false, true}) {
                        const auto energy = [&](double step) {
                            auto moved = u;
                            (along_y ? moved[n].y : moved[n].x) += step;
                            return stored_energy<Element>(law, moved, geometry);
                        };
                        // derivatives are with respect to lengths of half a side: shorter steps than for strains
                        EXPECT_NEAR(along_y ? f[n].y : f[n].x, -derivative_at_zero(energy, difference_step / 3),
                                    difference_error)
                            << testing::internal::GetTypeName<Case>() << ", node " << n;
                    }
                }
            }
        }
    });
}

TYPED_TEST(ElementContract, Tangent_OfConservativeLaws_IsSymmetric_AndThatOfFiniteDifferences) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    for_each_law([&]<class Case>() {
        const auto law = Case::law();
        const auto memory = element_at_rest<Element>(law, geometry, Sampling::mean);
        std::mt19937 random(7);
        const auto u = noisy<Element>(x, finite_deformations()[3], random);
        const Eigen::MatrixXd k = stiffness<Element>(law, u, geometry, memory, Sampling::mean);
        if (Case::cycle == Cycle::free) {
            // stiffnesses are a few times the modulus: sides over heights
            EXPECT_LE((k - k.transpose()).cwiseAbs().maxCoeff(), 5 * round_off)
                << testing::internal::GetTypeName<Case>();
        }
        for (int j = 0; j < k.cols(); ++j) {
            const auto force = [&](double step) -> Eigen::VectorXd {
                auto moved = u;
                (j % 2 == 0 ? moved[static_cast<std::size_t>(j / 2)].x : moved[static_cast<std::size_t>(j / 2)].y) +=
                    step;
                const auto f = forces<Element>(law, moved, geometry, memory, Sampling::mean);
                return Eigen::Map<const Eigen::VectorXd>(&f[0].x, k.rows());
            };
            const Eigen::VectorXd column = derivative_at_zero(force, difference_step / 10);
            // fifth derivatives grow with the fifth power of strain per displacement, and with stiffening: 1e-8 M
            EXPECT_LE((k.col(j) + column).cwiseAbs().maxCoeff(), 100 * difference_error)
                << testing::internal::GetTypeName<Case>();
        }
    });
}

// ---- packs
// -----------------------------------------------------------------------------------------------------------

/// Lane by lane into one pack: T is a struct of doubles only, P the same struct of packs.
template <class P, class T>
P interleaved(const std::array<T, pack_width>& scalars) {
    static_assert(sizeof(P) == pack_width * sizeof(T));
    P packs{};
    auto* to = reinterpret_cast<double*>(&packs);
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        const auto* from = reinterpret_cast<const double*>(&scalars[lane]);
        for (std::size_t k = 0; k < sizeof(T) / sizeof(double); ++k) to[k * pack_width + lane] = from[k];
    }
    return packs;
}

TYPED_TEST(ElementContract, Packs_LaneByLane_AgreeWithScalars) {
    using Element = typename TypeParam::Element;
    for_each_law([&]<class Case>() {
        using Law = typename Case::Law;
        const auto law = Case::law();
        std::mt19937 random(8);
        std::uniform_real_distribution<double> noise(-0.1, 0.1);
        for (const double size : {1.0, 1e-2, 1e-7}) {  // library functions, mixed, series
            std::array<TriangleGeometry<Element, double>, pack_width> geometry;
            std::array<Nodal<Element, double>, pack_width> u, f;
            std::array<ElementMemory<Element, Law, double>, pack_width> memory, after;
            for (std::size_t lane = 0; lane < pack_width; ++lane) {
                // shapes differ from lane to lane; straight sides stay straight
                Nodal<Element, double> shape = TypeParam::distorted();
                const auto change =
                    affine<Element>(shape, {noise(random), noise(random), noise(random), noise(random)});
                for (std::size_t n = 0; n < shape.size(); ++n) shape[n] += change[n];
                geometry[lane] = geometry_of<Element>(shape, axis + static_cast<double>(lane));
                u[lane] = noisy<Element>(shape, scaled(size, finite_deformations()[lane % 3]), random, 0.03 * size);
                const auto before = noisy<Element>(shape, scaled(size, finite_deformations()[1]), random, 0.01 * size);
                memory[lane] =
                    led_to<Element>(law, before, geometry[lane],
                                    element_at_rest<Element>(law, geometry[lane], Sampling::mean), Sampling::mean);
                f[lane] = forces<Element>(law, u[lane], geometry[lane], memory[lane], Sampling::mean);
                after[lane] = led_to<Element>(law, u[lane], geometry[lane], memory[lane], Sampling::mean);
            }
            const auto pack_geometry = interleaved<TriangleGeometry<Element, Pack>>(geometry);
            const auto pack_u = interleaved<Nodal<Element, Pack>>(u);
            ElementMemory<Element, Law, Pack> pack_memory{};
            if constexpr (Law::n_internal + Law::n_history > 0)
                pack_memory = interleaved<ElementMemory<Element, Law, Pack>>(memory);
            const auto pack_f = forces<Element>(law, pack_u, pack_geometry, pack_memory, Sampling::mean);
            const auto pack_after = led_to<Element>(law, pack_u, pack_geometry, pack_memory, Sampling::mean);
            for (std::size_t lane = 0; lane < pack_width; ++lane) {
                for (std::size_t n = 0; n < f[lane].size(); ++n) {
                    EXPECT_NEAR(lanes(pack_f[n].x)[lane], f[lane][n].x, round_off * size);
                    EXPECT_NEAR(lanes(pack_f[n].y)[lane], f[lane][n].y, round_off * size);
                }
                for (std::size_t s = 0; s < after[lane].size(); ++s)
                    for (std::size_t k = 0; k < Law::n_internal; ++k)
                        EXPECT_NEAR(lanes(pack_after[s].z[k])[lane], after[lane][s].z[k], round_off * size);
            }
        }
    });
}

// ---- rates and viscosity
// ---------------------------------------------------------------------------------------------

TYPED_TEST(ElementContract, Rates_OfAnyMotion_AreDerivativesInTime) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    std::mt19937 random(9);
    for (const Tensor<double>& h : finite_deformations()) {
        const auto u = noisy<Element>(x, h, random);
        const auto v = noisy<Element>(x, {0.5, -0.9, 0.7, 0.3}, random, 0.3);
        const auto at = [&](double t) {
            auto moved = u;
            for (std::size_t n = 0; n < x.size(); ++n) moved[n] += t * v[n];
            return triangle_kinematics<Element>(moved, geometry, Sampling::mean);
        };
        const auto rates = triangle_rates<Element>(v, at(0), geometry, Sampling::mean);
        constexpr double error = 1e-11;  // polynomials of degree 2 in t, and a logarithm: round-off of the difference
        for (std::size_t s = 0; s < rates.size(); ++s) {
            EXPECT_NEAR(rates[s].alpha.x, derivative_at_zero([&](double t) { return at(t).point[s].h_alpha.x; }),
                        error);
            EXPECT_NEAR(rates[s].alpha.y, derivative_at_zero([&](double t) { return at(t).point[s].h_alpha.y; }),
                        error);
            EXPECT_NEAR(rates[s].beta.x, derivative_at_zero([&](double t) { return at(t).point[s].h_beta.x; }), error);
            EXPECT_NEAR(rates[s].beta.y, derivative_at_zero([&](double t) { return at(t).point[s].h_beta.y; }), error);
            EXPECT_NEAR(rates[s].volume, derivative_at_zero([&](double t) { return std::log1p(at(t).volume_strain); }),
                        10 * error);
        }
    }
}

TYPED_TEST(ElementContract, ViscousForces_OnRigidMotion_Vanish) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    constexpr ViscousStress viscosity{2, 5};
    std::mt19937 random(11);
    for (const Tensor<double>& h : finite_deformations()) {
        const auto u = noisy<Element>(x, h, random);
        Nodal<Element, double> v, f{};
        for (std::size_t n = 0; n < x.size(); ++n) v[n] = 3.0 * turned(x[n] + u[n]) + Vec2<double>{0.4, -2};
        const auto kinematics = triangle_kinematics<Element>(u, geometry, Sampling::mean);
        const auto rates = triangle_rates<Element>(v, kinematics, geometry, Sampling::mean);
        const double power = add_viscous_force<Element>(viscosity, kinematics, rates, geometry, f);
        EXPECT_LE(largest<Element>(f), 500 * eps);
        EXPECT_LE(std::abs(power), 500 * eps);
    }
}

TYPED_TEST(ElementContract, ViscousForces_OnAnyMotion_DissipateWhatTheyReport) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    std::mt19937 random(12);
    for (const ViscousStress viscosity : {ViscousStress{2, 0}, ViscousStress{0, 5}, ViscousStress{2, 5}}) {
        for (const Tensor<double>& h : finite_deformations()) {
            const auto u = noisy<Element>(x, h, random);
            const auto v = noisy<Element>(x, {0.5, -0.9, 0.7, 0.3}, random, 0.5);
            Nodal<Element, double> f{};
            const auto kinematics = triangle_kinematics<Element>(u, geometry, Sampling::mean);
            const auto rates = triangle_rates<Element>(v, kinematics, geometry, Sampling::mean);
            const double power = add_viscous_force<Element>(viscosity, kinematics, rates, geometry, f);
            double work = 0, on_points = 0;
            for (std::size_t n = 0; n < x.size(); ++n) work -= dot(f[n], v[n]);
            for (std::size_t s = 0; s < rates.size(); ++s) {
                const auto stress = viscosity.stress(kinematics.point[s], rates[s]);
                on_points += geometry.of(static_cast<int>(s)).volume *
                             (dot(stress.p_alpha, rates[s].alpha) + dot(stress.p_beta, rates[s].beta));
            }
            EXPECT_GT(power, 0);
            EXPECT_NEAR(power, work, 500 * eps) << "-f . v";
            EXPECT_NEAR(power, on_points, 500 * eps) << "P : F'";
        }
    }
}

TYPED_TEST(ElementContract, ViscousForces_OfADual_HaveThemselvesAsDerivative) {
    using Element = typename TypeParam::Element;  // they are linear in v
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    constexpr ViscousStress viscosity{2, 5};
    using D = Dual<1>;
    const auto u = affine<Element>(x, finite_deformations()[2]);
    const auto v = affine<Element>(x, {0.5, -0.9, 0.7, 0.3});
    Nodal<Element, D> scaled_v, f;
    for (std::size_t n = 0; n < x.size(); ++n) {
        const D one = D::variable(1.0, 0);
        scaled_v[n] = {v[n].x * one, v[n].y * one};
        f[n] = {D(0.0), D(0.0)};
    }
    const auto kinematics = triangle_kinematics<Element>(u, geometry, Sampling::mean);
    const auto rates = triangle_rates<Element>(scaled_v, kinematics, geometry, Sampling::mean);
    add_viscous_force<Element>(viscosity, kinematics, rates, geometry, f);
    for (const auto& force : f) {
        EXPECT_NEAR(force.x.derivative[0], force.x.value, 500 * eps);
        EXPECT_NEAR(force.y.derivative[0], force.y.value, 500 * eps);
    }
}

// ---- inversion
// -------------------------------------------------------------------------------------------------------

TYPED_TEST(ElementContract, IsUpright_UntilOneSubTriangleIsTurnedInsideOut) {
    using Element = typename TypeParam::Element;
    const auto x = TypeParam::distorted();
    const auto geometry = geometry_of<Element>(x, axis);
    const auto upright = [&](const Nodal<Element, double>& u) {
        return is_upright(triangle_kinematics<Element>(u, geometry, Sampling::mean));
    };
    EXPECT_TRUE(upright({}));
    EXPECT_TRUE(upright(affine<Element>(x, rigid_rotation(2.0))));
    EXPECT_TRUE(upright(affine<Element>(x, {-0.99, 0, 0, 0})));
    EXPECT_FALSE(upright(affine<Element>(x, {-1.01, 0, 0, 0})));
    for (std::size_t s = 0; s < Element::n_sub; ++s) {
        // one corner of one sub-triangle through its opposite side
        const auto& [a, b, c] = Element::sub_triangles[s];
        Nodal<Element, double> u{};
        u[b] = 1.1 * (x[a] + x[c] - 2.0 * x[b]);
        EXPECT_FALSE(upright(u)) << "sub-triangle " << s;
    }
}

TYPED_TEST(ElementContract, IsUpright_NotWhereANodeIsNotANumber) {
    using Element = typename TypeParam::Element;
    const auto geometry = geometry_of<Element>(TypeParam::distorted(), axis);
    for (std::size_t n = 0; n < Element::n_nodes; ++n) {
        Nodal<Element, double> u{};
        u[n].y = std::numeric_limits<double>::quiet_NaN();
        EXPECT_FALSE(is_upright(triangle_kinematics<Element>(u, geometry, Sampling::mean))) << "node " << n;
        Nodal<Element, Pack> packs;
        for (auto& value : packs) value = {Pack(0.0), Pack(0.0)};
        packs[n].x = pack_of(
            [](std::size_t lane) { return lane == pack_width - 1 ? std::numeric_limits<double>::quiet_NaN() : 0.0; });
        std::array<TriangleGeometry<Element, double>, pack_width> same;
        same.fill(geometry);
        const auto pack_geometry = interleaved<TriangleGeometry<Element, Pack>>(same);
        const auto upright = is_upright(triangle_kinematics<Element>(packs, pack_geometry, Sampling::mean));
        EXPECT_FALSE(every_lane(upright)) << "node " << n;
        EXPECT_TRUE(pack_width == 1 || any_lane(upright)) << "the other lanes are sound";
    }
}

}  // namespace
}  // namespace gneiss
