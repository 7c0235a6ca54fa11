#pragma once
// Joints: pairs of sub-edges that a cohesion law holds together  [FORMULATION 7].

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/vec2.hpp"
#include "fracture/cohesion_properties.hpp"
#include "mesh/inner_sides.hpp"
#include "model/interaction.hpp"

namespace gneiss {

/// One joint: nodes of the sub-edge of the left element in walking order, the nodes opposite them, and what holds them.
struct Joint {
    std::array<std::int32_t, 4> nodes;  ///< a0, a1, b0, b1 of joint_kernel.hpp
    CohesionProperties<double> properties;
    std::int32_t side = 0;  ///< number of the inner side
};

/// A sub-edge along which two elements touch.
struct JointEdge {
    std::array<std::int32_t, 4> nodes;  ///< as in Joint
    std::int32_t left, right;           ///< elements
    std::int32_t side;                  ///< number of the inner side
};

/// The sub-edges of sides of elements: one for a CST, two for a composite.
/// @param sides  numbers of inner sides
std::vector<JointEdge> joint_edges(const Mesh& mesh, const InnerSides& inner, std::span<const std::int32_t> sides);

enum class JointLaw {
    intrinsic,  ///< MixedModeLaw<Insertion::intrinsic>
    y_code      ///< YCodeLaw
};

/// A joint as output shows it. Two values: of its two ends.
struct JointState {
    std::array<std::int32_t, 4> nodes;  ///< as in Joint
    std::int32_t side;                  ///< number of the inner side
    double length;                      ///< in the reference shape, m
    /// Of extrinsic ends with the strengths at which they were found to open.
    std::array<CohesionProperties<double>, 2> properties;
    std::array<double, 2> opening, slip;            ///< m
    std::array<double, 2> damage;                   ///< D, 0 to 1
    std::array<double, 2> fracture_i, fracture_ii;  ///< dissipated so far by fracture in opening, in sliding, J/m2
    std::array<double, 2> friction;                 ///< dissipated so far by friction, J/m2
    std::array<double, 2> strength_factor;  ///< of `properties` over the strengths given: 1, more for extrinsic ends
                                            ///< that began beyond them
    double mode;       ///< 1 opening, 0 sliding: o^2/(o^2 + s^2) of both ends where it failed, or as it is now
    double failed_at;  ///< s; 0: it has not failed
};

/// Joints of a solid, whose number may grow. An end that has no traction yet waits: its two nodes are one still, or
/// have parted in this very instant.
class Joints : public Interaction {
public:
    virtual std::size_t n_joints() const = 0;
    /// Which of its side's joints it is, in the order of joint_edges(): 0, or 1 for the second one of a composite.
    virtual std::size_t part_of_side(std::size_t joint) const = 0;
    /// Length of joints with damage at both ends, in the reference shape, m.
    virtual double cracked_length(std::span<const double> history) const = 0;
    /// Its inner side, and whether it has failed.
    virtual std::pair<std::int32_t, bool> failure(std::size_t joint, std::span<const double> history) const = 0;
    virtual JointState state_of(std::size_t joint, const State& state, std::span<const double> history) const = 0;

    /// Whether any joint has failed, at one end at least, and has not been handed over.
    virtual bool any_failed(std::span<const double> history) const = 0;
    /// Sides all of whose joints have failed and let go: open at both ends, or with an end that has opened or slid by
    /// more than a part of the length, past which the ends no longer lie opposite each other. So do those whose faces
    /// have turned about an end that holds, the other one being that far. Ascending.
    virtual std::vector<std::int32_t> sides_let_go(const State& accepted, std::span<const double> history) const = 0;
    /// From here on there is no force between these sides, but at ends of joints that have not failed.
    /// @return what was still stored there, J
    virtual double hand_over(std::span<const std::int32_t> sides, const State& accepted,
                             std::span<double> history) const = 0;

    /// Appends the forces of extrinsic joints on the elements at both sides.
    /// @param wanted  per node, not zero: at this one
    virtual void corner_forces(const State& accepted, std::span<const double> history,
                               std::span<const std::uint8_t> wanted, std::vector<CornerForce>& forces) const = 0;

    /// An end of a joint: one that waits for a traction while its nodes have parted, or any.
    struct WaitingEnd {
        std::size_t joint;
        std::size_t end;             ///< 0 or 1
        std::int32_t a, b;           ///< nodes
        double weight;               ///< w of joint_kernel.hpp, m2
        Vec2<double> normal, along;  ///< n, t: the force of a traction on a is w (t_n n + t_s t)
        std::int32_t side;
    };
    virtual std::vector<WaitingEnd> waiting(const State& accepted, std::span<const double> history) const = 0;
    /// What an end begins with.
    struct Start {
        double energy;     ///< in its springs, J
        double overshoot;  ///< of its traction over the strength that it was given, relative, >= 0
    };
    /// Gives an end its traction, from which it softens.
    /// @param normal, shear  Pa
    virtual Start wake(const WaitingEnd& end, double normal, double shear, std::span<double> history) const = 0;

    /// All ends, in the reference shape.
    virtual std::vector<WaitingEnd> ends() const = 0;
    /// Of joints that are there from the start: the traction of an end before anything has moved. To be called before
    /// initial_history().
    /// @param normal, shear  Pa; beyond the strength the end starts to fail in the first step
    virtual void preload(const WaitingEnd& end, double normal, double shear) = 0;
};

/// @param joints     at least one; their nodes stand at the same places in pairs
/// @param thickness  of the solid, m
/// @param law        intrinsic or y_code: all joints that there ever are
std::unique_ptr<Joints> make_joints(const Mesh& mesh, const std::vector<Joint>& joints, JointLaw law, double thickness);

/// Joints that come into being where sides open (Parting::opened), none at the start.
/// @param inner       of the mesh; has to outlive the joints
/// @param properties  of every inner side's sub-edges, one behind the other in the order of joint_edges()
std::unique_ptr<Joints> make_extrinsic_joints(const InnerSides& inner,
                                              std::vector<CohesionProperties<double>> properties, double thickness);

}  // namespace gneiss
