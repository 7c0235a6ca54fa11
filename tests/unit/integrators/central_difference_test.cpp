#include "integrators/central_difference.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "support/eps.hpp"
#include "support/one_thread.hpp"
#include "support/oscillator.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

using test::eps;
using test::Matrix;
using test::Oscillator;
using test::OscillatorModel;
using test::Vector;
using testing::ElementsAre;
using testing::HasSubstr;

/// A chain of two nodes; mass 1 kg everywhere, largest frequency about 12 rad/s.
OscillatorModel chain() {
    OscillatorModel model;
    model.mass = Vector{{1, 1, 1, 1}};
    model.stiffness = Matrix{{90, 10, -50, 0}, {10, 60, 0, -30}, {-50, 0, 50, 5}, {0, -30, 5, 40}};
    model.initial_v = Vector{{1, -0.5, 0.3, 0.7}};
    return model;
}

OscillatorModel single(double omega, double rate) {
    OscillatorModel model;
    model.mass = Vector{{2, 2}};
    model.stiffness = 2 * omega * omega * Matrix::Identity(2, 2);
    if (rate > 0) model.viscosity = 2 * rate * Matrix::Identity(2, 2);
    model.initial_u = Vector{{1, -0.3}};
    return model;
}

void advance(const SemiDiscrete& system, CentralDifference& integrator, State& state, int n, double dt) {
    for (int i = 0; i < n; ++i) integrator.advance(system, state, state.t + dt);
}

double size(const State& state) {
    return std::max(Oscillator::vector(state.u).cwiseAbs().maxCoeff(),
                    Oscillator::vector(state.v).cwiseAbs().maxCoeff());
}

// ---- stability
// --------------------------------------------------------------------------------------------------------

/// Largest |eigenvalue| of one step (u, v(n-1/2), a) -> next for x'' = -omega^2 x - c x', the damping force taken at
/// v(n-1/2) + dt/2 a(n-1).
double spectral_radius(double omega, double c, double dt) {
    Matrix step(3, 3);
    step.row(2) << -omega * omega, -c, -0.5 * c * dt;
    step.row(1) = Eigen::RowVector3d(0, 1, 0) + dt * step.row(2);
    step.row(0) = Eigen::RowVector3d(1, 0, 0) + dt * step.row(1);
    return Eigen::EigenSolver<Matrix>(step).eigenvalues().cwiseAbs().maxCoeff();
}

TEST(CentralDifferenceStability, CriticalStep_AnyFrequencyAndDamping_IsWhereTheRecursionBeginsToGrow) {
    constexpr double round_off = 1e-7;  // a double eigenvalue on the unit circle is known to sqrt(eps)
    for (const double omega : {0.0, 0.01, 0.3, 1.0, 5.0, 70.0}) {
        for (const double c : {0.0, 0.002, 0.1, 1.0, 8.0, 300.0}) {
            if (omega == 0 && c == 0) continue;
            const double critical = StabilityLimit{}.critical_time_step({omega, c});
            EXPECT_NEAR(critical * critical * omega * omega + 4 * critical * c, 4, 64 * eps);
            EXPECT_GT(spectral_radius(omega, c, 1.001 * critical), 1 + 1e-5) << omega << " " << c;
            for (const double part : {0.05, 0.3, 0.7, 0.999})
                EXPECT_LE(spectral_radius(omega, c, part * critical), 1 + round_off)
                    << omega << " " << c << " " << part;
        }
    }
}

struct Limit {
    double omega, rate;
};
class AtTheLimit : public testing::TestWithParam<Limit> {};

TEST_P(AtTheLimit, JustBelowTheCriticalStep_ManySteps_StaysBounded) {
    const Oscillator system(single(GetParam().omega, GetParam().rate));
    CentralDifference integrator({.safety = 0.999});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    advance(system, integrator, state, 20000, 0.999 * integrator.critical_time_step());
    // just below the limit the amplitude may be larger than at the start, by about (1 - 0.999^2)^-1/2
    EXPECT_LT(size(state), 30 * (1 + GetParam().omega));
}

TEST_P(AtTheLimit, JustAboveTheCriticalStep_ManySteps_Grows) {
    OscillatorModel model = single(GetParam().omega, GetParam().rate);
    const double critical = StabilityLimit{}.critical_time_step({GetParam().omega, GetParam().rate});
    model.bound = {0.5 * GetParam().omega, 0.5 * GetParam().rate};  // a bound that lies
    const Oscillator system(model);
    CentralDifference integrator({.safety = 1, .dt = 1.001 * critical});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    for (int block = 0; block < 200 && size(state) < 1e6; ++block)
        advance(system, integrator, state, 100, 1.001 * critical);
    EXPECT_GT(size(state), 1e6);
}

