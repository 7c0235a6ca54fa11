#pragma once
// Sides between elements that a user speaks of by name: cracks that are there before the run, interfaces.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/inner_sides.hpp"
#include "model/options.hpp"

namespace gneiss {

/// By numbers of inner sides.
struct NamedSides {
    std::vector<std::int32_t> cracked;                 ///< open from the start, ascending
    std::map<std::int32_t, std::size_t> interface_of;  ///< sides with strengths of their own, to the interface's number
    std::vector<std::int32_t> bonded;                  ///< sides that may not crack, ascending
};

/// @param inner  of the mesh, nothing open yet
/// @param where  FractureOptions::on
/// @throws InputError with every problem: names that the mesh has not, regions that do not meet, a side that two
///     entries claim, no side that may crack
NamedSides named_sides(const Mesh& mesh, const InnerSides& inner, const std::vector<CrackOptions>& cracks,
                       const std::vector<InterfaceOptions>& interfaces,
                       const std::optional<std::vector<std::string>>& where = {});

/// Opens sides that nothing holds together. A boundary that ends at a crack's mouth keeps the nodes of its own side:
/// those across the crack leave its set of nodes.
/// @param inner  of the mesh, nothing open yet
void open_cracks(Mesh& mesh, InnerSides& inner, std::span<const std::int32_t> cracked);

}  // namespace gneiss
