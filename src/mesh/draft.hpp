#pragma once
// A mesh under construction: what generators and readers produce, before checks, renumbering and splitting.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gneiss {

/// Six-noded triangles with names on them. Numbers are 0-based positions; labels are what messages call them.
struct MeshDraft {
    static constexpr std::int32_t no_node = -1;  ///< a mid-side node that add_mid_sides() has still to make

    std::string where = "mesh";  ///< prefix of messages: the file's name

    std::vector<std::array<double, 2>> nodes;  ///< m
    std::vector<std::int64_t> node_labels;
    bool report_unused_nodes = true;  ///< false where construction points of a geometry are among the nodes

    std::vector<std::array<std::int32_t, 6>> elements;  ///< order of composite.hpp, either sense
    std::vector<std::int64_t> element_labels;
    std::vector<std::int32_t> region;  ///< per element, index into region_names
    std::vector<std::string> region_names;
    std::map<std::string, std::vector<double>> element_data;  ///< one number per element; NaN: none

    std::map<std::string, std::vector<std::array<std::int32_t, 3>>> lines;  ///< corner, mid-side, corner; either sense
    std::map<std::string, std::vector<std::int32_t>> points;

    std::vector<std::string> warnings;  ///< found while reading

    std::int32_t add_node(double x, double y);                          ///< labelled one above the last
    void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c);  ///< likewise, in the first region

    /// Number of the region of what lies in these groups, new if need be; regions.hpp says how it is called.
    /// @param groups  at least one, no two alike
    std::int32_t region_of(const std::vector<std::string>& groups);
};

/// Makes the missing mid-side nodes of elements and lines, halfway between the corners. A side shared by elements gets
/// one node, and where one of them already has it, the others take it.
void add_mid_sides(MeshDraft& draft);

/// Moves every mid-side node halfway between its corners.
void straighten_sides(MeshDraft& draft);

/// Moves mid-side nodes halfway between their corners in elements that they turn inside out in part: curved sides of a
/// coarse mesh, or of a boundary layer.
/// @return labels of these elements
std::vector<std::int64_t> straighten_folded(MeshDraft& draft);

/// Turns every element that runs clockwise: in a file each surface has the sense in which it was drawn.
void orient(MeshDraft& draft);

/// Orders elements along a Hilbert curve through their centroids and nodes by first touch, so that neighbours in the
/// plane are neighbours in memory. Nodes that no element uses are dropped. Labels stay with what they label.
void renumber(MeshDraft& draft);

}  // namespace gneiss
