#pragma once
// Equilibria of a solid under loads that grow from t = 0.

#include <algorithm>
#include <vector>

#include "integrators/quasi_static.hpp"
#include "support/small_solids.hpp"
#include "system/march.hpp"

namespace gneiss::test {

/// The equilibria at the given times.
/// @param times  ascending, s
inline std::vector<State> equilibria(const SolidSystem& system, const std::vector<double>& times,
                                     const QuasiStatic::Options& options = {}) {
    QuasiStatic integrator(options);
    State state = system.initial_state();
    std::vector<State> states;
    March march;
    march.t_end = times.back();
    march.next_stop = [&](double) { return times[std::min(states.size(), times.size() - 1)]; };
    march.after_step = [&](const StepReport& step) {
        if (reached(step.t, times[states.size()])) states.push_back(state);
        return true;
    };
    march.run(system, integrator, state, false);
    return states;
}

/// A load or a prescribed motion that is there in full at t = 1.
inline AmplitudeOptions ramp_to_one() {
    AmplitudeOptions ramp;
    ramp.kind = AmplitudeOptions::Kind::ramp;
    ramp.end = 1;
    return ramp;
}

/// The displacement of the node at a place. @throws std::runtime_error if there is none
inline std::array<double, 2> displacement_at(const Mesh& mesh, const State& state, const std::array<double, 2>& place) {
    constexpr double near = 1e-9;  // m, of tens of metres
    for (std::size_t node = 0; node < mesh.n_nodes(); ++node)
        if (std::hypot(mesh.nodes[node][0] - place[0], mesh.nodes[node][1] - place[1]) < near)
            return {state.u[2 * node], state.u[2 * node + 1]};
    throw std::runtime_error("no node there");
}

}  // namespace gneiss::test
