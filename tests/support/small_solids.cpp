#include "support/small_solids.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace gneiss::test {

void distort(Mesh& mesh, double sub_edge, double part, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-part * sub_edge, part * sub_edge);
    std::vector<bool> outer(mesh.n_nodes(), false);
    for (const std::int32_t node : mesh.node_sets.at("outer")) outer[static_cast<std::size_t>(node)] = true;
    for (std::size_t node = 0; node < mesh.n_nodes(); ++node) {
        if (outer[node]) continue;
        mesh.nodes[node][0] += uniform(random);
        mesh.nodes[node][1] += uniform(random);
    }
}

Mesh rectangle(bool compt, double width, double height, std::array<int, 2> cells, MeshOptions::Pattern pattern) {
    MeshOptions options;
    options.width = width;
    options.height = height;
    options.cells = cells;
    options.pattern = pattern;
    return make_mesh(options, compt, {});
}

Mesh graded(bool compt, std::array<int, 2> cells, double narrowest, double growth, double height) {
    Mesh mesh = rectangle(compt, cells[0], height, cells);
    std::vector<double> lines{0.0};
    for (int column = 0; column < cells[0]; ++column)
        lines.push_back(lines.back() + narrowest * std::pow(growth, column));
    for (auto& node : mesh.nodes) {
        const auto column = static_cast<std::size_t>(std::min(std::floor(node[0]), cells[0] - 1.0));
        node[0] = lines[column] + (node[0] - static_cast<double>(column)) * (lines[column + 1] - lines[column]);
    }
    return mesh;
}

MaterialOptions rock(double axis_angle) {
    MaterialOptions material;
    material.density = 1000;
    material.constants = {0.267e9, 0.8e9, 1.6e9, 0.8e9};
    material.axes.angle = axis_angle;
    return material;
}

Solid make_solid(Mesh mesh, const SolidDescription& what, const std::function<void(SolidSystem::Parts&)>& add) {
    Solid solid{std::move(mesh), nullptr};
    SolidSystem::Parts parts;
    parts.blocks = make_blocks(solid.mesh, what.solid, what.materials);
    parts.terms = make_loads(solid.mesh, what.loads, what.solid.thickness);
    parts.models = make_lumped(solid.mesh, what.lumped, what.solid.thickness);
    parts.constraints = make_constraints(solid.mesh, what.boundaries);
    parts.initial_velocity = initial_velocity(solid.mesh, what.initial);
    parts.damping.mass_proportional = what.mass_damping;
    const auto edges = absorbing_edges(solid.mesh, what.boundaries);
    if (!edges.empty()) {
        const std::vector<PlaneStiffness> stiffness = element_stiffness(solid.mesh, parts.blocks);
        parts.damping.blocks = absorbing_blocks(
            solid.mesh, edges, [&](int element) { return stiffness[static_cast<std::size_t>(element)]; },
            what.solid.thickness);
    }
    if (add) add(parts);
    solid.system = std::make_unique<SolidSystem>(solid.mesh, std::move(parts));
    return solid;
}

Solid distorted_solid(bool compt, const SolidDescription& what) {
    Mesh mesh = rectangle(compt, 2, 1, {3, 2});
    distort(mesh, 0.25, 0.25, 3);
    return make_solid(std::move(mesh), what);
}

Eigen::MatrixXd dense(const SparsePattern& pattern, std::span<const double> values) {
    const auto n = static_cast<Eigen::Index>(pattern.n());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index row = 0; row < n; ++row)
        for (auto k = pattern.row_starts[static_cast<std::size_t>(row)];
             k < pattern.row_starts[static_cast<std::size_t>(row) + 1]; ++k)
            matrix(row, pattern.columns[static_cast<std::size_t>(k)]) = values[static_cast<std::size_t>(k)];
    return matrix;
}

Eigen::MatrixXd dense(const Tangent& tangent, const State& accepted, const Trial& trial,
                      const Tangent::Factors& factors) {
    const MatrixPattern pattern = tangent.pattern();
    std::vector<double> values(tangent.n_nonzero(), 1e300);
    tangent.assemble(accepted, trial, factors, values);
    Eigen::MatrixXd matrix = dense({pattern.row_starts, pattern.columns}, values);
    for (const auto& [factor, column] : tangent.beside(accepted, trial, factors).dyads)
        for (const auto& [row, a] : column)
            for (const auto& [other, b] : column) matrix(row, other) += factor * a * b;
    return matrix;
}

Eigen::MatrixXd dense_stiffness(const SemiDiscrete& system, const State& state) {
    const auto n = static_cast<Eigen::Index>(state.u.size());
    const double size = 1e-6 * system.smallest_length();
    Eigen::MatrixXd stiffness(n, n);
    std::vector<double> u = state.u, plus(u.size()), minus(u.size());
    for (Eigen::Index j = 0; j < n; ++j) {
        const auto dof = static_cast<std::size_t>(j);
        u[dof] = state.u[dof] + size;
        system.force(state, {state.t, state.last_event, u, state.v, {}}, plus);
        u[dof] = state.u[dof] - size;
        system.force(state, {state.t, state.last_event, u, state.v, {}}, minus);
        u[dof] = state.u[dof];
        for (Eigen::Index i = 0; i < n; ++i)
            stiffness(i, j) = (minus[static_cast<std::size_t>(i)] - plus[static_cast<std::size_t>(i)]) / (2 * size);
    }
    return stiffness;
}

Eigen::VectorXd dense_frequencies(const SemiDiscrete& system, const State& state) {
    const Eigen::MatrixXd stiffness = dense_stiffness(system, state);
    const auto mass = system.lumped_mass();
    const Eigen::VectorXd scale = Eigen::Map<const Eigen::VectorXd>(mass.data(), static_cast<Eigen::Index>(mass.size()))
                                      .cwiseSqrt()
                                      .cwiseInverse();
    const Eigen::MatrixXd symmetric =
        0.5 * scale.asDiagonal() * (stiffness + stiffness.transpose()) * scale.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

}  // namespace gneiss::test
