#include "contact/make_contact.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "mesh/boundary.hpp"
#include "mesh/sub_triangles.hpp"
#include "model/make_blocks.hpp"

namespace gneiss {
namespace {

constexpr std::size_t most_named = 10;

/// Of each element, m/Pa: its size, the side of an equilateral triangle of the area of one of its triangles, over its
/// stiffness, the largest of rho c^2 over all directions.
std::vector<double> layers_of(const Mesh& mesh, std::span<const std::unique_ptr<ElementBlock>> blocks, double factor) {
    const std::vector<PlaneStiffness> stiffness = element_stiffness(mesh, blocks);
    std::vector<double> layers;
    const auto n_sub = static_cast<int>(sub_triangles(mesh.kind).size());
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        double area = std::numeric_limits<double>::infinity();
        for (int sub = 0; sub < n_sub; ++sub) {
            const auto [i, j, k] = triangle_nodes(mesh, e, sub);
            const auto at = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
            area = std::min(area, std::abs(triangle_area(at(i), at(j), at(k))));
        }
        layers.push_back(std::sqrt(4 * area / std::sqrt(3.0)) /
                         (factor * std::max(stiffness[e].C_aaaa, stiffness[e].C_bbbb)));
    }
    return layers;
}

/// PartedMesh::masses.
std::vector<double> masses_of(const Mesh& mesh, std::span<const std::unique_ptr<ElementBlock>> blocks) {
    const auto n = static_cast<std::size_t>(mesh.nodes_per_element());
    std::vector<double> masses(mesh.connectivity.size()), own(2 * mesh.n_nodes(), 0.0);
    for (const auto& block : blocks)
        for (std::size_t local = 0; local < block->n_elements(); ++local) {
            block->add_mass(local, own);
            const auto e = static_cast<std::size_t>(block->element(local));
            for (std::size_t k = 0; k < n; ++k) {
                const std::size_t x = 2 * static_cast<std::size_t>(mesh.element(e)[k]);
                masses[n * e + k] = own[x];
                own[x] = own[x + 1] = 0;
            }
        }
    return masses;
}

double shortest_edge(const Mesh& mesh) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const BoundaryEdge& edge : contour(mesh))
        shortest = std::min(shortest, distance(mesh.nodes[static_cast<std::size_t>(edge.a)],
                                               mesh.nodes[static_cast<std::size_t>(edge.b)]));
    return shortest;
}

void refuse_overlaps(const Contact& contact) {
    const std::vector<double> at_rest(2 * contact.bodies().n_mesh_nodes(), 0.0);
    const auto overlaps = contact.overlaps(at_rest, overlap_tolerance * contact.bodies().shortest_edge());
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < std::min(overlaps.size(), most_named); ++i) {
        const ContactOverlap& at = overlaps[i];
        problems.push_back(
            {"[contact]",
             fmt::format("bodies overlap at the start: {} at ({:.6g}, {:.6g}) m is {:.3g} m deep in element {}",
                         at.node == at.other_node
                             ? fmt::format("node {}", at.node)
                             : fmt::format("the middle of the edge of nodes {} and {}", at.node, at.other_node),
                         at.at[0], at.at[1], at.depth, at.element)});
    }
    if (overlaps.size() > most_named)
        problems.push_back({"[contact]", fmt::format("and {} points more", overlaps.size() - most_named)});
    if (!problems.empty()) throw InputError(problems);
}

}  // namespace

std::unique_ptr<Contact> make_contact(const PartedMesh& start, std::span<const std::unique_ptr<ElementBlock>> blocks,
                                      const SolidOptions& solid, const ContactOptions& contact, bool comes_apart) {
    // a given penalty is that of two equal layers in series
    const std::vector<double> layers = contact.penalty > 0
                                           ? std::vector<double>(start.mesh.n_elements(), 0.5 / contact.penalty)
                                           : layers_of(start.mesh, blocks, contact.penalty_factor);
    const std::vector<double> masses = masses_of(start.mesh, blocks);
    auto made = std::make_unique<Contact>(
        PartedMesh{start.mesh, start.original_of, start.failed, masses}, layers, contact.potential_cap,
        Contact::Options{solid.thickness, contact.friction, contact.restitution, contact.tangential_factor,
                         contact.skin * shortest_edge(start.mesh), comes_apart});
    refuse_overlaps(*made);
    return made;
}

}  // namespace gneiss
