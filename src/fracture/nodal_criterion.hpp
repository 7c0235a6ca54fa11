#pragma once
// Nodes come apart where no tractions inside the strength envelope hold their elements together any more.

#include "fracture/crack_criterion.hpp"
#include "fracture/fan.hpp"
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
    explicit NodalCriterion(Parts parts) : CrackCriterion(parts) {}

private:
    CrackOpenings find(const State& state) override;
    double find_utilisation(const State& state) override;
    /// visit(fan, rupture) for every node that may rupture.
    template <class Visit>
    void for_each_node(const State& state, Visit visit);
    void find_corner_forces(const State& state);
    FanInterface interface_of(const State& state, const Fan::Interface& at);

    std::int64_t look_ = 0;
    std::vector<std::int64_t> looked_at_;  ///< per node
    std::vector<std::int32_t> candidates_;
    bool has_corner_forces_ = false;          ///< whether those of this look are known
    std::vector<CornerForce> corner_forces_;  ///< on edges and faces, by ascending node
    Fan fan_;
    NodeRupture rupture_;
    std::vector<FanCorner> corners_;
    std::vector<FanInterface> interfaces_;
};

}  // namespace gneiss
