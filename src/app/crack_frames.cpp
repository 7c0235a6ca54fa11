#include "app/crack_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gneiss {

Fragments find_fragments(const Cracking& cracking, const State& state) {
    const std::vector<bool> broken = cracking.broken_sides(state);
    return find_fragments(
        cracking.mesh(), cracking.inner(), [&](std::int32_t side) { return broken[static_cast<std::size_t>(side)]; },
        cracking.elements(), state);
}

std::size_t count_fragments(const Cracking& cracking, const State& state) {
    const std::vector<bool> broken = cracking.broken_sides(state);
    return count_fragments(cracking.mesh().n_elements(), cracking.inner(),
                           [&](std::int32_t side) { return broken[static_cast<std::size_t>(side)]; });
}

CrackFrames::CrackFrames(const std::filesystem::path& folder, const Cracking& cracking,
                         std::optional<double> restart_time, VtuData data)
    : cracking_(cracking),
      series_(folder, {}, restart_time, "cracks", data),
      fragments_(folder / "fragments.csv",
                 {{"t", "s"},
                  {"fragment"},
                  {"elements"},
                  {"mass", "kg"},
                  {"x", "m"},
                  {"y", "m"},
                  {"v_x", "m/s"},
                  {"v_y", "m/s"}},
                 restart_time) {}

void CrackFrames::write(const State& state, std::size_t step) {
    std::vector<std::array<double, 2>> points;
    std::vector<std::array<std::int32_t, 2>> lines;
    std::vector<std::int32_t> sides;
    std::vector<double> displacement, end_damage, end_opening, end_slip, end_fracture_i, end_fracture_ii;
    std::vector<double> end_tensile_strength, end_cohesion;
    std::vector<double> damage, opening, slip, mode, fracture, friction, failed_at, energy_i, energy_ii, penalty;
    const auto& nodes = cracking_.mesh().nodes;
    const auto history = cracking_.history(state);
    const auto mean = [](const std::array<double, 2>& ends) { return 0.5 * (ends[0] + ends[1]); };
    for (std::size_t joint = 0; joint < cracking_.joints().n_joints(); ++joint) {
        const JointState edge = cracking_.joints().state_of(joint, state, history);
        if (!(std::max(edge.damage[0], edge.damage[1]) > 0)) continue;
        const auto first = static_cast<std::int32_t>(points.size());
        lines.push_back({first, first + 1});
        for (std::size_t end = 0; end < 2; ++end) {
            const auto a = static_cast<std::size_t>(edge.nodes[end]), b = static_cast<std::size_t>(edge.nodes[end + 2]);
            points.push_back(nodes[a]);
            for (std::size_t c = 0; c < 2; ++c) displacement.push_back(0.5 * (state.u[2 * a + c] + state.u[2 * b + c]));
            end_damage.push_back(edge.damage[end]);
            end_opening.push_back(edge.opening[end]);
            end_slip.push_back(edge.slip[end]);
            end_fracture_i.push_back(edge.fracture_i[end]);
            end_fracture_ii.push_back(edge.fracture_ii[end]);
            end_tensile_strength.push_back(edge.properties[end].tensile_strength);
            end_cohesion.push_back(edge.properties[end].cohesion);
        }
        sides.push_back(edge.side);
        damage.push_back(std::min(edge.damage[0], edge.damage[1]));
        opening.push_back(mean(edge.opening));
        slip.push_back(mean(edge.slip));
        mode.push_back(edge.mode);
        fracture.push_back(mean(edge.fracture_i) + mean(edge.fracture_ii));
        friction.push_back(mean(edge.friction));
        failed_at.push_back(edge.failed_at > 0 ? edge.failed_at : std::numeric_limits<double>::quiet_NaN());
        energy_i.push_back(edge.properties[0].fracture_energy_i);
        energy_ii.push_back(edge.properties[0].fracture_energy_ii);
        penalty.push_back(edge.properties[0].penalty);
    }
    FieldMesh mesh;
    mesh.points = points;
    mesh.lines = lines;
    mesh.integers = {{"side", sides}};
    series_.set_mesh(mesh);
    series_.write(state.t, static_cast<std::int64_t>(step),
                  {{{"displacement", displacement, "m", 2},
                    {"end_damage", end_damage},
                    {"end_opening", end_opening, "m"},
                    {"end_slip", end_slip, "m"},
                    {"end_dissipated_fracture_i", end_fracture_i, "J/m2"},
                    {"end_dissipated_fracture_ii", end_fracture_ii, "J/m2"},
                    {"end_tensile_strength", end_tensile_strength, "Pa"},
                    {"end_cohesion", end_cohesion, "Pa"}},
                   {{"damage", damage},
                    {"opening", opening, "m"},
                    {"slip", slip, "m"},
                    {"mode", mode},
                    {"dissipated_fracture", fracture, "J/m2"},
                    {"dissipated_friction", friction, "J/m2"},
                    {"time_of_failure", failed_at, "s"},
                    {"fracture_energy_i", energy_i, "J/m2"},
                    {"fracture_energy_ii", energy_ii, "J/m2"},
                    {"penalty", penalty, "Pa/m"}}});

    if (fragments_.last_time() == state.t) return;
    const Fragments fragments = find_fragments(cracking_, state);
    for (std::size_t i = 0; i < fragments.all.size(); ++i) {
        const Fragment& f = fragments.all[i];
        const std::array<double, 8> row{state.t,
                                        static_cast<double>(i),
                                        static_cast<double>(f.n_elements),
                                        f.mass,
                                        f.centre.x,
                                        f.centre.y,
                                        f.velocity.x,
                                        f.velocity.y};
        fragments_.row(row);
    }
}

}  // namespace gneiss
