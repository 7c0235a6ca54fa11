#include "app/plausibility.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "app/make_integrator.hpp"
#include "app/plausible_loads.hpp"
#include "app/schedule.hpp"
#include "base/errors.hpp"
#include "fracture/cohesion_properties.hpp"
#include "mesh/measure.hpp"
#include "model/formula.hpp"
#include "model/make_blocks.hpp"
#include "model/mesh_names.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Strains of this order are rare on purpose; a unit that is wrong by a thousand is far above.
constexpr double large_load = 0.1;
/// Strengths of rock, concrete, glass, steel are 1e-5 to 1e-2 of their moduli, of weak soil 1e-6.
constexpr double small_strength = 1e-7;
constexpr double strength_in_pascals = 1e4;  ///< strengths in MPa are below, those of clay in Pa are not
constexpr double few_steps = 10;
constexpr double light = 100, heavy = 3e4;  ///< kg/m3: foams are lighter, osmium is 2.26e4
constexpr double dimensionless = 1;         ///< density of those who scale their equations
constexpr double full_turn = 2 * std::numbers::pi;
constexpr double steep_friction = 2;                        ///< tangent of 63 degrees
constexpr std::array<double, 2> plain_gravity{9.7, 10.01};  ///< m/s2, as they write it
/// Of the largest stress in situ: constant stress is balanced to round-off, one that grows with depth but for what a
/// mesh of ten elements does not resolve.
constexpr double out_of_balance = 0.1;
constexpr std::size_t most_samples = 2000;  ///< elements of a material of which speeds are found

constexpr std::string_view prefix = "plausibility: ";

struct Inspection {
    Inspection(const Case& built, fs::path folder);

    void waves();
    void strengths();
    void loads();
    void steps();
    void numbers_of_materials();
    void gravity();
    void stress_in_situ();
    void faces_of_cracks();
    void absorbing();
    void output();

    template <class... Args>
    void fact(std::string name, fmt::format_string<Args...> text, Args&&... args) {
        found.facts.emplace_back(std::move(name), fmt::format(text, std::forward<Args>(args)...));
    }
    template <class... Args>
    void warn(fmt::format_string<Args...> text, Args&&... args) {
        found.warnings.push_back(std::string(prefix) + fmt::format(text, std::forward<Args>(args)...));
    }
    std::string name_of_material(std::size_t m) const {
        const auto& regions = options.materials[m].regions;
        return fmt::format("[[material]] {}{}", m + 1,
                           regions.empty() ? "" : fmt::format(" ({})", fmt::join(regions, ", ")));
    }

    const Case& built;
    const CaseOptions& options;
    const Mesh& mesh;
    fs::path folder;
    MeshSize size;
    double width = 0, height = 0;            ///< of the mesh, m
    std::vector<PlaneStiffness> stiffness;   ///< of each element
    std::vector<std::int32_t> material_of;   ///< of each element
    std::vector<double> modulus;             ///< largest one at each node, Pa
    double fastest = 0, slowest = infinity;  ///< speeds of waves in the whole solid, m/s
    std::vector<double> material_modulus;    ///< largest one of each material, Pa
    Plausibility found;
};

double largest_modulus(const PlaneStiffness& of) { return std::max(of.C_aaaa, of.C_bbbb); }

Inspection::Inspection(const Case& case_, fs::path where)
    : built(case_),
      options(case_.options),
      mesh(*case_.mesh),
      folder(std::move(where)),
      size(mesh_size(mesh)),
      stiffness(element_stiffness(mesh, case_.system->elements().blocks())),
      material_of(material_of_elements(mesh, options.materials)),
      modulus(mesh.n_nodes(), 0.0),
      material_modulus(options.materials.size(), 0.0) {
    std::array low{infinity, infinity}, high{-infinity, -infinity};
    for (const auto& node : mesh.nodes)
        for (std::size_t c = 0; c < 2; ++c) {
            low[c] = std::min(low[c], node[c]);
            high[c] = std::max(high[c], node[c]);
        }
    width = high[0] - low[0];
    height = high[1] - low[1];
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        const double m = largest_modulus(stiffness[e]);
        for (int k = 0; k < mesh.nodes_per_element(); ++k) {
            double& at_node = modulus[static_cast<std::size_t>(mesh.element(e)[k])];
            at_node = std::max(at_node, m);
        }
        double& of_material = material_modulus[static_cast<std::size_t>(material_of[e])];
        of_material = std::max(of_material, m);
    }
}