INSTANTIATE_TEST_SUITE_P(UndampedAndViscous, AtTheLimit,
                         testing::Values(Limit{3, 0}, Limit{3, 0.4}, Limit{3, 2}, Limit{0.1, 5}));

TEST(CentralDifferenceStability, MassDampingAndAbsorbingBlocks_CriticalStepOfTheUndampedSystem_StaysBounded) {
    OscillatorModel model = chain();
    model.damping.mass_proportional = 7;
    model.damping.blocks = {{0, 40, 15, 90}};
    const Oscillator system(model);
    CentralDifference integrator({.safety = 0.999});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    advance(system, integrator, state, 5000, 0.999 * integrator.critical_time_step());
    EXPECT_LT(size(state), 0.01);  // damped away, slowly where the step is near the limit
}

// ---- energy
// -------------------------------------------------------------------------------------------------------------

TEST(CentralDifferenceEnergy, LinearUndampedSystem_DiscreteEnergy_IsConservedToRoundOff) {
    const Oscillator system(chain());
    CentralDifference integrator({.safety = 0.9});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    const double dt = 0.9 * integrator.critical_time_step();
    // half a step's kinetic energy belongs to a definite dt: take it after the first one
    advance(system, integrator, state, 1, dt);
    const double energy = integrator.kinetic_energy(system, state) + system.stored_energies(state).sum();
    for (int block = 0; block < 100; ++block) {
        advance(system, integrator, state, 100, dt);
        EXPECT_NEAR(integrator.kinetic_energy(system, state) + system.stored_energies(state).sum(), energy,
                    1e4 * eps * energy);  // 1e4 steps
    }
}

TEST(CentralDifferenceEnergy, DampedLoadedAndMovedSystem_Balance_ClosesToRoundOff) {
    OscillatorModel model = chain();
    model.damping.mass_proportional = 2;
    model.damping.blocks = {{1, 3, 1, 2}};
    model.load = [](double t, bool) { return Vector{{3 * std::sin(9 * t), 1, t, -2}}; };
    model.prescribed = {{{0, Constraint::Kind::velocity},
                         [](double t) { return 0.1 * t * t; },
                         [](double t) { return 1 - 0.2 * t; },
                         [](double) { return -0.2; }},
                        {{3, Constraint::Kind::displacement},
                         [](double t) { return 0.1 * std::sin(5 * t); },
                         [](double t) { return 0.5 * std::cos(5 * t); },
                         [](double t) { return -2.5 * std::sin(5 * t); }}};
    const Oscillator system(model);
    CentralDifference integrator({.safety = 0.5});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    const double dt = 0.5 * integrator.critical_time_step();
    advance(system, integrator, state, 1, dt);
    const auto balance = [&] {
        return integrator.kinetic_energy(system, state) + system.stored_energies(state).sum() + state.path.damping -
               state.path.external_work - state.path.support_work;
    };
    const double before = balance();
    advance(system, integrator, state, 1000, dt);
    EXPECT_GT(std::abs(state.path.support_work), 1);
    EXPECT_GT(state.path.damping, 1);
    EXPECT_NEAR(balance(), before, 1e4 * eps * state.path.damping);
}

// ---- prescribed motion
// ---------------------------------------------------------------------------------------------------

TEST(CentralDifferenceSupports, MovingSupport_PulledFreeMass_ReactionIsItsInertia) {
    OscillatorModel model = single(0, 0);
    model.bound = {10, 0};
    const double a = 3;
    model.prescribed = {{{0, Constraint::Kind::displacement},
                         [=](double t) { return 0.5 * a * t * t; },
                         [=](double t) { return a * t; },
                         [=](double) { return a; }},
                        {{1, Constraint::Kind::velocity},
                         [=](double t) { return -a * t * t; },
                         [=](double t) { return -2 * a * t; },
                         [=](double) { return -2 * a; }}};
    model.initial_u = Vector{{7, 0}};  // the prescription says where a run begins
    const Oscillator system(model);
    CentralDifference integrator({});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    EXPECT_EQ(state.u[0], 0);
    advance(system, integrator, state, 50, 0.1);
    // uniform acceleration is exact; differences of u over dt^2 = 0.01 lose two digits
    constexpr double tolerance = 1e4 * eps;
    EXPECT_NEAR(state.u[0], 0.5 * a * state.t * state.t, tolerance * state.u[0]);
    EXPECT_NEAR(state.v[0], a * state.t, tolerance * state.u[0] / 0.1);
    EXPECT_NEAR(state.u[1], -a * state.t * state.t, tolerance * state.u[0]);
    EXPECT_NEAR(integrator.reactions(system, state)[0], 2 * a, tolerance * state.u[0] / 0.01);
    EXPECT_NEAR(integrator.reactions(system, state)[1], -4 * a, tolerance * state.u[0] / 0.01);
    EXPECT_NEAR(state.path.support_work, 0.5 * 2 * (state.v[0] * state.v[0] + state.v[1] * state.v[1]),
                tolerance * state.path.support_work);
}

