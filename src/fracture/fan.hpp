#pragma once
// The elements around a node in the order in which their bonded sides lead from one to the next.

#include <cstdint>
#include <vector>

#include "mesh/inner_sides.hpp"

namespace gneiss {

struct Fan {
    /// An element, and the number that the node has in it.
    struct Corner {
        std::int32_t element;
        int node;
    };
    /// An end of a sub-edge at the node.
    struct Interface {
        SideNode at;         ///< side, and the node's place on it
        std::size_t part;    ///< sub-edge, in the walk of the side's left element
        std::size_t end;     ///< 0 where that sub-edge begins at the node, 1 where it ends there
        bool left_to_right;  ///< whether the fan's walk crosses it from the left element to the right one
    };
    std::vector<Corner> corners;        ///< counter-clockwise
    std::vector<Interface> interfaces;  ///< one less than corners, or as many where the fan is closed
};

/// The fan of the element with the lowest number at a node. A mid-side node between two composites has a closed fan of
/// two corners and both of the side's sub-edges.
/// @param[out] fan  overwritten
void find_fan(const Mesh& mesh, const InnerSides& inner, std::int32_t node, Fan& fan);

}  // namespace gneiss
