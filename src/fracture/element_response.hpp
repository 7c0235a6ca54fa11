#pragma once
// Stresses, nodal forces and masses of single elements in an accepted state, found pack by pack as they are asked for.

#include <array>
#include <cstdint>
#include <utility>
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
    /// An element's share of the mass at one of its nodes, kg.
    double mass(std::int32_t element, int node);

    // The same for who asks for many, step by step: places once, their packs all at once, then what stands there.

    /// Number of an element's pack. It and the places below stay what they are.
    std::size_t pack_of(std::int32_t element) const {
        const ElementForces::Place& place = elements_.place(element);
        return first_pack_[static_cast<std::size_t>(place.block)] + static_cast<std::size_t>(place.local) / pack_width;
    }
    std::size_t stress_place(const ElementSide& side, std::size_t part) const;
    std::size_t force_place(std::int32_t element, int node) const;
    /// What stands in a pack is to be found by the next find_wanted(), and not asked for before.
    void want(std::size_t pack) {
        if (std::exchange(seen_[pack], look_) != look_) wanted_.push_back(pack);
    }
    /// In parallel.
    void find_wanted();
    std::array<double, 3> mean_stress_at(std::size_t left, std::size_t right) const {
        const std::array<double, 3> a = stress_at(left), b = stress_at(right);
        return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
    }
    std::array<double, 3> stress_at(std::size_t place) const {
        return {stresses_[place], stresses_[place + pack_width], stresses_[place + 2 * pack_width]};
    }
    /// Of an element on one of its nodes, viscous part included, N.
    Vec2<double> force_at(std::size_t place) const { return {forces_[place], forces_[place + pack_width]}; }

private:
    std::size_t lane_of(std::int32_t element) const {
        return static_cast<std::size_t>(elements_.place(element).local) % pack_width;
    }
    void lay_out();
    void find(std::size_t pack);
    /// Finds an element's pack unless that was done before.
    void require(std::int32_t element) {
        if (const std::size_t pack = pack_of(element); seen_[pack] != look_) find(pack);
    }

    const Mesh& mesh_;
    const InnerSides& inner_;
    const ElementForces& elements_;
    const State* state_ = nullptr;
    std::int64_t look_ = 0;
    std::size_t n_sub_ = 0, n_nodes_ = 0;  ///< sub-triangles, nodes of an element
    std::vector<std::size_t> first_pack_;  ///< of each block, and the number of packs; empty: nothing is laid out yet
    std::vector<std::int64_t> seen_;       ///< look of each pack's answers
    std::vector<std::size_t> wanted_;      ///< packs
    std::vector<double> stresses_;         ///< shape (packs, sub-triangles, 3, lanes)
    std::vector<double> forces_;           ///< shape (packs, nodes, 2, lanes)
    std::vector<double> masses_;           ///< shape (elements, nodes); empty: not asked for yet
};

}  // namespace gneiss
