#include "model/initial_conditions.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "model/formula.hpp"
#include "model/mesh_names.hpp"
#include "model/problem_list.hpp"

namespace gneiss {
namespace {

std::string place(std::size_t entry) { return fmt::format("[[initial]] {}", entry + 1); }

std::string object(const InitialOptions& initial) {
    return initial.on.empty() ? "everything" : fmt::format("\"{}\"", initial.on);
}

std::vector<std::int32_t> nodes_meant(const Mesh& mesh, const std::string& on) {
    if (!on.empty()) return region_or_nodes_named(mesh, on);
    std::vector<std::int32_t> all(mesh.n_nodes());
    std::iota(all.begin(), all.end(), 0);
    return all;
}

}  // namespace

std::vector<double> initial_velocity(const Mesh& mesh, const std::vector<InitialOptions>& options) {
    ProblemList problems;
    std::vector<double> velocity(2 * mesh.n_nodes(), 0.0);
    std::vector<std::optional<std::size_t>> given_by(mesh.n_nodes());
    std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, std::size_t>> disagreements;

    for (std::size_t i = 0; i < options.size(); ++i) {
        std::vector<std::int32_t> nodes;
        std::optional<CompiledFormula> v_x, v_y;
        bool sound = problems.attempt(place(i), [&] { nodes = nodes_meant(mesh, options[i].on); });
        sound &= problems.attempt(place(i), [&] { v_x.emplace(options[i].velocity[0], "xy"); });
        sound &= problems.attempt(place(i), [&] { v_y.emplace(options[i].velocity[1], "xy"); });
        if (!sound) continue;
        problems.attempt(place(i), [&] {
            for (std::int32_t number : nodes) {
                const auto node = static_cast<std::size_t>(number);
                const auto& x = mesh.nodes[node];
                const double vx = (*v_x)(x[0], x[1]), vy = (*v_y)(x[0], x[1]);
                if (!given_by[node]) {
                    given_by[node] = i;
                    velocity[2 * node] = vx;
                    velocity[2 * node + 1] = vy;
                } else if (velocity[2 * node] != vx || velocity[2 * node + 1] != vy) {
                    auto& [n, example] = disagreements[{*given_by[node], i}];
                    if (n++ == 0) example = node;
                }
            }
        });
    }
    for (const auto& [pair, found] : disagreements) {
        const auto& [first, second] = pair;
        const auto& [n, node] = found;
        problems.add(
            place(second),
            fmt::format("on {} gives another velocity than {} on {} at {} node{}: node {} at ({}, {})",
                        object(options[second]), place(first), object(options[first]), n, n == 1 ? "" : "s, among them",
                        mesh.node_labels[node], mesh.nodes[node][0], mesh.nodes[node][1]));
    }
    problems.throw_if_any();
    return velocity;
}

}  // namespace gneiss
