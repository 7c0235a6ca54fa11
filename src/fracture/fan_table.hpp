#pragma once
// The fans of many nodes, laid out to be looked at step after step: each is found once, and again after the mesh has
// come apart around it.

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec2.hpp"
#include "fracture/cohesion_properties.hpp"
#include "fracture/element_response.hpp"
#include "fracture/fan.hpp"
#include "mesh/inner_sides.hpp"

namespace gneiss {

class FanTable {
public:
    struct Corner {
        double mass;  ///< at the node, kg
        std::int32_t element;
        std::uint32_t force, pack;  ///< place in the response; of the element
    };
    struct Interface {
        std::int32_t a, b;        ///< nodes of the sub-edge, in the walk of the side's left element
        Vec2<double> edge;        ///< from a to b in the reference shape, m
        double weight;            ///< half of the sub-edge's area in the reference shape, m2
        double sense, per_area;   ///< of FanInterface
        std::size_t left, right;  ///< places of the stresses on both sides in the response
        const CohesionProperties<double>* properties;
    };
    struct View {
        std::span<const Corner> corners;
        std::span<const Interface> interfaces;
        /// Per interface, 1/N2: g^2 is at most the square of the interface force T_j times this, whatever its
        /// direction.
        std::span<const double> per_force_squared;
        bool closed() const { return corners.size() == interfaces.size(); }
    };
    /// @param mesh, inner  referred to
    /// @param properties   of the sub-edges of every inner side, one behind the other; referred to
    FanTable(const Mesh& mesh, const InnerSides& inner, std::span<const CohesionProperties<double>> properties,
             double thickness)
        : mesh_(mesh), inner_(inner), properties_(properties), thickness_(thickness) {}

    /// Finds a node's fan unless it is known. @param response  of any state
    void require(std::int32_t node, ElementResponse& response);
    /// A fan that is known; until the next require() or forget().
    View at(std::int32_t node) const {
        const Range& r = ranges_[static_cast<std::size_t>(node)];
        return {std::span(corners_).subspan(r.corner, r.n_corners),
                std::span(interfaces_).subspan(r.interface, r.n_interfaces),
                std::span(per_force_squared_).subspan(r.interface, r.n_interfaces)};
    }
    /// The mesh has come apart, or its numbers have changed, at nodes of these elements.
    void forget(std::span<const std::int32_t> elements);

private:
    struct Range {
        std::size_t corner = 0, interface = 0;
        std::uint32_t n_corners = 0, n_interfaces = 0;  ///< no corners: not known
    };

    const Mesh& mesh_;
    const InnerSides& inner_;
    std::span<const CohesionProperties<double>> properties_;
    double thickness_;
    std::vector<Range> ranges_;  ///< shape (n_nodes)
    std::vector<Corner> corners_;
    std::vector<Interface> interfaces_;
    std::vector<double> per_force_squared_;
    std::size_t n_forgotten_ = 0;  ///< corners that no node has any more
    Fan fan_;
};

}  // namespace gneiss
