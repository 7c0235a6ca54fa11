// What is the compositions' own: stability, reversibility, energy, what they refuse.

#include "integrators/verlet.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/errors.hpp"
#include "support/amplification.hpp"
#include "support/eps.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator_problems.hpp"

namespace gneiss {
namespace {

using test::eps;
using testing::HasSubstr;
using VerletForm = Verlet::Form;

struct VerletKind {
    const VerletComposition& composition;
    VerletForm form;

    std::unique_ptr<Verlet> make(const StableStep::Options& step) const {
        return std::make_unique<Verlet>(Verlet::Options{step, form, composition.name});
    }
};
void PrintTo(const VerletKind& kind, std::ostream* out) { *out << kind.composition.name; }

std::vector<VerletKind> kinds() {
    std::vector<VerletKind> all;
    for (const VerletComposition& composition : verlet_compositions())
        for (const VerletForm form : {VerletForm::velocity, VerletForm::position}) all.push_back({composition, form});
    return all;
}

class EveryVerlet : public testing::TestWithParam<VerletKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, EveryVerlet, testing::ValuesIn(kinds()), [](const auto& instance) {
    return std::string(instance.param.form == VerletForm::velocity ? "Velocity_" : "Position_") +
           instance.param.composition.name;
});

TEST_P(EveryVerlet, StabilityLimit_IsWhereStepsBeginToGrow) {
    // up to just beyond it: sofroniou_spaletta_35 is unstable on a narrow interval there, and then stable up to 5.97
    const double expected = GetParam().composition.limit.omega_dt;
    const double limit =
        test::stability_limit([&](double dt) { return GetParam().make({.safety = 1, .dt = dt}); }, expected + 5e-4);
    // the table rounds down in its fifth digit; growth of 1e-6 a step begins that much later
    EXPECT_NEAR(limit, expected, 2e-4);
}

TEST_P(EveryVerlet, DampedInAnyWay_AtTheCriticalStep_StaysBounded) {
    // just below the limit the amplitude may be larger than at the start, by about (1 - 0.999^2)^-1/2
    EXPECT_LT(test::largest_under_damping([] { return GetParam().make({.safety = 0.999}); }), 30);
}

TEST_P(EveryVerlet, SubSteps_FulfilTheConditionsOfTheirOrder) {
    // of those of order p the ones on single sub-steps: their odd powers up to p - 1 vanish
    for (int power = 1; power < GetParam().composition.order; power += 2) {
        double sum = 0;
        for (const double part : GetParam().composition.sub_steps) sum += std::pow(part, power);
        EXPECT_NEAR(sum, power == 1 ? 1 : 0, 32 * eps) << "power " << power;
    }
}

TEST_P(EveryVerlet, MotionReversed_ComesBack) {
    test::OscillatorModel model = test::two_nodes();
    const test::Oscillator system(model);
    const auto integrator = GetParam().make({.dt = 0.05});
    State state = system.initial_state();
    const State before = state;
    integrator->start(system, state, StartReason::fresh);
    for (int step = 0; step < 200; ++step) integrator->advance(system, state, state.t + 0.05);
    for (double& v : state.v) v = -v;
    for (int step = 0; step < 200; ++step) integrator->advance(system, state, state.t + 0.05);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(state.u[i], before.u[i], 1e4 * eps);  // thousands of operations
        EXPECT_NEAR(state.v[i], -before.v[i], 1e5 * eps);
    }
}

TEST_P(EveryVerlet, ManyPeriodsUndamped_EnergyErrorDoesNotGrow) {
    const test::Oscillator system(test::two_nodes());
    const auto integrator = GetParam().make({.dt = 0.05});
    State state = system.initial_state();
    integrator->start(system, state, StartReason::fresh);
    const auto energy = [&] { return integrator->kinetic_energy(system, state) + system.stored_energies(state).sum(); };
    const double before = energy();
    double early = 0, late = 0;
    for (int step = 0; step < 40000; ++step) {
        integrator->advance(system, state, state.t + 0.05);
        double& largest = step < 20000 ? early : late;
        largest = std::max(largest, std::abs(energy() - before));
    }
    EXPECT_LT(early, 0.05 * before);
    EXPECT_LT(late, 1.1 * early + 1e4 * eps * before);
}

TEST(Verlet, SingleInVelocityForm_LinearUndamped_KeepsItsEnergyToRoundOff) {
    const test::Oscillator system(test::two_nodes());
    Verlet integrator({{.dt = 0.2}, VerletForm::velocity, "single"});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    const auto energy = [&] { return integrator.kinetic_energy(system, state) + system.stored_energies(state).sum(); };
    const double before = energy();
    for (int step = 0; step < 10000; ++step) integrator.advance(system, state, state.t + 0.2);
    EXPECT_NEAR(energy(), before, 1e4 * eps * before);  // 1e4 steps
}

TEST(Verlet, FiveSubSteps_WithAsManyForces_AreMoreAccurateThanThree) {
    const test::Oscillator system(test::two_nodes());
    const State exact = runge_kutta(system, test::oscillator_end, test::oscillator_reference_step);
    const auto error = [&](const char* composition, double sub_steps) {
        Verlet integrator({{.safety = 1, .dt = 0.01 * sub_steps}, VerletForm::velocity, composition});
        return test::distance(test::march_oscillator(system, integrator), exact);
    };
    const double three = error("yoshida_3", 3);
    EXPECT_LT(error("suzuki_5", 5), 0.5 * three);
    EXPECT_LT(error("mclachlan_5", 5), 0.5 * three);
}

TEST(Verlet, StepsBack_WithWhatCannotBeUndone_AreRefused) {
    test::OscillatorModel model = test::two_nodes();
    model.irreversible = true;
    const test::Oscillator system(model);
    State state = system.initial_state();
    for (const VerletComposition& composition : verlet_compositions()) {
        Verlet integrator({{}, VerletForm::velocity, composition.name});
        if (!composition.goes_back()) {
            EXPECT_NO_THROW(integrator.start(system, state, StartReason::fresh));
            continue;
        }
        try {
            integrator.start(system, state, StartReason::fresh);
            FAIL() << composition.name;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("friction and restitution cannot be undone: take `single`"));
        }
    }
}

TEST(Verlet, Options_OutOfRange_AreReported) {
    EXPECT_THROW(Verlet({{.safety = 0}, VerletForm::velocity, "single"}), InputError);
    try {
        Verlet integrator({{}, VerletForm::velocity, "suzuki"});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("given `suzuki`, must be one of single, yoshida_3, suzuki_5, mclachlan_5"));
    }
}

}  // namespace
}  // namespace gneiss
