// Whole runs: the energy balance, the number of threads, save and load.

#include <gtest/gtest.h>
#include <omp.h>

#include "support/one_thread.hpp"
#include "verification/everything.hpp"
#include "verification/run_solid.hpp"

namespace gneiss {
namespace {

constexpr double run_end = 2e-3;

TEST(WholeRun, EnergyBalance_EverythingActs_ClosesWithOrderTwo) {
    for (const bool compt : {false, true}) {
        for (const Form form : {Form::hyper, Form::hypo}) {
            const test::Solid solid = test::make_solid(test::rectangle(compt, 2, 2, {8, 8}), test::everything(form));
            const double coarse = test::run_solid(*solid.system, run_end, {.safety = 0.4}).ledger.balance_error();
            const test::SolidRun run = test::run_solid(*solid.system, run_end, {.safety = 0.2});
            EXPECT_LT(run.ledger.balance_error(), 1e-3) << compt;  // 150 steps from a jump of the pressure to the end
            EXPECT_LT(run.ledger.balance_error(), coarse / 3) << compt;
            // and every column has something to say
            const PathEnergies& path = run.ledger.path;
            for (const double entry : {path.external_work, std::abs(path.support_work), path.damping, path.viscous,
                                       path.absorbing, run.ledger.stored.sum(), run.ledger.kinetic})
                EXPECT_GT(entry, 1e-3 * path.external_work) << compt;
        }
    }
}

TEST(WholeRun, Threads_OneTwoAndThree_GiveTheSameBits) {
    std::vector<State> ends;
    for (const int threads : {1, 2, 3}) {
        omp_set_num_threads(threads);
        const test::Solid solid = test::make_solid(test::rectangle(true, 2, 2, {24, 24}), test::everything(Form::hypo));
        ends.push_back(test::run_solid(*solid.system, 3e-4).state);
    }
    omp_set_num_threads(1);
    EXPECT_GT(ends[0].path.external_work, 0);
    EXPECT_EQ(ends[1], ends[0]);
    EXPECT_EQ(ends[2], ends[0]);
}

TEST(WholeRun, SavedHalfwayAndLoaded_End_HasTheSameBits) {
    for (const Form form : {Form::hyper, Form::hypo}) {
        const test::Solid solid = test::make_solid(test::rectangle(true, 2, 2, {5, 5}), test::everything(form));
        State state = solid.system->initial_state(), saved;
        IntegratorMemory memory;
        CentralDifference integrator({});
        March march;
        march.t_end = run_end;
        march.after_step = [&](const StepReport& step) {
            if (memory.empty() && step.t > 0.4 * run_end) {
                saved = state;
                memory = integrator.save();
            }
            return true;
        };
        march.run(*solid.system, integrator, state, false);

        const test::Solid again = test::make_solid(test::rectangle(true, 2, 2, {5, 5}), test::everything(form));
        CentralDifference other({});
        other.load(*again.system, saved, memory);
        march.after_step = {};
        march.run(*again.system, other, saved, true);
        EXPECT_EQ(saved, state);
        EXPECT_EQ(other.save(), integrator.save());
    }
}

}  // namespace
}  // namespace gneiss
