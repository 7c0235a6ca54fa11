// What is generalized-alpha's own: its parameters, its damping, its matrices, its messages.

#include "integrators/generalized_alpha.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "support/one_thread.hpp"
#include "support/oscillator_problems.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;
using AlphaScheme = GeneralizedAlpha::Scheme;

/// One mass on one spring, and its idle neighbour of the other direction.
test::Oscillator one_mass(double omega) {
    test::OscillatorModel model;
    model.mass = test::Vector{{1, 1}};
    model.stiffness = omega * omega * test::Matrix::Identity(2, 2);
    model.initial_u = test::Vector{{1, 0}};
    return test::Oscillator(model);
}

GeneralizedAlpha::Options alpha_with(const AlphaScheme& scheme, double dt) {
    GeneralizedAlpha::Options options;
    options.scheme = scheme;
    options.dt = dt;
    return options;
}

TEST(GeneralizedAlpha, ChungHulbert_SpectralRadiusAtInfinity_IsRhoInf) {
    // the recursion is linear: the ratio of successive norms of (u, dt v) comes to its spectral radius; the
    // root is defective, so that the ratio approaches it as 1/n
    for (const double rho : {0.3, 0.5, 0.8, 1.0}) {
        constexpr double dt = 1, omega = 1e6;
        const test::Oscillator system = one_mass(omega);
        GeneralizedAlpha integrator(alpha_with(AlphaScheme::chung_hulbert(rho), dt));
        State state = system.initial_state();
        integrator.start(system, state, StartReason::fresh);
        const auto norm = [&] { return std::hypot(state.u[0], dt * state.v[0]); };
        constexpr int n = 60;
        double middle = 0;
        for (int step = 0; step < n; ++step) {
            integrator.advance(system, state, state.t + dt);
            if (step == n / 2 - 1) middle = norm();
        }
        // over n/2 steps the polynomial factor of a threefold root contributes at most (2)^2
        EXPECT_NEAR(std::pow(norm() / middle, 2.0 / n), rho, rho * (std::pow(4, 2.0 / n) - 1)) << rho;
    }
}

TEST(GeneralizedAlpha, MeanAcceleration_LinearUndamped_KeepsTheEnergy) {
    const test::Oscillator system = one_mass(3);
    GeneralizedAlpha integrator(alpha_with(AlphaScheme::newmark(0.25, 0.5), 0.5));
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    const auto energy = [&] { return integrator.kinetic_energy(system, state) + system.stored_energies(state).sum(); };
    const double before = energy();
    constexpr int n = 1000;
    for (int step = 0; step < n; ++step) integrator.advance(system, state, state.t + 0.5);
    // Newton's method leaves up to its tolerance in every step
    EXPECT_NEAR(energy(), before, n * 1e-9 * before);
}

TEST(GeneralizedAlpha, LinearProblemWithEqualSteps_FactorisesOnce) {
    const test::Oscillator system = one_mass(3);
    GeneralizedAlpha integrator(alpha_with(AlphaScheme::chung_hulbert(0.8), 0.125));
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    for (int step = 0; step < 16; ++step) integrator.advance(system, state, state.t + 0.125);
    EXPECT_EQ(integrator.counts().factorisations, 1u);
    // an interval that no number of such steps fills without round-off
    const double t_stop = state.t + 100;
    GeneralizedAlpha uneven(alpha_with(AlphaScheme::chung_hulbert(0.8), 0.1));
    uneven.start(system, state, StartReason::fresh);
    while (state.t < t_stop) uneven.advance(system, state, t_stop);
    EXPECT_EQ(uneven.counts().factorisations, 1u);
}

TEST(GeneralizedAlpha, OneForceThatFails_WhereverInTheStep_ShortensIt) {
    for (int n = 0; n < 4; ++n) {
        test::Oscillator system = one_mass(3);
        GeneralizedAlpha integrator(alpha_with(AlphaScheme::chung_hulbert(0.8), 0.125));
        State state = system.initial_state();
        integrator.start(system, state, StartReason::fresh);
        const std::size_t before = integrator.counts().evaluations;
        system.fail_after(n);
        const StepReport step = integrator.advance(system, state, 1);
        // the stage is evaluated twice, before and after its one correction, and the end of the step once
        const std::size_t evaluations = integrator.counts().evaluations - before;
        EXPECT_EQ(step.n_rejected, n < 3 ? 1u : 0u) << n << " of " << evaluations;
        EXPECT_EQ(step.t, n < 3 ? 0.0625 : 0.125);
    }
}

