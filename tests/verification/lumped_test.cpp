// Lumped models coupled to a solid, by every integrator: frequencies that can be derived by hand, energies, restarts,
// statics.

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "integrators/arkode.hpp"
#include "integrators/bathe.hpp"
#include "integrators/cvode.hpp"
#include "integrators/dynamic_relaxation.hpp"
#include "integrators/generalized_alpha.hpp"
#include "integrators/ida.hpp"
#include "integrators/noh_bathe.hpp"
#include "integrators/quasi_static.hpp"
#include "integrators/verlet.hpp"
#include "support/one_thread.hpp"
#include "support/plate_with_hole.hpp"
#include "verification/run_solid.hpp"

namespace gneiss {
namespace {

using Made = std::unique_ptr<Integrator>;

template <class Solver>
Made solver(typename Solver::Options options, double rtol) {
    options.rtol = rtol;
    return std::make_unique<Solver>(options);
}
Made table(const char* name, double rtol) {
    Arkode::Options options;
    options.table = name;
    return solver<Arkode>(options, rtol);
}
Made alpha(double rtol, const GeneralizedAlpha::Scheme& scheme = GeneralizedAlpha::Scheme::chung_hulbert(0.8)) {
    GeneralizedAlpha::Options options;
    options.scheme = scheme;
    options.rtol = rtol;
    return std::make_unique<GeneralizedAlpha>(options);
}
Made adams(double rtol) {
    Cvode::Options options;
    options.method = Cvode::Method::adams;
    options.iteration = Cvode::Iteration::functional;
    return solver<Cvode>(options, rtol);
}

struct Scheme {
    std::string name;
    double error;    ///< allowed, of displacement and velocity over their largest
    double balance;  ///< allowed, of the energy
    std::function<Made()> make;
};
void PrintTo(const Scheme& scheme, std::ostream* out) { *out << scheme.name; }

// Allowed as in integrators_test.cpp; the hammer's touches end no step, which costs schemes of high order theirs.
const Scheme schemes[] = {
    {"CentralDifference", 2e-3, 1e-4,
     [] { return std::make_unique<CentralDifference>(CentralDifference::Options{.safety = 0.1}); }},
    {"VelocityVerlet", 2e-3, 1e-4, [] { return std::make_unique<Verlet>(Verlet::Options{{.safety = 0.1}}); }},
    {"VerletOfOrderFour", 2e-3, 1e-4,
     [] {
         return std::make_unique<Verlet>(Verlet::Options{{.safety = 0.3}, Verlet::Form::position, "suzuki_5"});
     }},
    {"NohBathe", 2e-3, 1e-4, [] { return std::make_unique<NohBathe>(NohBathe::Options{{.safety = 0.1}}); }},
    {"Bathe", 5e-3, 1e-3, [] { return std::make_unique<Bathe>(Bathe::Options{.dt = 1e-5}); }},
    {"GeneralizedAlpha", 5e-3, 1e-3, [] { return alpha(1e-7); }},
    {"Newmark", 5e-3, 1e-3, [] { return alpha(1e-7, GeneralizedAlpha::Scheme::newmark(0.25, 0.5)); }},
    {"HilberHughesTaylor", 5e-3, 1e-3, [] { return alpha(1e-7, GeneralizedAlpha::Scheme::hht(0.1)); }},
    {"CvodeBdf", 2e-3, 1e-3, [] { return solver<Cvode>({}, 1e-7); }},
    {"CvodeAdams", 2e-3, 1e-4, [] { return adams(1e-7); }},
    {"Ida", 2e-3, 1e-3, [] { return solver<Ida>({}, 1e-7); }},
    {"ArkodeExplicit", 2e-4, 1e-5, [] { return table("dormand_prince_7_4_5", 1e-7); }},
    {"ArkodeImplicit", 2e-4, 1e-4, [] { return table("esdirk547l2sa_7_4_5", 1e-7); }},
    {"ArkodeAdditive", 2e-4, 1e-4, [] { return table("ark548l2sa_8_4_5", 1e-7); }},
};

LumpedOptions gas(double pressure) {
    LumpedOptions options;
    options.name = "gas";
    options.on = "hole";
    options.pressure = pressure;
    return options;
}

/// A charge that burns in the hole and leaks from it; a hammer on the top, an actuator from below.
test::SolidDescription everything_lumped(Form form) {
    test::SolidDescription what;
    what.materials[0].form = form;
    LumpedOptions burning = gas(1e7);
    burning.leak = 50;
    burning.burn = BurnOptions{.energy = 2e8, .time = 2e-3, .exponent = 0.5, .reference_pressure = 2e7};
    LumpedOptions hammer;
    hammer.kind = LumpedOptions::Kind::mass;
    hammer.name = "hammer";
    hammer.on = "top";
    hammer.direction = {0, -1};
    hammer.stiffness = 2e9;
    hammer.damping = 2e5;
    hammer.mass = 2000;
    hammer.velocity = 5;
    hammer.force = 2e4;
    LumpedOptions actuator = hammer;
    actuator.kind = LumpedOptions::Kind::actuator;
    actuator.name = "actuator";
    actuator.on = "bottom";
    actuator.direction = {0, 1};
    actuator.damping = 0;
    actuator.bonded = true;
    actuator.displacement = 5e-3;
    actuator.amplitude.kind = AmplitudeOptions::Kind::ramp;
    actuator.amplitude.end = 3e-3;
    what.lumped = {burning, hammer, actuator};
    BoundaryOptions absorbing, fixed;
    absorbing.kind = BoundaryOptions::Kind::absorbing;
    absorbing.on = "left";
    fixed.on = "right";
    fixed.value = {Formula(0.0), std::nullopt};
    what.boundaries = {absorbing, fixed};
    return what;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0, largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference = std::max(difference, std::abs(a[i] - b[i]));
        largest = std::max(largest, std::abs(b[i]));
    }
    return difference / largest;
}

class LumpedUnder : public testing::TestWithParam<Scheme> {};

TEST_P(LumpedUnder, EveryModel_AgreesWithATightSolution) {
    constexpr double t_end = 4e-3;  // waves cross the plate once or twice
    for (const Form form : {Form::hyper, Form::hypo}) {
        const test::Solid solid = test::make_solid(test::plate_with_hole(true), everything_lumped(form));
        const Made reference = table("fehlberg_13_7_8", 1e-9);
        const State exact = test::run_solid(*solid.system, t_end, *reference).state;
        const Made integrator = GetParam().make();
        const test::SolidRun run = test::run_solid(*solid.system, t_end, *integrator);
        EXPECT_LT(largest_difference(run.state.u, exact.u), GetParam().error);
        EXPECT_LT(largest_difference(run.state.v, exact.v), 5 * GetParam().error);  // higher frequencies
        EXPECT_LT(largest_difference(run.state.z, exact.z), 5 * GetParam().error);
        EXPECT_LT(run.ledger.balance_error(), GetParam().balance);
        EXPECT_GT(run.state.path.leaked, 1e5);
        EXPECT_GT(run.state.path.dampers, 1);
    }
}

TEST_P(LumpedUnder, ResumedFromACheckpoint_HasTheBitsOfARunThatGoesOn) {
    const test::Solid solid = test::make_solid(test::plate_with_hole(true), everything_lumped(Form::hyper));
    const auto run = [&](bool resume) {
        Made integrator = GetParam().make();
        State state = solid.system->initial_state();
        March march;
        march.t_end = 4e-4;
        march.run(*solid.system, *integrator, state, false);
        const IntegratorMemory memory = integrator->save();
        if (resume) {
            integrator = GetParam().make();
            integrator->load(*solid.system, state, memory);
        } else {
            integrator->forget(*solid.system, state);
        }
        march.t_end = 8e-4;
        march.run(*solid.system, *integrator, state, true);
        return state;
    };
    EXPECT_EQ(run(true), run(false));
}

// ---- one degree of freedom, derived by hand

/// A hole of 2 m x 1 m in a frame of cells of 1 m, of CST; of all nodes, the one in the middle of the upper wall alone
/// may move, up and down.
///
///     15--16--17--18--19     each cell has a diagonal that rises to the right
///      |   |   |   |   |
///     10--11--12--13--14     12 moves
///      |   |       |   |
///      5---6---7---8---9
///      |   |   |   |   |
///      0---1---2---3---4
Mesh frame() {
    Mesh mesh;
    mesh.kind = ElementKind::cst;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column) mesh.nodes.push_back({double(column), double(row)});
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            if (row == 1 && (column == 1 || column == 2)) continue;
            const int a = 5 * row + column;
            for (const int node : {a, a + 1, a + 6, a, a + 6, a + 5}) mesh.connectivity.push_back(node);
        }
    mesh.region.assign(mesh.n_elements(), 0);
    mesh.region_names = {"rock"};
    mesh.boundaries["hole"] = {{6, 11, 0}, {11, 12, 0}, {12, 13, 0}, {13, 8, 0}, {8, 7, 0}, {7, 6, 0}};
    mesh.boundaries["top"] = {{19, 18, 0}, {18, 17, 0}, {17, 16, 0}, {16, 15, 0}};
    mesh.node_sets["wall"] = {12};
    for (int node = 0; node < 20; ++node)
        if (node != 12) mesh.node_sets["others"].push_back(node);
    mesh.node_sets["top"] = {15, 16, 17, 18, 19};
    for (std::size_t i = 0; i < mesh.n_nodes(); ++i) mesh.node_labels.push_back(static_cast<std::int64_t>(i) + 1);
    for (std::size_t i = 0; i < mesh.n_elements(); ++i) mesh.element_labels.push_back(static_cast<std::int64_t>(i) + 1);
    return mesh;
}

