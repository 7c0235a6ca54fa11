// Once it runs, a step allocates nothing, and neither does a tangent: a program of its own, since it counts every
// allocation of the process.

#include <gtest/gtest.h>

#include "integrators/central_difference.hpp"
#include "mesh/make_mesh.hpp"
#include "model/boundaries.hpp"
#include "model/impedance.hpp"
#include "model/loads.hpp"
#include "model/make_blocks.hpp"
#include "model/solid_system.hpp"
#include "support/counted_allocations.hpp"

namespace gneiss {
namespace {

/// Everything that a step can meet: history, viscosity, damping, a follower pressure, a moving and an absorbing edge.
SolidSystem full_house(const Mesh& mesh, Form form) {
    SolidOptions solid;
    MaterialOptions material;
    material.form = form;
    material.density = 1000;
    material.constants = {0.267e9, 0.8e9, 1.6e9, 0.8e9};
    material.shear_viscosity = 1e3;
    LoadOptions pressure;
    pressure.kind = LoadOptions::Kind::pressure;
    pressure.on = "left";
    pressure.value[0] = Formula(1e5);
    pressure.amplitude.kind = AmplitudeOptions::Kind::ramp;
    pressure.amplitude.end = 1.0;
    BoundaryOptions moving, absorbing;
    moving.kind = BoundaryOptions::Kind::velocity;
    moving.on = "bottom";
    moving.value = {std::nullopt, Formula(0.01)};
    absorbing.kind = BoundaryOptions::Kind::absorbing;
    absorbing.on = "right";

    SolidSystem::Parts parts;
    parts.blocks = make_blocks(mesh, solid, {material});
    parts.terms = make_loads(mesh, {pressure}, solid.thickness);
    parts.constraints = make_constraints(mesh, {moving, absorbing});
    parts.damping.mass_proportional = 10;
    const auto edges = absorbing_edges(mesh, {moving, absorbing});
    parts.damping.blocks = absorbing_blocks(
        mesh, edges, [&](int) { return plane_stiffness(material.constants, 0.0, material.density); }, solid.thickness);
    return SolidSystem(mesh, std::move(parts));
}

Mesh several_chunks() {
    MeshOptions options;
    options.source = MeshOptions::Source::rectangle;
    options.cells = {40, 40};
    return make_mesh(options, true, {});
}

TEST(Step, OnceUnderWay_AllocatesNothing) {
    const Mesh mesh = several_chunks();
    for (const Form form : {Form::hyper, Form::hypo}) {
        const SolidSystem system = full_house(mesh, form);
        CentralDifference integrator({});
        State state = system.initial_state();
        integrator.start(system, state, StartReason::fresh);
        constexpr double far_away = 1.0;
        constexpr int warm_up = 5, n_steps = 200;  // the look at the stable step is among them
        for (int step = 0; step < warm_up; ++step) integrator.advance(system, state, far_away);
        const std::size_t before = n_allocations;
        for (int step = 0; step < n_steps; ++step) integrator.advance(system, state, far_away);
        for (int step = 0; step < n_steps; ++step) integrator.advance_unseen(system, state, far_away, far_away);
        EXPECT_EQ(n_allocations - before, 0u);
    }
}

TEST(LocalSteps, OnceUnderWay_AllocateNothing) {
    Mesh mesh = several_chunks();
    for (auto& node : mesh.nodes) node[0] *= 0.1 + node[0];  // columns up to 20 times as wide as the first ones
    for (const Form form : {Form::hyper, Form::hypo}) {
        const SolidSystem system = full_house(mesh, form);
        CentralDifference integrator({}, 6);
        State state = system.initial_state();
        integrator.start(system, state, StartReason::fresh);
        ASSERT_GT(integrator.work().elements, 0u);
        constexpr double far_away = 1.0;
        constexpr int warm_up = 5, n_steps = 100;  // a look at the stable step is among them
        for (int step = 0; step < warm_up; ++step) integrator.advance(system, state, far_away);
        const std::size_t before = n_allocations;
        for (int step = 0; step < n_steps; ++step) integrator.advance(system, state, far_away);
        EXPECT_EQ(n_allocations - before, 0u);
    }
}

TEST(Tangent, AssembledOnce_AllocatesNothing) {
    const Mesh mesh = several_chunks();
    for (const Form form : {Form::hyper, Form::hypo}) {
        const SolidSystem system = full_house(mesh, form);
        const State state = system.initial_state();
        State moved = state;
        moved.t = 0.5;  // the pressure is there
        for (std::size_t i = 0; i < moved.u.size(); ++i) moved.u[i] = 1e-6 * static_cast<double>(i % 7);
        const Tangent& tangent = *system.tangent();
        const Tangent::Factors factors{.mass = 1, .damping = 2, .stiffness = 3, .velocity = 4};
        std::vector<double> values(tangent.n_nonzero()), diagonal(moved.u.size());
        const Trial updated = Trial::of(moved);
        Trial given = updated;
        given.z = moved.z;
        const auto assemble = [&](const Trial& trial) {
            tangent.assemble(state, trial, factors, values);
            tangent.assemble_diagonal(state, trial, factors, diagonal);
        };
        assemble(updated);
        const std::size_t before = n_allocations;
        for (const Trial& trial : {updated, given}) assemble(trial);
        EXPECT_EQ(n_allocations - before, 0u);
    }
}

}  // namespace
}  // namespace gneiss
