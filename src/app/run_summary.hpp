#pragma once
// What summary.json says of a run.

#include <string>
#include <vector>

#include "app/build_case.hpp"
#include "io/output/summary.hpp"
#include "model/energy_ledger.hpp"

namespace gneiss {

/// Where a run stands.
struct RunNumbers {
    const State& state;                       ///< last accepted
    double last_dt = 0;                       ///< s
    std::size_t step = 0, first_step = 0;     ///< of the whole run; the first of this part of it, after a restart
    std::size_t n_rejected = 0, n_force = 0;  ///< trials thrown away, force evaluations of the scheme, of this part
    std::size_t n_force_searching = 0;        ///< those of steps that a search for an event has thrown away
    double setup_time = 0, wall_time = 0;     ///< s
    EnergyLedger energies;
    double largest_balance_error = 0;
};

/// @param deck  path of the deck; @param set  overrides laid over it
RunSummary summarise(const Case& built, const std::string& deck, const std::vector<std::string>& set,
                     const RunNumbers& now);

}  // namespace gneiss
