#pragma once
// What contact knows of a mesh: target triangles, contactor points, what is bonded, how deep a point is. It follows the
// mesh as that comes apart.
//
// Three numberings of nodes. Of the mesh as it is, in which forces act. Original: before any node was copied; the
// penetration potential speaks it, because copies stand at one place of the reference shape. Bonded: of a mesh whose
// sides open when their cohesion has failed, not before. Contact itself speaks the bonded one: a bonded node stands at
// the centre of mass of the mesh's nodes that it holds, and what pushes it gives them all the same acceleration. So
// joints that open or close a little leave no gaps and no overlaps in a body: a point inside is in exactly one of its
// triangles, and the potential that it feels has no jump. It does not move either where a node is copied.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/contactor_points.hpp"
#include "contact/penetration_potential.hpp"
#include "mesh/inner_sides.hpp"
#include "model/interaction.hpp"

namespace gneiss {

/// A mesh that may have come apart already.
struct PartedMesh {
    const Mesh& mesh;
    std::span<const std::int32_t> original_of = {};  ///< InnerSides::original_of(); empty: it is whole
    std::span<const std::int32_t> failed = {};       ///< inner sides that nothing holds
    std::span<const double> masses =
        {};  ///< of every element at its nodes, kg, shape of the connectivity; empty: equal
};

class ContactBodies {
public:
    /// @param layers  of each element, m/Pa, > 0: its size over its stiffness, see `compliance`
    /// @param cap     of the potential, in local sizes, > 0
    ContactBodies(const PartedMesh& start, std::span<const double> layers, double cap);
    ContactBodies(ContactBodies&&) = delete;  // what is bonded refers to a mesh in here
    ContactBodies& operator=(ContactBodies&&) = delete;
    ~ContactBodies() = default;

    /// Nodes that have been copied, sides that have failed. The cost is that of the whole mesh.
    void follow(const Parting& parting);

    /// Whether opening these inner sides beside those that have failed parts the faces of each of them, at one end at
    /// least: without that they lie on each other whatever the displacements, and contact cannot press.
    /// @returns those among them that come apart, in their order
    std::vector<std::int32_t> come_apart(std::span<const std::int32_t> sides) const { return bonded_.parted_by(sides); }

    /// Of the mesh as it is.
    std::size_t n_mesh_nodes() const { return bonded_of_.size(); }
    /// Bonded.
    std::size_t n_nodes() const { return bonded_mesh_.n_nodes(); }
    /// Nodes of the mesh that a bonded node holds, ascending; at least one.
    std::span<const std::int32_t> held(std::int32_t node) const {
        const auto first = held_.begin() + first_held_[static_cast<std::size_t>(node)];
        return {first, held_.begin() + first_held_[static_cast<std::size_t>(node) + 1]};
    }
    /// Part of the mass of its bonded node that a node of the mesh has.
    double share(std::int32_t mesh_node) const { return share_[static_cast<std::size_t>(mesh_node)]; }
    /// Displacements of the bonded nodes, m.
    /// @param u        of the mesh, m, shape (2 n_mesh_nodes)
    /// @param scratch  may hold what is returned, shape (2 n_nodes); otherwise that is u
    std::span<const double> displacements(std::span<const double> u, std::vector<double>& scratch) const;
    /// Whether the bonded nodes are those of the mesh, number by number.
    bool whole() const { return whole_; }
    /// Adds forces on bonded nodes, N, shape (2 n_nodes), to those on the mesh's nodes.
    void spread(std::span<const double> forces, std::span<double> f) const;

    /// Reference positions, m, shape (2 n_nodes).
    std::span<const double> reference() const { return reference_; }
    /// Counter-clockwise; those of one element one behind the other.
    std::span<const std::array<std::int32_t, 3>> triangles() const { return triangles_; }
    const TrianglePotential& potential(std::size_t triangle) const { return potential_.of_triangle(triangle); }
    const ContactorPoints& points() const { return points_; }

    /// Contactor points between nodes of the mesh as it is: what meets a wall.
    const ContactorPoints& mesh_points() const { return mesh_points_; }
    /// The element that an edge of the boundary belongs to, by its number in ContactorPoints::of_edge.
    std::int32_t element_of_edge(std::size_t edge) const { return edges_[edge].element; }
    /// Reference positions of the mesh as it is, m, shape (2 n_mesh_nodes).
    std::span<const double> mesh_reference() const { return mesh_reference_; }

    /// What one side of a contact gives, m/Pa: the size of a layer of elements over its stiffness, the least one of the
    /// body that it was part of at the start. One number per body, not one per element: the penalty then does not jump,
    /// nor the energy of contact, as a point moves from one triangle into the next. The least, so that it suits the
    /// smallest elements, whose frequency it must not exceed by much.
    double compliance(std::int32_t body) const { return compliance_[static_cast<std::size_t>(body)]; }
    double least_compliance() const;
    std::int32_t body_of_node(std::int32_t node) const {
        return body_of_original_[static_cast<std::size_t>(bonded_.original_of()[static_cast<std::size_t>(node)])];
    }
    std::int32_t body_of_mesh_node(std::int32_t node) const {
        return body_of_node(bonded_of_[static_cast<std::size_t>(node)]);
    }

    /// Shortest edge of the boundary, m.
    double shortest_edge() const { return shortest_edge_; }
    /// Length of boundary at each bonded node: half of each of its edges, m, shape (n_nodes).
    std::span<const double> boundary_length() const { return boundary_length_; }

    /// For messages: what the user's file calls a bonded node, and the element of a triangle.
    std::int64_t node_label(std::int32_t node) const {
        return bonded_mesh_.node_labels[static_cast<std::size_t>(node)];
    }
    std::int64_t element_label(std::int32_t triangle) const {
        return bonded_mesh_.element_labels[static_cast<std::size_t>(triangle) / n_sub_];
    }

private:
    /// A sub-edge of the boundary by local nodes of its element.
    struct Edge {
        std::int32_t element;
        int a, b;
    };

    static Mesh put_together(const PartedMesh& start, std::span<const std::int32_t> original);
    void find_bodies(std::span<const double> layers);
    void add_edges(std::span<const BoundaryEdge> contour);
    void fail(std::span<const std::int32_t> sides, const Mesh& mesh);
    void refresh(const Mesh& mesh);
    std::vector<BoundaryEdge> edges_of(const Mesh& mesh) const;

    std::size_t n_sub_;  ///< triangles per element
    Mesh bonded_mesh_;
    std::vector<std::int32_t> original_connectivity_;
    InnerSides bonded_;
    PenetrationPotential potential_;
    std::vector<std::int32_t> body_of_original_;
    std::vector<double> compliance_;  ///< m/Pa, per body

    std::vector<Edge> edges_;
    std::vector<double> reference_, boundary_length_;
    std::vector<std::array<std::int32_t, 3>> triangles_;
    ContactorPoints points_;
    // bonded nodes and those of the mesh
    std::vector<std::int32_t> bonded_of_, held_, first_held_;
    std::vector<double> masses_;  ///< PartedMesh::masses
    std::vector<double> share_;
    bool whole_ = true;
    ContactorPoints mesh_points_;
    std::vector<double> mesh_reference_;
    double shortest_edge_ = 0;
};

}  // namespace gneiss
