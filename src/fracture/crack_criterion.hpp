#pragma once
// Which sides open in an accepted state, at which of their nodes, and with which tractions.

#include <memory>
#include <span>
#include <vector>

#include "fracture/cohesion.hpp"
#include "fracture/element_response.hpp"
#include "fracture/joints.hpp"
#include "model/options.hpp"
#include "model/solid_system.hpp"

namespace gneiss {

struct CrackOpenings {
    std::vector<SideNode> ends;  ///< ascending

    /// The traction with which an end of a joint begins, where the criterion knows it.
    struct Start {
        std::int32_t side;
        std::size_t part, end;  ///< sub-edge in the walk of the left element, and 0 or 1 of its ends
        Vec2<double> on_left;   ///< Pa
    };
    std::vector<Start> starts;
};

class CrackCriterion {
public:
    struct Parts {
        const Mesh& mesh;
        const InnerSides& inner;
        const SolidSystem& solid;
        const Joints& joints;
        /// Of the sub-edges of every inner side, one behind the other; has to outlive the criterion.
        std::span<const CohesionProperties<double>> properties;
        double thickness;  ///< m
    };
    explicit CrackCriterion(Parts parts) : parts_(parts), response_(parts.mesh, parts.inner, parts.solid.elements()) {}
    virtual ~CrackCriterion() = default;

    /// Of a state whose elements near their strength are known (ElementForces::beyond).
    CrackOpenings openings(const State& state) {
        response_.look_at(state);
        return find(state);
    }
    /// Largest utilisation of the strength among the sides that are near it, -: 1 where one opens; 0: none is near.
    double utilisation(const State& state) {
        response_.look_at(state);
        return find_utilisation(state);
    }
    /// Mean of the stresses on both sides of a sub-edge, xx, yy, xy, Pa; of the state looked at last.
    std::array<double, 3> mean_stress(std::int32_t side, std::size_t part) { return response_.mean_stress(side, part); }
    void look_at(const State& state) { response_.look_at(state); }
    /// Sides have opened at nodes of these elements.
    virtual void follow(std::span<const std::int32_t> elements) { (void)elements; }

protected:
    virtual CrackOpenings find(const State& state) = 0;
    virtual double find_utilisation(const State& state) = 0;
    /// visit(element) for every element with a stress beyond its watch.
    template <class Visit>
    void for_each_element_beyond(const State& state, Visit visit) const {
        const ElementForces& elements = parts_.solid.elements();
        for (std::size_t b = 0; b < elements.blocks().size(); ++b) {
            const ElementBlock& block = *elements.blocks()[b];
            const auto beyond = elements.beyond(b, state);
            for (std::size_t pack = 0; pack < beyond.size(); ++pack) {
                const auto lanes = static_cast<unsigned>(beyond[pack]);
                for (std::size_t lane = 0; lane < pack_width && lanes >> lane != 0; ++lane)
                    if (const std::size_t local = pack * pack_width + lane;
                        (lanes >> lane & 1U) != 0 && local < block.n_elements())
                        visit(block.element(local));
            }
        }
    }

    Parts parts_;
    ElementResponse response_;
};

/// Which elements a criterion has to look at.
WatchReach watch_reach(FractureOptions::Criterion criterion);

std::unique_ptr<CrackCriterion> make_crack_criterion(FractureOptions::Criterion criterion, CrackCriterion::Parts parts);

}  // namespace gneiss
