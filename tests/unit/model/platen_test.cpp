#include "model/platen.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "support/finite_differences.hpp"
#include "unit/model/tiny_mesh.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;

constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
constexpr std::int32_t point = 4;  ///< behind the four nodes of the rectangle

LumpedOptions hammer() {
    LumpedOptions options;
    options.kind = LumpedOptions::Kind::mass;
    options.name = "hammer";
    options.on = "top";
    options.direction = {0.3, -0.4};
    options.stiffness = 6e4;
    options.damping = 50;
    options.gap = 0.1;
    options.mass = 20;
    options.ground_stiffness = 1e4;
    options.velocity = 3;
    options.force = 200;
    return options;
}
LumpedOptions actuator() {
    LumpedOptions options = hammer();
    options.kind = LumpedOptions::Kind::actuator;
    options.damping = options.mass = options.ground_stiffness = options.velocity = options.force = 0;
    options.displacement = 0.5;
    options.amplitude.kind = AmplitudeOptions::Kind::ramp;
    options.amplitude.end = 2;
    return options;
}

Platen make(const LumpedOptions& options) {
    const Mesh mesh = test::rectangle_mesh();
    Platen platen(options, mesh, mesh.boundaries.at(options.on));
    platen.place_point(point);
    return platen;
}

// Nodes of "top" are 2 and 3, half of its length each. One of them is pressed, the other one is not.
const std::vector<double> u{0.1, 0.2, 0, 0, 0.02, 0.05, 0.05, -0.4, 0.15, 0.01};
const std::vector<double> v{0, 0, 1, 2, 0.3, -0.2, 0.5, 0.1, 2, 0.5};
Trial at(double t = 1) { return {t, 0, u, v, {}}; }

std::vector<double> force(const Platen& platen, const Trial& trial) {
    std::vector<double> f(u.size(), 0.0);
    platen.add_force(trial, f);
    return f;
}

TEST(Platen, Pressed_PushesItsNodesAlongItsDirection) {
    const std::vector<double> f = force(make(hammer()), at());
    // n = (0.6, -0.8): n.u_2 = -0.028, n.u_3 = 0.35; d_2 = 0.15 - 0.1 + 0.028, d_3 < 0; n.v_2 = 0.34
    const double push = 0.5 * (6e4 * 0.078 + 50 * (2 - 0.34));
    EXPECT_THAT(f, testing::Pointwise(testing::DoubleNear(1e5 * round_off),
                                      {0.0, 0.0, 0.0, 0.0, 0.6 * push, -0.8 * push, 0.0, 0.0, 200 - push - 1e4 * 0.15,
                                       -(6e4 + 1e4) * 0.01}));
}

TEST(Platen, FliesOffFasterThanTheSpringPushes_TheDamperDoesNotPull) {
    const Platen platen = make(hammer());
    std::vector<double> v_away = v;
    v_away[8] = -200;  // 50 N s/m: the damper alone would pull with 10 kN, the spring pushes with 4.7 kN
    const Trial away{1, 0, u, v_away, {}};
    const std::vector<double> f = force(platen, away);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(f[i], 0) << i;
    EXPECT_EQ(platen.quantities(away)[2].value, 0);
    // what the spring gives back meanwhile the damper takes
    Trial later = away;
    const double dt = 1e-7;
    std::vector<double> u_later = u;
    for (std::size_t i = 0; i < u.size(); ++i) u_later[i] += dt * v_away[i];
    later.t += dt;
    later.u = u_later;
    PathEnergies energies;
    platen.add_path_energies(away, later, energies);
    const auto spring = [&](const Trial& trial) {  // without that to the ground
        const std::size_t q = 2 * static_cast<std::size_t>(point);
        return platen.stored_energy(trial) - 0.5 * 1e4 * trial.u[q] * trial.u[q];
    };
    EXPECT_NEAR(energies.dampers, spring(away) - spring(later), 1e-6 * energies.dampers);  // the trapezoidal rule
}

TEST(Platen, Bonded_PullsAsWell) {
    LumpedOptions options = hammer();
    options.bonded = true;
    options.damping = 0;
    const std::vector<double> f = force(make(options), at());
    const double pull = 0.5 * 6e4 * (0.15 - 0.1 - 0.35);
    EXPECT_LT(pull, 0);
    EXPECT_NEAR(f[6], 0.6 * pull, 1e5 * round_off);
    EXPECT_NEAR(f[7], -0.8 * pull, 1e5 * round_off);
}

TEST(Platen, Actuator_IsWhereItsTableSays) {
    const Platen platen = make(actuator());
    EXPECT_FALSE(platen.point());
    EXPECT_THAT(platen.switch_times(), testing::ElementsAre(0, 2));
    const std::vector<double> f = force(platen, at(1));  // q = 0.25
    const double push = 0.5 * 6e4 * (0.25 - 0.1 + 0.028);
    EXPECT_NEAR(f[4], 0.6 * push, 1e5 * round_off);
    EXPECT_EQ(f[8], 0);
    EXPECT_NEAR(platen.quantities(at(1))[0].value, 0.25, round_off);
    EXPECT_NEAR(platen.quantities(at(1))[1].value, push, 1e5 * round_off);
}

Eigen::MatrixXd dense(const Platen& platen, bool by_velocity) {
    const auto pairs = platen.couplings();
    std::vector<ForceTerm::Stiffness> blocks(pairs.size());
    by_velocity ? platen.velocity_stiffness(at(), blocks) : platen.stiffness(at(), blocks);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(10, 10);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        k.block<2, 2>(2 * pairs[i][0], 2 * pairs[i][1]) +=
            Eigen::Matrix2d{{blocks[i].xx, blocks[i].xy}, {blocks[i].yx, blocks[i].yy}};
    return k;
}

