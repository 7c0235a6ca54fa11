// What CVODE, ARKODE and IDA share beyond the contract of integrators: tolerances, matrices, messages.

#include <gmock/gmock.h>

#include <memory>

#include "integrators/arkode.hpp"
#include "integrators/cvode.hpp"
#include "integrators/ida.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator_problems.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

template <class Options>
std::vector<std::string> keys_of_problems(const Options& options) {
    try {
        options.validate();
    } catch (const InputError& error) {
        std::vector<std::string> keys;
        for (const Problem& problem : error.problems()) keys.push_back(problem.where);
        return keys;
    }
    return {};
}

template <class Options>
Options spoilt() {
    Options options;
    options.rtol = 0;
    options.longest = -1;
    options.scales = {-1, -1, -1};
    return options;
}

TEST(SundialsOde, Options_AllProblemsAtOnce) {
    auto cvode = spoilt<Cvode::Options>();
    cvode.max_order = 6;
    EXPECT_THAT(keys_of_problems(cvode),
                UnorderedElementsAre("integrator.rtol", "integrator.longest", "integrator.displacement_scale",
                                     "integrator.velocity_scale", "integrator.stress_scale", "integrator.max_order"));
    auto ida = spoilt<Ida::Options>();
    ida.max_order = -1;
    EXPECT_EQ(keys_of_problems(ida).size(), 6u);
    auto arkode = spoilt<Arkode::Options>();
    arkode.dt = -1;
    EXPECT_EQ(keys_of_problems(arkode).size(), 6u);
    cvode = {};
    cvode.method = Cvode::Method::adams;
    cvode.max_order = 12;
    EXPECT_THAT(keys_of_problems(cvode), testing::IsEmpty());
}

TEST(SundialsOde, UnknownTable_NamesAllThereAre) {
    Arkode::Options options;
    options.table = "rk4";
    try {
        Arkode integrator(options);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("given `rk4`, must be one of heun_euler_2_1_2, "));
        for (const RungeKuttaTable& table : runge_kutta_tables())
            EXPECT_EQ(std::string_view(error.what()).find(table.name) != std::string_view::npos, table.here())
                << table.name;
    }
}

TEST(SundialsOde, SystemWithoutTangent_OnlyExplicitAndFunctionalOnesTakeIt) {
    test::OscillatorModel model = test::two_nodes();
    model.has_tangent = false;
    const test::Oscillator system(model);
    State state = system.initial_state();
    Cvode::Options functional;
    functional.iteration = Cvode::Iteration::functional;
    Cvode newton({}), free_of_matrices(functional);
    EXPECT_THROW(newton.start(system, state, StartReason::fresh), InputError);
    EXPECT_NO_THROW(free_of_matrices.start(system, state, StartReason::fresh));
    Arkode explicit_one({});
    EXPECT_NO_THROW(explicit_one.start(system, state, StartReason::fresh));
}

TEST(SundialsOde, LinearProblem_TangentsServeForManySteps) {
    const test::Oscillator system(test::two_nodes());
    Cvode integrator({});
    test::march_oscillator(system, integrator);
    const SundialsOde::Counts counts = integrator.counts();
    EXPECT_GT(counts.steps, 100u);
    // CVODE asks for new ones after 50 steps, and for a new factorisation where gamma has moved by a third
    EXPECT_LT(counts.linearisations, counts.steps / 20);
    EXPECT_LT(counts.factorisations, counts.steps / 3);
}

TEST(SundialsOde, StageThatCannotBeEvaluated_IsAShorterStep) {
    for (const char* table : {"dormand_prince_7_4_5", "verner_8_5_6", "sdirk_5_3_4"}) {
        test::Oscillator system(test::two_nodes());
        const State exact = runge_kutta(system, test::oscillator_end, test::oscillator_reference_step);
        Arkode::Options options;
        options.table = table;
        Arkode integrator(options);
        State state = system.initial_state();
        integrator.start(system, state, StartReason::fresh);
        for (int step = 0; step < 5; ++step) integrator.advance(system, state, test::oscillator_end);
        const double before = state.t;
        system.fail_after(2);
        const StepReport step = integrator.advance(system, state, test::oscillator_end);
        EXPECT_EQ(step.n_rejected, 1U) << table;
        EXPECT_GT(state.t, before) << table;
        std::size_t n_steps = 6;
        for (; state.t < test::oscillator_end; ++n_steps) integrator.advance(system, state, test::oscillator_end);
        // as Error_FollowsTheTolerance of the contract
        EXPECT_LT(test::distance(state, exact), 10 * static_cast<double>(n_steps) * options.rtol) << table;
    }
}

