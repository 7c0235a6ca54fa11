// Equilibria of small solids against dense solutions, closed forms, and the forces themselves.

#include "integrators/quasi_static.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "support/one_thread.hpp"
#include "support/oscillator.hpp"
#include "support/small_solids.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;

AmplitudeOptions ramp() {
    AmplitudeOptions amplitude;
    amplitude.kind = AmplitudeOptions::Kind::ramp;
    amplitude.end = 1;
    return amplitude;
}

BoundaryOptions held(const char* on, std::optional<Formula> x, std::optional<Formula> y) {
    BoundaryOptions boundary;
    boundary.on = on;
    boundary.value = {x, y};
    boundary.amplitude = ramp();
    return boundary;
}

LoadOptions loaded(LoadOptions::Kind kind, Formula x, Formula y) {
    LoadOptions load;
    load.kind = kind;
    load.on = "top";
    load.value = {x, y};
    load.amplitude = ramp();
    return load;
}

/// Fixed at the bottom, traction on top that grows until t = 1.
test::SolidDescription sheared(double traction) {
    test::SolidDescription what;
    what.boundaries = {held("bottom", 0, 0)};
    what.loads = {loaded(LoadOptions::Kind::traction, traction, -0.3 * traction)};
    return what;
}

struct Solution {
    State state;
    std::size_t n_steps = 0, n_rejected = 0;
    std::vector<double> times;
};