TEST(Platen, Tangents_AreTheDerivativesOfTheForce) {
    for (LumpedOptions options : {hammer(), actuator()})
        for (const bool bonded : {false, true})
            for (const bool by_velocity : {false, true}) {
                if (by_velocity && options.kind == LumpedOptions::Kind::actuator) continue;
                options.bonded = bonded;
                const Platen platen = make(options);
                std::vector<double> u_now = u, v_now = v;
                std::vector<double>& x = by_velocity ? v_now : u_now;
                Eigen::MatrixXd expected(10, 10);
                for (std::size_t j = 0; j < 10; ++j) {
                    const double before = x[j];
                    expected.col(static_cast<Eigen::Index>(j)) = derivative_at_zero([&](double h) {
                        x[j] = before + h;
                        const std::vector<double> f = force(platen, {1, 0, u_now, v_now, {}});
                        return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(f.data(), 10));
                    });
                    x[j] = before;
                }
                // linear: round-off of forces of 1e5 over steps of 5e-4
                EXPECT_LT((dense(platen, by_velocity) - expected).cwiseAbs().maxCoeff(), 1e-12 * 1e5 / 5e-4);
            }
}

TEST(Platen, StiffnessAndEnergy_BelongTogether) {
    for (const bool bonded : {false, true}) {
        LumpedOptions options = hammer();
        options.bonded = bonded;
        options.damping = options.force = 0;
        const Platen platen = make(options);
        std::vector<double> x = u;
        x[9] = 0;  // what holds the second component stores nothing while nothing pushes it
        const std::vector<double> f = force(platen, {1, 0, x, v, {}});
        for (std::size_t j = 0; j < 9; ++j) {
            const double before = x[j];
            const double slope = derivative_at_zero([&](double h) {
                x[j] = before + h;
                return platen.stored_energy({1, 0, x, v, {}});
            });
            x[j] = before;
            EXPECT_NEAR(f[j], -slope, 1e-12 * 1e5 / 5e-4);
        }
    }
}

TEST(Platen, Bounds_AreAboveStiffnessAndDamping) {
    LumpedOptions options = hammer();
    options.bonded = true;
    const Platen platen = make(options);
    const std::vector<double> mass{9, 9, 9, 9, 3, 3, 8, 8, 20, 20};
    const Eigen::VectorXd scale = Eigen::Map<const Eigen::VectorXd>(mass.data(), 10).cwiseSqrt().cwiseInverse();
    const auto largest = [&](bool by_velocity) {
        return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() * -dense(platen, by_velocity) *
                                                              scale.asDiagonal())
            .eigenvalues()
            .maxCoeff();
    };
    const auto rates = platen.largest_rates(at(), mass);
    EXPECT_GE(rates.omega_squared, largest(false));
    EXPECT_LE(rates.omega_squared, 3 * largest(false));
    EXPECT_GE(rates.damping, largest(true));
    EXPECT_LE(rates.damping, 3 * largest(true));
    std::vector<double> bound(10, 0.0);
    platen.add_stiffness_bound(at(), bound);
    Eigen::MatrixXd rest = dense(platen, false);
    rest.diagonal() += Eigen::Map<const Eigen::VectorXd>(bound.data(), 10);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(rest).eigenvalues().minCoeff(), -1e-9 * 1e5);
}

TEST(Platen, Work_IsThatOfForcesAndOfTheDamper) {
    std::vector<double> further = u, faster = v;
    further[8] += 0.02;
    faster[8] += 1;
    const Trial from = at(1), to{1.01, 0, further, faster, {}};
    PathEnergies energies;
    make(hammer()).add_path_energies(from, to, energies);
    EXPECT_NEAR(energies.external_work, 200 * 0.02, round_off);
    const double before = 0.5 * 50 * std::pow(2 - 0.34, 2), after = 0.5 * 50 * std::pow(3 - 0.34, 2);  // node 2 alone
    EXPECT_NEAR(energies.dampers, 0.5 * (before + after) * 0.01, 1e3 * round_off);
    PathEnergies of_actuator;
    const Platen platen = make(actuator());
    platen.add_path_energies(at(1), at(1.2), of_actuator);
    const double push = 0.5 * 6e4 * (0.15 + 0.028);
    EXPECT_NEAR(of_actuator.external_work, 0.5 * (2 * push + 0.5 * 6e4 * 0.05) * 0.05, 1e5 * round_off);
}

TEST(Platen, WhatHasNoMeaning_IsRefused) {
    const auto refusal = [](const LumpedOptions& options) -> std::string {
        try {
            make(options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "taken";
    };
    LumpedOptions nowhere = hammer(), everywhere = hammer(), jumping = actuator();
    nowhere.direction = {0, 0};
    EXPECT_THAT(refusal(nowhere), HasSubstr("direction = [0, 0]: has no length"));
    everywhere.amplitude.kind = AmplitudeOptions::Kind::expression;
    everywhere.amplitude.expression = "t*x";
    EXPECT_THAT(refusal(everywhere), HasSubstr("may depend on t alone"));
    jumping.amplitude.kind = AmplitudeOptions::Kind::heaviside;
    jumping.amplitude.start = 1;
    EXPECT_THAT(refusal(jumping), HasSubstr("amplitude: jumps"));
}

}  // namespace
}  // namespace gneiss
