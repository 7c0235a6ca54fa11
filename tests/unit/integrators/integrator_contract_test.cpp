// What every integrator of dynamics has to show: its order on damped, loaded, non-autonomous problems with internal
// variables and moving supports, errors that follow the tolerance, restarts, failures. A new one joins by one line.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <tuple>

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
using test::OscillatorProblem;

using Made = std::unique_ptr<Integrator>;

struct FixedScheme {
    std::string name;
    int order;
    double longest;  ///< first step of the halvings, s: 0.2 or a half of it, or of that
    std::function<Made(double dt)> make;
};

Made alpha(const GeneralizedAlpha::Scheme& scheme, double dt) {
    GeneralizedAlpha::Options options;
    options.scheme = scheme;
    options.dt = dt;
    options.tolerance = 1e-12;
    return std::make_unique<GeneralizedAlpha>(options);
}

/// Verner's tables of SUNDIALS 6.7 and newer: the largest terms of their errors are so small that the next ones rule at
/// any step which round-off allows, and errors fall faster than their order says (9_5_6: as h^7 on these linear
/// problems).
bool made_to_be_precise(std::string_view table) { return table.starts_with("verner_") && table != "verner_8_5_6"; }

std::vector<FixedScheme> fixed_schemes() {
    using Scheme = GeneralizedAlpha::Scheme;
    std::vector<FixedScheme> schemes{
        {"CentralDifference", 2, 0.0125,
         [](double dt) {
             return std::make_unique<CentralDifference>(CentralDifference::Options{.safety = 1.0, .dt = dt});
         }},
        {"ChungHulbert", 2, 0.0125, [](double dt) { return alpha(Scheme::chung_hulbert(0.3), dt); }},
        {"Newmark", 2, 0.0125, [](double dt) { return alpha(Scheme::newmark(0.3, 0.5), dt); }},
        {"NewmarkDamped", 1, 0.003125, [](double dt) { return alpha(Scheme::newmark(0.36, 0.7), dt); }},
        {"HilberHughesTaylor", 2, 0.0125, [](double dt) { return alpha(Scheme::hht(0.2), dt); }},
    };
    for (const double rho_inf : {0.0, 0.6}) {
        schemes.push_back({rho_inf == 0 ? "Bathe" : "BatheWithRhoInf", 2, 0.0125, [rho_inf](double dt) {
                               return std::make_unique<Bathe>(Bathe::Options{rho_inf, dt, {.tolerance = 1e-12}});
                           }});
    }
    for (const double split : {0.54, 0.6}) {
        schemes.push_back({split == 0.54 ? "NohBathe" : "NohBatheDamped", 2, 0.0125, [split](double dt) {
                               return std::make_unique<NohBathe>(NohBathe::Options{{.safety = 1, .dt = dt}, split});
                           }});
    }
    for (const VerletComposition& composition : verlet_compositions()) {
        const double longest[] = {0, 0, 0.0125, 0, 0.025, 0, 0.05, 0, 0.1, 0, 0.2};
        for (const Verlet::Form form : {Verlet::Form::velocity, Verlet::Form::position}) {
            const char* const name = form == Verlet::Form::velocity ? "VelocityVerlet_" : "PositionVerlet_";
            schemes.push_back(
                {std::string(name) + composition.name, composition.order, longest[composition.order],
                 [&composition, form](double dt) {
                     return std::make_unique<Verlet>(Verlet::Options{{.safety = 1, .dt = dt}, form, composition.name});
                 }});
        }
    }
    for (const MultirateTable& table : multirate_tables()) {
        schemes.push_back({table.name, table.order, 0.025, [&table](double dt) {
                               Mri::Options options;
                               options.table = table.name;
                               options.dt = dt;
                               options.rtol = 1e-13;  // of the fast part
                               return std::make_unique<Mri>(options);
                           }});
    }
    for (const RungeKuttaTable& table : runge_kutta_tables()) {
        // from where the leading error rules to where round-off is still far
        const double longest[] = {0, 0.0015625, 0.0125, 0.0125, 0.025, 0.025, 0.025, 0.2, 0.1, 0.2};
        if (!table.here()) continue;
        // small error constants: nothing but round-off would be left at the length of others
        const double own = table.name == std::string_view("verner_9_5_6") ? 0.2 : longest[table.order()];
        schemes.push_back({table.name, table.order(), own, [&table](double dt) {
                               Arkode::Options options;
                               options.table = table.name;
                               options.dt = dt;
                               options.rtol = 1e-12;  // of its Newton iterations
                               return std::make_unique<Arkode>(options);
                           }});
    }
    return schemes;
}

void PrintTo(const FixedScheme& scheme, std::ostream* out) { *out << scheme.name; }

class FixedStepOrder : public testing::TestWithParam<std::tuple<FixedScheme, OscillatorProblem>> {};