void Inspection::waves() {
    constexpr int n_directions = 18;
    const std::size_t every = 1 + mesh.n_elements() / most_samples;
    std::vector<std::array<double, 4>> speeds(options.materials.size(), {infinity, 0, infinity, 0});
    for (std::size_t e = 0; e < mesh.n_elements(); e += every) {
        auto& [s_low, s_high, p_low, p_high] = speeds[static_cast<std::size_t>(material_of[e])];
        for (int i = 0; i < n_directions; ++i) {
            const double angle = std::numbers::pi * i / n_directions;
            const auto [p, s] = plane_waves(stiffness[e], {std::cos(angle), std::sin(angle)});
            p_low = std::min(p_low, p.phase_speed);
            p_high = std::max(p_high, p.phase_speed);
            s_low = std::min(s_low, s.phase_speed);
            s_high = std::max(s_high, s.phase_speed);
        }
    }
    const auto range = [](double low, double high) {
        constexpr double same = 1e-6;
        return high - low < same * high ? fmt::format("{:.4g}", high) : fmt::format("{:.4g} to {:.4g}", low, high);
    };
    for (std::size_t m = 0; m < speeds.size(); ++m) {
        const auto& [s_low, s_high, p_low, p_high] = speeds[m];
        if (p_high == 0) continue;  // of no element, or of none that was looked at
        fact("waves", "{}: c_P {} m/s, c_S {} m/s", name_of_material(m), range(p_low, p_high), range(s_low, s_high));
        fastest = std::max(fastest, p_high);
        slowest = std::min(slowest, s_low);
    }
    const double crossing = std::max(width, height) / fastest;
    fact("size", "{:.4g} x {:.4g} m; the fastest wave crosses it in {:.3g} s{}", width, height, crossing,
         built.integrator->is_static() ? "" : fmt::format(", {:.3g} times in the run", options.run.t_end / crossing));
    const double speed = largest_prescribed_speed(built);
    if (speed > fastest && !built.integrator->is_static()) {
        warn("a velocity of {:.4g} m/s is prescribed, waves run at {:.4g} m/s at most: are moduli in Pa, lengths in m?",
             speed, fastest);
        found.overload = found.warnings.back().substr(prefix.size());
    }
}

void Inspection::loads() {
    for (const LoadPeak& peak : load_peaks(built, modulus, std::max(width, height), size.smallest_edge)) {
        if (peak.stress == 0) continue;
        fact("load", "{}: {}, {:.2g} of the modulus there, {:.4g} Pa", peak.name, peak.value, peak.over_modulus,
             peak.modulus);
        if (peak.over_modulus > large_load) {
            warn(
                "{}: {} at ({:.4g}, {:.4g}) m is {:.2g} of the modulus there, {:.4g} Pa: are moduli and loads in Pa, "
                "lengths in m?",
                peak.name, peak.value, peak.x, peak.y, peak.over_modulus, peak.modulus);
            if (found.overload.empty()) found.overload = found.warnings.back().substr(prefix.size());
        }
        if (peak.shortest_time > 0 && !built.integrator->is_static()) {
            const double length = 2 * peak.shortest_time * slowest;  // half a period
            fact("wavelength",
                 "{}: {:.3g} s from trough to crest, {:.3g} m of the slowest wave, {:.3g} edges of {:.3g} m", peak.name,
                 peak.shortest_time, length, length / size.largest_edge, size.largest_edge);
        }
    }
}

void Inspection::steps() {
    const IntegratorOptions& integrator = options.integrator;
    if (built.integrator->is_static() || integrator.adaptive) return;
    double dt = integrator.dt;
    if (dt == 0 && has_critical_step(integrator))
        dt = integrator.safety * 2 / built.system->frequency_bound(built.system->initial_state()).omega;
    if (dt > 0 && options.run.t_end < few_steps * dt)
        warn(
            "run.t_end, {:.4g} s, is no more than {:.2g} steps of {:.4g} s; the fastest wave crosses the "
            "mesh of {:.4g} x {:.4g} m "
            "in "
            "{:.3g} s: are lengths in m, times in s, densities in kg/m3?",
            options.run.t_end, options.run.t_end / dt, dt, width, height, std::max(width, height) / fastest);
}

