#pragma once
// Nodes come apart where no tractions inside the strength envelope hold their elements together any more.

#include "fracture/crack_criterion.hpp"
#include "fracture/fan_table.hpp"
#include "fracture/node_rupture.hpp"

namespace gneiss {

/// The criterion of node_rupture.hpp at every node next to an element whose stress is near the strength of its sides.
/// An end opens when the traction with which it begins reaches the envelope.
///
/// Forces that belong to one element (its stresses, tractions and pressures on its edges, cohesion at its faces) act on
/// its corner. All others (body forces, contact, mass-proportional damping, viscous boundaries, forces at nodes) are
/// shared by mass, and cancel: contact hands its force to the copies of a node by their masses as well.
class NodalCriterion final : public CrackCriterion {
public:
    explicit NodalCriterion(Parts parts)
        : CrackCriterion(parts), fans_(parts.mesh, parts.inner, parts.properties, parts.thickness) {}
    void follow(std::span<const std::int32_t> elements) override { fans_.forget(elements); }

private:
    /// What is found in a range of candidates, and the scratch to find it.
    struct Found {
        CrackOpenings openings;
        double utilisation;
        std::vector<FanCorner> corners;
        std::vector<FanInterface> interfaces;
        NodeRupture rupture;
    };
    CrackOpenings find(const State& state) override;
    double find_utilisation(const State& state) override;
    /// The parts of found_ that this look has filled, in the order of the candidates.
    std::span<Found> look(const State& state);
    void find_candidates(const State& state);
    void find_corner_forces(const State& state);
    void look_at_node(const State& state, std::int32_t node, Found& found) const;
    void add_openings(std::int32_t node, const NodeRupture& rupture, CrackOpenings& openings) const;

    std::int64_t look_ = 0;
    std::vector<std::int64_t> looked_at_;  ///< per node
    std::vector<std::int32_t> candidates_;
    FanTable fans_;
    std::vector<std::uint8_t> open_fan_;      ///< per node: a candidate with an open fan
    std::vector<std::uint8_t> held_;          ///< per node, bit c: a support moves its component c
    std::vector<CornerForce> corner_forces_;  ///< on edges and faces at nodes with open fans, by ascending node
    std::vector<Found> found_;
};

}  // namespace gneiss