TEST_P(FixedStepOrder, ThreeHalvings_WholeState_IsTheSchemes) {
    const auto& [scheme, problem] = GetParam();
    const Oscillator system(problem.model());
    const State exact = runge_kutta(system, test::oscillator_end, test::oscillator_reference_step);
    const auto error = [&](double dt) {
        const Made integrator = scheme.make(dt);
        return test::distance(march_oscillator(system, *integrator), exact);
    };
    // STYLE: |p_obs - p| < 0.15 over three halvings, as far as errors can be told from what the reference and the
    // differentiated motion of supports leave. Order 8 has no room for that.
    const double tolerance = scheme.order < 8 ? 0.15 : 0.5, smallest = 50 * test::oscillator_floor;
    double dt = scheme.longest, before = error(dt);
    for (int halving = 0; halving < 3; ++halving) {
        dt /= 2;
        const double now = error(dt);
        if ((halving > 0 || made_to_be_precise(scheme.name)) && now < smallest) break;
        const double order = std::log2(before / now);
        EXPECT_GT(order, scheme.order - tolerance) << "dt = " << dt << ", error " << now;
        if (!made_to_be_precise(scheme.name)) {
            EXPECT_LT(order, scheme.order + tolerance) << "dt = " << dt << ", error " << now;
        }
        before = now;
    }
}

/// The march of march_oscillator() with a checkpoint at 1.2 s, which is taken up by another integrator.
State march_in_two(const Oscillator& system, const std::function<Made()>& make, bool resume) {
    Made integrator = make();
    State state = system.initial_state();
    March march;
    march.t_end = 1.2;
    march.next_stop = [](double t) { return t < 0.4 ? 0.4 : t < 1.2 ? 1.2 : test::oscillator_end; };
    march.run(system, *integrator, state, false);
    const IntegratorMemory memory = integrator->save();
    if (resume) {
        integrator = make();
        integrator->load(system, state, memory);
    } else {
        integrator->forget(system, state);
    }
    march.t_end = test::oscillator_end;
    march.run(system, *integrator, state, true);
    EXPECT_EQ(integrator->reactions(system, state).size(), system.constraints().size());
    return state;
}

TEST_P(FixedStepOrder, ResumedFromACheckpoint_HasTheBitsOfARunThatGoesOn) {
    const auto& [scheme, problem] = GetParam();
    const Oscillator system(problem.model());
    const auto make = [&, &scheme = scheme] { return scheme.make(scheme.longest); };
    EXPECT_EQ(march_in_two(system, make, true), march_in_two(system, make, false));
}

INSTANTIATE_TEST_SUITE_P(Schemes, FixedStepOrder,
                         testing::Combine(testing::ValuesIn(fixed_schemes()),
                                          testing::ValuesIn(test::oscillator_problems())),
                         [](const auto& instance) {
                             return std::get<0>(instance.param).name + "_" + std::get<1>(instance.param).name;
                         });

// ---- steps from an error estimate

struct AdaptiveScheme {
    std::string name;
    std::function<Made(double rtol)> make;
};
void PrintTo(const AdaptiveScheme& scheme, std::ostream* out) { *out << scheme.name; }

template <class Scheme>
Made sundials(typename Scheme::Options options, double rtol) {
    options.rtol = rtol;
    return std::make_unique<Scheme>(options);
}

const AdaptiveScheme adaptive_schemes[] = {
    {"GeneralizedAlpha",
     [](double rtol) {
         GeneralizedAlpha::Options options;
         options.rtol = rtol;
         return std::make_unique<GeneralizedAlpha>(options);
     }},
    {"Hht",
     [](double rtol) {
         GeneralizedAlpha::Options options;
         options.scheme = GeneralizedAlpha::Scheme::hht(0.2);
         options.rtol = rtol;
         return std::make_unique<GeneralizedAlpha>(options);
     }},
    {"CvodeBdf", [](double rtol) { return sundials<Cvode>({}, rtol); }},
    {"CvodeBdfOfOrderTwo",
     [](double rtol) {
         Cvode::Options options;
         options.max_order = 2;
         return sundials<Cvode>(options, rtol);
     }},
    {"CvodeAdams",
     [](double rtol) {
         Cvode::Options options;
         options.method = Cvode::Method::adams;
         options.iteration = Cvode::Iteration::functional;
         return sundials<Cvode>(options, rtol);
     }},
    {"CvodeAdamsNewton",
     [](double rtol) {
         Cvode::Options options;
         options.method = Cvode::Method::adams;
         return sundials<Cvode>(options, rtol);
     }},
    {"Ida", [](double rtol) { return sundials<Ida>({}, rtol); }},
    {"ArkodeExplicit", [](double rtol) { return sundials<Arkode>({}, rtol); }},
    {"ArkodeImplicit",
     [](double rtol) {
         Arkode::Options options;
         options.table = "sdirk_5_3_4";
         return sundials<Arkode>(options, rtol);
     }},
    {"ArkodeAdditive",
     [](double rtol) {
         Arkode::Options options;
         options.table = "ark436l2sa_6_3_4";
         return sundials<Arkode>(options, rtol);
     }},
};

class AdaptiveSteps : public testing::TestWithParam<std::tuple<AdaptiveScheme, OscillatorProblem>> {};

