#include "model/gas_cavity.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "support/finite_differences.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;

constexpr double thickness = 0.5, p_0 = 3e6;
constexpr double gas_round_off = 64 * std::numeric_limits<double>::epsilon();

/// Nodes of a hole of 2 m x 1 m, far from the origin, in a solid that is not there: walking along it the solid is on
/// the left, so that it is walked clockwise.
struct Hole {
    Mesh mesh;
    std::vector<BoundaryEdge> edges{{0, 3, 0}, {3, 2, 0}, {2, 1, 0}, {1, 0, 0}};

    Hole() { mesh.nodes = {{10, -5}, {12, -5}, {12, -4}, {10, -4}}; }
    std::vector<double> at_rest() const { return std::vector<double>(2 * mesh.n_nodes(), 0.0); }
};

LumpedOptions gas() {
    LumpedOptions options;
    options.name = "gas";
    options.on = "hole";
    options.pressure = p_0;
    return options;
}
LumpedOptions burning_gas() {
    LumpedOptions options = gas();
    options.leak = 20;
    options.burn = BurnOptions{.energy = 8e6, .time = 0.03, .exponent = 0.8, .reference_pressure = 5e6};
    return options;
}

GasCavity cavity_of(const Hole& hole, const LumpedOptions& options) {
    return {options, hole.mesh, hole.edges, thickness};
}

Trial trial(double t, const std::vector<double>& u, std::span<const double> z = {}) { return {t, 0, u, u, z}; }

/// The hole scaled about its corner 0.
std::vector<double> scaled(const Hole& hole, double by) {
    std::vector<double> u;
    for (const auto& [x, y] : hole.mesh.nodes) {
        u.push_back((by - 1) * (x - 10));
        u.push_back((by - 1) * (y + 5));
    }
    return u;
}
const std::vector<double> some_displacement{0.1, -0.05, 0.2, 0.03, -0.1, 0.15, 0.05, 0.3};

TEST(GasCavity, Expansion_IsAdiabatic) {
    const Hole hole;
    const GasCavity cavity = cavity_of(hole, gas());
    EXPECT_EQ(cavity.n_internal(), 0u);
    EXPECT_NEAR(cavity.initial_volume(), 2 * thickness, gas_round_off);
    const double energy_0 = cavity.stored_energy(trial(0, scaled(hole, 1)));
    EXPECT_NEAR(energy_0, p_0 * 2 * thickness / 0.4, gas_round_off * energy_0);
    for (const double by : {0.5, 0.9, 1.3, 3.0}) {
        const std::vector<double> u = scaled(hole, by);
        const double ratio = by * by;  // V/V_0
        EXPECT_NEAR(cavity.volume(trial(0, u)), ratio * 2 * thickness, gas_round_off * ratio);
        EXPECT_NEAR(cavity.pressure(trial(0, u)), p_0 * std::pow(ratio, -1.4),
                    gas_round_off * p_0 * std::pow(ratio, -1.4));
        // p_0 V_0^k (V_0^(1-k) - V^(1-k))/(k - 1): the work of an adiabatic expansion
        const double work = energy_0 * (1 - std::pow(ratio, -0.4));
        EXPECT_NEAR(energy_0 - cavity.stored_energy(trial(0, u)), work, gas_round_off * energy_0);
    }
}

TEST(GasCavity, Force_PushesTheWallsOutwards) {
    const Hole hole;
    std::vector<double> f = hole.at_rest();
    cavity_of(hole, gas()).add_force(trial(0, hole.at_rest()), f);
    const double x = 0.5 * p_0 * thickness, y = p_0 * thickness;  // halves of walls of 1 m and 2 m
    EXPECT_THAT(f, testing::Pointwise(testing::DoubleNear(gas_round_off * p_0), {-x, -y, x, -y, x, y, -x, y}));
}