TEST(CentralDifferenceSupports, FixedSupport_LoadedSpring_ReactionIsWhatTheSupportHasToCarry) {
    OscillatorModel model = chain();
    model.load = [](double, bool) { return Vector{{5, 0, 0, 0}}; };
    const auto zero = [](double) { return 0.0; };
    model.prescribed = {{{0, Constraint::Kind::displacement}, zero, zero, zero}};
    model.damping.mass_proportional = 3;
    model.damping.blocks = {{0, 1, 0.5, 1}};
    const Oscillator system(model);
    CentralDifference integrator({});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    advance(system, integrator, state, 20, 0.01);
    const double carried = model.stiffness.row(0).dot(Oscillator::vector(state.u)) + 0.5 * state.v[1] - 5;
    EXPECT_NEAR(integrator.reactions(system, state)[0], carried, 64 * eps * 90);
    EXPECT_EQ(state.u[0], 0);
    EXPECT_EQ(state.v[0], 0);
    EXPECT_EQ(state.path.support_work, 0);
}

TEST(CentralDifferenceSupports, VelocityJumpAtAReinitialise_SupportWork_IsTheKineticEnergyItBrings) {
    OscillatorModel model = single(0, 0);
    model.bound = {10, 0};
    double speed = 1;
    model.prescribed = {{{0, Constraint::Kind::velocity}, nullptr, [&speed](double) { return speed; }, nullptr}};
    const Oscillator system(model);
    CentralDifference integrator({});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    EXPECT_EQ(state.path.support_work, 0);
    speed = 4;
    integrator.start(system, state, StartReason::reinitialise);
    EXPECT_EQ(state.v[0], 4);
    EXPECT_DOUBLE_EQ(state.path.support_work, 0.5 * 2 * (16 - 1));
}

// ---- steps
// ---------------------------------------------------------------------------------------------------------------

TEST(CentralDifferenceSteps, StopsBetweenSteps_AreHitExactlyByEqualSteps) {
    const Oscillator system(chain());
    CentralDifference integrator({.safety = 0.8});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    const double limit = 0.8 * integrator.critical_time_step();
    for (const double stop : {3.5 * limit, 3.6 * limit, 9.6 * limit * (1 + 4 * eps)}) {
        std::vector<double> steps;
        while (state.t < stop) steps.push_back(integrator.advance(system, state, stop).dt);
        EXPECT_EQ(state.t, stop);
        for (const double dt : steps) {
            EXPECT_LE(dt, limit * (1 + 1e-9));
            EXPECT_NEAR(dt, steps[0], 64 * eps * stop);
        }
    }
    // six limits and a round-off: six steps, not seven
    EXPECT_NEAR(integrator.advance(system, state, state.t + 6 * limit * (1 + 4 * eps)).dt, limit, 1e-9 * limit);
}

TEST(CentralDifferenceSteps, FixedStep_LongerThanTheCriticalOne_IsRefusedBeforeAnythingMoves) {
    const Oscillator system(chain());
    CentralDifference integrator({.dt = 1});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    const State before = state;
    try {
        integrator.advance(system, state, 10);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the fixed step dt = 1 s exceeds the critical step 0.1"));
        EXPECT_THAT(error.what(), HasSubstr("at t = 0 s"));
    }
    EXPECT_EQ(state, before);
}

TEST(CentralDifferenceSteps, UnusableBound_AtTheStart_IsReported) {
    OscillatorModel model = chain();
    model.bound = {std::numeric_limits<double>::quiet_NaN(), 0};
    const Oscillator system(model);
    CentralDifference integrator({});
    State state = system.initial_state();
    try {
        integrator.start(system, state, StartReason::fresh);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), HasSubstr("no stable time step at t = 0 s: omega <= nan"));
    }
}

