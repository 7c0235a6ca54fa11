#pragma once
// What the name of a region stands for, where groups of a mesh file overlap.
//
// Regions share no element. What lies in several groups of a file is a region of its own that has the names of all of
// them, "matrix & source"; each of these names then stands for all regions that have it.

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace gneiss {

/// Name of the region of what lies in these groups, in whatever order.
std::string name_of_overlap(std::vector<std::string> groups);

/// Names that regions can be spoken of by, each once: in the order of the regions.
std::vector<std::string> names_of_regions(const Mesh& mesh);

/// Numbers of the regions that a name stands for, ascending; empty: the mesh has none of this name.
std::vector<std::int32_t> regions_named(const Mesh& mesh, const std::string& name);

/// Names of each region, ascending: one, or those of the groups that overlap there.
std::vector<std::vector<std::string>> groups_of_regions(const Mesh& mesh);

}  // namespace gneiss