TEST(GasCavity, Force_IsMinusTheDerivativeOfItsEnergy) {
    const Hole hole;
    LumpedOptions leaking = gas();
    leaking.leak = 3;
    const std::vector<double> z{1.7 * p_0};
    for (const auto& [options, own] : {std::pair(gas(), std::vector<double>{}), {leaking, z}}) {
        const GasCavity cavity = cavity_of(hole, options);
        std::vector<double> u = some_displacement, f = hole.at_rest();
        cavity.add_force(trial(0, u, own), f);
        for (std::size_t i = 0; i < u.size(); ++i) {
            const double before = u[i];
            const double slope = derivative_at_zero([&](double h) {
                u[i] = before + h;
                return cavity.stored_energy(trial(0, u, own));
            });
            u[i] = before;
            EXPECT_NEAR(f[i], -slope, 1e-8 * p_0);  // of the difference: 1e-11 of the energy over a step of 5e-4
        }
    }
}

/// df/du with z given, or following u.
Eigen::MatrixXd tangent(const GasCavity& cavity, const Trial* from, const Trial& at) {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(8, 8);
    const auto pairs = cavity.couplings();
    std::vector<ForceTerm::Stiffness> blocks(pairs.size());
    cavity.stiffness(at, blocks);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        k.block<2, 2>(2 * pairs[i][0], 2 * pairs[i][1]) +=
            Eigen::Matrix2d{{blocks[i].xx, blocks[i].xy}, {blocks[i].yx, blocks[i].yy}};
    const LowRank::Dyad beside = *cavity.dyad(from, at);
    for (const auto& [row, a] : beside.column)
        for (const auto& [column, b] : beside.column) k(row, column) -= beside.factor * a * b;
    return k;
}

TEST(GasCavity, Tangent_IsTheDerivativeOfTheForce) {
    const Hole hole;
    const std::vector<double> z_0{1.2 * p_0, 7e6}, u_0 = scaled(hole, 1.05);
    for (const bool follows : {false, true}) {
        const GasCavity cavity = cavity_of(hole, burning_gas());
        const Trial from = trial(0, u_0, z_0);
        std::vector<double> u = some_displacement, z = z_0, f(8);
        const auto force = [&] {
            if (follows) cavity.update_internal(from, trial(0.01, u), z);
            std::ranges::fill(f, 0.0);
            cavity.add_force(trial(0.01, u, z), f);
            return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(f.data(), 8));
        };
        Eigen::MatrixXd expected(8, 8);
        for (std::size_t j = 0; j < 8; ++j) {
            const double before = u[j];
            expected.col(static_cast<Eigen::Index>(j)) = derivative_at_zero([&](double h) {
                u[j] = before + h;
                return force();
            });
            u[j] = before;
        }
        force();
        const Eigen::MatrixXd k = tangent(cavity, follows ? &from : nullptr, trial(0.01, u, z));
        EXPECT_LT((k - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.cwiseAbs().maxCoeff());
        EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), gas_round_off * k.cwiseAbs().maxCoeff());
    }
}

TEST(GasCavity, Bounds_AreAboveItsStiffness) {
    const Hole hole;
    const GasCavity cavity = cavity_of(hole, gas());
    const Trial at = trial(0, some_displacement);
    const Eigen::MatrixXd k = -tangent(cavity, nullptr, at);
    const std::vector<double> mass{3, 3, 5, 5, 2, 2, 4, 4};
    const Eigen::VectorXd scale = Eigen::Map<const Eigen::VectorXd>(mass.data(), 8).cwiseSqrt().cwiseInverse();
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() * k * scale.asDiagonal())
                               .eigenvalues()
                               .maxCoeff();
    const double bound = cavity.largest_rates(at, mass).omega_squared;
    EXPECT_GE(bound, largest);
    EXPECT_LE(bound, 3 * largest) << "and of some use";
    std::vector<double> diagonal(8, 0.0);
    cavity.add_stiffness_bound(at, diagonal);
    Eigen::MatrixXd rest = -k;
    rest.diagonal() += Eigen::Map<const Eigen::VectorXd>(diagonal.data(), 8);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(rest).eigenvalues().minCoeff(), -1e-9 * p_0);
}

