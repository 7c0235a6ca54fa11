#pragma once
// What joints store and dissipate, and what bounds their stiffness: another part of joint_batch.hpp.

#include "fracture/joint_batch.hpp"

namespace gneiss {

template <class Law, bool extrinsic>
double JointBatch<Law, extrinsic>::omega_squared(const Trial&, std::span<const double> history,
                                                 std::span<const double> lumped_mass) const {
    // sums of magnitudes along the rows of M^-1 K: each spring ties a node to one other
    bound_.assign(lumped_mass.size() / 2, 0.0);
    for_each_spring(history, [&](std::int32_t node, double k) { bound_[static_cast<std::size_t>(node)] += 2 * k; });
    double largest = 0;
    for (std::size_t node = 0; node < bound_.size(); ++node)
        largest = std::max(largest, bound_[node] / lumped_mass[2 * node]);
    return largest;
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::add_stiffness_bound(const Trial&, std::span<const double> history,
                                                     std::span<double> bound) const {
    for_each_spring(history, [&](std::int32_t node, double k) {
        bound[2 * static_cast<std::size_t>(node)] += 2 * k;
        bound[2 * static_cast<std::size_t>(node) + 1] += 2 * k;
    });
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::add_stored(const Trial& accepted, std::span<const double> history,
                                            StoredEnergies& energies) const {
    energies.joints += ordered_sum(n_packs(), partial_, [&](std::size_t first, std::size_t last) {
        Pack sum(0.0);
        for (std::size_t pack = first; pack < last; ++pack) {
            const auto motion = of_law(pack, joint_motion(edge(pack), gather(accepted.u, pack)));
            for (std::size_t i = 0; i < joint_points; ++i) {
                const History at = history_of(history, pack, i);
                sum += weight(history, pack, at) *
                       Law::stored_energy(of(history, pack, i), at, motion.opening[i], motion.slip[i]);
            }
        }
        return sum_of_lanes(sum);
    });
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::add_dissipated(std::span<const double> from, std::span<const double> to,
                                                PathEnergies& energies) const {
    const auto sum_of = [&](auto dissipated) {
        return ordered_sum(n_packs(), partial_, [&](std::size_t first, std::size_t last) {
            Pack sum(0.0);
            for (std::size_t pack = first; pack < last; ++pack) {
                if (untouched(to, pack)) continue;
                for (std::size_t i = 0; i < joint_points; ++i) {
                    const History before = history_of(from, pack, i);
                    sum += weight(from, pack, before) * (dissipated(history_of(to, pack, i)) - dissipated(before));
                }
            }
            return sum_of_lanes(sum);
        });
    };
    energies.fracture += sum_of([](const History& at) { return at.fracture(); });
    energies.friction += sum_of([](const History& at) { return at.friction; });
}

}  // namespace gneiss
