#pragma once
// When the elements around a node come apart, and with which tractions  [FORMULATION 7, decisions/037].
//
// Until a side opens, its two faces move as one, whatever it takes: a rigid interface. Around a node stand the corners
// e_1, e_2, ... of elements, with the interfaces s_1 between e_1 and e_2 and so on, each represented at the node by its
// weight w, half of its sub-edge's area. With F_j the force of element e_j on the node, m_j its mass there and
// a = sum F_j/sum m_j the node's acceleration, the interface force T_j on e_j follows from the motion of the corners,
//
//   T_j - T_(j-1) = m_j a - F_j.
//
// An open fan (T_0 = 0) is statically determinate. In a closed one T_j = c + P_j with an unknown vector c. Each
// traction T_j/w_j has to stay inside the strength envelope g_j <= 1. The fan holds as long as some c fulfils all of
// them (lower-bound theorem of limit analysis); it ruptures when
//
//   min over c of max over j of g_j((c + P_j)/w_j) = 1.
//
// At this minimum the gradients of the active g_j combine to zero with positive factors: those are openings that are
// compatible around the node, so that the active interfaces, two or three of them, part the fan. It is the limit of
// joints with infinite penalty that are there from the start.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/vec2.hpp"
#include "fracture/cohesion_properties.hpp"

namespace gneiss {

/// Force, N, and mass, kg, of one element at a node.
struct FanCorner {
    Vec2<double> force{0, 0};
    double mass = 0;
};

/// The interface between two neighbouring corners, seen from the left element of its side.
struct FanInterface {
    double weight;                 ///< w, m2
    Vec2<double> normal, along;    ///< n out of the left element, t along its walk
    double sense;                  ///< 1: the fan's walk crosses it from left to right; -1: from right to left
    Vec2<double> stress_traction;  ///< on the left element, Pa, from the mean of the stresses on both sides
    const CohesionProperties<double>* properties;
    double per_area = sense / weight;  ///< makes T_j the traction on the left element, 1/m2
};

struct NodeRupture {
    double utilisation = 0;              ///< the minimum above, or a bound from above where that is below 1, -
    std::vector<std::size_t> opening;    ///< interfaces that open, ascending; none: the fan holds
    std::vector<Vec2<double>> traction;  ///< of all interfaces, on the left element, Pa
};

/// @param corners     in walking order, two at least
/// @param interfaces  one less than corners: an open fan; as many: the last one leads back to the first corner
/// @param held        components in which a support moves the node: there tractions are those of the stresses
/// @param[out] found  overwritten
void find_rupture(std::span<const FanCorner> corners, std::span<const FanInterface> interfaces,
                  std::array<bool, 2> held, NodeRupture& found);

/// What the utilisation of a closed fan is at most, at little cost: that of one c, with the least strength in every
/// direction.
/// @param per_force_squared  of every interface, 1/N2: g^2 is at most |T_j|^2 times this
double bound_of_closed_fan(std::span<const FanCorner> corners, std::span<const double> per_force_squared);

}  // namespace gneiss