TEST(CentralDifferenceSteps, FailedForce_LeavesTheAcceptedState) {
    OscillatorModel model = chain();
    model.maxwell = Matrix{{1, 0, -1, 0}};
    model.maxwell_stiffness = 5;
    Oscillator system(model);
    CentralDifference integrator({});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    advance(system, integrator, state, 3, 0.01);
    const State before = state;
    system.fail_after(0);
    EXPECT_THROW(integrator.advance(system, state, 1), RecoverableError);
    EXPECT_EQ(state, before);
}

// ---- steps that nobody sees
// -------------------------------------------------------------------------------------------------

/// Everything that steps may pass unseen with: a load, a support that moves, an absorbing node, internal variables.
OscillatorModel without_damping() {
    OscillatorModel model = chain();
    model.damping.blocks = {{1, 3, 1, 2}};
    model.load = [](double t, bool) { return Vector{{3 * std::sin(9 * t), 1, t, -2}}; };
    model.maxwell = Matrix{{1, 0, -1, 0}};
    model.maxwell_stiffness = 5;
    model.prescribed = {{{1, Constraint::Kind::displacement},
                         [](double t) { return 0.1 * std::sin(5 * t); },
                         [](double t) { return 0.5 * std::cos(5 * t); },
                         [](double t) { return -2.5 * std::sin(5 * t); }}};
    return model;
}

/// An integrator under way, and its twin.
struct Pair {
    explicit Pair(const OscillatorModel& model) : system(model) {
        integrator.start(system, state, StartReason::fresh);
        twin.start(system, twin_state, StartReason::fresh);
    }
    Oscillator system;
    CentralDifference integrator{{.safety = 0.7, .bound_interval = 50}}, twin{{.safety = 0.7, .bound_interval = 50}};
    State state = system.initial_state(), twin_state = system.initial_state();
};

TEST(CentralDifferenceUnseen, AnyNumberOfSteps_HaveTheBitsOfSeenOnes) {
    Pair pair(without_damping());
    constexpr double t_stop = 10;
    std::size_t most = 0;
    while (pair.state.t < t_stop) {
        const StepReport report = pair.integrator.advance_unseen(pair.system, pair.state, t_stop, t_stop);
        most = std::max(most, report.n_steps);
        EXPECT_EQ(report.n_force, report.n_steps);
        for (std::size_t step = 0; step < report.n_steps; ++step)
            pair.twin.advance(pair.system, pair.twin_state, t_stop);
        ASSERT_EQ(pair.state, pair.twin_state) << "t = " << pair.state.t;
        ASSERT_EQ(pair.integrator.save(), pair.twin.save());
        EXPECT_EQ(pair.integrator.kinetic_energy(pair.system, pair.state),
                  pair.twin.kinetic_energy(pair.system, pair.twin_state));
    }
    EXPECT_GT(most, 8u);
    EXPECT_EQ(pair.twin_state.t, t_stop);
}

TEST(CentralDifferenceUnseen, TheFirstStepThatComesToTheLook_IsSeen) {
    Pair pair(without_damping());
    const double look = 3.5 * 0.7 * pair.integrator.critical_time_step();
    const StepReport report = pair.integrator.advance_unseen(pair.system, pair.state, 10, look);
    EXPECT_EQ(report.n_steps, 4u);
    EXPECT_LT(report.t - report.dt, look);
    EXPECT_GE(report.t, look);
}

TEST(CentralDifferenceUnseen, DampingAndViscosity_EveryStepIsSeen) {
    OscillatorModel damped = without_damping(), viscous = without_damping();
    damped.damping.mass_proportional = 0.4;
    viscous.viscosity = 0.01 * viscous.stiffness;
    for (const OscillatorModel& model : {damped, viscous}) {
        Pair pair(model);
        EXPECT_EQ(pair.integrator.advance_unseen(pair.system, pair.state, 10, 10).n_steps, 1u);
    }
}

