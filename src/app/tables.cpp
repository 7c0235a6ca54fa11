#include "app/tables.hpp"

#include <fmt/format.h>
#include <cmath>
#include <map>

#include "app/crack_frames.hpp"
#include "base/errors.hpp"
#include "mesh/sub_triangles.hpp"
#include "model/mesh_names.hpp"

namespace gneiss {

std::vector<CsvColumn> history_columns(bool cracks) {
    std::vector<CsvColumn> columns{{"t", "s"}, {"step"}, {"dt", "s"}};
    for (const char* energy :
         {"kinetic", "stored_material", "stress_power", "stored_contact", "stored_joints", "stored_models",
          "external_work", "support_work", "dissipated_damping", "dissipated_viscous", "dissipated_absorbing",
          "dissipated_friction", "dissipated_fracture", "dissipated_contact", "leaked", "dissipated_dampers",
          "splitting", "scheme", "left_over"})
        columns.push_back({energy, "J"});
    columns.push_back({"balance_error"});
    if (cracks) columns.insert(columns.end(), {{"cracked_length", "m"}, {"fragments"}, {"nodes"}});
    return columns;
}

void add_crack_columns(const Cracking& cracking, const State& state, std::vector<double>& row) {
    row.push_back(cracking.joints().cracked_length(cracking.history(state)));
    row.push_back(static_cast<double>(count_fragments(cracking, state)));
    row.push_back(static_cast<double>(cracking.mesh().n_nodes()));
}

void add_model_columns(const SolidSystem& system, std::vector<CsvColumn>& columns) {
    for (const auto& quantity : system.models().quantities(system.initial_state()))
        columns.push_back({quantity.name, quantity.unit});
}

void add_model_columns(const SolidSystem& system, const State& state, std::vector<double>& row) {
    for (const auto& quantity : system.models().quantities(state)) row.push_back(quantity.value);
}

std::vector<double> history_row(double t, std::size_t step, double dt, const EnergyLedger& ledger) {
    const StoredEnergies& stored = ledger.stored;
    const PathEnergies& path = ledger.path;
    return {t,
            static_cast<double>(step),
            dt,
            ledger.kinetic,
            stored.material,
            stored.stress_power,
            stored.contact,
            stored.joints,
            stored.models,
            path.external_work,
            path.support_work,
            path.damping,
            path.viscous,
            path.absorbing,
            path.friction,
            path.fracture,
            path.contact,
            path.leaked,
            path.dampers,
            path.splitting,
            ledger.scheme,
            ledger.left_over(),
            ledger.balance_error()};
}

std::vector<CsvColumn> step_columns(const Integrator& integrator) {
    std::vector<CsvColumn> columns{{"t", "s"}, {"dt", "s"}, {"rejected"}};
    for (const StepColumn& column : integrator.step_columns()) columns.push_back({column.name, column.unit});
    columns.push_back({"why_rejected"});
    return columns;
}

std::vector<double> step_row(const StepReport& step) {
    std::vector<double> row{step.t, step.dt, static_cast<double>(step.n_rejected)};
    row.insert(row.end(), step.numbers.begin(), step.numbers.end());
    return row;
}

ProbeTable::ProbeTable(const Mesh& mesh, const std::vector<ProbeOptions>& probes) : mesh_(&mesh) {
    std::vector<Problem> problems;
    for (const ProbeOptions& given : probes) {
        try {
            Probe probe{given.name, locate(mesh, given.at), given.about.has_value(), {1, 0}};
            if (given.about) {
                const double dx = given.at[0] - (*given.about)[0], dy = given.at[1] - (*given.about)[1];
                const double length = std::hypot(dx, dy);
                if (!(length > 0))
                    throw InputError("", "stands at the centre it is to be seen from: no radial direction");
                probe.direction = {dx / length, dy / length};
            }
            probes_.push_back(std::move(probe));
        } catch (const InputError& error) {
            for (const Problem& problem : error.problems())
                problems.push_back({fmt::format("output.probes `{}`", given.name), problem.message});
        }
    }
    if (!problems.empty()) throw InputError(problems);
}

std::vector<CsvColumn> ProbeTable::columns() const {
    std::vector<CsvColumn> columns{{"t", "s"}};
    for (const Probe& probe : probes_) {
        const auto add = [&](const char* quantity, const char* unit) {
            columns.push_back({probe.name + "." + quantity, unit});
        };
        for (const char* name : {"u_x", "u_y"}) add(name, "m");
        for (const char* name : {"v_x", "v_y"}) add(name, "m/s");
        for (const char* name : {"sigma_xx", "sigma_yy", "sigma_xy"}) add(name, "Pa");
        if (!probe.radial) continue;
        for (const char* name : {"u_r", "u_t"}) add(name, "m");
        for (const char* name : {"v_r", "v_t"}) add(name, "m/s");
        for (const char* name : {"sigma_rr", "sigma_tt", "sigma_rt"}) add(name, "Pa");
    }
    return columns;
}

ReactionTable::ReactionTable(const Mesh& mesh, const std::vector<BoundaryOptions>& boundaries,
                             std::span<const Constraint> constraints)
    : column_of_(constraints.size()) {
    std::map<std::size_t, std::size_t> column_of_dof;
    std::map<std::string, std::size_t> column_of_name;
    for (const BoundaryOptions& boundary : boundaries) {
        if (boundary.kind == BoundaryOptions::Kind::absorbing) continue;
        const std::vector<std::int32_t>& nodes = nodes_named(mesh, boundary.on);
        for (std::size_t component = 0; component < 2; ++component) {
            if (!boundary.value[component]) continue;
            const std::string name = boundary.on + (component == 0 ? ".R_x" : ".R_y");
            const auto [column, is_new] = column_of_name.try_emplace(name, columns_.size());
            if (is_new) columns_.push_back({name, "N"});
            for (const std::int32_t node : nodes)
                column_of_dof.try_emplace(2 * static_cast<std::size_t>(node) + component, column->second);
        }
    }
    for (std::size_t k = 0; k < constraints.size(); ++k) column_of_[k] = column_of_dof.at(constraints[k].dof);
}

std::vector<CsvColumn> ReactionTable::columns() const {
    std::vector<CsvColumn> columns{{"t", "s"}};
    columns.insert(columns.end(), columns_.begin(), columns_.end());
    return columns;
}

std::vector<double> ReactionTable::row(double t, std::span<const double> reactions) const {
    std::vector<double> row(columns_.size() + 1, 0.0);
    row[0] = t;
    for (std::size_t k = 0; k < reactions.size(); ++k) row[column_of_[k] + 1] += reactions[k];
    return row;
}

std::vector<double> ProbeTable::row(const SolidSystem& system, const State& state) const {
    std::vector<double> row{state.t};
    const auto at = [&](const std::vector<double>& nodal, const MeshPoint& point) {
        std::array<double, 2> value{0, 0};
        const auto nodes = triangle_nodes(*mesh_, static_cast<std::size_t>(point.element), point.sub_triangle);
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t c = 0; c < 2; ++c)
                value[c] += point.weights[k] * nodal[2 * static_cast<std::size_t>(nodes[k]) + c];
        return value;
    };
    for (const Probe& probe : probes_) {
        const auto u = at(state.u, probe.point), v = at(state.v, probe.point);
        const auto sigma =
            system.point_fields(state, probe.point.element)[static_cast<std::size_t>(probe.point.sub_triangle)].cauchy;
        row.insert(row.end(), {u[0], u[1], v[0], v[1], sigma[0], sigma[1], sigma[2]});
        if (!probe.radial) continue;
        const double c = probe.direction[0], s = probe.direction[1];
        row.insert(row.end(), {c * u[0] + s * u[1], c * u[1] - s * u[0], c * v[0] + s * v[1], c * v[1] - s * v[0],
                               c * c * sigma[0] + s * s * sigma[1] + 2 * s * c * sigma[2],
                               s * s * sigma[0] + c * c * sigma[1] - 2 * s * c * sigma[2],
                               s * c * (sigma[1] - sigma[0]) + (c * c - s * s) * sigma[2]});
    }
    return row;
}

}  // namespace gneiss