TEST(GasCavity, LeakAlone_FollowsTheExponential) {
    const Hole hole;
    LumpedOptions options = gas();
    options.leak = 4;
    const GasCavity cavity = cavity_of(hole, options);
    ASSERT_EQ(cavity.n_internal(), 1u);
    std::vector<double> z(1), after(1);
    cavity.initial_internal(z);
    EXPECT_EQ(z[0], p_0);
    // whatever the volume does: p V^kappa falls at kappa times the rate of the mass
    cavity.update_internal(trial(1, scaled(hole, 1), z), trial(1.1, scaled(hole, 2)), after);
    EXPECT_NEAR(after[0], p_0 * std::exp(-1.4 * 4 * 0.1), gas_round_off * p_0);
}

TEST(GasCavity, BurningAtConstantVolume_HeatsByWhatHasBurnt) {
    const Hole hole;
    LumpedOptions options = gas();
    options.burn = BurnOptions{.energy = 8e6, .time = 0.03};
    const GasCavity cavity = cavity_of(hole, options);
    ASSERT_EQ(cavity.n_internal(), 2u);
    std::vector<double> z(2), after(2);
    cavity.initial_internal(z);
    const std::vector<double> u = hole.at_rest();
    EXPECT_NEAR(cavity.stored_energy(trial(0, u, z)), p_0 * 2 * thickness / 0.4 + 8e6, gas_round_off * 1e8);
    cavity.update_internal(trial(0, u, z), trial(0.02, u), after);
    const double burnt = 8e6 * (1 - std::exp(-0.02 / 0.03));
    EXPECT_NEAR(cavity.pressure(trial(0.02, u, after)), p_0 + 0.4 * burnt / (2 * thickness), gas_round_off * 1e8);
    EXPECT_NEAR(cavity.quantities(trial(0.02, u, after)).back().value, 8e6 - burnt, gas_round_off * 1e8);
}

TEST(GasCavity, Updates_AreOfOrderTwoOfTheRate) {
    const Hole hole;
    const GasCavity cavity = cavity_of(hole, burning_gas());
    const auto u_at = [&](double t) { return scaled(hole, 1 + 0.3 * std::sin(40 * t)); };
    const double t_end = 0.05;
    const auto by_updates = [&](int n) {
        std::vector<double> z(2), next(2);
        cavity.initial_internal(z);
        for (int i = 0; i < n; ++i) {
            const std::vector<double> u = u_at(t_end * i / n), u_next = u_at(t_end * (i + 1) / n);
            cavity.update_internal(trial(t_end * i / n, u, z), trial(t_end * (i + 1) / n, u_next), next);
            z.swap(next);
        }
        return z;
    };
    // the classical Runge-Kutta method on internal_rate(): 1e-12 with so many steps
    std::vector<double> exact(2);
    cavity.initial_internal(exact);
    constexpr int n_exact = 2000;
    const double dt = t_end / n_exact;
    for (int i = 0; i < n_exact; ++i) {
        const auto rate = [&](double t, const std::array<double, 2>& z) {
            std::array<double, 2> dz;
            const std::vector<double> u = u_at(t);
            cavity.internal_rate(trial(t, u, z), dz);
            return dz;
        };
        const auto moved = [&](const std::array<double, 2>& k, double by) {
            return std::array{exact[0] + by * k[0], exact[1] + by * k[1]};
        };
        const double t = i * dt;
        const auto k1 = rate(t, moved({0, 0}, 0)), k2 = rate(t + dt / 2, moved(k1, dt / 2)),
                   k3 = rate(t + dt / 2, moved(k2, dt / 2)), k4 = rate(t + dt, moved(k3, dt));
        for (std::size_t c = 0; c < 2; ++c) exact[c] += dt / 6 * (k1[c] + 2 * k2[c] + 2 * k3[c] + k4[c]);
    }
    const auto error = [&](int n) {
        const std::vector<double> z = by_updates(n);
        return std::hypot(z[0] - exact[0], z[1] - exact[1]);
    };
    double before = error(50);
    for (const int n : {100, 200, 400}) {
        const double now = error(n);
        EXPECT_NEAR(observed_order(before, now), 2, 0.15) << n;
        before = now;
    }
}