TEST(CentralDifferenceUnseen, FailureUnderWay_KeepsTheStepsBeforeIt) {
    Pair pair(without_damping());
    pair.system.fail_after(5);
    const StepReport report = pair.integrator.advance_unseen(pair.system, pair.state, 10, 10);
    EXPECT_EQ(report.n_steps, 5u);
    for (int step = 0; step < 5; ++step) pair.twin.advance(pair.system, pair.twin_state, 10);
    EXPECT_EQ(pair.state.t, pair.twin_state.t);
    EXPECT_EQ(pair.state.u, pair.twin_state.u);
    EXPECT_EQ(pair.state.path, pair.twin_state.path);
    // v(n) comes back from v(n+1/2): a subtraction undoes an addition but for round-off
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(pair.state.v[i], pair.twin_state.v[i], 8 * eps * size(pair.state));
    EXPECT_NEAR(pair.integrator.kinetic_energy(pair.system, pair.state),
                pair.twin.kinetic_energy(pair.system, pair.twin_state), 64 * eps);
    EXPECT_THAT(pair.integrator.reactions(pair.system, pair.state),
                ElementsAre(pair.twin.reactions(pair.system, pair.twin_state)[0]));
    // and the run can go on
    while (pair.state.t < 1) pair.integrator.advance_unseen(pair.system, pair.state, 1, 1);
    while (pair.twin_state.t < 1) pair.twin.advance(pair.system, pair.twin_state, 1);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(pair.state.u[i], pair.twin_state.u[i], 1e-12 * size(pair.state));
}

TEST(CentralDifferenceUnseen, FailureInTheFirstStep_IsReported) {
    Pair pair(without_damping());
    pair.system.fail_after(0);
    const State before = pair.state;
    EXPECT_THROW(pair.integrator.advance_unseen(pair.system, pair.state, 10, 10), RecoverableError);
    EXPECT_EQ(pair.state, before);
}

// ---- restart
// ---------------------------------------------------------------------------------------------------------------

OscillatorModel everything() {
    OscillatorModel model = without_damping();
    model.damping.mass_proportional = 0.4;
    model.viscosity = 0.01 * model.stiffness;
    return model;
}

TEST(CentralDifferenceRestart, SavedAndLoaded_FurtherSteps_HaveTheSameBits) {
    const Oscillator system(everything());
    CentralDifference integrator({.safety = 0.7});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    while (state.t < 1) integrator.advance(system, state, 1);

    const Oscillator other_system(everything());
    CentralDifference other({.safety = 0.7});
    State other_state = state;
    other.load(other_system, other_state, integrator.save());
    EXPECT_EQ(other.kinetic_energy(other_system, other_state), integrator.kinetic_energy(system, state));
    const auto expected = integrator.reactions(system, state);
    EXPECT_THAT(other.reactions(other_system, other_state),
                testing::ElementsAreArray(expected.begin(), expected.end()));
    while (state.t < 3) {
        integrator.advance(system, state, 3);
        other.advance(other_system, other_state, 3);
        ASSERT_EQ(other_state, state);
    }
    EXPECT_EQ(other.save(), integrator.save());
}

TEST(CentralDifferenceRestart, MemoryOfAnotherSystem_IsRefusedByName) {
    const Oscillator system(everything());
    CentralDifference integrator({});
    State state = system.initial_state();
    integrator.start(system, state, StartReason::fresh);
    IntegratorMemory memory = integrator.save();
    const IntegratorMemory complete = memory;
    for (const auto& [name, values] : complete) {
        memory = complete;
        memory.erase(name);
        try {
            integrator.load(system, state, memory);
            FAIL() << name;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("`" + name + "` is missing"));
        }
    }
    memory = complete;
    memory["acceleration"].pop_back();
    EXPECT_THROW(integrator.load(system, state, memory), InputError);
}

// ---- options
// ---------------------------------------------------------------------------------------------------------------

std::vector<std::string> messages(const CentralDifference::Options& options) {
    try {
        options.validate();
    } catch (const InputError& error) {
        std::vector<std::string> all;
        for (const Problem& problem : error.problems()) all.push_back(problem.where + ": " + problem.message);
        return all;
    }
    return {};
}

TEST(CentralDifferenceOptions, Defaults_AreValid) { EXPECT_THAT(messages({}), ElementsAre()); }

TEST(CentralDifferenceOptions, OutOfRange_EveryOne_IsReportedAtOnce) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    EXPECT_THAT(messages({.safety = 0, .dt = -1}), ElementsAre("integrator.safety: given 0, must be in (0, 1]",
                                                               "integrator.dt: given -1 s, must be >= 0 s"));
    EXPECT_THAT(messages({.safety = 1.5}), ElementsAre("integrator.safety: given 1.5, must be in (0, 1]"));
    EXPECT_THAT(messages({.safety = nan, .dt = nan}), testing::SizeIs(2));
    EXPECT_THAT(messages({.dt = infinity}), testing::SizeIs(1));
    EXPECT_THROW(CentralDifference({.safety = -1}), InputError);
}

}  // namespace
}  // namespace gneiss
