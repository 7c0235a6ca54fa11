#include "contact/contact_bodies.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "base/index.hpp"
#include "base/parallel.hpp"
#include "mesh/boundary.hpp"
#include "mesh/sub_triangles.hpp"

namespace gneiss {
namespace {

std::vector<std::int32_t> counted(std::size_t n) {
    std::vector<std::int32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

std::vector<std::int32_t> originals(const PartedMesh& start) {
    if (!start.original_of.empty()) return {start.original_of.begin(), start.original_of.end()};
    return counted(start.mesh.n_nodes());
}

/// Triangles of a mesh, counter-clockwise.
std::vector<std::array<std::int32_t, 3>> triangles_of(const Mesh& mesh) {
    const auto subs = sub_triangles(mesh.kind);
    std::vector<std::array<std::int32_t, 3>> all;
    all.reserve(mesh.n_elements() * subs.size());
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (const SubTriangle& sub : subs) {
            const SubTriangle local = mesh.kind == ElementKind::cst ? sub : counter_clockwise(sub);
            const std::int32_t* nodes = mesh.element(e);
            all.push_back({nodes[local[0]], nodes[local[1]], nodes[local[2]]});
        }
    return all;
}

std::vector<double> flat(const std::vector<Point2>& nodes) {
    std::vector<double> all;
    all.reserve(2 * nodes.size());
    for (const auto& [x, y] : nodes) {
        all.push_back(x);
        all.push_back(y);
    }
    return all;
}

}  // namespace

Mesh ContactBodies::put_together(const PartedMesh& start, std::span<const std::int32_t> original) {
    const Mesh& mesh = start.mesh;
    const std::size_t n = index(std::ranges::max(original)) + 1;
    Mesh all;
    all.kind = mesh.kind;
    all.nodes.resize(n);
    all.node_labels.resize(n);
    for (std::size_t node = 0; node < mesh.n_nodes(); ++node) {
        all.nodes[index(original[node])] = mesh.nodes[node];
        all.node_labels[index(original[node])] = mesh.node_labels[node];
    }
    all.element_labels = mesh.element_labels;
    all.connectivity.reserve(mesh.connectivity.size());
    for (const std::int32_t node : mesh.connectivity) all.connectivity.push_back(original[index(node)]);
    return all;
}

ContactBodies::ContactBodies(const PartedMesh& start, std::span<const double> layers, double cap)
    : n_sub_(sub_triangles(start.mesh.kind).size()),
      bonded_mesh_(put_together(start, originals(start))),
      original_connectivity_(bonded_mesh_.connectivity),
      bonded_(bonded_mesh_),
      potential_(bonded_mesh_.nodes, triangles_of(bonded_mesh_), cap),
      masses_(start.masses.begin(), start.masses.end()) {
    if (masses_.empty()) masses_.assign(start.mesh.connectivity.size(), 1.0);
    find_bodies(layers);
    add_edges(contour(bonded_mesh_));
    fail(start.failed, start.mesh);
    refresh(start.mesh);
}

void ContactBodies::find_bodies(std::span<const double> layers) {
    // nodes of one body have one root
    std::vector<std::int32_t> root = counted(bonded_mesh_.n_nodes());
    const auto find = [&](std::int32_t node) {
        while (root[index(node)] != node) node = root[index(node)] = root[index(root[index(node)])];
        return node;
    };
    for (std::size_t e = 0; e < bonded_mesh_.n_elements(); ++e)
        for (int k = 1; k < bonded_mesh_.nodes_per_element(); ++k) {
            const auto [low, high] = std::minmax({find(bonded_mesh_.element(e)[0]), find(bonded_mesh_.element(e)[k])});
            root[index(high)] = low;
        }
    body_of_original_.assign(root.size(), -1);
    std::int32_t n_bodies = 0;
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(root.size()); ++node) {
        const std::int32_t first = find(node);  // never higher than the node
        body_of_original_[index(node)] = first == node ? n_bodies++ : body_of_original_[index(first)];
    }
    compliance_.assign(index(n_bodies), std::numeric_limits<double>::infinity());
    for (std::size_t e = 0; e < bonded_mesh_.n_elements(); ++e) {
        double& least = compliance_[index(body_of_original_[index(bonded_mesh_.element(e)[0])])];
        least = std::min(least, layers[e]);
    }
}

double ContactBodies::least_compliance() const { return *std::ranges::min_element(compliance_); }

void ContactBodies::add_edges(std::span<const BoundaryEdge> contour) {
    std::vector<std::array<std::int32_t, 2>> added;
    for (const BoundaryEdge& edge : contour) {
        const std::span nodes(bonded_mesh_.element(index(edge.element)),
                              static_cast<std::size_t>(bonded_mesh_.nodes_per_element()));
        const auto local = [&](std::int32_t node) {
            return static_cast<int>(std::ranges::find(nodes, node) - nodes.begin());
        };
        edges_.push_back({edge.element, local(edge.a), local(edge.b)});
        added.push_back({edge.a, edge.b});
    }
    potential_.add_boundary(added);
}

/// @param mesh  as it is: a side is bonded still where its faces have a node of it in common, until they have not
void ContactBodies::fail(std::span<const std::int32_t> sides, const Mesh& mesh) {
    std::vector<std::array<std::int32_t, 2>> added;
    const auto n = static_cast<std::size_t>(bonded_mesh_.nodes_per_element());
    std::vector<SideNode> ends;
    const auto add_ends = [&](std::int32_t s) {
        const InnerSide& side = bonded_.sides()[index(s)];
        const std::int32_t* left = mesh.element(index(side.left.element));
        const std::span right(mesh.element(index(side.right.element)), n);
        const auto local = side_nodes(mesh.kind, side.left.side);
        for (std::int32_t place = 0; place < static_cast<std::int32_t>(local.size()); ++place)
            if (std::ranges::find(right, left[local[index(place)]]) == right.end()) ends.push_back({s, place});
    };
    for (const std::int32_t s : sides) {
        if (bonded_.is_open(s)) continue;
        const InnerSide& side = bonded_.sides()[index(s)];
        for (const ElementSide& face : {side.left, side.right}) {
            const auto local = side_nodes(bonded_mesh_.kind, face.side);
            for (std::size_t k = 0; k + 1 < local.size(); ++k) {
                edges_.push_back({face.element, local[k], local[k + 1]});
                const std::int32_t* nodes = original_connectivity_.data() + n * index(face.element);
                if (face.element == side.left.element) added.push_back({nodes[local[k]], nodes[local[k + 1]]});
            }
        }
        const std::size_t before = ends.size();
        add_ends(s);
        if (ends.size() > before) continue;
        // alone inside the mesh: it parts nothing yet
        for (const SideNode& end : bonded_.nodes_of(std::span(&s, 1))) ends.push_back(end);
    }
    for (std::int32_t s = 0; s < static_cast<std::int32_t>(bonded_.sides().size()); ++s)
        if (bonded_.is_open(s)) add_ends(s);
    bonded_.open(ends);
    if (!added.empty()) potential_.add_boundary(added);
}

void ContactBodies::follow(const Parting& parting) {
    fail(parting.failed, parting.mesh);
    refresh(parting.mesh);
}

std::span<const double> ContactBodies::displacements(std::span<const double> u, std::vector<double>& scratch) const {
    if (whole_) return u;
    scratch.resize(2 * n_nodes());
    parallel_ranges(n_nodes(), [&](std::size_t first, std::size_t last) {
        for (std::size_t node = first; node < last; ++node) {
            const auto all = held(static_cast<std::int32_t>(node));
            double x = 0, y = 0;
            for (const std::int32_t one : all) {
                x += share(one) * u[2 * index(one)];
                y += share(one) * u[2 * index(one) + 1];
            }
            scratch[2 * node] = x;
            scratch[2 * node + 1] = y;
        }
    });
    return scratch;
}

void ContactBodies::spread(std::span<const double> forces, std::span<double> f) const {
    parallel_ranges(n_nodes(), [&](std::size_t first, std::size_t last) {
        for (std::size_t node = first; node < last; ++node) {
            const double x = forces[2 * node], y = forces[2 * node + 1];
            if (x == 0 && y == 0) continue;
            for (const std::int32_t one : held(static_cast<std::int32_t>(node))) {
                f[2 * index(one)] += share(one) * x;
                f[2 * index(one) + 1] += share(one) * y;
            }
        }
    });
}

void ContactBodies::refresh(const Mesh& mesh) {
    constexpr std::int32_t none = -1;
    bonded_of_.assign(mesh.n_nodes(), none);
    for (std::size_t k = 0; k < mesh.connectivity.size(); ++k)
        bonded_of_[index(mesh.connectivity[k])] = bonded_mesh_.connectivity[k];
    whole_ = bonded_of_.size() == n_nodes();
    first_held_.assign(n_nodes() + 1, 0);
    for (std::size_t node = 0; node < bonded_of_.size(); ++node) {
        whole_ = whole_ && bonded_of_[node] == static_cast<std::int32_t>(node);
        ++first_held_[index(bonded_of_[node]) + 1];
    }
    std::partial_sum(first_held_.begin(), first_held_.end(), first_held_.begin());
    held_.resize(bonded_of_.size());
    std::vector<std::int32_t> next(first_held_.begin(), first_held_.end() - 1);
    for (std::size_t node = 0; node < bonded_of_.size(); ++node)
        held_[index(next[index(bonded_of_[node])]++)] = static_cast<std::int32_t>(node);

    std::vector<double> mass(mesh.n_nodes(), 0.0), whole_mass(n_nodes(), 0.0);
    for (std::size_t k = 0; k < mesh.connectivity.size(); ++k) {
        mass[index(mesh.connectivity[k])] += masses_[k];
        whole_mass[index(bonded_mesh_.connectivity[k])] += masses_[k];
    }
    share_.resize(mesh.n_nodes());
    for (std::size_t node = 0; node < share_.size(); ++node)
        share_[node] = held(bonded_of_[node]).size() == 1 ? 1 : mass[node] / whole_mass[index(bonded_of_[node])];

    triangles_ = triangles_of(bonded_mesh_);
    reference_ = flat(bonded_mesh_.nodes);
    mesh_reference_ = flat(mesh.nodes);
    const std::vector<BoundaryEdge> boundary = edges_of(bonded_mesh_);
    points_ = contactor_points(boundary, bonded_mesh_.nodes);
    mesh_points_ = contactor_points(edges_of(mesh), mesh.nodes);
    boundary_length_.assign(n_nodes(), 0);
    shortest_edge_ = std::numeric_limits<double>::infinity();
    for (const BoundaryEdge& edge : boundary) {
        const double length = distance(bonded_mesh_.nodes[index(edge.a)], bonded_mesh_.nodes[index(edge.b)]);
        shortest_edge_ = std::min(shortest_edge_, length);
        for (const std::int32_t node : {edge.a, edge.b}) boundary_length_[index(node)] += 0.5 * length;
    }
}

std::vector<BoundaryEdge> ContactBodies::edges_of(const Mesh& mesh) const {
    std::vector<BoundaryEdge> boundary;
    boundary.reserve(edges_.size());
    for (const Edge& edge : edges_) {
        const std::int32_t* nodes = mesh.element(index(edge.element));
        boundary.push_back({nodes[edge.a], nodes[edge.b], edge.element});
    }
    return boundary;
}

}  // namespace gneiss
