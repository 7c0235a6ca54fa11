// One end of a bar is pressed by 1 MPa: after 2 ms the work of the pressure, where it went, and how well they balance.
#include <cstdio>
#include <gneiss/integrators/central_difference.hpp>
#include <gneiss/integrators/mass_and_damping.hpp>
#include <gneiss/mesh/make_mesh.hpp>
#include <gneiss/model/energy_ledger.hpp>
#include <gneiss/model/initial_conditions.hpp>
#include <gneiss/model/loads.hpp>
#include <gneiss/model/make_blocks.hpp>
#include <gneiss/model/solid_system.hpp>
#include <gneiss/system/march.hpp>

int main() {
    gneiss::MeshOptions bar;
    bar.width = 10, bar.height = 0.5;  // m
    bar.cells = {160, 8};
    gneiss::SolidOptions plane_stress;  // of composite triangles, 1 m thick
    plane_stress.plane = gneiss::Plane::stress;
    gneiss::MaterialOptions rock;
    rock.density = 2500;                                          // kg/m3
    rock.constants = gneiss::isotropic_plane_stress(20e9, 0.0);  // Pa
    gneiss::LoadOptions pressure;
    pressure.on = "left";
    pressure.kind = gneiss::LoadOptions::Kind::pressure;
    pressure.value[0] = gneiss::Formula(1e6);  // Pa

    const gneiss::Mesh mesh = gneiss::make_mesh(bar, plane_stress.compt, {});
    gneiss::SolidSystem::Parts parts;
    parts.blocks = gneiss::make_blocks(mesh, plane_stress, {rock});
    parts.terms = gneiss::make_loads(mesh, {pressure}, plane_stress.thickness);
    parts.initial_velocity = gneiss::initial_velocity(mesh, {});
    const gneiss::SolidSystem solid(mesh, std::move(parts));

    gneiss::CentralDifference integrator({.safety = 0.8});  // of the largest stable step
    gneiss::State state = solid.initial_state();
    gneiss::March march;
    march.t_end = 2e-3;  // s
    march.run(solid, integrator, state, false);

    std::vector<double> scratch;
    gneiss::EnergyLedger energies;
    energies.kinetic = gneiss::synchronised_kinetic_energy(solid, state.v, scratch);
    energies.scheme = integrator.kinetic_energy(solid, state) - energies.kinetic;
    energies.stored = solid.stored_energies(state);
    energies.path = state.path;
    std::printf("kinetic %.3f J, stored %.3f J, balance error %.1e\n", energies.kinetic, energies.stored.sum(),
                energies.balance_error());
}
