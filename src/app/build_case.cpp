#include "app/build_case.hpp"

#include "app/checkpoints.hpp"
#include "app/make_integrator.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/errors.hpp"
#include "contact/make_contact.hpp"
#include "fracture/cohesion.hpp"
#include "fracture/initial_tractions.hpp"
#include "mesh/make_mesh.hpp"
#include "model/impedance.hpp"
#include "model/initial_conditions.hpp"
#include "model/load_courses.hpp"
#include "model/loads.hpp"
#include "model/make_blocks.hpp"
#include "model/make_lumped.hpp"
#include "model/rigid_motions.hpp"
#include "model/stress_at_rest.hpp"

namespace gneiss {
namespace {

/// Runs one step of the building and keeps its problems, so that all are reported together.
template <class Step>
void collect(std::vector<Problem>& problems, Step step) {
    try {
        step();
    } catch (const InputError& error) {
        problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    }
}

/// Stiffness of every element at the start, where an absorbing boundary asks for it; otherwise nothing.
std::vector<PlaneStiffness> stiffness_for_absorbing(const Mesh& mesh, const std::vector<BoundaryOptions>& boundaries,
                                                    std::span<const std::unique_ptr<ElementBlock>> blocks) {
    // Without blocks the materials are at fault: that is reported already.
    if (absorbing_edges(mesh, boundaries).empty() || blocks.empty()) return {};
    return element_stiffness(mesh, blocks);
}

/// Impedances of the elements at an absorbing boundary.
/// @param stiffness  of stiffness_for_absorbing()
std::vector<Damping::Block> absorbing_damping(const Mesh& mesh, const std::vector<BoundaryOptions>& boundaries,
                                              const std::vector<PlaneStiffness>& stiffness, double thickness) {
    if (stiffness.empty()) return {};
    return absorbing_blocks(
        mesh, absorbing_edges(mesh, boundaries),
        [&](int element) { return stiffness[static_cast<std::size_t>(element)]; }, thickness);
}

/// What stands around the solid, made anew from a mesh that has come apart.
std::function<SolidSystem::Surroundings(const Mesh&)> surroundings_of(const SolidSystem& system, const Mesh& mesh,
                                                                      const CaseOptions& options,
                                                                      const LoadCourses& courses) {
    return
        [courses, loads = options.loads, lumped = options.lumped, boundaries = options.boundaries,
         thickness = options.solid.thickness,
         stiffness = stiffness_for_absorbing(mesh, options.boundaries, system.elements().blocks())](const Mesh& now) {
            SolidSystem::Surroundings around;
            around.terms = make_loads(now, loads, thickness, courses.loads);
            around.models = make_lumped(now, lumped, thickness, courses.lumped);
            around.constraints = make_constraints(now, boundaries, courses.boundaries);
            around.damping = absorbing_damping(now, boundaries, stiffness, thickness);
            return around;
        };
}

/// @throws InputError naming the rigid motions that neither prescribed displacement or velocity nor contact holds
/// @param contact, walls  null: none
void need_supports(const CaseOptions& options, const Mesh& mesh, const SolidSystem::Parts& parts,
                   const Contact* contact, const Walls* walls) {
    std::vector<std::array<std::int32_t, 2>> bonds;
    for (const auto& interaction : parts.interactions) {
        if (interaction.get() == contact || interaction.get() == walls) continue;
        const auto more = interaction->couplings();
        bonds.insert(bonds.end(), more.begin(), more.end());
    }
    std::vector<Touch> touches;
    const auto add = [&](const std::vector<ContactPlace>& places, bool rough) {
        for (const ContactPlace& place : places)
            touches.push_back({place.node, place.other, place.at, {place.normal.x, place.normal.y}, rough});
    };
    if (contact != nullptr)
        add(contact->places(std::vector<double>(2 * mesh.n_nodes(), 0.0)), options.contact.friction > 0);
    if (walls != nullptr)
        add(walls->places(), options.contact.friction > 0 || std::ranges::any_of(options.walls, [](const auto& wall) {
                                 return wall.friction.value_or(0) > 0;
                             }));
    const std::vector<FreePart> free = free_parts(mesh, parts.constraints.constraints(), bonds, touches);
    if (free.empty()) return;
    std::string message = "too few supports for a static solution, which leaves free " + describe(free, mesh);
    if (contact != nullptr)
        message += fmt::format(
            "; contact holds along its normal, with friction along the face too, what is at most contact.skin, {:.3g} "
            "m, "
            "away: hold the rest by a [[boundary]], close wider gaps in the mesh, or let it find its place under a "
            "dynamic integrator",
            contact->options().skin);
    throw InputError("[[boundary]]", message);
}

/// @throws InputError where a gas ends at a plane of symmetry that nothing holds its wall to
void need_planes_of_symmetry(const CaseOptions& options, const Mesh& mesh, std::span<const Constraint> constraints) {
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < options.lumped.size(); ++i) {
        const LumpedOptions& gas = options.lumped[i];
        if (!gas.about || !mesh.boundaries.contains(gas.on)) continue;
        std::map<std::int32_t, int> leaves;  // edges that leave a node, less those that arrive
        for (const BoundaryEdge& edge : mesh.boundaries.at(gas.on)) {
            ++leaves[edge.a];
            --leaves[edge.b];
        }
        std::erase_if(leaves, [](const auto& one) { return one.second == 0; });
        const std::string where = fmt::format("[[lumped]] {}", i + 1);
        if (leaves.size() > 2) problems.push_back({where, fmt::format("on = \"{}\": is in several pieces", gas.on)});
        for (const auto& [node, count] : leaves) {
            const Point2 x = mesh.nodes[static_cast<std::size_t>(node)];
            const double length = distance(x, *gas.about);
            constexpr double aligned = 1e-9;
            // the component along the normal of the plane; of one that is inclined both
            const std::array along{std::abs(x[0] - (*gas.about)[0]), std::abs(x[1] - (*gas.about)[1])};
            for (std::size_t c = 0; c < 2; ++c)
                if (along[1 - c] > aligned * length &&
                    !std::ranges::binary_search(constraints, 2 * static_cast<std::size_t>(node) + c, {},
                                                &Constraint::dof))
                    problems.push_back(
                        {where, fmt::format("about: the wall ends at ({:.6g}, {:.6g}) m, on a plane of symmetry that "
                                            "nothing holds it to: a [[boundary]] must give its displacement along {}",
                                            x[0], x[1], c == 0 ? "x" : "y")});
        }
    }
    if (!problems.empty()) throw InputError(problems);
}

/// @throws InputError for gas that would change with time where there is none, and masses that nothing holds
void need_static_models(const CaseOptions& options) {
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < options.lumped.size(); ++i) {
        const LumpedOptions& model = options.lumped[i];
        if (model.kind == LumpedOptions::Kind::mass && !model.bonded && model.gap > 0 && model.ground_stiffness == 0)
            problems.push_back({fmt::format("[[lumped]] {}", i + 1),
                                "gap: nothing holds a mass that touches nothing, and a static solution has no way to "
                                "let it fall; give ground_stiffness, bonded = true, or no gap"});
        for (const auto& [given, key] : {std::pair(model.leak > 0, "leak"), {model.burn.has_value(), "burn"}})
            if (given)
                problems.push_back({fmt::format("[[lumped]] {}", i + 1),
                                    fmt::format("{}: has no meaning under integrator.type = \"{}\", whose time is that "
                                                "of the loads",
                                                key, options.integrator.type)});
    }
    if (!problems.empty()) throw InputError(problems);
}

