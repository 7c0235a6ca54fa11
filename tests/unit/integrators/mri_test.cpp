// What is the multirate methods' own: the fast part, what it costs, their messages.

#include "integrators/mri.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/errors.hpp"
#include "integrators/arkode.hpp"
#include "support/amplification.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator_problems.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;

Mri::Options mri_with(const char* table, double dt, double rtol) {
    Mri::Options options;
    options.table = table;
    options.dt = dt;
    options.rtol = rtol;
    return options;
}

/// Two nodes that a stiff contact of 300 rad/s holds together.
test::OscillatorModel stiff_contact() {
    test::OscillatorModel model = test::two_nodes();
    const test::Vector normal{{1, 0.2, -1, -0.2}};
    model.interactions = 5e4 * normal * normal.transpose();
    model.stiffness += model.interactions;
    model.initial_u = test::Vector{{0.1, 0, 0.1, 0}};
    model.initial_v = test::Vector{{0.5, 0.3, 0.5, 0.3}};
    model.load = test::smooth_load;
    return model;
}

TEST(Mri, StiffInteractions_StepsFarAboveTheirLimit_AreAccurateWhereASingleRateMethodIsUnstable) {
    const test::Oscillator system(stiff_contact());
    ASSERT_GT(system.exact_bound().omega, 300);
    const State exact = runge_kutta(system, test::oscillator_end, 2e-5);
    constexpr double dt = 0.025;  // 7 or more in omega dt
    for (const MultirateTable& table : multirate_tables()) {
        Mri mri(mri_with(table.name, dt, 1e-8));
        EXPECT_LT(test::distance(test::march_oscillator(system, mri), exact), 2e-3) << table.name;
    }
    Arkode::Options single;
    single.table = "zonneveld_5_3_4";
    single.dt = dt;
    Arkode arkode(single);
    const State grown = test::march_oscillator(system, arkode);
    EXPECT_FALSE(test::distance(grown, exact) < 1e3);
}

TEST(Mri, StiffInteractions_StepsThatResolveThem_ConvergeWithTheOrder) {
    const test::Oscillator system(stiff_contact());
    const State exact = runge_kutta(system, test::oscillator_end, 2e-5);
    for (const MultirateTable& table : multirate_tables()) {
        const auto error = [&](double dt) {
            Mri mri(mri_with(table.name, dt, 1e-12));
            return test::distance(test::march_oscillator(system, mri), exact);
        };
        // order 4 falls faster here, and sooner into what the fast part's tolerance leaves
        double dt = table.order == 3 ? 0.003125 : 0.00625, before = error(dt);
        for (int halving = 0; halving < 2; ++halving) {
            dt /= 2;
            const double now = error(dt);
            EXPECT_GT(std::log2(before / now), table.order - 0.15) << table.name << ", dt = " << dt;
            before = now;
        }
    }
}

TEST(Mri, Limit_OfTheSlowPartAlone_IsTheTables) {
    for (const MultirateTable& table : multirate_tables()) {
        const double limit =
            test::stability_limit([&](double dt) { return std::make_unique<Mri>(mri_with(table.name, dt, 1e-10)); }, 6);
        EXPECT_NEAR(limit, table.limit, 0.01) << table.name;
    }
}

TEST(Mri, StepAboveTheLimitOfTheSlowPart_IsWarnedOfOnce) {
    test::OscillatorModel model = stiff_contact();
    model.bound = {.omega = 10, .damping_rate = 0, .of_bonds = 64};  // 6 without bonds
    const test::Oscillator system(model);
    for (const MultirateTable& table : multirate_tables())
        for (const double part : {0.99, 1.01}) {
            Mri mri(mri_with(table.name, part * table.limit / 6, 1e-6));
            State state = system.initial_state();
            mri.start(system, state, StartReason::fresh);
            const std::string first = mri.advance(system, state, 10).warning;
            EXPECT_EQ(first.empty(), part < 1) << table.name << first;
            EXPECT_EQ(mri.advance(system, state, 10).warning, "");
        }
}

TEST(Mri, StiffInteractions_LoadsAndDamping_BalanceAgainstTheEnergy) {
    test::OscillatorModel model = stiff_contact();
    model.damping.mass_proportional = 0.4;
    const test::Oscillator system(model);
    for (const MultirateTable& table : multirate_tables()) {
        Mri mri(mri_with(table.name, 0.0125, 1e-8));
        State state = system.initial_state();
        const auto energy = [&] { return mri.kinetic_energy(system, state) + system.stored_energies(state).sum(); };
        const double before = energy();
        March march;
        march.t_end = test::oscillator_end;
        march.run(system, mri, state, false);
        // some of the contact's vibration is between the ledger's two looks at a step
        EXPECT_NEAR(energy() - before, state.path.external_work - state.path.damping,
                    1e-2 * std::abs(state.path.external_work))
            << table.name;
    }
}

TEST(Mri, WithinTheFirstStepAfterAStart_StatesAreAsAccurateAsInLaterOnes) {
    test::OscillatorModel model = test::two_nodes();
    model.interactions = 0.3 * model.stiffness;
    model.load = test::smooth_load;
    const test::Oscillator system(model);
    for (const MultirateTable& table : multirate_tables()) {
        Mri mri(mri_with(table.name, 0.025, 1e-10));
        State state = system.initial_state(), at;
        std::vector<double> reactions;
        mri.start(system, state, StartReason::fresh);
        const auto error_within = [&] {
            const double start = state.t;
            mri.advance(system, state, 1);
            mri.state_within(system, 0.5 * (start + state.t), at, reactions);
            return test::distance(at, runge_kutta(system, at.t, test::oscillator_reference_step));
        };
        const double of_first = error_within();
        const double later = std::max(error_within(), error_within());
        mri.forget(system, state);  // as after an event
        const double of_next_first = error_within();
        EXPECT_LT(of_first, 4 * later) << table.name;  // derivatives of the motion vary by less
        EXPECT_LT(of_next_first, 4 * later) << table.name;
    }
}

TEST(Mri, ForceEvaluations_AreThoseOfTheSlowPart) {
    const test::Oscillator system(stiff_contact());
    Mri mri(mri_with("mri_gark_erk33a", 0.025, 1e-8));
    State state = system.initial_state();
    mri.start(system, state, StartReason::fresh);
    mri.advance(system, state, 1);
    const std::size_t fast_before = mri.work().interactions;
    const StepReport step = mri.advance(system, state, 1);
    EXPECT_EQ(step.n_force, 3u);                             // its stages
    EXPECT_GT(mri.work().interactions - fast_before, 100u);  // 7 radians at six digits and more
}

TEST(Mri, Options_AreRefusedByName) {
    for (const double dt : {0.0, -1.0, std::nan("")}) EXPECT_THROW(Mri(mri_with("mis_kw3", dt, 1e-6)), InputError);
    try {
        Mri mri(mri_with("mis", 0.1, 1e-6));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("given `mis`, must be one of mis_kw3, mri_gark_erk33a, mri_gark_erk45a"));
    }
}

}  // namespace
}  // namespace gneiss
