#pragma once
// Cracks that grow: sides of elements open where they reach their strength, and go over to contact when nothing holds
// them any more  [FORMULATION 7].

#include <functional>
#include <optional>
#include <vector>

#include "fracture/crack_criterion.hpp"
#include "fracture/joints.hpp"
#include "mesh/inner_sides.hpp"
#include "model/solid_system.hpp"
#include "system/event.hpp"

namespace gneiss {

/// Looks at every accepted state.
///
/// A criterion tells which sides open, and at which of their nodes. Nodes around which elements have come apart are
/// copied; the ends of joints between an original and its copies then get tractions with which every copy goes on with
/// the acceleration that the node had, so that neither velocity nor acceleration jumps:
///
///   sum over ends at copy g of (+-) w t = m_g a - f_g,   a = sum f_g/sum m_g,
///
/// t nearest, in the sense of least squares, to what the criterion found, or else to the mean of the stresses on both
/// sides.
class Cracking final : public Event {
public:
    struct Parts {
        Mesh& mesh;
        InnerSides& inner;  ///< of the mesh
        SolidSystem& solid;
        Joints& joints;  ///< one of the solid's interactions
        /// Of the sub-edges of every inner side, one behind the other; empty: no side opens, joints are there from the
        /// start.
        std::vector<CohesionProperties<double>> properties = {};
        FractureOptions::Criterion criterion = FractureOptions::Criterion::nodal;  ///< when they open
        double thickness = 1;                                                      ///< of the solid, m
        /// By how much the utilisation may be beyond 1 where sides open, -: Event::indicator_tolerance(); 0: no matter.
        double overshoot = 0;
        /// Which of these failed sides contact can take over: ContactBodies::come_apart(). Joints of the others go on
        /// to press, all of them where this is empty.
        std::function<std::vector<std::int32_t>(std::span<const std::int32_t>)> come_apart = {};
        /// Loads, constraints and absorbing boundaries of the mesh as it is. Called when a node of a named place was
        /// copied.
        std::function<SolidSystem::Surroundings(const Mesh&)> surroundings = {};
        bool loads_everywhere = false;  ///< body forces: any copy changes the surroundings
    };
    explicit Cracking(Parts parts);

    std::string name() const override { return "cracking"; }
    std::optional<double> next_time(const State&) const override { return std::nullopt; }
    EventOutcome apply(State&) override { return EventOutcome::none; }
    bool watches() const override { return true; }
    bool stirred(const State& state) const override;
    EventOutcome look(State& accepted) override;
    bool has_indicator() const override { return !parts_.properties.empty(); }
    double indicator_tolerance() const override { return parts_.overshoot; }
    /// How far the utilisation of what is nearest to its strength is beyond 1; -1: nothing is near.
    double indicator(const State& state) const override;

    const Joints& joints() const { return parts_.joints; }
    const Mesh& mesh() const { return parts_.mesh; }
    const InnerSides& inner() const { return parts_.inner; }
    const ElementForces& elements() const { return parts_.solid.elements(); }
    /// Inner sides that nothing holds any more: open without a joint, or all of their joints have failed. By number.
    std::vector<bool> broken_sides(const State& state) const;
    std::span<const double> history(const State& state) const;
    std::size_t n_events() const { return n_events_; }
    /// By how much the tractions with which ends of joints began were beyond the strength given, relative.
    struct Overshoot {
        double largest;         ///< so far
        double by_dissipation;  ///< mean, each end by what its fracture has dissipated
    };
    Overshoot overshoot(const State& state) const;
    /// When the first side has opened, s.
    std::optional<double> first_opening() const { return first_opening_; }

    /// What has been told of the openings, and what has come apart, in the order in which it did: enough to come to the
    /// same mesh again.
    std::vector<double> save() const;
    /// Lets a mesh as it was at the start come apart as told, together with all that hangs on it.
    /// @throws InputError if it does not fit the mesh
    void replay(const std::vector<double>& record);

private:
    struct Change {
        std::vector<SideNode> opened;      ///< ascending
        std::vector<std::int32_t> failed;  ///< sides
    };
    bool named(const std::vector<NodeCopy>& copies) const;
    void part(const Change& change, State& state);
    void wake_ends(State& state, const std::vector<CrackOpenings::Start>& starts);

    Parts parts_;
    std::vector<double> record_;
    std::size_t n_events_ = 0;
    double largest_overshoot_ = 0;
    std::optional<double> first_opening_;        ///< s
    std::unique_ptr<CrackCriterion> criterion_;  ///< null: no side opens
    std::vector<double> force_;
};

}  // namespace gneiss
