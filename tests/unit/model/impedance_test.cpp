#include "model/impedance.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "unit/model/tiny_mesh.hpp"

namespace gneiss {
namespace {

using std::numbers::pi;

/// Closed forms of some ten operations.
constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
/// VERIFICATION 2 gives speeds to 0.1 m/s.
constexpr double printed_digits = 0.051;

Vec2<double> direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

PlaneStiffness set_19_20(double axis) { return plane_stiffness({0, 1e9, 2e9, 1e9}, axis, 1000); }
PlaneStiffness set_22_23(double axis) { return plane_stiffness({0.267e9, 0.8e9, 1.6e9, 0.8e9}, axis, 1000); }

/// Group speed of the faster wave whose energy travels along `angle`, by bisection over the wave normal.
double group_speed(const PlaneStiffness& stiffness, double angle) {
    const auto group = [&](double normal) { return plane_waves(stiffness, direction(normal))[0].group_velocity; };
    const Vec2<double> along = direction(angle);
    double low = angle - 0.5, high = angle + 0.5;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (cross(along, group(middle)) < 0 ? low : high) = middle;
    }
    return dot(group(low), along);
}

/// Traction on the plane with normal n of the velocity gradient or displacement gradient a (outer) n: C:(a n) . n
Vec2<double> traction_of_wave(const PlaneStiffness& stiffness, const Vec2<double>& a, const Vec2<double>& n) {
    // on the material axes, component by component from the strain
    const Vec2<double> alpha = direction(stiffness.axis_angle), beta = turned(alpha);
    const double a1 = dot(a, alpha), a2 = dot(a, beta), n1 = dot(n, alpha), n2 = dot(n, beta);
    const double e11 = a1 * n1, e22 = a2 * n2, shear = a1 * n2 + a2 * n1;
    const double s11 = stiffness.C_aaaa * e11 + stiffness.C_aabb * e22;
    const double s22 = stiffness.C_aabb * e11 + stiffness.C_bbbb * e22;
    const double s12 = stiffness.C_abab * shear;
    return (s11 * n1 + s12 * n2) * alpha + (s12 * n1 + s22 * n2) * beta;
}

TEST(PlaneWaves, Isotropic_AnyDirection_HaveTheSpeedsOfPAndSWaves) {
    const double lambda = 4e9, mu = 3e9, rho = 2650;
    const PlaneStiffness rock{lambda + 2 * mu, lambda + 2 * mu, lambda, mu, 0.3, rho};
    for (double angle : {0.0, 0.4, 1.1, 2.8, -1.9}) {
        const Vec2<double> n = direction(angle);
        const auto [p, s] = plane_waves(rock, n);
        const double c_p = std::sqrt((lambda + 2 * mu) / rho), c_s = std::sqrt(mu / rho);
        EXPECT_NEAR(p.phase_speed, c_p, round_off * c_p);
        EXPECT_NEAR(s.phase_speed, c_s, round_off * c_p);
        EXPECT_NEAR(std::abs(dot(p.polarisation, n)), 1, round_off);
        EXPECT_NEAR(dot(s.polarisation, n), 0, round_off);
        EXPECT_NEAR(p.group_velocity.x, c_p * n.x, round_off * c_p);
        EXPECT_NEAR(p.group_velocity.y, c_p * n.y, round_off * c_p);
        const SymmetricMatrix z = impedance(rock, n);
        const Vec2<double> z_n = z * n, z_t = z * turned(n);
        EXPECT_NEAR(dot(z_n, n), rho * c_p, round_off * rho * c_p);
        EXPECT_NEAR(dot(z_t, turned(n)), rho * c_s, round_off * rho * c_p);
        EXPECT_NEAR(dot(z_t, n), 0, round_off * rho * c_p);
    }
}

TEST(PlaneWaves, ReferenceCase2_GroupSpeedsOfTheFasterWave_AreThePrintedOnes) {
    for (double axis : {0.0, 0.7}) {
        EXPECT_NEAR(group_speed(set_19_20(axis), axis), 1000.0, printed_digits);
        EXPECT_NEAR(group_speed(set_19_20(axis), axis + pi / 4), 1081.1, printed_digits);
        EXPECT_NEAR(group_speed(set_19_20(axis), axis + pi / 2), 1414.2, printed_digits);
        EXPECT_NEAR(group_speed(set_22_23(axis), axis), 1033.0, printed_digits);
        EXPECT_NEAR(group_speed(set_22_23(axis), axis + pi / 4), 1099.4, printed_digits);
        EXPECT_NEAR(group_speed(set_22_23(axis), axis + pi / 2), 1366.4, printed_digits);
    }
}

TEST(PlaneWaves, Anisotropic_GroupVelocity_HasThePhaseSpeedAlongTheNormal) {
    for (double angle = 0; angle < 2 * pi; angle += 0.37) {
        for (const PlaneWave& wave : plane_waves(set_22_23(0.2), direction(angle))) {
            EXPECT_NEAR(dot(wave.group_velocity, direction(angle)), wave.phase_speed, round_off * wave.phase_speed);
        }
    }
}

TEST(PlaneWaves, Anisotropic_GroupVelocity_IsTheGradientOfFrequencyByWaveVector) {
    const double step = 1e-5;  // central difference: error about step^2 c
    const double tolerance = 10 * step * step * 1414;
    const PlaneStiffness rock = set_22_23(0.2);
    for (std::size_t mode : {0u, 1u}) {
        const double angle = 0.6;
        const auto frequency = [&](double kx, double ky) {
            const double k = std::hypot(kx, ky);
            return k * plane_waves(rock, {kx / k, ky / k})[mode].phase_speed;
        };
        const Vec2<double> n = direction(angle);
        const Vec2<double> group = plane_waves(rock, n)[mode].group_velocity;
        EXPECT_NEAR(group.x, (frequency(n.x + step, n.y) - frequency(n.x - step, n.y)) / (2 * step), tolerance);
        EXPECT_NEAR(group.y, (frequency(n.x, n.y + step) - frequency(n.x, n.y - step)) / (2 * step), tolerance);
    }
}

TEST(ChristoffelMatrix, TurnedAxes_AnyDirection_MapsAmplitudeToTraction) {
    const PlaneStiffness rock = set_22_23(0.9);
    for (double angle = 0; angle < 2 * pi; angle += 0.5) {
        for (const Vec2<double>& a : {Vec2<double>{1, 0}, Vec2<double>{0, 1}}) {
            const Vec2<double> expected = traction_of_wave(rock, a, direction(angle));
            const Vec2<double> found = christoffel_matrix(rock, direction(angle)) * a;
            EXPECT_NEAR(found.x, expected.x, round_off * rock.C_bbbb);
            EXPECT_NEAR(found.y, expected.y, round_off * rock.C_bbbb);
        }
    }
}

TEST(Impedance, Anisotropic_Squared_IsDensityTimesChristoffel) {
    const PlaneStiffness rock = set_22_23(0.9);
    for (double angle = 0; angle < 2 * pi; angle += 0.5) {
        const SymmetricMatrix z = impedance(rock, direction(angle));
        const SymmetricMatrix gamma = christoffel_matrix(rock, direction(angle));
        const double scale = rock.density * rock.C_bbbb;
        EXPECT_NEAR(z.xx * z.xx + z.xy * z.xy, rock.density * gamma.xx, round_off * scale);
        EXPECT_NEAR(z.xy * (z.xx + z.yy), rock.density * gamma.xy, round_off * scale);
        EXPECT_NEAR(z.yy * z.yy + z.xy * z.xy, rock.density * gamma.yy, round_off * scale);
        EXPECT_GT(z.xx, 0);
        EXPECT_GT(z.xx * z.yy - z.xy * z.xy, 0);
    }
}

TEST(Impedance, NormalIncidence_EitherPolarisation_IsNotReflected) {
    // u = p g(n.x - c t): v = -c p g', grad u = p (outer) n g', so an outgoing wave has traction -Z v with no
    // remainder.
    const PlaneStiffness rock = set_19_20(0.5);
    for (double angle = 0; angle < 2 * pi; angle += 0.5) {
        const Vec2<double> n = direction(angle);
        for (const PlaneWave& wave : plane_waves(rock, n)) {
            const Vec2<double> v = -wave.phase_speed * wave.polarisation;
            const Vec2<double> rest = traction_of_wave(rock, wave.polarisation, n) + impedance(rock, n) * v;
            EXPECT_NEAR(rest.x, 0, round_off * rock.C_bbbb);
            EXPECT_NEAR(rest.y, 0, round_off * rock.C_bbbb);
        }
    }
}

TEST(AbsorbingBlocks, Rectangle_EachEdge_GivesHalfItsImpedanceToItsNodes) {
    const Mesh mesh = test::rectangle_mesh();
    const PlaneStiffness rock = set_22_23(0.4), clay = set_19_20(0);
    const double thickness = 0.5;
    const std::vector<BoundaryEdge> edges{{1, 2, 0}, {2, 3, 1}};  // right, length 1; top, length 2
    const auto blocks = absorbing_blocks(
        mesh, edges, [&](int element) { return element == 0 ? rock : clay; }, thickness);
    const SymmetricMatrix right = impedance(rock, {1, 0}), top = impedance(clay, {0, 1});
    const double scale = round_off * right.xx;
    ASSERT_EQ(blocks.size(), 3u);
    EXPECT_EQ(blocks[0].node, 1);
    EXPECT_NEAR(blocks[0].xx, 0.25 * right.xx, scale);
    EXPECT_NEAR(blocks[0].xy, 0.25 * right.xy, scale);
    EXPECT_NE(blocks[0].xy, 0);
    EXPECT_EQ(blocks[1].node, 2);
    EXPECT_NEAR(blocks[1].xx, 0.25 * right.xx + 0.5 * top.xx, scale);
    EXPECT_NEAR(blocks[1].yy, 0.25 * right.yy + 0.5 * top.yy, scale);
    EXPECT_EQ(blocks[2].node, 3);
    EXPECT_NEAR(blocks[2].yy, 0.5 * top.yy, scale);
}

TEST(AbsorbedWork, Step_BlockTimesMeanVelocity_WorksOnTheDisplacement) {
    const std::vector<Damping::Block> blocks{{1, 2.0, 0.5, 3.0}};
    State from, to;
    from.u = {0, 0, 1, 1};
    to.u = {9, 9, 1.5, 2};
    from.v = {7, 7, 1, -1};
    to.v = {7, 7, 3, 5};
    // mean v = (2, 2), C v = (5, 7), du = (0.5, 1)
    EXPECT_DOUBLE_EQ(absorbed_work(blocks, Trial::of(from), Trial::of(to)), 9.5);
}

TEST(AbsorbedWork, Leapfrog_MassOnADashpot_LosesExactlyWhatIsAbsorbed) {
    const double mass = 3, dt = 0.2;
    const Damping::Block c{0, 2.0, 0.7, 3.0};
    // v^{n+1/2} from (M/dt + C/2) v^{n+1/2} = (M/dt - C/2) v^{n-1/2}  [FORMULATION 5]
    const double xx = mass / dt + c.xx / 2, yy = mass / dt + c.yy / 2, xy = c.xy / 2, det = xx * yy - xy * xy;
    const auto next = [&](const Vec2<double>& v) {
        const Vec2<double> right{(mass / dt - c.xx / 2) * v.x - xy * v.y, (mass / dt - c.yy / 2) * v.y - xy * v.x};
        return Vec2<double>{(yy * right.x - xy * right.y) / det, (xx * right.y - xy * right.x) / det};
    };
    Vec2<double> before{4, -1}, after = next(before);
    State from, to;
    from.u = {0, 0};
    double absorbed = 0;
    const double kinetic_at_start = 0.5 * mass * dot(before, after);
    for (int step = 0; step < 20; ++step) {
        const Vec2<double> later = next(after);
        from.v = {0.5 * (before.x + after.x), 0.5 * (before.y + after.y)};
        to.v = {0.5 * (after.x + later.x), 0.5 * (after.y + later.y)};
        to.u = {from.u[0] + dt * after.x, from.u[1] + dt * after.y};
        absorbed += absorbed_work({&c, 1}, Trial::of(from), Trial::of(to));
        before = after;
        after = later;
        from.u = to.u;
    }
    EXPECT_GT(absorbed, 0.9 * kinetic_at_start);
    EXPECT_NEAR(absorbed + 0.5 * mass * dot(before, after), kinetic_at_start, round_off * kinetic_at_start);
}

}  // namespace
}  // namespace gneiss
