#pragma once
// Forces that do not follow the deformation: at nodes, tractions on boundaries, body forces.

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec2.hpp"
#include "mesh/mesh.hpp"
#include "model/amplitude.hpp"
#include "model/force_term.hpp"

namespace gneiss {

/// The part of a load that one node takes from one place.
struct LoadShare {
    std::int32_t node;
    Vec2<double> force;         ///< N, at amplitude 1
    Vec2<double> at;            ///< reference position whose amplitude scales it, m
    std::int32_t element = -1;  ///< whose edge it acts on; -1: none's
};

/// A pattern of nodal forces times an amplitude: nodal forces, tractions and body forces differ in the pattern alone.
class DeadLoad final : public ForceTerm {
public:
    /// @param shares  in any order; those of one node at one place are summed once and for all
    DeadLoad(std::string name, std::vector<LoadShare> shares, Amplitude amplitude);

    std::string name() const override { return name_; }
    void add_force(const Trial& trial, std::span<double> f) const override;
    void corner_forces(const Trial& trial, std::vector<CornerForce>& forces) const override;
    void add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const override;
    std::vector<double> switch_times() const override { return amplitude_.switch_times(); }

private:
    std::string name_;
    std::vector<LoadShare> shares_;
    std::vector<LoadShare> on_edges_;  ///< those with an element, as they were given
    Amplitude amplitude_;
};

/// A vector field in the reference shape: N, Pa or N/m3.
using Field = std::array<CompiledFormula, 2>;

/// The same force, N, on each of the nodes (but for what `value` makes of their positions).
std::vector<LoadShare> nodal_force_shares(const Mesh& mesh, const std::vector<std::int32_t>& nodes, const Field& value);

/// Traction, Pa, per reference length: the values at the two nodes of an edge, linear between them, integrated exactly,
/// so that node a takes h L (2 t_a + t_b)/6.
std::vector<LoadShare> traction_shares(const Mesh& mesh, const std::vector<BoundaryEdge>& edges, const Field& value,
                                       double thickness);

/// Body force, N/m3, per reference volume: each sub-triangle gives a third of its volume to each of its nodes, as it
/// does with its mass [FORMULATION 2]; `value` is taken at the node.
std::vector<LoadShare> body_force_shares(const Mesh& mesh, const std::vector<std::int32_t>& elements,
                                         const Field& value, double thickness);

}  // namespace gneiss
