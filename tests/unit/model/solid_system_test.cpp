#include "model/solid_system.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "materials/small_strain_stiffness.hpp"
#include "support/eps.hpp"
#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

using test::eps;
using testing::ElementsAre;

LoadOptions traction(const std::string& on, double x, double y, double start) {
    LoadOptions load;
    load.on = on;
    load.value = {x, y};
    load.amplitude.kind = AmplitudeOptions::Kind::heaviside;
    load.amplitude.start = start;
    return load;
}

double sum_of(const std::vector<double>& nodal, std::size_t component) {
    double sum = 0;
    for (std::size_t i = component; i < nodal.size(); i += 2) sum += nodal[i];
    return sum;
}

TEST(SolidSystem, Force_ElementsAndLoads_AreSummedAndSwitched) {
    test::SolidDescription what;
    what.solid.thickness = 0.5;
    what.loads = {traction("right", 3e6, 0, 0), traction("top", 0, -1e6, 0.25)};
    const test::Solid solid = test::distorted_solid(true, what);
    State state = solid.system->initial_state();
    const State before = state;
    std::vector<double> f(state.u.size(), 1e300);
    solid.system->force(state, Trial::of(state), f);
    EXPECT_EQ(sum_of(f, 0), 0);  // nothing has been switched on
    Trial trial = Trial::of(state);
    trial.last_event = 0;
    solid.system->force(state, trial, f);
    EXPECT_NEAR(sum_of(f, 0), 3e6 * 1 * 0.5, 100 * eps * 3e6);
    trial.last_event = 0.25;
    for (double& u : state.u) u += 1e-3;  // translation
    trial.u = state.u;
    solid.system->force(before, trial, f);
    EXPECT_NEAR(sum_of(f, 0), 3e6 * 1 * 0.5, 100 * eps * 3e6);
    EXPECT_NEAR(sum_of(f, 1), -1e6 * 2 * 0.5, 100 * eps * 3e6);
    ASSERT_EQ(solid.system->events().size(), 1u);
    EXPECT_EQ(solid.system->events()[0]->next_time(before), 0.0);
}

TEST(SolidSystem, InitialState_VelocitiesAndMemory_AreThere) {
    test::SolidDescription what;
    what.materials[0].form = Form::hypo;
    what.materials[0].in_situ_stress[0] = -1e6;
    what.materials[0].shear_viscosity = 1e3;
    what.initial = {{"", {Formula("y"), 2}}};
    const test::Solid solid = test::distorted_solid(true, what);
    const State state = solid.system->initial_state();
    const Layout layout = solid.system->layout();
    EXPECT_EQ(state.t, 0);
    EXPECT_EQ(state.u, std::vector<double>(layout.n_dof, 0.0));
    EXPECT_EQ(state.z.size(), layout.n_internal);
    EXPECT_EQ(state.history.size(), layout.n_history);
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        EXPECT_EQ(state.v[2 * node], solid.mesh.nodes[node][1]);
        EXPECT_EQ(state.v[2 * node + 1], 2);
    }
    // simple shear at rate 1 over 2 m2: eta per volume
    EXPECT_NEAR(state.path.viscous_power, 1e3 * 2, 1e-12 * 2e3);
    EXPECT_EQ(solid.system->stored_energies(state).sum(), 0);
}

TEST(SolidSystem, PointFields_OfAViscousSolidInUniformFlow_HaveNewtonsStress) {
    for (const bool compt : {false, true}) {
        test::SolidDescription what;
        what.materials[0].shear_viscosity = 2e3;
        what.materials[0].bulk_viscosity = 5e3;
        what.initial = {{"", {Formula("3*x + 2*y"), Formula("-4*x - y")}}};
        const test::Solid solid = test::distorted_solid(compt, what);
        // at rest, so all stress is viscous (1e-9: some hundred roundings): 2 eta (d - tr d/2 I) + zeta tr d I, d = [3,
        // -1; -1, -1]
        for (const PointFields& fields : solid.system->point_fields(solid.system->initial_state())) {
            EXPECT_NEAR(fields.cauchy[0], 2 * 2e3 * 2 + 5e3 * 2, 1e-9);
            EXPECT_NEAR(fields.cauchy[1], -2 * 2e3 * 2 + 5e3 * 2, 1e-9);
            EXPECT_NEAR(fields.cauchy[2], 2 * 2e3 * -1, 1e-9);
            EXPECT_NEAR(fields.cauchy_zz, 5e3 * 2, 1e-9);
        }
    }
}