/// @throws InputError if the scheme is made for what the case has not
void need_interactions(const CaseOptions& options) {
    if (options.integrator.type == "mri" && options.fracture.method == FractureOptions::Method::none &&
        options.contact.method == ContactOptions::Method::none)
        throw InputError("integrator.type",
                         "`mri` takes joints and contact in short steps, and there are neither: take `arkode`");
}

/// What is given and has no effect where nothing moves.
std::vector<std::string> warnings_of_statics(const CaseOptions& options) {
    std::vector<std::string> warnings;
    const auto idle = [&](bool given, const char* what) {
        if (given)
            warnings.push_back(
                fmt::format("{}: has no effect under integrator.type = \"{}\"", what, options.integrator.type));
    };
    idle(!options.initial.empty(), "initial");
    idle(options.run.mass_damping > 0, "run.mass_damping");
    idle(std::ranges::any_of(options.boundaries,
                             [](const auto& b) { return b.kind == BoundaryOptions::Kind::absorbing; }),
         "boundary with kind = \"absorbing\"");
    idle(std::ranges::any_of(options.materials,
                             [](const auto& m) { return m.shear_viscosity > 0 || m.bulk_viscosity > 0; }),
         "viscosity of a material");
    idle(std::ranges::any_of(options.lumped, [](const auto& l) { return l.velocity != 0 || l.damping > 0; }),
         "velocity or damping of a [[lumped]] mass");
    if (std::ranges::any_of(options.loads,
                            [](const auto& load) { return load.amplitude.kind == AmplitudeOptions::Kind::constant; }))
        warnings.push_back(
            "load with a constant amplitude: is there in full at the first load step; with a ramp it grows, "
            "and the energies balance");
    return warnings;
}

