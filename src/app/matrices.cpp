#include "app/matrices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "app/build_case.hpp"
#include "app/checkpoints.hpp"
#include "app/threads.hpp"
#include "integrators/prescribed_motion.hpp"
#include "io/deck/deck.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/matrix_market.hpp"
#include "io/output/version.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

/// The state that the deck starts from, or that of the checkpoint. No integrator starts: its matrices and factors would
/// stand beside those that are written, and some refuse a system that they do not suit.
State state_of(const RunArguments& arguments, const Case& built) {
    const SolidSystem& system = *built.system;
    State state = system.initial_state();
    if (arguments.restart) {
        RunProgress progress;
        load_checkpoint(*arguments.restart, built, state, progress);
        return state;
    }
    apply_due_events(system, state);
    PrescribedMotion motion;
    motion.bind(system, system.frequency_bound(state).omega);
    motion.hold(system, state, StartReason::fresh);
    if (built.integrator->is_static()) std::ranges::fill(state.v, 0.0);
    return state;
}

/// Rows of a matrix, and what stands beside it filled in.
struct Filled {
    MatrixPattern pattern;
    std::vector<double> values;
};
Filled filled(const MatrixPattern& pattern, const std::vector<double>& values, const LowRank& beside) {
    Filled all;
    all.pattern.row_starts.push_back(0);
    for (std::size_t row = 0; row + 1 < pattern.row_starts.size(); ++row) {
        std::map<std::int64_t, double> entries;
        for (auto k = static_cast<std::size_t>(pattern.row_starts[row]);
             k < static_cast<std::size_t>(pattern.row_starts[row + 1]); ++k)
            entries[pattern.columns[k]] = values[k];
        for (const auto& [factor, column] : beside.dyads)
            for (const auto& [at, value] : column)
                if (at == static_cast<std::int64_t>(row))
                    for (const auto& [other, more] : column) entries[other] += factor * value * more;
        for (const auto& [column, value] : entries) {
            all.pattern.columns.push_back(column);
            all.values.push_back(value);
        }
        all.pattern.row_starts.push_back(static_cast<std::int64_t>(all.values.size()));
    }
    return all;
}

nlohmann::ordered_json description(const RunArguments& arguments, const Case& built, const State& state) {
    nlohmann::ordered_json json;
    json["title"] = built.options.title;
    json["version"] = version_string();
    json["deck"] = fs::absolute(arguments.deck).string();
    if (!arguments.set.empty()) json["overrides"] = arguments.set;
    json["t_s"] = state.t;
    json["n_dof"] = state.u.size();
    json["dof_of_node"] =
        "2 node + component, nodes from 0, points of lumped masses behind them; the matrices count rows and columns "
        "from 1";
    json["symmetric"] = built.system->tangent()->symmetric();
    std::vector<std::size_t> constrained;
    for (const Constraint& constraint : built.system->constraints()) constrained.push_back(constraint.dof);
    json["constrained_dofs"] = constrained;
    json["nodes_m"] = built.mesh->nodes;
    auto& elements = json["elements"] = nlohmann::ordered_json::array();
    for (std::size_t e = 0; e < built.mesh->n_elements(); ++e)
        elements.push_back(
            std::vector(built.mesh->element(e), built.mesh->element(e) + built.mesh->nodes_per_element()));
    json["displacement_m"] = state.u;
    std::vector<double> force(state.u.size());
    built.system->force(state, Trial::of(state), force);
    json["force_N"] = force;
    return json;
}

}  // namespace

void write_matrices(const RunArguments& arguments) {
    use_threads(arguments.threads);
    const Case built = build_case(read_deck(arguments.deck, arguments.set));
    const State state = state_of(arguments, built);
    const fs::path out = arguments.out.empty() ? fs::path("results") / arguments.deck.stem() : arguments.out;
    make_folder(out);

    const Tangent& tangent = *built.system->tangent();
    const MatrixPattern pattern = tangent.pattern();
    std::vector<double> values(tangent.n_nonzero());
    const auto write = [&](const char* name, const Tangent::Factors& factors, const char* what) {
        tangent.assemble(state, Trial::of(state), factors, values);
        const LowRank beside = tangent.beside(state, Trial::of(state), factors);
        if (beside.empty()) {
            write_matrix_market(out / name, {pattern.row_starts, pattern.columns, values}, what);
        } else {
            const Filled all = filled(pattern, values, beside);
            write_matrix_market(out / name, {all.pattern.row_starts, all.pattern.columns, all.values}, what);
        }
    };
    write("stiffness.mtx", {.stiffness = 1}, "stiffness, -df/du, N/m");
    write("damping.mtx", {.damping = 1, .velocity = 1}, "damping, C - df/dv, N s/m");
    write("mass.mtx", {.mass = 1}, "lumped mass, kg");
    write_atomically(out / "system.json", description(arguments, built, state).dump() + '\n');
}

}  // namespace gneiss
