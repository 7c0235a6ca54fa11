#pragma once
// One run of a solid, with its ledger.

#include <functional>

#include "integrators/central_difference.hpp"
#include "model/energy_ledger.hpp"
#include "support/small_solids.hpp"
#include "system/march.hpp"

namespace gneiss::test {

struct SolidRun {
    State state;
    EnergyLedger ledger;
    std::size_t n_steps = 0;
};

/// @param after_step  called with the state after every step, if given
inline SolidRun run_solid(const SolidSystem& system, double t_end, Integrator& integrator,
                          const std::function<void(const State& state)>& after_step = {}) {
    SolidRun run;
    run.state = system.initial_state();
    March march;
    march.t_end = t_end;
    march.after_start = [&] {
        run.ledger.initial = integrator.kinetic_energy(system, run.state) + system.stored_energies(run.state).sum();
    };
    march.after_step = [&](const StepReport&) {
        ++run.n_steps;
        if (after_step) after_step(run.state);
        return true;
    };
    march.run(system, integrator, run.state, false);
    run.ledger.kinetic = integrator.kinetic_energy(system, run.state);
    run.ledger.stored = system.stored_energies(run.state);
    run.ledger.path = run.state.path;
    return run;
}

/// Under central difference.
inline SolidRun run_solid(const SolidSystem& system, double t_end, const CentralDifference::Options& options = {},
                          const std::function<void(const State& state)>& after_step = {}) {
    CentralDifference integrator(options);
    return run_solid(system, t_end, integrator, after_step);
}

}  // namespace gneiss::test