TEST(GasCavity, Leak_EntersTheLedger) {
    const Hole hole;
    LumpedOptions options = gas();
    options.leak = 2;
    const GasCavity cavity = cavity_of(hole, options);
    const std::vector<double> u = hole.at_rest();
    const auto left = [&](int n) {
        std::vector<double> z{p_0}, next(1);
        PathEnergies energies;
        for (int i = 0; i < n; ++i) {
            const Trial from = trial(0.1 * i / n, u, z);
            cavity.update_internal(from, trial(0.1 * (i + 1) / n, u), next);
            cavity.add_path_energies(from, trial(0.1 * (i + 1) / n, u, next), energies);
            z = next;
        }
        return cavity.stored_energy(trial(0, u, z)) + energies.leaked;
    };
    const double start = cavity.stored_energy(trial(0, u, std::vector{p_0}));
    const double error = left(10) - start, at_half = left(20) - start;
    EXPECT_LT(std::abs(at_half), 1e-4 * start);  // (kappa leak dt)^2/12 of what has leaked, a quarter of it all
    EXPECT_NEAR(observed_order(error, at_half), 2, 0.05);
}

TEST(GasCavity, WallThatHasParted_IsClosedByALine) {
    Hole hole;
    hole.mesh.nodes.push_back(hole.mesh.nodes[2]);  // a copy of node 2: the wall 2-1 has come off
    hole.edges[2].a = 4;
    const GasCavity cavity = cavity_of(hole, gas());
    EXPECT_NEAR(cavity.initial_volume(), 2 * thickness, gas_round_off);
    std::vector<double> u = hole.at_rest();
    u[8] = 0.3;  // it leans outwards: a trapezoid and the triangle of the mouth
    EXPECT_NEAR(cavity.volume(trial(0, u)), (2 + 0.5 * 0.3 * 1) * thickness, gas_round_off);
}

TEST(GasCavity, Quarter_IsClosedByPlanesOfSymmetry) {
    // the quarter of a square hole of 2 m x 2 m, planes of symmetry through (3, 4)
    Mesh mesh;
    mesh.nodes = {{4, 4}, {4, 5}, {3, 5}};
    const std::vector<BoundaryEdge> edges{{2, 1, 0}, {1, 0, 0}};
    LumpedOptions options = gas();
    EXPECT_THROW(GasCavity(options, mesh, edges, thickness), InputError);
    options.about = {3, 4};
    const GasCavity cavity(options, mesh, edges, thickness);
    EXPECT_NEAR(cavity.initial_volume(), thickness, gas_round_off);
    std::vector<double> u(6, 0.0), f(6, 0.0);
    cavity.add_force(trial(0, u), f);
    EXPECT_NEAR(f[0], 0.5 * p_0 * thickness, gas_round_off * p_0);
    EXPECT_NEAR(f[5], 0.5 * p_0 * thickness, gas_round_off * p_0);
    u[0] = u[2] = 0.5;
    EXPECT_NEAR(cavity.volume(trial(0, u)), 1.5 * thickness, gas_round_off);
}

/// The message of what making a gas throws.
std::string refusal(const LumpedOptions& options, const Hole& hole, const std::vector<BoundaryEdge>& edges) {
    try {
        GasCavity(options, hole.mesh, edges, thickness);
    } catch (const InputError& error) {
        return error.what();
    }
    return "taken";
}

TEST(GasCavity, BoundaryWithoutCavity_IsRefusedWithTheReason) {
    const Hole hole;
    const std::vector<BoundaryEdge> outer{{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {3, 0, 0}}, open{{0, 3, 0}, {3, 2, 0}};
    EXPECT_THAT(refusal(gas(), hole, outer), HasSubstr("on = \"hole\": the solid lies inside of it"));
    EXPECT_THAT(refusal(gas(), hole, open), HasSubstr("is open and encloses no cavity"));
    LumpedOptions idle = gas();
    idle.about = {11, -4.5};
    EXPECT_THAT(refusal(idle, hole, hole.edges), HasSubstr("`about` has no effect"));
}

TEST(GasCavity, NothingLeft_AsksForAnotherTrial) {
    const Hole hole;
    std::vector<double> u = hole.at_rest(), f = u;
    u[1] = u[3] = 1.5;
    try {
        cavity_of(hole, gas()).add_force(trial(0.25, u), f);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("gas \"gas\": nothing is left of its cavity at t = 0.25 s, volume -0.5 m3"));
    }
}

}  // namespace
}  // namespace gneiss