void Inspection::numbers_of_materials() {
    for (std::size_t m = 0; m < options.materials.size(); ++m) {
        const MaterialOptions& material = options.materials[m];
        if (material.density != dimensionless && (material.density < light || material.density > heavy))
            warn("{}: a density of {:.4g} kg/m3: water has 1000, rock 2000 to 3500, steel 7850", name_of_material(m),
                 material.density);
        if (material.axes.kind == AxesOptions::Kind::angle) try {
                const CompiledFormula angle(material.axes.angle, "xy");
                double largest = 0;
                const auto centroids = element_centroids(mesh);
                for (std::size_t e = 0; e < mesh.n_elements(); ++e)
                    if (material_of[e] == static_cast<std::int32_t>(m))
                        largest = std::max(largest, std::abs(angle(centroids[e][0], centroids[e][1])));
                if (largest > full_turn)
                    warn(
                        "{}: axes turned by up to {:.4g} rad, more than a full turn: angles are in radians, {:.4g} "
                        "degrees are {:.4g}",
                        name_of_material(m), largest, largest, largest * std::numbers::pi / 180);
            } catch (const InputError&) {
                // blocks have been made from it: not reached
            }
    }
    if (options.contact.friction > steep_friction)
        warn("contact.friction: {:.4g} is the tangent of {:.3g} degrees; that of {:.4g} degrees is {:.4g}",
             options.contact.friction, std::atan(options.contact.friction) * 180 / std::numbers::pi,
             options.contact.friction, std::tan(options.contact.friction * std::numbers::pi / 180));
}

void Inspection::strengths() {
    for (std::size_t m = 0; m < options.materials.size(); ++m) {
        const auto& strength = options.materials[m].strength;
        if (!strength || material_modulus[m] == 0) continue;
        const double tensile = std::ranges::min(strength->tensile), E = material_modulus[m];
        const double length = cohesion_length(std::ranges::min(strength->fracture_energy_i), E, tensile);
        if (options.fracture.method != FractureOptions::Method::none)
            fact("strength",
                 "{}: tensile {:.4g} Pa, {:.2g} of the modulus; a crack softens over {:.3g} m, {:.3g} edges "
                 "of {:.3g} m",
                 name_of_material(m), tensile, tensile / E, length, length / size.largest_edge, size.largest_edge);
        if (tensile < small_strength * E && tensile < strength_in_pascals)
            warn("{}: a tensile strength of {:.4g} Pa is {:.2g} of the modulus, {:.4g} Pa: are both in Pa?",
                 name_of_material(m), tensile, tensile / E, E);
        const double friction =
            std::max(std::ranges::max(strength->friction), std::ranges::max(strength->residual_friction));
        if (friction > steep_friction)
            warn("{} strength: friction {:.4g} is the tangent of {:.3g} degrees; that of {:.4g} degrees is {:.4g}",
                 name_of_material(m), friction, std::atan(friction) * 180 / std::numbers::pi, friction,
                 std::tan(friction * std::numbers::pi / 180));
    }
}

void Inspection::gravity() {
    for (std::size_t i = 0; i < options.loads.size(); ++i) {
        const LoadOptions& load = options.loads[i];
        if (load.kind != LoadOptions::Kind::body_force) continue;
        const auto plain = [&](const Formula& value) {
            return value.constant && std::abs(*value.constant) >= plain_gravity[0] &&
                   std::abs(*value.constant) <= plain_gravity[1];
        };
        const bool heavy_enough = std::ranges::any_of(
            options.materials, [](const MaterialOptions& material) { return material.density >= light; });
        for (const Formula& value : load.value)
            if (plain(value) && heavy_enough)
                warn(
                    "[[load]] {}: a body force of {} N/m3 is per volume; the weight is density times gravity, {:.6g} "
                    "N/m3 for {:.4g} kg/m3",
                    i + 1, value.text, *value.constant * options.materials.front().density,
                    options.materials.front().density);
    }
}

/// Force of the start at every node, of stress, loads and gas; those of all nodes at one place add up at each of them.
/// Zero where motion is prescribed.
/// @param place  number of each node's place
std::vector<Vec2<double>> unbalanced_forces(const Case& built, std::span<const std::int32_t> place) {
    const SolidSystem& system = *built.system;
    const State state = system.initial_state();
    Trial trial = Trial::of(state);
    trial.last_event = 0;  // what is switched on at t = 0 is there
    std::vector<double> f(state.u.size()), loads(state.u.size());
    system.elements().force(state, trial, f);
    system.external_force(trial, loads);
    system.models().add_force(state, trial, loads, {});
    const auto at = [&place](std::size_t node) { return static_cast<std::size_t>(place[node]); };
    std::vector<Vec2<double>> sums(place.size(), {0, 0}), forces(place.size(), {0, 0});
    for (std::size_t node = 0; node < place.size(); ++node)
        sums[at(node)] += {f[2 * node] + loads[2 * node], f[2 * node + 1] + loads[2 * node + 1]};
    for (const Constraint& constraint : system.constraints())
        if (constraint.dof < 2 * place.size())
            (constraint.dof % 2 == 0 ? sums[at(constraint.dof / 2)].x : sums[at(constraint.dof / 2)].y) = 0;
    for (std::size_t node = 0; node < place.size(); ++node) forces[node] = sums[at(node)];
    return forces;
}