constexpr double density = 1000, c_22 = 1.867e9, shear = 0.4e9, thickness = 0.5;

test::SolidDescription one_wall(double pressure) {
    test::SolidDescription what;
    what.solid.compt = false;
    what.solid.thickness = thickness;
    what.materials = {test::rock(0)};  // C_22 = M_v + M_beta, shear modulus M_psi/2
    what.lumped = {gas(pressure)};
    LoadOptions held;  // against the pressure on half a metre on either side: at rest where nothing is strained
    held.kind = LoadOptions::Kind::nodal_force;
    held.on = "wall";
    held.value = {0.0, -pressure * thickness};
    what.loads = {held};
    BoundaryOptions others, upright;
    others.on = "others";
    others.value = {Formula(0.0), Formula(0.0)};
    upright.on = "wall";
    upright.value = {Formula(0.0), std::nullopt};
    what.boundaries = {others, upright};
    InitialOptions push;
    push.on = "wall";
    push.velocity = {0.0, 1e-2};
    what.initial = {push};
    return what;
}

/// Three right triangles of 1/2 m2 meet at the wall, with gradients of its shape function of (1, -1), (-1, 0), (0, -1)
/// per m, and give it a third of their mass each; the gas adds kappa p (dV/du)^2/V, dV/du = 1 m h, V = 2 m2 h.
double wall_frequency(double pressure) {
    const double stiffness = 0.5 * thickness * (2 * c_22 + 2 * shear) + 1.4 * pressure * thickness / 2;
    return std::sqrt(stiffness / (0.5 * density * thickness));
}

