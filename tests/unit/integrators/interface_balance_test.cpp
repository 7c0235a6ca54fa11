// A mass between two stiff stops, under implicit steps far above the period of a stop's spring: what kinks do to them.

#include "integrators/interface_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "integrators/bathe.hpp"
#include "integrators/generalized_alpha.hpp"
#include "support/one_thread.hpp"

namespace gneiss {
namespace {

constexpr double moving_mass = 2, gap = 1, speed = 3;  // kg, m, m/s

/// One node, free to move along x between stops at -gap and gap: springs that press alone, and store as contact does.
class BetweenStops final : public SemiDiscrete {
public:
    explicit BetweenStops(double stiffness) : stiffness_(stiffness), tangent_(*this) {}

    /// A history, as joints and contact have one.
    Layout layout() const override { return {2, 0, 1}; }
    State initial_state() const override {
        State state;
        state.u = {0, 0};
        state.v = {speed, 0};
        state.history = {0};
        return state;
    }
    std::span<const double> lumped_mass() const override { return mass_; }
    const Damping& damping() const override { return damping_; }
    std::span<const Constraint> constraints() const override { return {}; }
    void constraint_values(double, double, std::span<double>) const override {}
    bool force_depends_on_velocity() const override { return false; }
    void force(const State&, const Trial& trial, std::span<double> f) const override {
        f[0] = -stiffness_ * pressed(trial.u[0]);
        f[1] = 0;
    }
    void force_and_update(const State& accepted, const Trial& trial, std::span<double> f, std::span<double>,
                          std::span<double> history) const override {
        force(accepted, trial, f);
        history[0] = 0;
    }
    void external_force(const Trial&, std::span<double> f) const override { std::ranges::fill(f, 0.0); }
    using SemiDiscrete::interaction_force;
    void interaction_force(const State& accepted, const Trial& trial, std::span<double> f,
                           std::span<double>) const override {
        force(accepted, trial, f);
    }
    StoredEnergies stored_energies(const State& state) const override {
        StoredEnergies energies;
        energies.contact = 0.5 * stiffness_ * pressed(state.u[0]) * pressed(state.u[0]);
        return energies;
    }
    void internal_rate(const State&, const Trial&, std::span<double>) const override {}
    void internal_weights(std::span<double>) const override {}
    double smallest_length() const override { return gap; }
    const Tangent* tangent() const override { return &tangent_; }
    FrequencyBound frequency_bound(const State&) const override {
        return {.omega = std::sqrt(stiffness_ / moving_mass)};
    }
    void add_path_energies(const State& from, State& to) const override { to.path = from.path; }
    std::span<const std::unique_ptr<Event>> events() const override { return {}; }

private:
    class Diagonal final : public Tangent {
    public:
        explicit Diagonal(const BetweenStops& system) : system_(system) {}
        bool symmetric() const override { return true; }
        std::size_t n_nonzero() const override { return 2; }
        MatrixPattern pattern() const override { return {{0, 1, 2}, {0, 1}}; }
        void assemble(const State&, const Trial& trial, const Factors& factors,
                      std::span<double> values) const override {
            const double k = pressed(trial.u[0]) != 0 ? system_.stiffness_ : 0;
            values[0] = factors.mass * moving_mass + factors.stiffness * k;
            values[1] = factors.mass * moving_mass;
        }
        void assemble_diagonal(const State& accepted, const Trial& trial, const Factors& factors,
                               std::span<double> diagonal) const override {
            assemble(accepted, trial, factors, diagonal);
        }

    private:
        const BetweenStops& system_;
    };

    static double pressed(double x) { return x > gap ? x - gap : std::min(0.0, x + gap); }