void Inspection::stress_in_situ() {
    double stress = 0;
    const auto centroids = element_centroids(mesh);
    // by how much a stress varies within elements, which have one value each: what that leaves at their nodes is no
    // fault
    std::vector<double> varies(mesh.n_nodes(), 0.0);
    for (std::size_t m = 0; m < options.materials.size(); ++m) {
        const auto& given = options.materials[m].in_situ_stress;
        if (std::ranges::all_of(given, &Formula::is_zero)) continue;
        for (const Formula& part : given) {
            const CompiledFormula value(part, "xy");
            for (std::size_t e = 0; e < mesh.n_elements(); ++e)
                if (material_of[e] == static_cast<std::int32_t>(m)) {
                    const double inside = value(centroids[e][0], centroids[e][1]);
                    stress = std::max(stress, std::abs(inside));
                    const std::span nodes(mesh.element(e), static_cast<std::size_t>(mesh.nodes_per_element()));
                    double most = 0;
                    for (const std::int32_t node : nodes) {
                        const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
                        most = std::max(most, std::abs(value(x[0], x[1]) - inside));
                    }
                    for (const std::int32_t node : nodes)
                        varies[static_cast<std::size_t>(node)] = std::max(varies[static_cast<std::size_t>(node)], most);
                }
        }
    }
    if (stress == 0 || !options.walls.empty()) return;  // what walls carry shows under way alone
    std::vector<std::int32_t> place(mesh.n_nodes());
    std::iota(place.begin(), place.end(), 0);
    if (built.inner) std::ranges::copy(built.inner->original_of(), place.begin());
    const std::vector<Vec2<double>> forces = unbalanced_forces(built, place);
    const std::vector<double> areas = element_areas(mesh);
    std::vector<double> area_at(mesh.n_nodes(), 0.0);
    const int n = mesh.nodes_per_element();
    const auto at = [&place](std::size_t node) { return static_cast<std::size_t>(place[node]); };
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (int k = 0; k < n; ++k) area_at[at(static_cast<std::size_t>(mesh.element(e)[k]))] += areas[e] / n;
    double worst = 0;
    std::size_t where = 0;
    Vec2<double> sum{0, 0};  // in which what single elements leave cancels
    for (std::size_t node = 0; node < mesh.n_nodes(); ++node) {
        if (at(node) == node) sum += forces[node];
        const double traction =
            std::hypot(forces[node].x, forces[node].y) / (options.solid.thickness * std::sqrt(area_at[at(node)])) -
            2 * varies[node];
        if (traction > worst) {
            worst = traction;
            where = node;
        }
    }
    const double in_all = std::hypot(sum.x, sum.y) / (options.solid.thickness * std::max(width, height));
    if (worst < out_of_balance * stress && in_all > 3 * out_of_balance * stress) {
        warn(
            "in_situ_stress of up to {:.4g} Pa is out of balance at the start: forces of {:.3g} N in x and {:.3g} N in "
            "y in all have nothing to match them: is a weight missing?",
            stress, sum.x, sum.y);
        return;
    }
    if (worst < out_of_balance * stress) return;
    std::string on = "inside";
    for (const auto& [name, nodes] : mesh.node_sets)
        if (std::ranges::binary_search(nodes, static_cast<std::int32_t>(where)) && mesh.boundaries.contains(name))
            on = fmt::format("on `{}`", name);
    warn(
        "in_situ_stress of up to {:.4g} Pa is out of balance at the start, by some {:.2g} Pa at ({:.4g}, {:.4g}) m {}: "
        "no traction, support or weight matches it there. Sound where a cavity is opened at once",
        stress, worst, mesh.nodes[where][0], mesh.nodes[where][1], on);
}