TEST_P(LumpedUnder, GasAndWall_SwingAtTheFrequencyDerivedByHand) {
    constexpr double pressure = 2e9;  // as stiff as the wall, half as much again
    const test::Solid solid = test::make_solid(frame(), one_wall(pressure));
    const double omega = wall_frequency(pressure), period = 2 * std::numbers::pi / omega;
    ASSERT_GT(omega, 1.2 * wall_frequency(0));
    const Made integrator = GetParam().make();
    const State after = test::run_solid(*solid.system, period, *integrator).state;
    constexpr std::size_t wall = 2 * 12 + 1;
    // amplitudes of 1e-6 m: nothing but the scheme's own error, over one period
    EXPECT_NEAR(after.u[wall], 0, 5 * GetParam().error * 1e-2 / omega);
    EXPECT_NEAR(after.v[wall], 1e-2, 5 * GetParam().error * 1e-2);
}

TEST_P(LumpedUnder, MassOnASpring_SwingsAtItsFrequency) {
    test::SolidDescription what = one_wall(1);
    LumpedOptions mass;
    mass.kind = LumpedOptions::Kind::mass;
    mass.name = "mass";
    mass.on = "top";  // which is fixed
    mass.direction = {3, -4};
    mass.stiffness = 6e8;
    mass.ground_stiffness = 3e8;
    mass.bonded = true;
    mass.mass = 1000;
    mass.velocity = 2;
    what.lumped = {mass};
    what.initial.clear();
    what.loads.clear();
    const test::Solid solid = test::make_solid(frame(), what);
    const double omega = std::sqrt((6e8 + 3e8) / 1000), period = 2 * std::numbers::pi / omega;
    const Made integrator = GetParam().make();
    const test::SolidRun run = test::run_solid(*solid.system, 0.75 * period, *integrator);
    const std::size_t own = solid.system->layout().n_dof - 2;
    EXPECT_NEAR(run.state.u[own], -2 / omega, 5 * GetParam().error * 2 / omega);
    EXPECT_NEAR(run.state.v[own], 0, 5 * GetParam().error * 2);
    EXPECT_EQ(run.state.u[own + 1], 0);
    EXPECT_NEAR(run.ledger.stored.models, 0.5 * 1000 * 4, 10 * GetParam().error * 2000);
}

