// The explicit loop with forces that remember.

#include <gtest/gtest.h>

#include "integrators/central_difference.hpp"
#include "support/one_thread.hpp"
#include "support/sliders.hpp"

namespace gneiss {
namespace {

TEST(CentralDifference, HistoryWithoutInternalVariables_IsKept) {
    // halves that are sheared on each other: what friction takes is missing from the energy, and nothing else
    test::SolidDescription what;
    InitialOptions initial;
    initial.velocity = {Formula("40*y - 20"), Formula(0)};
    what.initial = {initial};
    const test::Solid solid = test::cut_solid(true, 1e6, what);
    CentralDifference integrator({.safety = 0.1});
    State state = solid.system->initial_state();
    ASSERT_TRUE(state.z.empty());
    integrator.start(*solid.system, state, StartReason::fresh);
    const auto energy = [&] {
        return integrator.kinetic_energy(*solid.system, state) + solid.system->stored_energies(state).sum();
    };
    const double before = energy();
    while (state.t < 2e-3) integrator.advance(*solid.system, state, 2e-3);
    EXPECT_GT(state.path.friction, 0.1 * before);
    // steps of a tenth of the critical one: (omega dt/2)^2 of what vibrates, and kinks of the sliders
    EXPECT_NEAR(energy() + state.path.friction, before, 2e-3 * before);
}

}  // namespace
}  // namespace gneiss