TEST(GeneralizedAlpha, ForceThatIsNoNumber_FailsTheStep) {
    test::OscillatorModel model = one_mass(3).model();
    model.load = [](double t, bool) { return test::Vector{{t > 0.5 ? std::nan("") : 0.0, 0}}; };
    const test::Oscillator system(model);
    GeneralizedAlpha integrator(alpha_with(AlphaScheme::chung_hulbert(0.8), 0.125));
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    EXPECT_THROW(
        {
            while (state.t < 1) integrator.advance(system, state, 1);
        },
        RecoverableError);
    EXPECT_LE(state.t, 0.5 + 0.125);
}

TEST(GeneralizedAlpha, AdaptiveStepsOfOrderOne_AreRefused) {
    GeneralizedAlpha::Options options = alpha_with(AlphaScheme::newmark(0.3025, 0.6), 0);
    options.rtol = 1e-4;
    EXPECT_THROW(GeneralizedAlpha{options}, InputError);
}

TEST(GeneralizedAlpha, Schemes_HaveThePublishedNumbers) {
    // Chung and Hulbert (1993), (25): rho_inf = 1 is the undamped member, 0 annihilates
    const AlphaScheme undamped = AlphaScheme::chung_hulbert(1), annihilating = AlphaScheme::chung_hulbert(0);
    EXPECT_DOUBLE_EQ(undamped.alpha_m, 0.5);
    EXPECT_DOUBLE_EQ(undamped.alpha_f, 0.5);
    EXPECT_DOUBLE_EQ(undamped.beta, 0.25);
    EXPECT_DOUBLE_EQ(undamped.gamma, 0.5);
    EXPECT_DOUBLE_EQ(annihilating.alpha_m, -1);
    EXPECT_DOUBLE_EQ(annihilating.alpha_f, 0);
    EXPECT_DOUBLE_EQ(annihilating.beta, 1);
    EXPECT_DOUBLE_EQ(annihilating.gamma, 1.5);
    // Hilber, Hughes and Taylor (1977): beta = (1 - alpha)^2/4, gamma = 1/2 - alpha, their alpha = -0.3
    EXPECT_DOUBLE_EQ(AlphaScheme::hht(0.3).beta, 0.4225);
    EXPECT_DOUBLE_EQ(AlphaScheme::hht(0.3).gamma, 0.8);
}

TEST(GeneralizedAlpha, Options_AllProblemsAtOnce) {
    GeneralizedAlpha::Options options;
    options.scheme = {0.1, 0.05, 0, 0.4};
    options.dt = -1;
    options.longest = -1;
    options.tolerance = 0;
    options.most_iterations = 0;
    options.interface_tolerance = 1.5;
    try {
        GeneralizedAlpha integrator(options);
        FAIL();
    } catch (const InputError& error) {
        std::vector<std::string> keys;
        for (const Problem& problem : error.problems()) keys.push_back(problem.where);
        EXPECT_THAT(keys,
                    UnorderedElementsAre("integrator.alpha", "integrator.gamma", "integrator.beta", "integrator.dt",
                                         "integrator.dt", "integrator.longest", "integrator.interface_tolerance",
                                         "integrator.tolerance", "integrator.most_iterations"));
    }
}

TEST(GeneralizedAlpha, SystemWithoutTangent_IsRefused) {
    test::OscillatorModel model = test::two_nodes();
    model.has_tangent = false;
    const test::Oscillator system(model);
    GeneralizedAlpha integrator(alpha_with(AlphaScheme::chung_hulbert(0.8), 0.1));
    State state = system.initial_state();
    EXPECT_THROW(integrator.start(system, state, StartReason::fresh), InputError);
}

}  // namespace
}  // namespace gneiss