INSTANTIATE_TEST_SUITE_P(Schemes, LumpedUnder, testing::ValuesIn(schemes),
                         [](const auto& instance) { return instance.param.name; });

// ---- energy

TEST(GasThatBurnsAndLeaks, CompositionsOfVerletSteps_KeepTheirOrder) {
    constexpr double t_end = 1e-3;
    test::SolidDescription what;
    what.lumped = {everything_lumped(Form::hyper).lumped.front()};
    const test::Solid solid = test::make_solid(test::plate_with_hole(true), what);
    const Made reference = table("fehlberg_13_7_8", 1e-13);
    const State exact = test::run_solid(*solid.system, t_end, *reference).state;
    for (const Verlet::Form form : {Verlet::Form::velocity, Verlet::Form::position}) {
        std::vector<double> errors;
        for (const int n_steps : {40, 80, 160}) {
            Verlet integrator({{.safety = 1, .dt = t_end / n_steps}, form, "suzuki_5"});
            const State state = test::run_solid(*solid.system, t_end, integrator).state;
            errors.push_back(largest_difference(state.u, exact.u) + largest_difference(state.z, exact.z));
        }
        for (std::size_t i = 1; i < errors.size(); ++i)
            EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 4, 0.15)
                << (form == Verlet::Form::velocity ? "velocity " : "position ") << errors[i];
    }
}

TEST(GasDrivenCavity, TightTolerance_KeepsMechanicalAndGasEnergy) {
    test::SolidDescription what;
    what.lumped = {gas(2e7)};
    const test::Solid solid = test::make_solid(test::plate_with_hole(true), what);
    const Made integrator = table("fehlberg_13_7_8", 1e-10);
    const test::SolidRun run = test::run_solid(*solid.system, 5e-3, *integrator);
    const double given = run.ledger.initial - run.ledger.stored.models;  // by the gas: far less than it has
    EXPECT_GT(given, 1e-3 * run.ledger.initial);
    EXPECT_LT(std::abs(run.ledger.left_over()), 1e-8 * given);
}

// ---- statics

class LumpedStatics : public testing::TestWithParam<bool> {};  ///< by Newton's method

TEST_P(LumpedStatics, GasHammerAndActuator_AreInEquilibrium) {
    test::SolidDescription what = everything_lumped(Form::hyper);
    what.lumped[0].leak = 0;
    what.lumped[0].burn.reset();
    what.lumped[1].velocity = what.lumped[1].damping = 0;
    what.boundaries.erase(what.boundaries.begin());
    what.boundaries[0].value = {Formula(0.0), Formula(0.0)};
    const test::Solid solid = test::make_solid(test::plate_with_hole(true), what);
    Made integrator;
    if (GetParam())
        integrator = std::make_unique<QuasiStatic>(QuasiStatic::Options{});
    else
        integrator = std::make_unique<DynamicRelaxation>(DynamicRelaxation::Options{});
    std::size_t n_steps = 0;
    const test::SolidRun run = test::run_solid(*solid.system, 3e-3, *integrator, [&](const State&) { ++n_steps; });
    std::vector<double> f(run.state.u.size());
    solid.system->force(run.state, Trial::of(run.state), f);
    for (const Constraint& constraint : solid.system->constraints()) f[constraint.dof] = 0;
    for (const double force : f) EXPECT_NEAR(force, 0, 1e-8 * 1e7);  // tolerance 1e-9 of the pressure on a metre
    // the hammer rests with its weight on the solid, which it touches somewhere
    const auto quantities = solid.system->models().quantities(run.state);
    EXPECT_NEAR(quantities[5].value, 2e4, 1e-3);
    EXPECT_EQ(quantities[5].name, "hammer.force");
}

INSTANTIATE_TEST_SUITE_P(Solvers, LumpedStatics, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "Newton" : "Relaxation"; });

}  // namespace
}  // namespace gneiss