Solution run(const SemiDiscrete& system, QuasiStatic& integrator, double t_end = 1) {
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

std::vector<bool> is_fixed(const SemiDiscrete& system) {
    std::vector<bool> fixed(system.layout().n_dof, false);
    for (const Constraint& constraint : system.constraints()) fixed[constraint.dof] = true;
    return fixed;
}

/// Largest force on a free degree of freedom over the largest of all, evaluated anew at the state.
double out_of_balance(const SemiDiscrete& system, const State& state) {
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

TEST(QuasiStatic, SmallLoad_IsTheDenseLinearSolution) {
    for (const bool compt : {false, true}) {
        const test::Solid solid = test::distorted_solid(compt, sheared(1e3));
        QuasiStatic integrator({});
        const Solution found = run(*solid.system, integrator);
        // K u = p by dense differences at rest
        const State rest = solid.system->initial_state();
        Eigen::MatrixXd stiffness = test::dense_stiffness(*solid.system, rest);
        Trial full = Trial::of(rest);
        full.t = 1;
        full.last_event = 0;
        std::vector<double> p(rest.u.size());
        solid.system->force(rest, full, p);
        const std::vector<bool> fixed = is_fixed(*solid.system);
        for (Eigen::Index i = 0; i < stiffness.rows(); ++i) {
            if (!fixed[static_cast<std::size_t>(i)]) continue;
            stiffness.row(i).setZero();
            stiffness(i, i) = 1;
            p[static_cast<std::size_t>(i)] = 0;
        }
        const Eigen::VectorXd u =
            stiffness.partialPivLu().solve(Eigen::Map<Eigen::VectorXd>(p.data(), stiffness.rows()));
        // strains of 1e-6: nonlinear terms, and the differences' own error, times the condition of a few thousand
        const double scale = u.cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < u.size(); ++i)
            EXPECT_NEAR(found.state.u[static_cast<std::size_t>(i)], u[i], 2e-5 * scale);
        EXPECT_EQ(found.n_steps, 1u);
        EXPECT_EQ(found.state.v, rest.v);
    }
}

TEST(QuasiStatic, FiniteLoad_EveryLawAndLoad_IsInEquilibrium) {
    struct Case {
        bool compt;
        Form form;
        StressMap map;
        LoadOptions::Kind load;
    };
    const auto traction = LoadOptions::Kind::traction, pressure = LoadOptions::Kind::pressure;
    for (const Case& c :
         {Case{false, Form::hyper, StressMap::conjugate, traction},
          Case{true, Form::hyper, StressMap::conjugate, traction}, Case{true, Form::hyper, StressMap::direct, traction},
          Case{true, Form::hypo, StressMap::conjugate, traction},
          Case{true, Form::hyper, StressMap::conjugate, pressure}}) {
        test::SolidDescription what = sheared(1e8);
        what.materials[0].form = c.form;
        what.materials[0].stress_map = c.map;
        if (c.load == pressure) what.loads = {loaded(pressure, 2e8, 0)};
        const test::Solid solid = test::distorted_solid(c.compt, what);
        QuasiStatic integrator({.tolerance = 1e-10, .step = 0.25});
        const Solution found = run(*solid.system, integrator);
        EXPECT_LE(out_of_balance(*solid.system, found.state), 1e-9);
        const auto [lowest, highest] = std::ranges::minmax(found.state.u);
        EXPECT_GT(highest - lowest, 0.02) << "a finite deformation";
        EXPECT_LE(integrator.counts().iterations, 5 * found.n_steps) << "quadratic convergence";
    }
}

TEST(QuasiStatic, Reactions_BalanceTheLoad) {
    const test::Solid solid = test::distorted_solid(true, sheared(1e8));
    QuasiStatic integrator({.step = 0.5});
    const Solution found = run(*solid.system, integrator);
    double x = 0, y = 0;
    for (std::size_t k = 0; k < integrator.reactions().size(); ++k)
        (solid.system->constraints()[k].dof % 2 == 0 ? x : y) += integrator.reactions()[k];
    // traction times the width of 2 m, thickness 1 m; out of balance by 1e-9 at some dozen nodes
    EXPECT_NEAR(x, -2e8, 1e-7 * 2e8);
    EXPECT_NEAR(y, 0.6e8, 1e-7 * 2e8);
}

TEST(QuasiStatic, PrescribedStretch_IsUniformAndStoresItsWork) {
    // sides on rollers, pulled by 10 %: H = diag(0.1, h_yy) with no stress across, the same everywhere
    test::SolidDescription what;
    what.materials[0] = test::rock(0);
    what.boundaries = {held("left", 0, {}), held("bottom", {}, 0), held("right", 0.2, {})};
    const test::Solid solid = test::distorted_solid(true, what);
    QuasiStatic integrator({.tolerance = 1e-10, .longest = 0.02});
    const Solution found = run(*solid.system, integrator);
    EXPECT_EQ(found.state.t, 1);
    const auto fields = solid.system->point_fields(found.state);
    for (const PointFields& point : fields) {
        EXPECT_NEAR(point.cauchy[0], fields[0].cauchy[0], 1e-8 * std::abs(fields[0].cauchy[0]));
        EXPECT_NEAR(point.cauchy[1], 0, 1e-8 * std::abs(fields[0].cauchy[0]));
    }
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node)
        EXPECT_NEAR(found.state.u[2 * node], 0.1 * solid.mesh.nodes[node][0], 1e-9);
    // the trapezoidal rule over fifty steps of a force that bends by 10 %: 0.1/50^2 of the work at most
    const double stored = solid.system->stored_energies(found.state).sum();
    EXPECT_EQ(found.n_steps, 50u);
    EXPECT_NEAR(found.state.path.support_work, stored, 4e-5 * stored);
    EXPECT_GT(stored, 1e5);
}

TEST(QuasiStatic, EverythingPrescribed_FollowsTheMotion) {
    Mesh mesh = test::rectangle(false, 1, 1, {1, 1});
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(mesh.n_nodes()); ++node)
        mesh.node_sets["all"].push_back(node);
    test::SolidDescription what;
    what.boundaries = {held("all", Formula("0.1*x"), Formula("-0.05*y*y"))};
    const test::Solid solid = test::make_solid(std::move(mesh), what);
    QuasiStatic integrator({});
    const Solution found = run(*solid.system, integrator);
    ASSERT_EQ(integrator.reactions().size(), found.state.u.size());
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        const auto& [x, y] = solid.mesh.nodes[node];
        EXPECT_DOUBLE_EQ(found.state.u[2 * node], 0.1 * x);
        EXPECT_DOUBLE_EQ(found.state.u[2 * node + 1], -0.05 * y * y);
    }
}