TEST(SundialsOde, GivenScales_LoosenTheTolerance) {
    const test::Oscillator system(test::two_nodes());
    const auto steps = [&](double scale) {
        Cvode::Options options;
        options.scales = {scale, 5 * scale, 0};
        Cvode integrator(options);
        test::march_oscillator(system, integrator);
        return integrator.counts().steps;
    };
    EXPECT_GT(steps(0.1), steps(10) * 3 / 2);
}

TEST(SundialsOde, StateWithinAStep_IsAsExactAsItsEnd) {
    test::OscillatorModel model = test::two_nodes();
    model.load = test::smooth_load;
    model.damping.mass_proportional = 0.4;
    model.damping.blocks = {{0, 3.0, 1.2, 5.0}};
    model.prescribed = {test::moving(1, Constraint::Kind::displacement, -0.2),
                        test::moving(2, Constraint::Kind::velocity, 0.15)};
    const test::Oscillator system(model);
    std::vector<std::unique_ptr<Integrator>> integrators;
    Cvode::Options cvode;
    Ida::Options ida;
    cvode.rtol = ida.rtol = 1e-8;
    integrators.push_back(std::make_unique<Cvode>(cvode));
    integrators.push_back(std::make_unique<Ida>(ida));
    for (const char* table : {"dormand_prince_7_4_5", "fehlberg_13_7_8", "kvaerno_7_4_5"}) {
        Arkode::Options arkode;
        arkode.rtol = 1e-8;
        arkode.table = table;
        integrators.push_back(std::make_unique<Arkode>(arkode));
    }
    for (const auto& integrator : integrators) {
        ASSERT_TRUE(integrator->interpolates());
        State state = system.initial_state();
        integrator->start(system, state, StartReason::fresh);
        const auto energy = [&](const State& at) {
            const PathEnergies& path = at.path;
            return integrator->kinetic_energy(system, at) + system.stored_energies(at).sum() + path.damping +
                   path.absorbing - path.external_work - path.support_work;
        };
        double start = 0;
        std::size_t n_steps = 0;
        for (double next = 0.7; state.t < next; ++n_steps) {
            start = state.t;
            integrator->advance(system, state, test::oscillator_end);
        }
        State at;
        std::vector<double> reactions;
        for (const double part : {0.2, 0.5, 0.9}) {
            integrator->state_within(system, start + part * (state.t - start), at, reactions);
            const State exact = runge_kutta(system, at.t, test::oscillator_reference_step);
            // as Error_FollowsTheTolerance of the contract
            EXPECT_LT(test::distance(at, exact), 10 * static_cast<double>(n_steps) * 1e-8) << integrator->name();
            // the rule of order 4 over a part of the step; the table of order 8 takes steps of 0.04
            EXPECT_NEAR(energy(at), energy(state), 2e-6 * std::abs(at.path.external_work)) << integrator->name();
        }
        // at the end it is the state itself
        integrator->state_within(system, state.t, at, reactions);
        EXPECT_LT(test::distance(at, state), 1e-13) << integrator->name();
        EXPECT_NEAR(energy(at), energy(state), 1e-12) << integrator->name();
        const auto at_end = integrator->reactions(system, state);
        for (std::size_t k = 0; k < reactions.size(); ++k)
            EXPECT_NEAR(reactions[k], at_end[k], 1e-9) << integrator->name();
        // and the march goes on from it
        const double reached = state.t;
        EXPECT_GT(integrator->advance(system, state, test::oscillator_end).t, reached) << integrator->name();
    }
}

TEST(SundialsOde, NothingMoves_NothingHappens) {
    test::OscillatorModel model = test::two_nodes();
    model.initial_u = model.initial_v = test::Vector::Zero(4);
    const test::Oscillator system(model);
    Cvode integrator({});
    const State state = test::march_oscillator(system, integrator);
    EXPECT_EQ(state.u, std::vector<double>(4, 0.0));
    EXPECT_EQ(state.v, std::vector<double>(4, 0.0));
}

}  // namespace
}  // namespace gneiss
