#pragma once
// Pressure that stays normal to the current boundary and acts per current length.

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec2.hpp"
#include "mesh/mesh.hpp"
#include "model/amplitude.hpp"
#include "model/force_term.hpp"

namespace gneiss {

/// Follower pressure on the edges of a boundary, linear along each edge between the values that belong to the reference
/// positions of its nodes. A constant pressure is conservative: its force is -p h times the gradient of the area that
/// the current edges enclose.
class FollowerPressure final : public ForceTerm {
public:
    /// @param value      pressure at amplitude 1, Pa, > 0 pushes onto the solid
    /// @param thickness  h, m, > 0
    /// @throws InputError if `value` is not finite at a node
    FollowerPressure(std::string name, const Mesh& mesh, const std::vector<BoundaryEdge>& edges,
                     const CompiledFormula& value, Amplitude amplitude, double thickness);

    std::string name() const override { return name_; }
    void add_force(const Trial& trial, std::span<double> f) const override;
    void corner_forces(const Trial& trial, std::vector<CornerForce>& forces) const override;
    std::vector<std::array<std::int32_t, 2>> couplings() const override;
    void stiffness(const Trial& trial, std::span<Stiffness> df_du) const override;
    void add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const override;
    std::vector<double> switch_times() const override { return amplitude_.switch_times(); }

private:
    struct Edge {
        std::int32_t a, b, element;
        Vec2<double> x_a, x_b;  ///< reference positions, m
        double p_a, p_b;        ///< at amplitude 1, Pa
    };

    std::array<Vec2<double>, 2> forces(const Edge& edge, const Amplitude::Instant& amplitude,
                                       std::span<const double> u) const;

    std::string name_;
    std::vector<Edge> edges_;
    Amplitude amplitude_;
    double thickness_;
};

}  // namespace gneiss
