// How often a step evaluates forces: a scheme's own evaluations, apart from those of starts and of the energy balance.
// The system counts too, so that none is left out.

#include <cstdio>  // SUNDIALS 6.4 forgets it

#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "integrators/arkode.hpp"
#include "integrators/bathe.hpp"
#include "integrators/central_difference.hpp"
#include "integrators/cvode.hpp"
#include "integrators/generalized_alpha.hpp"
#include "integrators/ida.hpp"
#include "integrators/mri.hpp"
#include "integrators/noh_bathe.hpp"
#include "integrators/verlet.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator_problems.hpp"

namespace gneiss {
namespace {

using test::Oscillator;
using test::OscillatorModel;
using Made = std::unique_ptr<Integrator>;

constexpr double counted_step = 0.05;  ///< s, below every limit: omega dt = 0.42
constexpr int n_counted = 6;
/// Of a start: its forces, and those now and a little later that scales of errors are taken from.
constexpr std::size_t with_scales = 3;

OscillatorModel free_nodes() {
    OscillatorModel model = test::two_nodes();
    model.load = test::smooth_load;
    return model;
}

OscillatorModel with_supports(bool moving) {
    OscillatorModel model = free_nodes();
    const auto rest = [](double value) { return [value](double) { return value; }; };
    if (moving)
        model.prescribed = {test::moving(1, Constraint::Kind::displacement, -0.2)};
    else
        model.prescribed = {{{1, Constraint::Kind::displacement}, rest(-0.2), rest(0), rest(0)}};
    return model;
}

OscillatorModel with_memory() {
    OscillatorModel model = free_nodes();
    model.maxwell = test::Matrix{{1, 0, -1, 0}};
    model.maxwell_stiffness = 20;
    model.relaxation_time = 0.4;
    return model;
}

OscillatorModel viscous() {
    OscillatorModel model = free_nodes();
    model.viscosity = test::Matrix{{3, -1, -1, 0}, {-1, 2, 0, 0}, {-1, 0, 2, 0.5}, {0, 0, 0.5, 1}};
    return model;
}

/// What some steps have evaluated.
struct Evaluations {
    std::vector<std::size_t> of_step;  ///< by the scheme
    std::size_t own = 0, balance = 0, starts = 0, by_system = 0, iterations = 0;
};

Evaluations evaluations_of(Integrator& integrator, const OscillatorModel& model) {
    const Oscillator system(model);
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    Evaluations all;
    for (int step = 0; step < n_counted; ++step) {
        all.of_step.push_back(integrator.advance(system, state, n_counted * counted_step).n_force);
        all.own += all.of_step.back();
    }
    const WorkCounts work = integrator.work();
    all.balance = work.balance;
    all.starts = work.starts;
    all.iterations = work.iterations;
    all.by_system = system.n_evaluations();
    return all;
}

Made arkode(const RungeKuttaTable& table) {
    Arkode::Options options;
    options.table = table.name;
    options.dt = counted_step;
    options.rtol = 1e-10;  // of its Newton iterations
    return std::make_unique<Arkode>(options);
}

std::vector<const RungeKuttaTable*> tables_of(RungeKuttaTable::Kind kind) {
    std::vector<const RungeKuttaTable*> tables;
    for (const RungeKuttaTable& table : runge_kutta_tables())
        if (table.kind() == kind && table.here()) tables.push_back(&table);
    return tables;
}

/// What ARKODE's dense output evaluates for the middles of steps, which the energy balance asks for.
std::size_t dense_output(const RungeKuttaTable& table) {
    const std::size_t of_step = table.order() < 5 ? 0 : table.order() == 5 ? 1 : 4;
    return of_step * n_counted;
}

class ExplicitTable : public testing::TestWithParam<const RungeKuttaTable*> {};

TEST_P(ExplicitTable, AStep_EvaluatesItsStages) {
    const RungeKuttaTable& name = *GetParam();
    const std::unique_ptr<ARKodeButcherTableMem, void (*)(ARKodeButcherTable)> table(
        ARKodeButcherTable_LoadERK(static_cast<ARKODE_ERKTableID>(name.explicit_id)), ARKodeButcherTable_Free);
    const auto stages = static_cast<std::size_t>(table->stages);
    std::vector<std::size_t> expected(n_counted, stages);
#if GNEISS_SUNDIALS_HAS_LAZY_RATES
    // the first stage of all is the start's; what a step ends with begins the next one, and is evaluated unless it was
    // the last stage
    if (ARKodeButcherTable_IsStifflyAccurate(table.get())) std::ranges::fill(expected, stages - 1);
#else
    // ARKODE evaluates the first stage anew where the last node was the end of the step: nothing is saved by it. The
    // first stage of all is the start's; where the last node is not the end, ARKODE evaluates there for the next step
    if (table->c[table->stages - 1] == 1) --expected.front();
#endif
    const auto model_of = [](const std::string& which) {
        return which == "free" ? free_nodes() : with_supports(which == "moving");
    };
    for (const std::string which : {"free", "resting", "moving"}) {
        const Evaluations found = evaluations_of(*arkode(name), model_of(which));
        EXPECT_EQ(found.of_step, expected) << which;
        EXPECT_EQ(found.starts, with_scales) << which;
        // the work of a support that moves: its force in the middle of every step, and at the end where no stage is
        const std::size_t dense = dense_output(name);
        EXPECT_GE(found.balance, dense + (which == "moving" ? n_counted : 0u)) << which;
        EXPECT_LE(found.balance, dense + (which == "moving" ? 2 * n_counted + 1 : 0u)) << which;
        EXPECT_EQ(found.own + found.starts + found.balance, found.by_system) << which;
    }
}

INSTANTIATE_TEST_SUITE_P(Arkode, ExplicitTable, testing::ValuesIn(tables_of(RungeKuttaTable::Kind::explicit_)),
                         [](const auto& instance) { return std::string(instance.param->name); });

TEST(EvaluationCounts, KnownTables_HaveTheStagesOfTheirPapers) {
    const auto of_step = [](const std::string& name) {
        const auto tables = runge_kutta_tables();
        const auto table = std::ranges::find_if(tables, [&](const auto& one) { return name == one.name; });
        return evaluations_of(*arkode(*table), with_supports(false)).of_step.back();
    };
    EXPECT_EQ(of_step("heun_euler_2_1_2"), 2u);
    EXPECT_EQ(of_step("dormand_prince_7_4_5"),
              GNEISS_SUNDIALS_HAS_LAZY_RATES ? 6u : 7u);  // the last one is the next first
    EXPECT_EQ(of_step("fehlberg_13_7_8"), 13u);
}

// ---- implicit tables

class ImplicitTable : public testing::TestWithParam<const RungeKuttaTable*> {};

TEST_P(ImplicitTable, AStep_EvaluatesItsNewtonIterationsAndItsStages) {
    const RungeKuttaTable& name = *GetParam();
    const std::unique_ptr<ARKodeButcherTableMem, void (*)(ARKodeButcherTable)> table(
        ARKodeButcherTable_LoadDIRK(static_cast<ARKODE_DIRKTableID>(name.implicit_id)), ARKodeButcherTable_Free);
    const Evaluations found = evaluations_of(*arkode(name), with_supports(false));
    // an iteration that moves nothing evaluates nothing; a stage that is solved, and the end of a step, once more each
    const auto stages = static_cast<std::size_t>(table->stages);
    EXPECT_LE(found.own, found.iterations + n_counted * (stages + 1));
    EXPECT_GE(found.own, n_counted * stages);
    EXPECT_EQ(found.starts, with_scales);
    EXPECT_EQ(found.balance, dense_output(name));
    EXPECT_EQ(found.own + found.starts + found.balance, found.by_system);
}

INSTANTIATE_TEST_SUITE_P(Arkode, ImplicitTable, testing::ValuesIn(tables_of(RungeKuttaTable::Kind::implicit)),
                         [](const auto& instance) { return std::string(instance.param->name); });
INSTANTIATE_TEST_SUITE_P(ArkodeAdditive, ImplicitTable, testing::ValuesIn(tables_of(RungeKuttaTable::Kind::additive)),
                         [](const auto& instance) { return std::string(instance.param->name); });

// ---- explicit schemes of our own

struct OwnCounts {
    std::string name;
    std::size_t of_step, of_viscous_step;
    bool forces_at_ends;  ///< it has evaluated forces where a step ends
    std::function<Made()> make;
};
void PrintTo(const OwnCounts& scheme, std::ostream* out) { *out << scheme.name; }

std::vector<OwnCounts> explicit_schemes() {
    const StableStep::Options step{.safety = 1, .dt = counted_step};
    std::vector<OwnCounts> schemes{
        {"CentralDifference", 1, 1, true, [=] { return std::make_unique<CentralDifference>(step); }},
        {"NohBathe", 2, 2, true, [=] { return std::make_unique<NohBathe>(NohBathe::Options{.step = step}); }}};
    for (const VerletComposition& composition : verlet_compositions())
        for (const Verlet::Form form : {Verlet::Form::velocity, Verlet::Form::position}) {
            const bool ends = form == Verlet::Form::velocity;
            const std::size_t n = composition.sub_steps.size();
            // anew until they are symmetric to the order: three times for order 4
            schemes.push_back({std::string(ends ? "Velocity_" : "Position_") + composition.name, n,
                               n * static_cast<std::size_t>(composition.order - 1), ends, [=, &composition] {
                                   return std::make_unique<Verlet>(Verlet::Options{step, form, composition.name});
                               }});
        }
    return schemes;
}

class ExplicitScheme : public testing::TestWithParam<OwnCounts> {};

TEST_P(ExplicitScheme, AStep_EvaluatesItsSubSteps) {
    const OwnCounts& scheme = GetParam();
    for (const bool held : {false, true}) {
        const Evaluations found = evaluations_of(*scheme.make(), held ? with_supports(true) : free_nodes());
        EXPECT_EQ(found.of_step, std::vector<std::size_t>(n_counted, scheme.of_step));
        EXPECT_EQ(found.starts, 1u);
        EXPECT_EQ(found.balance, held && !scheme.forces_at_ends ? n_counted : 0u);  // of the reactions
        EXPECT_EQ(found.own + found.starts + found.balance, found.by_system);
    }
    EXPECT_EQ(evaluations_of(*scheme.make(), viscous()).of_step,
              std::vector<std::size_t>(n_counted, scheme.of_viscous_step));
}

INSTANTIATE_TEST_SUITE_P(Schemes, ExplicitScheme, testing::ValuesIn(explicit_schemes()),
                         [](const auto& instance) { return instance.param.name; });

// ---- implicit schemes of our own

struct NewtonCounts {
    std::string name;
    std::size_t stages;
    bool end_is_a_stage;
    std::function<Made()> make;
};
void PrintTo(const NewtonCounts& scheme, std::ostream* out) { *out << scheme.name; }

Made alpha(const GeneralizedAlpha::Scheme& scheme) {
    GeneralizedAlpha::Options options;
    options.scheme = scheme;
    options.dt = counted_step;
    return std::make_unique<GeneralizedAlpha>(options);
}

const NewtonCounts newton_schemes[] = {
    {"Newmark", 1, true, [] { return alpha(GeneralizedAlpha::Scheme::newmark(0.25, 0.5)); }},
    {"ChungHulbert", 1, false, [] { return alpha(GeneralizedAlpha::Scheme::chung_hulbert(0.8)); }},
    {"Hht", 1, false, [] { return alpha(GeneralizedAlpha::Scheme::hht(0.1)); }},
    {"Bathe", 2, true, [] { return std::make_unique<Bathe>(Bathe::Options{.dt = counted_step}); }},
};

class NewtonScheme : public testing::TestWithParam<NewtonCounts> {};

TEST_P(NewtonScheme, AStep_EvaluatesItsNewtonIterationsAndOnceMoreToSeeThatTheyAreDone) {
    const NewtonCounts& scheme = GetParam();
    const Evaluations found = evaluations_of(*scheme.make(), with_supports(true));
    EXPECT_EQ(found.own, found.iterations + n_counted * scheme.stages);
    EXPECT_EQ(found.starts, scheme.name == "Bathe" ? 1 : with_scales);
    EXPECT_EQ(found.balance, scheme.end_is_a_stage ? 0u : n_counted);
    EXPECT_EQ(found.own + found.starts + found.balance, found.by_system);
    // what is remembered is evaluated where the step, or sub-step, ends
    const Evaluations remembering = evaluations_of(*scheme.make(), with_memory());
    EXPECT_EQ(remembering.own, remembering.iterations + 2 * n_counted * scheme.stages);
    EXPECT_EQ(remembering.balance, 0u);
}

INSTANTIATE_TEST_SUITE_P(Schemes, NewtonScheme, testing::ValuesIn(newton_schemes),
                         [](const auto& instance) { return instance.param.name; });

// ---- steps to a tolerance

struct ControlledCounts {
    std::string name;
    std::size_t dense;  ///< evaluations of its dense output in n_counted
    std::function<Made()> make;
};
void PrintTo(const ControlledCounts& scheme, std::ostream* out) { *out << scheme.name; }

Made cvode(Cvode::Method method, Cvode::Iteration iteration) {
    Cvode::Options options;
    options.method = method;
    options.iteration = iteration;
    return std::make_unique<Cvode>(options);
}

const ControlledCounts controlled_schemes[] = {
    {"Bdf", 0, [] { return cvode(Cvode::Method::bdf, Cvode::Iteration::newton); }},
    {"Adams", 0, [] { return cvode(Cvode::Method::adams, Cvode::Iteration::functional); }},
    {"Ida", 0, [] { return std::make_unique<Ida>(Ida::Options{}); }},
    {"DormandPrince", n_counted, [] { return std::make_unique<Arkode>(Arkode::Options{}); }},
};

class ControlledScheme : public testing::TestWithParam<ControlledCounts> {};

TEST_P(ControlledScheme, NoEvaluation_IsLeftOut) {
    for (const bool moving : {false, true}) {
        const Evaluations found = evaluations_of(*GetParam().make(), with_supports(moving));
        EXPECT_GE(found.own, std::max<std::size_t>(found.iterations, n_counted));
        EXPECT_EQ(found.starts, with_scales);
        // at most the start, the middle and the end of every step
        EXPECT_GE(found.balance, GetParam().dense + (moving ? n_counted : 0u));
        EXPECT_LE(found.balance, GetParam().dense + (moving ? 2u * n_counted + 1 : 0u));
        EXPECT_EQ(found.own + found.starts + found.balance, found.by_system);
    }
}

TEST_P(ControlledScheme, Reactions_AskedForOnceOrInEveryStep_AreTheSame) {
    for (const bool moving : {false, true}) {
        const Oscillator system(with_supports(moving));
        std::vector<double> found;
        for (const bool every : {false, true}) {
            const Made integrator = GetParam().make();
            State state = system.initial_state();
            integrator->start(system, state, StartReason::fresh);
            for (int step = 0; step < n_counted; ++step) {
                integrator->advance(system, state, 1);
                if (every || step + 1 == n_counted) found.push_back(integrator->reactions(system, state)[0]);
            }
            EXPECT_LE(integrator->work().balance, GetParam().dense + (moving ? 2u : 1u) * n_counted + 1);
        }
        EXPECT_EQ(found.front(), found.back());
        EXPECT_NE(found.front(), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, ControlledScheme, testing::ValuesIn(controlled_schemes),
                         [](const auto& instance) { return instance.param.name; });

TEST(EvaluationCounts, Multirate_AreThoseOfTheSlowStages) {
    const std::size_t stages[] = {3, 3, 5};  // integrators/README.md
    for (std::size_t k = 0; k < multirate_tables().size(); ++k) {
        Mri::Options options;
        options.table = multirate_tables()[k].name;
        options.dt = counted_step;
        Mri mri(options);
        const Evaluations found = evaluations_of(mri, with_supports(false));
        EXPECT_EQ(found.of_step, std::vector<std::size_t>(n_counted, stages[k])) << options.table;
        EXPECT_EQ(found.balance, 0u) << options.table;
        EXPECT_EQ(found.own + found.starts, found.by_system) << options.table;
    }
}

}  // namespace
}  // namespace gneiss
