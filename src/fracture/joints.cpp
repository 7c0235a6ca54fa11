#include "fracture/joints.hpp"

#include "fracture/joint_batch_energies.hpp"
#include "fracture/joint_batch_topology.hpp"
#include "fracture/y_code_law.hpp"

namespace gneiss {

std::vector<JointEdge> joint_edges(const Mesh& mesh, const InnerSides& inner, std::span<const std::int32_t> sides) {
    std::vector<JointEdge> all;
    for (const std::int32_t side : sides) {
        const auto& [left, right] = inner.sides()[static_cast<std::size_t>(side)];
        const auto a = side_nodes(mesh.kind, left.side), b = side_nodes(mesh.kind, right.side);
        const std::int32_t* of_left = mesh.element(static_cast<std::size_t>(left.element));
        const std::int32_t* of_right = mesh.element(static_cast<std::size_t>(right.element));
        for (std::size_t k = 0; k + 1 < a.size(); ++k)  // the right element walks the other way
            all.push_back(
                {{of_left[a[k]], of_left[a[k + 1]], of_right[b[b.size() - 1 - k]], of_right[b[b.size() - 2 - k]]},
                 left.element,
                 right.element,
                 side});
    }
    return all;
}

std::unique_ptr<Joints> make_joints(const Mesh& mesh, const std::vector<Joint>& joints, JointLaw law,
                                    double thickness) {
    if (law == JointLaw::y_code) return std::make_unique<JointBatch<YCodeLaw, false>>(mesh, joints, thickness);
    return std::make_unique<JointBatch<MixedModeLaw<Insertion::intrinsic>, false>>(mesh, joints, thickness);
}

std::unique_ptr<Joints> make_extrinsic_joints(const InnerSides& inner,
                                              std::vector<CohesionProperties<double>> properties, double thickness) {
    return std::make_unique<JointBatch<MixedModeLaw<Insertion::extrinsic>, true>>(
        Mesh{}, std::vector<Joint>{}, thickness, &inner, std::move(properties));
}

}  // namespace gneiss
