// What is Bathe's own: its formulas, its damping, its one matrix, its messages.

#include "integrators/bathe.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/errors.hpp"
#include "support/amplification.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator_problems.hpp"

namespace gneiss {
namespace {

using testing::UnorderedElementsAre;

std::unique_ptr<Bathe> bathe_with(double rho_inf, double dt) {
    return std::make_unique<Bathe>(Bathe::Options{rho_inf, dt, {.tolerance = 1e-12}});
}

TEST(Bathe, RhoInfZero_IsTheTrapezoidalRuleThenThreePointBackwardEuler) {
    // Bathe (2007), of x'' = -omega^2 x with the split 2 - sqrt(2): a2 = c1 v + c2 v1 + c3 v2, v2 likewise of u
    const double omega = 3, g = 2 - std::sqrt(2.0);
    const double c1 = (1 - g) / g, c2 = -1 / ((1 - g) * g), c3 = (2 - g) / (1 - g);
    const auto matrix = test::amplification([](double dt) { return bathe_with(0, dt); }, omega);
    for (int column = 0; column < 2; ++column) {
        const double u = column == 0, v = omega * column, h = g / 2, w = omega * omega;
        const double u1 = (u + 2 * h * v - h * h * w * u) / (1 + h * h * w), v1 = v - h * w * (u + u1);
        // v2 = c1 u + c2 u1 + c3 u2, -w u2 = c1 v + c2 v1 + c3 v2
        const double u2 = -(c1 * v + c2 * v1 + c3 * (c1 * u + c2 * u1)) / (w + c3 * c3);
        const double v2 = c1 * u + c2 * u1 + c3 * u2;
        EXPECT_NEAR(matrix(0, column), u2, 1e-12);
        EXPECT_NEAR(matrix(1, column), v2 / omega, 1e-12);
    }
}

TEST(Bathe, SpectralRadius_AtInfinityIsRhoInf_AndIsNowhereAboveOne) {
    for (const double rho : {0.0, 0.3, 0.5, 0.8, 1.0}) {
        const auto radius = [&](double omega) {
            return test::spectral_radius(test::amplification([&](double dt) { return bathe_with(rho, dt); }, omega));
        };
        // the eigenvalues meet at -rho as the root of 1/(omega dt)
        EXPECT_NEAR(radius(1e5), rho, 2 / std::sqrt(1e5));
        for (double omega = 0.1; omega < 1e4; omega *= 1.3) EXPECT_LT(radius(omega), 1 + 1e-7) << rho << " " << omega;
    }
}

TEST(Bathe, RhoInfOne_LinearUndamped_KeepsTheEnergy) {
    const test::Oscillator system(test::two_nodes());
    const auto integrator = bathe_with(1, 0.5);
    State state = system.initial_state();
    integrator->start(system, state, StartReason::fresh);
    const auto energy = [&] { return integrator->kinetic_energy(system, state) + system.stored_energies(state).sum(); };
    const double before = energy();
    double largest = 0;
    for (int step = 0; step < 1000; ++step) {
        integrator->advance(system, state, state.t + 0.5);
        largest = std::max(largest, std::abs(energy() - before));
    }
    EXPECT_LT(largest, 1e-9 * before);  // two trapezoidal rules; Newton's method leaves up to its tolerance in each
}

TEST(Bathe, LinearProblemWithEqualSteps_FactorisesOnce) {
    const test::Oscillator system(test::two_nodes());
    for (const double rho : {0.0, 0.4, 1.0}) {
        const auto integrator = bathe_with(rho, 0.1);
        State state = system.initial_state();
        integrator->start(system, state, StartReason::fresh);
        while (state.t < 10) integrator->advance(system, state, 10);
        EXPECT_EQ(integrator->counts().factorisations, 1u) << rho;
    }
}

TEST(Bathe, OneForceThatFails_WhereverInTheStep_HalvesIt) {
    for (int n = 0; n < 4; ++n) {
        test::Oscillator system(test::two_nodes());
        const auto integrator = bathe_with(0.5, 0.125);
        State state = system.initial_state();
        integrator->start(system, state, StartReason::fresh);
        system.fail_after(n);
        const StepReport step = integrator->advance(system, state, 1);
        // either sub-step is evaluated before and after its one correction
        EXPECT_EQ(step.n_rejected, 1u) << n;
        EXPECT_EQ(step.t, 0.0625);
    }
}

TEST(Bathe, Options_AllProblemsAtOnce) {
    Bathe::Options options{
        .rho_inf = -0.1, .dt = 0, .newton = {.tolerance = 0, .most_iterations = 0}, .interface_tolerance = 0};
    try {
        Bathe integrator(options);
        FAIL();
    } catch (const InputError& error) {
        std::vector<std::string> keys;
        for (const Problem& problem : error.problems()) keys.push_back(problem.where);
        EXPECT_THAT(keys, UnorderedElementsAre("integrator.rho_inf", "integrator.dt", "integrator.tolerance",
                                               "integrator.most_iterations", "integrator.interface_tolerance"));
    }
}

TEST(Bathe, SystemWithoutTangent_IsRefused) {
    test::OscillatorModel model = test::two_nodes();
    model.has_tangent = false;
    const test::Oscillator system(model);
    State state = system.initial_state();
    EXPECT_THROW(bathe_with(0, 0.1)->start(system, state, StartReason::fresh), InputError);
}

}  // namespace
}  // namespace gneiss
