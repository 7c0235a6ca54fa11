#pragma once
// What a checkpoint of a run holds, and how a run goes on from one.

#include <filesystem>

#include "app/balance_watch.hpp"
#include "app/build_case.hpp"

namespace gneiss {

/// Where a run is, beside the state of its system.
struct RunProgress {
    std::size_t step = 0;
    double initial_energy = 0;  ///< J
    BalanceRecord balance = {};
};

/// The same mesh in the same numbering, cut into the same blocks of the same packs: what z and history are ordered by.
std::string layout_fingerprint(const Mesh& mesh, const SolidSystem& system);

void save_checkpoint(const std::filesystem::path& path, const std::string& deck_fingerprint, const Case& built,
                     const State& state, const RunProgress& progress);

/// Puts state, integrator and progress where they were.
/// @return fingerprint of the deck that the checkpoint was written under
/// @throws InputError if the file is no checkpoint, or of another mesh, system or integrator
std::string load_checkpoint(const std::filesystem::path& path, const Case& built, State& state, RunProgress& progress);

}  // namespace gneiss
