// Local steps of central difference: what they converge to, what they conserve, what they save, and what they refuse.

#include "integrators/local_steps.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <omp.h>

#include <cmath>
#include <random>

#include "base/errors.hpp"
#include "integrators/arkode.hpp"
#include "integrators/central_difference.hpp"
#include "support/one_thread.hpp"
#include "support/small_solids.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;

constexpr int most_levels_allowed = LocalSteps::most_levels;

/// Waves in 24 columns of cells that grow from 0.05 to 0.8 m.
test::Solid graded_solid(bool compt, double amplitude = 1, int rows = 0) {
    if (rows == 0) rows = compt ? 12 : 3;  // packs enough for levels
    test::SolidDescription what;
    what.initial.emplace_back();
    what.initial[0].velocity = {Formula(fmt::format("{}*sin(2*x)", amplitude)),
                                Formula(fmt::format("{}*cos(x + y)", amplitude))};
    return test::make_solid(test::graded(compt, {24, rows}, 0.05, 1.128, 0.8 * rows), what);
}

State march_to(const SemiDiscrete& system, Integrator& integrator, double t_end) {
    State state = system.initial_state();
    March march;
    march.t_end = t_end;
    march.run(system, integrator, state, false);
    return state;
}

double l2_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

TEST(LocalSteps, HalvedSteps_ConvergeWithOrderTwo) {
    constexpr double t_end = 4e-4;  // waves cross the small elements and more
    for (const bool compt : {false, true}) {
        const test::Solid solid = graded_solid(compt);
        Arkode::Options tight;
        tight.table = "fehlberg_13_7_8";
        tight.rtol = 1e-11;
        Arkode reference(tight);
        const State exact = march_to(*solid.system, reference, t_end);
        double before = 0;
        for (const double dt : {8e-6, 4e-6, 2e-6}) {
            CentralDifference local({.dt = dt}, most_levels_allowed);
            const State end = march_to(*solid.system, local, t_end);
            const double omega = 1 / (0.5 * t_end);  // weighs velocities like displacements
            const double now = std::hypot(l2_difference(end.u, exact.u), l2_difference(end.v, exact.v) / omega);
            if (before > 0) {
                EXPECT_NEAR(std::log2(before / now), 2, 0.15) << "dt = " << dt << ", compt " << compt;
            }
            before = now;
        }
    }
}

TEST(LocalSteps, NoiseAtTheLimit_DoesNotGrow) {
    for (const bool compt : {false, true}) {
        const test::Solid solid = graded_solid(compt);
        CentralDifference local({.safety = 1}, most_levels_allowed);
        State state = solid.system->initial_state();
        std::mt19937 random(5);
        std::uniform_real_distribution<double> uniform(-1e-4, 1e-4);  // m/s: the solid stays linear
        for (double& v : state.v) v = uniform(random);
        local.start(*solid.system, state, StartReason::fresh);
        const auto largest_energy = [&](int n_steps) {
            double largest = 0;
            for (int step = 0; step < n_steps; ++step) {
                local.advance(*solid.system, state, 1e9);
                largest = std::max(
                    largest, local.kinetic_energy(*solid.system, state) + solid.system->stored_energies(state).sum());
            }
            return largest;
        };
        const double first = largest_energy(1500);
        // growth of 1e-4 in a step would make it 1.35 times as large
        EXPECT_LT(largest_energy(1500), 1.05 * first) << compt;
    }
}

TEST(LocalSteps, FreeSolid_KeepsItsMomentum) {
    const test::Solid solid = graded_solid(true);
    const auto momentum = [&](const State& state, std::size_t component) {
        double sum = 0;
        for (std::size_t i = component; i < state.v.size(); i += 2) sum += solid.system->lumped_mass()[i] * state.v[i];
        return sum;
    };
    CentralDifference local({}, most_levels_allowed);
    const State start = solid.system->initial_state(), end = march_to(*solid.system, local, 5e-3);
    double mass = 0;
    for (std::size_t i = 0; i < start.v.size(); i += 2) mass += solid.system->lumped_mass()[i];
    for (const std::size_t component : {0u, 1u})
        EXPECT_NEAR(momentum(end, component), momentum(start, component), 1e-11 * mass);  // round-off at 1 m/s
}

