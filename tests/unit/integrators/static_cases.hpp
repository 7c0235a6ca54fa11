#pragma once
// Small solids under loads that grow until t = 1, and how they get there: for tests of static integrators.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "integrators/load_stepping.hpp"
#include "support/small_solids.hpp"
#include "system/march.hpp"

namespace gneiss::test {

inline AmplitudeOptions ramp() {
    AmplitudeOptions amplitude;
    amplitude.kind = AmplitudeOptions::Kind::ramp;
    amplitude.end = 1;
    return amplitude;
}

inline BoundaryOptions held(const char* on, std::optional<Formula> x, std::optional<Formula> y) {
    BoundaryOptions boundary;
    boundary.on = on;
    boundary.value = {x, y};
    boundary.amplitude = ramp();
    return boundary;
}

inline LoadOptions loaded(LoadOptions::Kind kind, Formula x, Formula y) {
    LoadOptions load;
    load.kind = kind;
    load.on = "top";
    load.value = {x, y};
    load.amplitude = ramp();
    return load;
}

/// Fixed at the bottom, traction on top that grows until t = 1.
inline SolidDescription sheared(double traction) {
    SolidDescription what;
    what.boundaries = {held("bottom", 0, 0)};
    what.loads = {loaded(LoadOptions::Kind::traction, traction, -0.3 * traction)};
    return what;
}

/// A load that deforms a solid of a dozen elements by some hundredths.
struct FiniteLoad {
    bool compt;
    SolidDescription what;
};

/// Laws, stress maps, dead and follower loads.
inline std::vector<FiniteLoad> finite_loads() {
    struct Case {
        bool compt;
        Form form;
        StressMap map;
        LoadOptions::Kind load;
    };
    const auto traction = LoadOptions::Kind::traction, pressure = LoadOptions::Kind::pressure;
    std::vector<FiniteLoad> loads;
    for (const Case& c :
         {Case{false, Form::hyper, StressMap::conjugate, traction},
          Case{true, Form::hyper, StressMap::conjugate, traction}, Case{true, Form::hyper, StressMap::direct, traction},
          Case{true, Form::hypo, StressMap::conjugate, traction},
          Case{true, Form::hyper, StressMap::conjugate, pressure}}) {
        SolidDescription what = sheared(1e8);
        what.materials[0].form = c.form;
        what.materials[0].stress_map = c.map;
        if (c.load == pressure) what.loads = {loaded(pressure, 2e8, 0)};
        loads.push_back({c.compt, what});
    }
    return loads;
}

struct Solution {
    State state;
    std::size_t n_steps = 0, n_rejected = 0;
    std::vector<double> times;
};

inline Solution run(const SemiDiscrete& system, Integrator& integrator, double t_end = 1) {
    Solution result;
    result.state = system.initial_state();
    March march;
    march.t_end = t_end;
    march.after_step = [&](const StepReport& step) {
        ++result.n_steps;
        result.n_rejected += step.n_rejected;
        result.times.push_back(step.t);
        return true;
    };
    march.run(system, integrator, result.state, false);
    return result;
}

inline std::vector<bool> is_fixed(const SemiDiscrete& system) {
    std::vector<bool> fixed(system.layout().n_dof, false);
    for (const Constraint& constraint : system.constraints()) fixed[constraint.dof] = true;
    return fixed;
}

/// Largest force on a free degree of freedom over the largest of all, evaluated anew at the state.
inline double out_of_balance(const SemiDiscrete& system, const State& state) {
    std::vector<double> f(state.u.size());
    system.force(state, Trial::of(state), f);
    const std::vector<bool> fixed = is_fixed(system);
    double largest = 0, free = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        largest = std::max(largest, std::abs(f[i]));
        if (!fixed[i]) free = std::max(free, std::abs(f[i]));
    }
    return free / largest;
}

/// After a quarter of a run another integrator takes up what the first one saves; both come to the end alike.
inline void expect_other_goes_on_with_the_same_bits(const SemiDiscrete& system, Integrator& integrator,
                                                    Integrator& other) {
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    integrator.advance(system, state, 0.25);
    State other_state = state;
    other.load(system, other_state, integrator.save());
    while (state.t < 1) {
        integrator.advance(system, state, 1);
        other.advance(system, other_state, 1);
        ASSERT_EQ(state, other_state);
    }
    EXPECT_EQ(integrator.save(), other.save());
}

/// An integrator with these options, and its own defaults for what no other has.
template <class I>
I with_options(const LoadStepping::Options& common) {
    typename I::Options options;
    static_cast<LoadStepping::Options&>(options) = common;
    return I(options);
}

}  // namespace gneiss::test