    double stiffness_;
    std::vector<double> mass_{moving_mass, moving_mass};
    Damping damping_;
    Diagonal tangent_;
};

struct Choice {
    const char* name;
    std::function<std::unique_ptr<Integrator>(double dt, double interface_tolerance)> make;
};

auto alpha_scheme(const GeneralizedAlpha::Scheme& scheme) {
    return [scheme](double dt, double interface_tolerance) -> std::unique_ptr<Integrator> {
        GeneralizedAlpha::Options options;
        options.scheme = scheme;
        options.dt = dt;
        options.interface_tolerance = interface_tolerance;
        return std::make_unique<GeneralizedAlpha>(options);
    };
}

auto bathe(double rho_inf) {
    return [rho_inf](double dt, double interface_tolerance) -> std::unique_ptr<Integrator> {
        return std::make_unique<Bathe>(
            Bathe::Options{.rho_inf = rho_inf, .dt = dt, .interface_tolerance = interface_tolerance});
    };
}

class Kinks : public testing::TestWithParam<Choice> {};
INSTANTIATE_TEST_SUITE_P(
    Schemes, Kinks,
    testing::Values(Choice{"GeneralizedAlpha08", alpha_scheme(GeneralizedAlpha::Scheme::chung_hulbert(0.8))},
                    Choice{"GeneralizedAlpha1", alpha_scheme(GeneralizedAlpha::Scheme::chung_hulbert(1))},
                    Choice{"GeneralizedAlpha0", alpha_scheme(GeneralizedAlpha::Scheme::chung_hulbert(0))},
                    Choice{"Newmark", alpha_scheme(GeneralizedAlpha::Scheme::newmark(0.25, 0.5))},
                    Choice{"Hht", alpha_scheme(GeneralizedAlpha::Scheme::hht(0.1))}, Choice{"Bathe0", bathe(0)},
                    Choice{"Bathe08", bathe(0.8)}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(Kinks, MassBetweenStiffStops_KeepsItsEnergy) {
    // the spring of a stop turns by 20 rad in a step: 30 steps from stop to stop, 40 bounces
    constexpr double dt = gap / speed / 15, omega = 20 / dt, duration = 80 * gap / speed;
    const BetweenStops system(moving_mass * omega * omega);
    const auto integrator = GetParam().make(dt, scheme_defaults::interface_tolerance);
    State state = system.initial_state();
    integrator->start(system, state, StartReason::fresh);
    const auto energy = [&] { return integrator->kinetic_energy(system, state) + system.stored_energies(state).sum(); };
    const double before = energy();
    double largest = 0, smallest = before;
    std::size_t n_steps = 0, n_rejected = 0;
    for (; state.t < duration; ++n_steps) {
        const StepReport step = integrator->advance(system, state, duration);
        n_rejected += step.n_rejected;
        if (step.n_rejected > 0) {
            EXPECT_FALSE(step.rejected.empty());
        }
        largest = std::max(largest, energy());
        smallest = std::min(smallest, energy());
        ASSERT_LT(n_steps, 20000u);
    }
    EXPECT_GT(n_rejected, 0u);
    // free flight changes nothing; a bounce is some tens of steps, each of which may miss by its part, most by less
    constexpr double tolerance = 40 * 10 * scheme_defaults::interface_tolerance;
    EXPECT_LE(largest, before * (1 + tolerance)) << n_steps << " steps";
    EXPECT_GE(smallest, before * (1 - tolerance)) << n_steps << " steps";
}

TEST_P(Kinks, AnyStepWillDo_NoneIsTakenAgain) {
    constexpr double dt = gap / speed / 15, omega = 20 / dt;
    const BetweenStops system(moving_mass * omega * omega);
    const auto integrator = GetParam().make(dt, 1);
    State state = system.initial_state();
    integrator->start(system, state, StartReason::fresh);
    for (int n = 0; n < 60; ++n) {  // two bounces
        const StepReport step = integrator->advance(system, state, 1e9);
        EXPECT_EQ(step.n_rejected, 0u);
        EXPECT_NEAR(step.dt, dt, 1e-9 * dt);  // steps to the stop, far off, are equal
    }
    EXPECT_EQ(integrator->work().interactions, 0u);  // and nothing is spent on it
}

}  // namespace
}  // namespace gneiss
