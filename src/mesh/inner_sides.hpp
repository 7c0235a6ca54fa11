#pragma once
// The sides along which elements touch, and meshes that come apart along them.

#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace gneiss {

/// Where two elements touch.
struct InnerSide {
    ElementSide left, right;  ///< left.element < right.element; each walks the side in its own direction
};

/// Local numbers of the nodes of a side in walking order: two of a CST, corner, mid-side, corner of a composite.
std::span<const int> side_nodes(ElementKind kind, int side);

/// A node that has come into being where others parted.
struct NodeCopy {
    std::int32_t original, copy;
};

/// A node of an inner side, by its place in the walking order of the left element: 0, 1, and 2 of a composite.
struct SideNode {
    std::int32_t side, place;
    friend auto operator<=>(const SideNode&, const SideNode&) = default;
};

/// Opens sides of a mesh, whole or at some of their nodes. Elements stay together at a node as long as they are bonded
/// to each other around it: those that are not get nodes of their own, at the same place.
class InnerSides {
public:
    /// @param mesh  refers to it; changed by open(). Nodes that elements share without a common side at them (two
    /// elements that touch in a point alone) are told apart by the first open() around them.
    explicit InnerSides(Mesh& mesh);

    /// By ascending left element and side.
    std::span<const InnerSide> sides() const { return sides_; }
    /// The inner side that a side of an element is part of; -1: it is on the contour.
    std::int32_t number(const ElementSide& side) const { return number_[index(side)]; }
    /// Whether it is open at one of its nodes at least.
    bool is_open(std::int32_t side) const { return open_[static_cast<std::size_t>(side)] != 0; }
    bool is_open(const SideNode& at) const { return (open_[static_cast<std::size_t>(at.side)] >> at.place & 1) != 0; }
    /// The element across a side of an element that has a node there; -1: none, or not bonded at that node.
    std::int32_t bonded(const ElementSide& side, std::int32_t node) const;

    /// Opens sides, given by their numbers, those that are open already among them or not. Nodes around which elements
    /// have come apart are copied: the elements with the lowest number keep the node, each other group gets a copy at
    /// the end of the mesh's nodes. Connectivity, boundaries, node sets (a copy belongs where its original does) and
    /// labels follow.
    /// @return the copies, in the order of their numbers
    std::vector<NodeCopy> open(std::span<const std::int32_t> sides);
    /// The same for some nodes of sides: at the others they hold.
    std::vector<NodeCopy> open(std::span<const SideNode> ends);
    /// All nodes of these sides.
    std::vector<SideNode> nodes_of(std::span<const std::int32_t> sides) const;

    /// Sides among these whose two faces would have a node of their own each, at one end or between them, if all of
    /// them were opened. One that stands alone inside a mesh of three-noded elements has none: both ends hold together
    /// around it.
    std::vector<std::int32_t> parted_by(std::span<const std::int32_t> sides) const;

    /// Numbers the nodes anew, in the order in which elements have them: copies stand at the end until then, far from
    /// their neighbours.
    void renumber();
    /// Number that each node had, or the node that it is a copy of, when this was made.
    std::span<const std::int32_t> original_of() const { return original_; }
    /// Elements that have a node, ascending.
    std::span<const std::int32_t> elements_at(std::int32_t node) const {
        const Range& range = at_node_[static_cast<std::size_t>(node)];
        return std::span(elements_).subspan(static_cast<std::size_t>(range.first), static_cast<std::size_t>(range.n));
    }

private:
    struct Range {
        std::int32_t first, n;
    };
    std::size_t index(const ElementSide& side) const {
        return 3 * static_cast<std::size_t>(side.element) + static_cast<std::size_t>(side.side);
    }
    /// Parts the elements at a node into groups that hold together.
    void split(std::int32_t node, std::vector<NodeCopy>& copies);
    /// Those among `left`, ascending, that are bonded to its first one around a node, the first one included; they are
    /// taken out of it.
    /// @param more  sides that count as open, ascending
    std::vector<std::int32_t> take_group(std::int32_t node, std::vector<std::int32_t>& left,
                                         std::span<const std::int32_t> more) const;
    void rename(std::int32_t element, std::int32_t from, std::int32_t to);

    Mesh& mesh_;
    std::vector<InnerSide> sides_;
    std::vector<std::int32_t> number_;    ///< shape (n_elements, 3)
    std::vector<std::uint8_t> open_;      ///< bit k: at place k
    std::vector<std::int32_t> elements_;  ///< those at a node one behind the other
    std::vector<std::int32_t> original_;  ///< shape (n_nodes)
    std::vector<Range> at_node_;          ///< of elements_, shape (n_nodes)
};

}  // namespace gneiss