TEST(QuasiStatic, LoadInOneStepOrMany_SameEquilibrium) {
    const test::Solid solid = test::distorted_solid(true, sheared(1e8));
    QuasiStatic one({.tolerance = 1e-11}), many({.tolerance = 1e-11, .step = 0.05});
    const Solution coarse = run(*solid.system, one), fine = run(*solid.system, many);
    EXPECT_LT(coarse.n_steps, fine.n_steps);
    for (std::size_t i = 0; i < coarse.state.u.size(); ++i)
        EXPECT_NEAR(coarse.state.u[i], fine.state.u[i], 1e-9 * solid.system->smallest_length());
}

TEST(QuasiStatic, TooLongAStep_IsCutAndGrowsAgain) {
    // squeezed by 0.38 at once: elements turn inside out in the first iterate
    test::SolidDescription what;
    what.boundaries = {held("bottom", 0, 0), held("top", 0, -0.38)};
    const test::Solid solid = test::distorted_solid(true, what);
    QuasiStatic integrator({.most_iterations = 5});
    const Solution found = run(*solid.system, integrator);
    EXPECT_GT(found.n_rejected, 0u);
    EXPECT_LE(out_of_balance(*solid.system, found.state), 1e-8);
    EXPECT_EQ(found.times.back(), 1);
    EXPECT_TRUE(std::ranges::is_sorted(found.times));
}

TEST(QuasiStatic, WithoutSupports_IsSingularAndMovesNothing) {
    test::SolidDescription what = sheared(1e6);
    what.boundaries.clear();
    const test::Solid solid = test::distorted_solid(true, what);
    QuasiStatic integrator({});
    State state = solid.system->initial_state();
    integrator.start(*solid.system, state, StartReason::fresh);
    const State before = state;
    try {
        integrator.advance(*solid.system, state, 1);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no equilibrium found after load time t = 0 s"));
        EXPECT_THAT(error.what(), HasSubstr("singular"));
    }
    EXPECT_EQ(state, before);
}

TEST(QuasiStatic, SavedAndLoaded_GoesOnWithTheSameBits) {
    test::SolidDescription what = sheared(1e8);
    what.materials[0].form = Form::hypo;
    const test::Solid solid = test::distorted_solid(true, what);
    QuasiStatic integrator({.step = 0.125}), other({.step = 0.125});
    State state = solid.system->initial_state();
    integrator.start(*solid.system, state, StartReason::fresh);
    integrator.advance(*solid.system, state, 0.25);
    State other_state = state;
    other.load(*solid.system, other_state, integrator.save());
    while (state.t < 1) {
        integrator.advance(*solid.system, state, 1);
        other.advance(*solid.system, other_state, 1);
        ASSERT_EQ(state, other_state);
    }
    EXPECT_EQ(integrator.save(), other.save());
}

TEST(QuasiStatic, SystemWithoutTangent_IsRefused) {
    test::OscillatorModel model;
    model.mass = test::Vector{{1, 1}};
    model.stiffness = test::Matrix::Identity(2, 2);
    model.has_tangent = false;
    const test::Oscillator system(model);
    QuasiStatic integrator({});
    State state = system.initial_state();
    EXPECT_THROW(integrator.start(system, state, StartReason::fresh), InputError);
}

TEST(QuasiStatic, Options_AllProblemsAtOnce) {
    try {
        QuasiStatic integrator({.tolerance = 0, .step = -1, .longest = -1, .shortest = 1, .most_iterations = 0});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.problems().size(), 5u);
        EXPECT_THAT(error.what(), HasSubstr("integrator.tolerance"));
        EXPECT_THAT(error.what(), HasSubstr("must be in (0, 0.01]"));
    }
}

}  // namespace
}  // namespace gneiss
