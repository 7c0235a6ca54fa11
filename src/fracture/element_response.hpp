#pragma once
// Stresses, nodal forces and masses of single elements in an accepted state, found pack by pack as they are asked for.

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/inner_sides.hpp"
#include "model/element_forces.hpp"

namespace gneiss {

class ElementResponse {
public:
    /// @param mesh, inner, elements  referred to
    ElementResponse(const Mesh& mesh, const InnerSides& inner, const ElementForces& elements)
        : mesh_(mesh), inner_(inner), elements_(elements) {}

    /// From here on, until the next call, of this state.
    void look_at(const State& state);

    /// Cauchy stress next to a sub-edge of a side, without its viscous part, xx, yy, xy, Pa.
    /// @param part  number of the sub-edge in the element's own walk: 0, or 1 for the second one of a composite
    std::array<double, 3> stress(const ElementSide& side, std::size_t part);
    /// Mean of both sides of an inner side.
    /// @param part  in the walk of its left element
    std::array<double, 3> mean_stress(std::int32_t side, std::size_t part);
    /// Force of an element on one of its nodes, viscous part included, N.
    Vec2<double> force(std::int32_t element, int node);
    /// An element's share of the mass at one of its nodes, kg.
    double mass(std::int32_t element, int node);

private:
    /// Where the answers of an element's pack stand, which is asked now unless it was before.
    std::size_t slot_of(std::int32_t element);

    const Mesh& mesh_;
    const InnerSides& inner_;
    const ElementForces& elements_;
    const State* state_ = nullptr;
    std::int64_t look_ = 0;
    std::vector<std::size_t> first_pack_;  ///< of each block
    std::vector<std::int64_t> seen_;       ///< look of each pack's answers
    std::vector<double> stresses_;         ///< shape (packs, sub-triangles, 3, lanes)
    std::vector<double> forces_;           ///< shape (packs, nodes, 2, lanes)
    std::vector<double> masses_;           ///< shape (elements, nodes); empty: not asked for yet
};

}  // namespace gneiss
