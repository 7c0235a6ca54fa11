// Lumped models on a mesh that comes apart: gas in a hole whose wall cracks, a hammer on a point behind the nodes.

#include <gtest/gtest.h>

#include "integrators/central_difference.hpp"
#include "model/gas_cavity.hpp"
#include "support/cracking_solid.hpp"
#include "support/one_thread.hpp"
#include "support/plate_with_hole.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

test::SolidDescription pressed() {
    test::SolidDescription what;
    StrengthOptions strength;
    strength.tensile = {2e6, 2e6};
    strength.cohesion = {8e6, 8e6};
    strength.friction = {0.6, 0.6};
    strength.residual_friction = {0.4, 0.4};
    strength.fracture_energy_i = {200, 200};
    strength.fracture_energy_ii = {2000, 2000};
    what.materials[0].strength = strength;
    LumpedOptions gas, hammer;
    gas.name = "gas";
    gas.on = "hole";
    gas.pressure = 6e6;
    gas.leak = 10;
    hammer.kind = LumpedOptions::Kind::mass;
    hammer.name = "hammer";
    hammer.on = "top";
    hammer.direction = {0, -1};
    hammer.stiffness = 1e9;
    hammer.mass = 500;
    hammer.velocity = 1;
    what.lumped = {gas, hammer};
    return what;
}

test::CrackingSolid cracking_plate() {
    return test::cracking_solid(test::plate_with_hole(true, 5, {0.4, 0.8}), pressed());
}

State run(test::CrackingSolid& solid, double t_end) {
    CentralDifference integrator(CentralDifference::Options{.safety = 0.4});
    State state = solid.system->initial_state();
    March march;
    march.t_end = t_end;
    march.run(*solid.system, integrator, state, false);
    return state;
}

TEST(LumpedCracking, CracksInTheWall_LeaveGasAndHammerTheirs) {
    test::CrackingSolid solid = cracking_plate();
    const std::size_t n_before = solid.mesh->n_nodes();
    const double initial = solid.system->stored_energies(solid.system->initial_state()).sum() + 0.5 * 500;
    const State state = run(solid, 2.5e-3);
    ASSERT_GT(solid.mesh->n_nodes(), n_before);
    ASSERT_EQ(state.u.size(), 2 * solid.mesh->n_nodes() + 2);
    EXPECT_EQ(solid.system->lumped_mass().back(), 500);
    const auto& hole = solid.mesh->boundaries.at("hole");
    std::size_t parted = 0;
    for (std::size_t i = 0; i < hole.size(); ++i) parted += hole[i].b != hole[(i + 1) % hole.size()].a ? 1 : 0;
    ASSERT_GT(parted, 0u) << "cracks run into the wall";
    // the polygon of the wall, lines across mouths included
    double twice = 0;
    const auto at = [&](std::int32_t node) {
        const auto i = static_cast<std::size_t>(node);
        return Vec2<double>{solid.mesh->nodes[i][0] + state.u[2 * i], solid.mesh->nodes[i][1] + state.u[2 * i + 1]};
    };
    for (std::size_t i = 0; i < hole.size(); ++i) {
        twice -= cross(at(hole[i].a), at(hole[i].b));
        twice -= cross(at(hole[i].b), at(hole[(i + 1) % hole.size()].a));
    }
    EXPECT_NEAR(solid.system->models().quantities(state)[1].value, 0.5 * twice, 1e-12);
    // the hammer has been thrown back, and nothing got lost on the way
    EXPECT_LT(state.v[state.v.size() - 2], 0);
    PathEnergies path = state.path;
    double kinetic = 0;
    for (std::size_t i = 0; i < state.v.size(); ++i)
        kinetic += 0.5 * solid.system->lumped_mass()[i] * state.v[i] * state.v[i];
    const double left = kinetic + solid.system->stored_energies(state).sum() + path.leaked + path.fracture +
                        path.friction - path.splitting - initial;
    const double given = initial - solid.system->stored_energies(state).models;
    EXPECT_LT(std::abs(left), 0.02 * given);  // kinetic energy at whole steps, not the leapfrog's own
}

TEST(LumpedCracking, Replay_ComesToTheSameForces) {
    test::CrackingSolid first = cracking_plate(), again = cracking_plate();
    const State state = run(first, 1.5e-3);
    again.cracking->replay(first.cracking->save());
    ASSERT_EQ(first.system->layout().n_dof, again.system->layout().n_dof);
    std::vector<double> f(state.u.size()), g(f.size());
    first.system->force(state, Trial::of(state), f);
    again.system->force(state, Trial::of(state), g);
    EXPECT_EQ(f, g);
}

}  // namespace
}  // namespace gneiss