TEST(SolidSystem, PointFields_UniformStrain_AreThoseOfHooke) {
    for (const bool compt : {false, true}) {
        const test::Solid solid = test::distorted_solid(compt);
        State state = solid.system->initial_state();
        const double size = 1e-7;  // stress differs from Hooke's by size squared
        const double h[2][2] = {{1 * size, -0.5 * size}, {0.2 * size, -2 * size}};
        for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node)
            for (std::size_t i = 0; i < 2; ++i)
                state.u[2 * node + i] = h[i][0] * solid.mesh.nodes[node][0] + h[i][1] * solid.mesh.nodes[node][1];
        const MunjizaConstants constants = test::rock().constants;
        const double angle = 0.4, c = std::cos(angle), s = std::sin(angle);
        const Eigen::Matrix2d axes{{c, -s}, {s, c}};
        const Eigen::Matrix2d strain =
            axes.transpose() *
            Eigen::Matrix2d{{h[0][0], 0.5 * (h[0][1] + h[1][0])}, {0.5 * (h[0][1] + h[1][0]), h[1][1]}} * axes;
        const Eigen::Vector3d on_axes =
            small_strain_stiffness(constants) * Eigen::Vector3d(strain(0, 0), strain(1, 1), 2 * strain(0, 1));
        const Eigen::Matrix2d sigma =
            axes * Eigen::Matrix2d{{on_axes[0], on_axes[2]}, {on_axes[2], on_axes[1]}} * axes.transpose();
        const double tolerance = 20 * size * size * 2e9;
        const std::vector<PointFields> all = solid.system->point_fields(state);
        const std::size_t n_sub = compt ? 4 : 1;
        ASSERT_EQ(all.size(), solid.mesh.n_elements() * n_sub);
        for (std::size_t e = 0; e < solid.mesh.n_elements(); ++e) {
            const std::vector<PointFields> own = solid.system->point_fields(state, static_cast<std::int32_t>(e));
            ASSERT_EQ(own.size(), n_sub);
            for (std::size_t k = 0; k < n_sub; ++k) {
                EXPECT_EQ(own[k].cauchy, all[e * n_sub + k].cauchy);
                EXPECT_NEAR(own[k].cauchy[0], sigma(0, 0), tolerance);
                EXPECT_NEAR(own[k].cauchy[1], sigma(1, 1), tolerance);
                EXPECT_NEAR(own[k].cauchy[2], sigma(0, 1), tolerance);
                EXPECT_NEAR(own[k].stretch[0], 1 + h[0][0] + h[1][1], 10 * size * size);
                EXPECT_NEAR(own[k].stretch[1], 1 + strain(0, 0), 10 * size * size);
                EXPECT_NEAR(own[k].stretch[2], 1 + strain(1, 1), 10 * size * size);
                EXPECT_NEAR(own[k].munjiza[0], constants.M_v * (h[0][0] + h[1][1]), tolerance);
                EXPECT_NEAR(own[k].munjiza[1], constants.M_alpha * strain(0, 0), tolerance);
            }
        }
    }
}

TEST(SolidSystem, PathEnergies_OneStep_AreTheTrapezoidalSums) {
    test::SolidDescription what;
    what.loads = {traction("right", 3e6, 0, 0)};
    what.mass_damping = 5;
    what.materials[0].bulk_viscosity = 2e3;
    BoundaryOptions absorbing;
    absorbing.kind = BoundaryOptions::Kind::absorbing;
    absorbing.on = "left";
    what.boundaries = {absorbing};
    const test::Solid solid = test::distorted_solid(true, what);
    State from = solid.system->initial_state(), to = from;
    from.last_event = to.last_event = 0;
    to.t = 0.1;
    from.path.external_work = 7;
    double mass = 0;
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        to.u[2 * node] = 0.01;
        from.v[2 * node] = 1;
        to.v[2 * node] = 3;
        mass += solid.system->lumped_mass()[2 * node];
    }
    solid.system->add_path_energies(from, to);
    EXPECT_NEAR(to.path.external_work, 7 + 3e6 * 0.01, 1e-9);
    EXPECT_NEAR(to.path.damping, 5 * mass * 2 * 0.01, 1e-9);
    EXPECT_NEAR(to.path.viscous, 0, 1e-6);  // rigid motion
    double z_xx = 0;
    for (const auto& block : solid.system->damping().blocks) z_xx += block.xx;
    EXPECT_NEAR(to.path.absorbing, z_xx * 2 * 0.01, 1e-12 * z_xx);

    // uniform dilatation at rates 1 and 3 per second: 4 zeta rate^2 per volume at each end
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node)
        for (std::size_t i = 0; i < 2; ++i) {
            from.v[2 * node + i] = solid.mesh.nodes[node][i];
            to.v[2 * node + i] = 3 * solid.mesh.nodes[node][i];
            to.u[2 * node + i] = 0;
        }
    from.path.viscous_power = 4 * 2e3 * 2;
    solid.system->add_path_energies(from, to);
    EXPECT_NEAR(to.path.viscous_power, 4 * 2e3 * 9 * 2, 1e-9 * 144e3);
    EXPECT_NEAR(to.path.viscous, 0.5 * (4 * 2e3 * 2) * (1 + 9) * 0.1, 1e-9 * 8e3);
}

TEST(SolidSystem, Events_SwitchesOfLoadsAndBoundaries_AreOneList) {
    test::SolidDescription what;
    what.loads = {traction("right", 3e6, 0, 0.5)};
    BoundaryOptions moving;
    moving.kind = BoundaryOptions::Kind::velocity;
    moving.on = "left";
    moving.value[0] = Formula(1.0);
    moving.amplitude.kind = AmplitudeOptions::Kind::ramp;
    moving.amplitude.start = 0.25;
    moving.amplitude.end = 0.75;
    what.boundaries = {moving};
    const test::Solid solid = test::distorted_solid(true, what);
    State state = solid.system->initial_state();
    std::vector<double> times;
    state.t = 1;
    while (const auto next = solid.system->events()[0]->next_time(state)) {
        times.push_back(*next);
        solid.system->events()[0]->apply(state);
    }
    EXPECT_THAT(times, ElementsAre(0.25, 0.5, 0.75));
}

}  // namespace
}  // namespace gneiss