void Inspection::faces_of_cracks() {
    const bool cracks = options.fracture.method != FractureOptions::Method::none || !options.cracks.empty();
    if (!cracks || options.contact.method != ContactOptions::Method::none) return;
    const auto compressive = [](const Formula& part) { return part.constant && *part.constant < 0; };
    const bool pressed =
        std::ranges::any_of(options.loads,
                            [](const LoadOptions& load) {
                                return load.kind == LoadOptions::Kind::pressure && load.value[0].constant &&
                                       *load.value[0].constant > 0;
                            }) ||
        std::ranges::any_of(options.lumped, [](const LumpedOptions& model) { return !model.bonded; }) ||
        std::ranges::any_of(options.materials, [&](const MaterialOptions& material) {
            return compressive(material.in_situ_stress[0]) || compressive(material.in_situ_stress[1]);
        });
    fact("cracks", "no contact: faces that close pass through each other");
    if (pressed)
        warn(
            "cracks without contact in a solid that is pressed: faces that close pass through each other, [contact] "
            "keeps them apart");
}

void Inspection::absorbing() {
    const auto held = [this](std::int32_t node, std::size_t c) {
        return std::ranges::binary_search(built.system->constraints(), 2 * static_cast<std::size_t>(node) + c, {},
                                          &Constraint::dof);
    };
    for (std::size_t i = 0; i < options.boundaries.size(); ++i) {
        const BoundaryOptions& boundary = options.boundaries[i];
        if (boundary.kind != BoundaryOptions::Kind::absorbing) continue;
        if (std::ranges::all_of(nodes_named(mesh, boundary.on),
                                [&](std::int32_t node) { return held(node, 0) && held(node, 1); }))
            warn("[[boundary]] {}: nothing is absorbed on \"{}\", another [[boundary]] gives its motion in x and y",
                 i + 1, boundary.on);
    }
}

void Inspection::output() {
    const double t_end = options.run.t_end;
    for (const auto& [key, interval] :
         {std::pair("output.fields", options.output.fields), std::pair("output.history", options.output.history),
          std::pair("output.states", options.output.states), std::pair("run.checkpoint", options.run.checkpoint)})
        if (interval > t_end)
            warn("{}: an interval of {:.4g} s is longer than the run, {:.4g} s", key, interval, t_end);
    constexpr double many_rows = 1e6;  // hundreds of MB of a table; what was meant is a row for each step
    if (const double rows = t_end / options.output.history;
        options.output.history > 0 && !options.output.rows_at_steps && rows > many_rows)
        warn(
            "output.history: {:.2g} rows, each at its own time, make as many steps; `rows = \"steps\"` has at most a "
            "row for a step",
            rows);

    // columns of field_frames, before they are compressed; a state has displacement, velocity and stress
    constexpr double per_node = 8 * (3 + 3 + 3 + 1), per_triangle = 8 * (6 + 4 + 4 + 3 + 3) + 4 * (3 + 1) + 1 + 2 * 4,
                     per_state = 8 * 4;
    const double triangles = static_cast<double>(mesh.n_elements()) * (mesh.nodes_per_element() == 3 ? 1 : 4);
    const double frame = per_node * static_cast<double>(mesh.n_nodes()) + per_triangle * triangles;
    const double n_frames = Schedule(options, built.integrator->interpolates()).most_frames();
    const double n_states = options.output.states > 0 ? t_end / options.output.states : 0;
    const double all = n_frames * frame + n_states * per_state * static_cast<double>(mesh.n_nodes());
    fs::path there = fs::absolute(folder);
    while (!fs::exists(there) && there.has_relative_path()) there = there.parent_path();
    std::error_code error;
    const auto space = fs::space(there, error);
    fact("disk", "{:.0f} frames of at most {:.3g} MB, {:.3g} GB in all{}", n_frames, frame / 1e6, all / 1e9,
         error ? "" : fmt::format("; {:.3g} GB are free", static_cast<double>(space.available) / 1e9));
    if (!error && all > static_cast<double>(space.available))
        warn("fields and states may take {:.3g} GB, {} has {:.3g} GB left", all / 1e9, there.string(),
             static_cast<double>(space.available) / 1e9);
}

}  // namespace

Plausibility plausibility(const Case& built, const fs::path& folder) {
    Inspection look(built, folder);
    look.waves();
    look.loads();
    look.strengths();
    look.numbers_of_materials();
    look.gravity();
    look.stress_in_situ();
    look.faces_of_cracks();
    look.steps();
    look.absorbing();
    look.output();
    return std::move(look.found);
}

}  // namespace gneiss