TEST(LocalSteps, UnseenSteps_HaveTheBitsOfSeenOnes) {
    const test::Solid solid = graded_solid(false);
    CentralDifference one({}, most_levels_allowed), other({}, most_levels_allowed);
    State seen = solid.system->initial_state(), unseen = seen;
    one.start(*solid.system, seen, StartReason::fresh);
    other.start(*solid.system, unseen, StartReason::fresh);
    std::size_t n_steps = 0;
    while (n_steps < 100) n_steps += other.advance_unseen(*solid.system, unseen, 1, 1).n_steps;
    for (std::size_t step = 0; step < n_steps; ++step) one.advance(*solid.system, seen, 1);
    EXPECT_EQ(seen, unseen);
}

TEST(LocalSteps, ResumedFromACheckpoint_HasTheBitsOfARunThatGoesOn) {
    const test::Solid solid = graded_solid(true);
    CentralDifference whole({}, most_levels_allowed);
    State state = solid.system->initial_state();
    whole.start(*solid.system, state, StartReason::fresh);
    for (int step = 0; step < 20; ++step) whole.advance(*solid.system, state, 1);
    State resumed_state = state;
    CentralDifference resumed({}, most_levels_allowed);
    resumed.load(*solid.system, resumed_state, whole.save());
    for (int step = 0; step < 80; ++step) {  // over a look at the bound
        whole.advance(*solid.system, state, 1);
        resumed.advance(*solid.system, resumed_state, 1);
    }
    EXPECT_EQ(state, resumed_state);
}

TEST(LocalSteps, Threads_GiveTheSameBits) {
    std::vector<State> ends;
    for (const int threads : {1, 2, 3}) {
        omp_set_num_threads(threads);
        const test::Solid solid = graded_solid(false, 1, 20);  // several chunks of a level
        CentralDifference local({}, most_levels_allowed);
        ends.push_back(march_to(*solid.system, local, 1e-3));
    }
    omp_set_num_threads(1);
    EXPECT_EQ(ends[1], ends[0]);
    EXPECT_EQ(ends[2], ends[0]);
}

TEST(LocalSteps, Work_IsThatOfEachLevelsOwnSteps) {
    const test::Solid solid = graded_solid(true);
    const auto levels = solid.system->levels(most_levels_allowed);
    ASSERT_NE(levels, nullptr);
    std::size_t in_a_step = 0;
    for (int k = 1; k <= levels->finest(); ++k) in_a_step += levels->n_elements(k) << k;
    CentralDifference local({}, most_levels_allowed), plain({});
    State state = solid.system->initial_state();
    local.start(*solid.system, state, StartReason::fresh);
    for (int step = 0; step < 10; ++step) local.advance(*solid.system, state, 1);
    EXPECT_EQ(local.work().elements, 11 * in_a_step);  // the start evaluates them as well
    State other = solid.system->initial_state();
    plain.start(*solid.system, other, StartReason::fresh);
    const double ratio = local.critical_time_step() / plain.critical_time_step();
    EXPECT_NEAR(ratio, 0.9 * std::ldexp(1.0, levels->finest()), 1e-6 * ratio);  // the limit is 1.8 instead of 2
}

TEST(LocalSteps, ElementsOfOneSize_HaveTheBitsOfOneStepForAll) {
    const test::Solid solid = test::make_solid(test::rectangle(true, 1, 1, {4, 4}), {});
    EXPECT_EQ(solid.system->levels(most_levels_allowed), nullptr);
    CentralDifference local({}, most_levels_allowed), plain({});
    EXPECT_EQ(march_to(*solid.system, local, 1e-3), march_to(*solid.system, plain, 1e-3));
    EXPECT_EQ(local.work().elements, 0u);
}

TEST(LocalSteps, Options_AreRefusedWithTheirReason) {
    const auto refusal = [](const StableStep::Options& options, int levels) -> std::string {
        try {
            CentralDifference local(options, levels);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal({}, most_levels_allowed), "");
    for (const int levels : {0, -1, most_levels_allowed + 1})
        EXPECT_THAT(refusal({}, levels), HasSubstr("integrator.levels: given")) << levels;
    EXPECT_THAT(refusal({.lanczos = true}, 2), HasSubstr("integrator.bound: "));
    EXPECT_EQ(refusal({.lanczos = true}, 1), "");
}

}  // namespace
}  // namespace gneiss