/// How far beyond the strength sides may open.
double overshoot_allowed(const CaseOptions& options) {
    constexpr double usual = 0.01;
    if (options.fracture.overshoot > 0) return options.fracture.overshoot;
    const std::set<std::string> short_steps{"central_difference", "verlet", "noh_bathe"};
    return short_steps.contains(options.integrator.type) ? 0 : usual;
}

}  // namespace

Case build_case(CaseOptions options) {
    Case built;
    MeshReport report;
    *built.mesh = make_mesh(options.mesh, options.solid.compt, {}, &report);
    for (const std::string& warning : report.warnings) built.warnings.push_back("mesh: " + warning);

    const bool cracks = options.fracture.method != FractureOptions::Method::none;
    const bool extrinsic = options.fracture.method == FractureOptions::Method::extrinsic;
    NamedSides named;
    std::vector<JointEdge> edges;
    if (cracks || !options.cracks.empty()) {
        built.inner = std::make_unique<InnerSides>(*built.mesh);
        named = named_sides(*built.mesh, *built.inner, options.cracks, options.interfaces, options.fracture.on);
        open_cracks(*built.mesh, *built.inner, named.cracked);
        if (cracks && !extrinsic) open_all_sides(*built.inner, named.bonded);
        // sides that open under way look up their properties by their numbers, those of all sides included
        std::vector<std::int32_t> without_joint;
        if (!extrinsic) std::ranges::set_union(named.cracked, named.bonded, std::back_inserter(without_joint));
        if (cracks) edges = all_edges(*built.mesh, *built.inner, without_joint);
    }

    std::vector<Problem> problems;
    SolidSystem::Parts parts;
    collect(problems, [&] { parts.blocks = make_blocks(*built.mesh, options.solid, options.materials); });
    const LoadCourses courses = find_courses(*built.mesh, options);
    parts.courses = courses.all();
    built.warnings.insert(built.warnings.end(), courses.warnings.begin(), courses.warnings.end());
    collect(problems,
            [&] { parts.terms = make_loads(*built.mesh, options.loads, options.solid.thickness, courses.loads); });
    collect(problems,
            [&] { parts.models = make_lumped(*built.mesh, options.lumped, options.solid.thickness, courses.lumped); });
    collect(problems,
            [&] { parts.constraints = make_constraints(*built.mesh, options.boundaries, courses.boundaries); });
    collect(problems, [&] { need_planes_of_symmetry(options, *built.mesh, parts.constraints.constraints()); });
    collect(problems, [&] { parts.initial_velocity = initial_velocity(*built.mesh, options.initial); });
    collect(problems, [&] {
        parts.damping.blocks = absorbing_damping(*built.mesh, options.boundaries,
                                                 stiffness_for_absorbing(*built.mesh, options.boundaries, parts.blocks),
                                                 options.solid.thickness);
    });
    std::unique_ptr<Joints> joints;
    std::vector<CohesionProperties<double>> properties;
    if (cracks && !parts.blocks.empty())
        collect(problems, [&] {
            properties = edge_properties(*built.mesh, edges, parts.blocks, options.materials, options.fracture,
                                         options.interfaces, named, built.warnings);
            if (extrinsic) {
                watch_strength(*built.mesh, edges, properties, parts.blocks, watch_reach(options.fracture.criterion));
                joints = make_extrinsic_joints(*built.inner, properties, options.solid.thickness);
            } else {
                joints =
                    make_cohesion(*built.mesh, edges, properties, options.fracture.method, options.solid.thickness);
                properties.clear();
            }
        });
    std::vector<std::unique_ptr<Interaction>> contacts;
    const Contact* contact = nullptr;
    Walls* walls = nullptr;
    if (options.contact.method != ContactOptions::Method::none && !parts.blocks.empty())
        collect(problems, [&] {
            const auto original_of = built.inner ? built.inner->original_of() : std::span<const std::int32_t>{};
            auto bodies = make_contact({*built.mesh, original_of, named.cracked}, parts.blocks, options.solid,
                                       options.contact, cracks);
            contact = bodies.get();
            contacts.push_back(std::move(bodies));
            if (options.walls.empty()) return;
            auto made = make_walls(*contact, options.walls, options.contact.friction);
            walls = made.get();
            contacts.push_back(std::move(made));
        });
    parts.damping.mass_proportional = options.run.mass_damping;
    collect(problems, [&] { built.integrator = make_integrator(options.integrator, contact != nullptr); });
    collect(problems, [&] { need_interactions(options); });
    collect(problems, [&] { built.probes = ProbeTable(*built.mesh, options.output.probes); });
    if (!problems.empty()) throw InputError(problems);
    if (joints) parts.interactions.push_back(std::move(joints));
    for (auto& one : contacts) parts.interactions.push_back(std::move(one));
    if (built.integrator->is_static()) {
        need_static_models(options);
        need_supports(options, *built.mesh, parts, contact, walls);
    }

    if (!cracks && std::ranges::any_of(options.materials, [](const auto& m) { return m.strength.has_value(); }))
        built.warnings.push_back("material.strength: has no effect without fracture.method");
    const bool searches = options.run.event_tolerance > 0;
    if (searches && !extrinsic && contact == nullptr)
        built.warnings.push_back(
            "run.event_tolerance: has no effect without fracture.method = extrinsic or contact: what is searched for "
            "are sides that open at their strength, and bodies that touch or part");
    if (built.integrator->is_static())
        for (const std::string& warning : warnings_of_statics(options)) built.warnings.push_back(warning);
    Joints* const cohesion = cracks ? static_cast<Joints*>(parts.interactions.front().get()) : nullptr;
    built.system = std::make_unique<SolidSystem>(*built.mesh, std::move(parts));
    const bool stressed = std::ranges::any_of(options.materials, [](const MaterialOptions& material) {
        return !std::ranges::all_of(material.in_situ_stress, &Formula::is_zero);
    });
    if (stressed) {
        const auto stress = stress_at_rest(*built.system);
        if (walls != nullptr) walls->preload(stress);
        if (cohesion != nullptr && !extrinsic)
            if (const std::size_t n = preload_joints(*cohesion, *built.inner, *built.system, stress); n > 0)
                built.warnings.push_back(
                    fmt::format("in_situ_stress: {} ends of joints start beyond their strength, and fail at once", n));
    }
    if (cohesion != nullptr) {
        Cracking::Parts parts_of_cracking{.mesh = *built.mesh,
                                          .inner = *built.inner,
                                          .solid = *built.system,
                                          .joints = *cohesion,
                                          .properties = std::move(properties),
                                          .criterion = options.fracture.criterion,
                                          .thickness = options.solid.thickness,
                                          .overshoot = overshoot_allowed(options),
                                          .come_apart = {},
                                          .surroundings = surroundings_of(*built.system, *built.mesh, options, courses),
                                          .loads_everywhere = std::ranges::any_of(options.loads, [](const auto& load) {
                                              return load.kind == LoadOptions::Kind::body_force;
                                          })};
        if (contact != nullptr)
            parts_of_cracking.come_apart = [&bodies = contact->bodies()](std::span<const std::int32_t> sides) {
                return bodies.come_apart(sides);
            };
        auto cracking = std::make_unique<Cracking>(std::move(parts_of_cracking));
        built.cracking = cracking.get();
        built.system->add_event(std::move(cracking));
    }
    if (searches && contact != nullptr) {
        auto touches = std::make_unique<Touches>(*contact, walls);
        built.touches = touches.get();
        built.system->add_event(std::move(touches));
    }
    built.layout = layout_fingerprint(*built.mesh, *built.system);
    for (const Constraint& constraint : built.system->constraints())
        built.held.push_back(static_cast<std::int64_t>(constraint.dof));
    built.reactions = ReactionTable(*built.mesh, options.boundaries, built.system->constraints());
    built.options = std::move(options);
    return built;
}

double memory_estimate(const Case& built) {
    const Layout layout = built.system->layout();
    // u, v, mass, inverse mass, a, next u, v, workspace; z and history twice
    constexpr double nodal_vectors = 9, memory_vectors = 2;
    double bytes = (nodal_vectors * static_cast<double>(layout.n_dof) +
                    memory_vectors * static_cast<double>(layout.n_internal + layout.n_history)) *
                   sizeof(double);
    for (const auto& block : built.system->elements().blocks())
        bytes += static_cast<double>(block->bytes_per_element()) * static_cast<double>(block->n_elements());
    bytes += static_cast<double>(built.mesh->n_elements()) * (built.mesh->nodes_per_element() * 4.0 + 12.0) +
             static_cast<double>(built.mesh->n_nodes()) * 24.0;
    return bytes;
}

}  // namespace gneiss
