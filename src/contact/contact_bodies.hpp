#pragma once
// What contact knows of a mesh: target triangles, contactor points, what is bonded, how deep a point is. It follows the
// mesh as that comes apart.
//
// Three numberings of nodes. Current: the mesh as it is, in which forces act. Original: before any node was copied; the
// penetration potential speaks it, because copies stand at one place of the reference shape. Bonded: of a mesh whose
// sides open when their cohesion has failed, not before: two current nodes with one bonded number are held together.

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

    std::size_t n_nodes() const { return joined_.size(); }
    /// Reference positions, m, shape (2 n_nodes).
    std::span<const double> reference() const { return reference_; }
    /// Current node numbers, counter-clockwise; those of one element one behind the other.
    std::span<const std::array<std::int32_t, 3>> triangles() const { return triangles_; }
    const TrianglePotential& potential(std::size_t triangle) const { return potential_.of_triangle(triangle); }
    const ContactorPoints& points() const { return points_; }
    /// Bonded number of each node, shape (n_nodes).
    std::span<const std::int32_t> joined() const { return joined_; }

    /// What one side of a contact gives, m/Pa: the size of a layer of elements over its stiffness, the least one of the
    /// body that it was part of at the start. One number per body, not one per element: the penalty then does not jump,
    /// nor the energy of contact, as a point moves from one triangle into the next. The least, so that it suits the
    /// smallest elements, whose frequency it must not exceed by much.
    double compliance(std::int32_t body) const { return compliance_[static_cast<std::size_t>(body)]; }
    double least_compliance() const;
    std::int32_t body_of_node(std::int32_t node) const {
        return body_of_original_[static_cast<std::size_t>(original_[static_cast<std::size_t>(node)])];
    }

    /// Shortest edge of the boundary, m.
    double shortest_edge() const { return shortest_edge_; }
    /// Length of boundary at each node: half of each of its edges, m, shape (n_nodes).
    std::span<const double> boundary_length() const { return boundary_length_; }

    /// For messages: what the user's file calls them.
    std::int64_t node_label(std::int32_t node) const {
        return bonded_mesh_.node_labels[static_cast<std::size_t>(joined_[static_cast<std::size_t>(node)])];
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

    static Mesh whole(const PartedMesh& start, std::span<const std::int32_t> original);
    void find_bodies(std::span<const double> layers);
    void add_edges(std::span<const BoundaryEdge> contour);
    void fail(std::span<const std::int32_t> sides);
    void refresh(const Mesh& mesh);

    std::size_t n_sub_;                   ///< triangles per element
    std::vector<std::int32_t> original_;  ///< of each current node
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
    std::vector<std::int32_t> joined_;
    double shortest_edge_ = 0;
};

}  // namespace gneiss
