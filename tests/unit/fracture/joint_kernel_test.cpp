// A joint whose faces turn against each other, up to and past 180 degrees: directions, energy, forces, tangents.

#include "fracture/joint_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/dual.hpp"
#include "base/pack.hpp"
#include "support/eps.hpp"
#include "support/packs.hpp"

namespace gneiss {
namespace {

using test::eps;

constexpr double degree = std::numbers::pi / 180;
constexpr Vec2<double> edge{0.8, 0.6};  // of length 1 m
template <class T>
using Nodal = std::array<Vec2<T>, joint_nodes>;

Vec2<double> rotated(const Vec2<double>& v, double angle) {
    return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}

/// Face b turned about the end `hinge` of the edge so that the other end opens; the whole joint turned by `whole`.
Nodal<double> opened(double angle, std::size_t hinge, double whole = 0) {
    const std::array<Vec2<double>, 2> ends{Vec2<double>{0, 0}, edge};
    Nodal<double> u;
    for (std::size_t i = 0; i < joint_points; ++i) {
        // n is on the right of the walk: about its start b opens clockwise
        const Vec2<double> b = ends[hinge] + rotated(ends[i] - ends[hinge], hinge == 0 ? -angle : angle);
        u[i] = rotated(ends[i], whole) - ends[i];
        u[i + 2] = rotated(b, whole) - ends[i];
    }
    return u;
}

/// Springs of two stiffnesses: unlike equal ones they turn the faces.
constexpr double k_n = 3, k_s = 2;  // Pa/m

double energy(const Nodal<double>& u) {
    const auto motion = joint_motion(edge, u);
    double sum = 0;
    for (std::size_t i = 0; i < joint_points; ++i)
        sum += 0.5 * (k_n * motion.opening[i] * motion.opening[i] + k_s * motion.slip[i] * motion.slip[i]);
    return sum;
}

template <class T>
Nodal<T> forces(const Nodal<T>& u) {
    const auto motion = joint_motion(edge, u);
    std::array<Traction<T>, joint_points> tractions;
    for (std::size_t i = 0; i < joint_points; ++i) tractions[i] = {k_n * motion.opening[i], k_s * motion.slip[i]};
    return joint_forces(motion, 1.0, tractions);
}

/// A little slid, stretched and skewed, as no symmetry would have it.
Nodal<double> skewed(Nodal<double> u) {
    u[0].x += 0.02;
    u[1].y -= 0.05;
    u[2].x -= 0.03;
    u[3].y += 0.04;
    return u;
}

constexpr std::array<double, 11> angles{0, 1, 60, 89, 91, 150, 179, 180, 181, 240, 330};  // degrees

TEST(JointKernel, FacesOpenedLikeABook_StandOpenByTheChord_PastAHalfTurn) {
    for (const std::size_t hinge : {std::size_t{0}, std::size_t{1}})
        for (const double angle : angles) {
            const auto motion = joint_motion(edge, opened(angle * degree, hinge, 0.7));
            // round-off of positions of 1 m over the shortest vector that a direction is taken from, 2^(1/2)
            EXPECT_NEAR(motion.opening[1 - hinge], 2 * std::sin(0.5 * angle * degree), 16 * eps) << angle;
            EXPECT_NEAR(motion.slip[1 - hinge], 0, 16 * eps) << angle;
            EXPECT_NEAR(motion.opening[hinge], 0, 16 * eps) << angle;
            EXPECT_NEAR(motion.slip[hinge], 0, 16 * eps) << angle;
        }
}

TEST(JointKernel, FacesPressedTogether_StandClosed) {
    for (const double angle : {-0.01, -1.0, -20.0})
        for (const std::size_t hinge : {std::size_t{0}, std::size_t{1}})
            EXPECT_LT(joint_motion(edge, opened(angle * degree, hinge)).opening[1 - hinge], 0) << angle;
}

TEST(JointKernel, Energy_IsContinuousWhereDirectionsAreTakenAnotherWay) {
    constexpr double step = 1e-9;  // rad: across it energies of some J change by as much
    for (const double angle : {90.0, 180.0, 270.0})
        for (const std::size_t hinge : {std::size_t{0}, std::size_t{1}}) {
            const double before = energy(skewed(opened(angle * degree - step, hinge)));
            const double after = energy(skewed(opened(angle * degree + step, hinge)));
            EXPECT_NEAR(before, after, 20 * step * (1 + before)) << angle;
        }
}

TEST(JointKernel, Forces_AreTheGradientOfTheEnergy_AtAnyAngle) {
    constexpr double step = 1e-6;  // truncation step^2, round-off eps/step: below 1e-9 of forces of some N
    for (const std::size_t hinge : {std::size_t{0}, std::size_t{1}})
        for (const double angle : angles) {
            const Nodal<double> at = skewed(opened(angle * degree, hinge, 0.7));
            const auto f = forces(at);
            for (std::size_t k = 0; k < joint_nodes; ++k)
                for (const auto component : {&Vec2<double>::x, &Vec2<double>::y}) {
                    Nodal<double> plus = at, minus = at;
                    plus[k].*component += step;
                    minus[k].*component -= step;
                    EXPECT_NEAR(f[k].*component, (energy(minus) - energy(plus)) / (2 * step), 1e-8) << angle;
                }
        }
}

TEST(JointKernel, Forces_BalanceInForceAndMoment_AtAnyAngle) {
    for (const double angle : angles) {
        const Nodal<double> u = skewed(opened(angle * degree, 0, 0.7));
        const auto f = forces(u);
        const std::array<Vec2<double>, joint_nodes> at{u[0], edge + u[1], u[2], edge + u[3]};
        Vec2<double> sum{0, 0};
        double moment = 0;
        for (std::size_t k = 0; k < joint_nodes; ++k) {
            sum += f[k];
            moment += cross(at[k], f[k]);
        }
        // round-off of forces of some N on arms of some m
        for (const double rest : {sum.x, sum.y, moment}) EXPECT_NEAR(rest, 0, 200 * eps) << angle;
    }
}

TEST(JointKernel, Tangent_IsTheDerivativeOfTheForces_AtAnyAngle) {
    using D = Dual<2 * joint_nodes, double>;
    constexpr double step = 1e-6;  // as above, of forces
    for (const std::size_t hinge : {std::size_t{0}, std::size_t{1}})
        for (const double angle : angles) {
            const Nodal<double> at = skewed(opened(angle * degree, hinge, 0.7));
            Nodal<D> moved;
            for (int k = 0; k < static_cast<int>(joint_nodes); ++k) {
                const auto node = static_cast<std::size_t>(k);
                moved[node] = {D::variable(at[node].x, 2 * k), D::variable(at[node].y, 2 * k + 1)};
            }
            const auto f = forces(moved);
            for (int j = 0; j < 2 * static_cast<int>(joint_nodes); ++j) {
                const auto component = j % 2 == 0 ? &Vec2<double>::x : &Vec2<double>::y;
                const auto node = static_cast<std::size_t>(j / 2);
                Nodal<double> plus = at, minus = at;
                plus[node].*component += step;
                minus[node].*component -= step;
                const auto f_plus = forces(plus), f_minus = forces(minus);
                for (std::size_t k = 0; k < joint_nodes; ++k) {
                    EXPECT_NEAR(f[k].x.derivative[j], (f_plus[k].x - f_minus[k].x) / (2 * step), 1e-7) << angle;
                    EXPECT_NEAR(f[k].y.derivative[j], (f_plus[k].y - f_minus[k].y) / (2 * step), 1e-7) << angle;
                }
            }
        }
}

TEST(JointKernel, LanesOfAPack_AreJointsOneByOne) {
    const auto at = [](std::size_t lane) { return skewed(opened(angles[lane % angles.size()] * degree, lane % 2)); };
    Nodal<Pack> u;
    for (std::size_t k = 0; k < joint_nodes; ++k)
        u[k] = {pack_of([&](std::size_t lane) { return at(lane)[k].x; }),
                pack_of([&](std::size_t lane) { return at(lane)[k].y; })};
    const auto motion = joint_motion(Vec2<Pack>{Pack(edge.x), Pack(edge.y)}, u);
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        const auto alone = joint_motion(edge, at(lane));
        for (std::size_t i = 0; i < joint_points; ++i) {
            EXPECT_NEAR(motion.opening[i].get(lane), alone.opening[i], 8 * eps) << lane;
            EXPECT_NEAR(motion.slip[i].get(lane), alone.slip[i], 8 * eps) << lane;
        }
    }
}

}  // namespace
}  // namespace gneiss
