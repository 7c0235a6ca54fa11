#pragma once
// The mesh that everything else reads: nodes, elements of one kind, named regions, boundaries and points.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gneiss {

/// Kind of the elements of a mesh. The value is the number of nodes of one element.
enum class ElementKind : int { cst = 3, compt = 6 };

/// A straight piece of boundary between two neighbouring nodes. A composite triangle has two on each side.
/// Walking from node a to node b, the solid lies on the left: the outward normal is (dy, -dx)/length.
struct BoundaryEdge {
    std::int32_t a, b;     ///< node numbers
    std::int32_t element;  ///< the element that the edge belongs to
};

/// One of the three sides of an element: from its corner `side` to the next one, counter-clockwise.
struct ElementSide {
    std::int32_t element;
    int side;  ///< 0 to 2
};

/// A plane mesh. Node and element numbers are 0-based positions in the arrays below; labels keep what the
/// user's file called them, for messages.
struct Mesh {
    ElementKind kind = ElementKind::compt;

    std::vector<std::array<double, 2>> nodes;  ///< reference positions, m
    std::vector<std::int32_t> connectivity;    ///< nodes_per_element() numbers per element, counter-clockwise;
                                               ///< compt: 1..6 around the triangle, corners first, third, fifth
    std::vector<std::int32_t> region;          ///< per element, index into region_names
    std::vector<std::string> region_names;

    std::map<std::string, std::vector<BoundaryEdge>> boundaries;  ///< edges by name, in walking order where they chain
    std::map<std::string, std::vector<std::int32_t>>
        node_sets;  ///< nodes by name, ascending; every boundary has its own
    std::map<std::string, std::vector<ElementSide>> inner_lines;  ///< sides inside the solid by name, ascending, each
                                                                  ///< named once, by the element with the lower number
    std::map<std::string, std::vector<double>> element_data;      ///< numbers per element read from the mesh file

    std::vector<std::int64_t> node_labels;     ///< what the file called each node; 1-based numbers for generated meshes
    std::vector<std::int64_t> element_labels;  ///< likewise for elements; the CST of one composite share its label

    int nodes_per_element() const { return static_cast<int>(kind); }
    std::size_t n_nodes() const { return nodes.size(); }
    std::size_t n_elements() const { return connectivity.size() / static_cast<std::size_t>(kind); }
    const std::int32_t* element(std::size_t e) const {
        return connectivity.data() + e * static_cast<std::size_t>(kind);
    }
};

}  // namespace gneiss