TEST_P(AdaptiveSteps, Error_FollowsTheTolerance) {
    const auto& [scheme, problem] = GetParam();
    const Oscillator system(problem.model());
    const State exact = runge_kutta(system, test::oscillator_end, test::oscillator_reference_step);
    std::vector<double> errors;
    for (const double rtol : {1e-4, 1e-6, 1e-8}) {
        const Made integrator = scheme.make(rtol);
        std::size_t n_steps = 0;
        errors.push_back(test::distance(test::march_oscillator(system, *integrator, &n_steps), exact));
        // local errors of rtol times the scales, of 0.1 to 5, that all add up
        EXPECT_LT(errors.back(), 10 * static_cast<double>(n_steps) * rtol) << n_steps << " steps";
    }
    // of a method of order p the error falls by rtol^(p/(p+1)): 460-fold for order 2, 10^4 for the highest
    EXPECT_GT(errors.front() / errors.back(), 200);
}

TEST_P(AdaptiveSteps, ResumedFromACheckpoint_HasTheBitsOfARunThatGoesOn) {
    const auto& [scheme, problem] = GetParam();
    const Oscillator system(problem.model());
    const auto make = [&] { return scheme.make(1e-6); };
    EXPECT_EQ(march_in_two(system, make, true), march_in_two(system, make, false));
}

INSTANTIATE_TEST_SUITE_P(Schemes, AdaptiveSteps,
                         testing::Combine(testing::ValuesIn(adaptive_schemes),
                                          testing::ValuesIn(test::oscillator_problems())),
                         [](const auto& instance) {
                             return std::get<0>(instance.param).name + "_" + std::get<1>(instance.param).name;
                         });

/// Fixed steps so short that even those of order 2 are as accurate as the others at their tolerance.
std::vector<AdaptiveScheme> fine_fixed_schemes() {
    std::vector<AdaptiveScheme> schemes;
    for (const FixedScheme& scheme : fixed_schemes())
        if (scheme.order > 1) schemes.push_back({scheme.name, [make = scheme.make](double) { return make(2.5e-4); }});
    return schemes;
}

class AnyIntegrator : public testing::TestWithParam<AdaptiveScheme> {};

TEST_P(AnyIntegrator, FailedStep_LeavesTheAcceptedState) {
    OscillatorModel model = test::two_nodes();
    model.prescribed = {test::moving(1, Constraint::Kind::displacement, -0.2)};
    Oscillator system(model);
    const Made integrator = GetParam().make(1e-6);
    State state = system.initial_state();
    integrator->start(system, state, StartReason::fresh);
    for (int step = 0; step < 5; ++step) integrator->advance(system, state, 2);
    const State accepted = state;
    system.fail_from_now_on();
    try {
        for (int step = 0; step < 5; ++step) integrator->advance(system, state, 2);
        FAIL() << "no step has failed";
    } catch (const RecoverableError& error) {
        EXPECT_NE(std::string(error.what()).find("told to fail"), std::string::npos) << error.what();
    }
    EXPECT_EQ(state, accepted);
}

TEST_P(AnyIntegrator, SupportsAndLoads_BalanceAgainstTheEnergy) {
    OscillatorModel model = test::two_nodes();
    model.load = test::smooth_load;
    model.damping.mass_proportional = 0.4;
    model.damping.blocks = {{0, 3.0, 1.2, 5.0}};
    model.prescribed = {test::moving(1, Constraint::Kind::displacement, -0.2),
                        test::moving(2, Constraint::Kind::velocity, 0.15)};
    const Oscillator system(model);
    const Made integrator = GetParam().make(1e-8);
    State state = system.initial_state();
    March march;
    march.t_end = test::oscillator_end;
    double before = 0;
    const auto energy = [&] { return integrator->kinetic_energy(system, state) + system.stored_energies(state).sum(); };
    march.after_start = [&] { before = energy(); };
    march.run(system, *integrator, state, false);
    const PathEnergies& path = state.path;
    const double supplied = path.external_work + path.support_work - path.damping - path.absorbing;
    EXPECT_GT(std::abs(path.support_work), 0.1);
    // of order 2 the error of the solution itself, 21-fold for a hundredth of the tolerance, is the largest
    EXPECT_NEAR(energy() - before, supplied, 2e-6 * (std::abs(path.external_work) + std::abs(path.support_work)));
}

TEST_P(AnyIntegrator, StartedAfresh_TakesTheSameSteps) {
    const Oscillator system(test::two_nodes());
    const Made integrator = GetParam().make(1e-6);
    State once = system.initial_state(), again = once;
    for (State* state : {&once, &again}) {
        integrator->start(system, *state, StartReason::fresh);
        for (int step = 0; step < 20; ++step) integrator->advance(system, *state, 2);
    }
    EXPECT_EQ(once, again);
}

INSTANTIATE_TEST_SUITE_P(FixedSteps, AnyIntegrator, testing::ValuesIn(fine_fixed_schemes()),
                         [](const auto& instance) { return instance.param.name; });
INSTANTIATE_TEST_SUITE_P(Schemes, AnyIntegrator, testing::ValuesIn(adaptive_schemes),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace gneiss
