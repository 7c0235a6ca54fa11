#pragma once
// How joints are put in order and follow a mesh that comes apart, and what is told of one of them: another part of
// joint_batch.hpp.

#include "fracture/joint_batch.hpp"

namespace gneiss {

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::plan_sums() {
    const std::size_t first_loose = first_loose_pack() * pack_width;
    std::int32_t largest = -1;
    for (std::size_t joint = first_loose; joint < n_joints_; ++joint)
        for (std::size_t k = 0; k < joint_nodes; ++k) largest = std::max(largest, node(joint, k));
    std::vector<std::size_t> next(static_cast<std::size_t>(largest + 2), 0);
    for (std::size_t joint = first_loose; joint < n_joints_; ++joint)
        for (std::size_t k = 0; k < joint_nodes; ++k) ++next[static_cast<std::size_t>(node(joint, k)) + 1];
    touched_.clear();
    first_.clear();
    for (std::size_t n = 0; n + 1 < next.size(); ++n) {
        if (next[n + 1] > 0) {
            touched_.push_back(static_cast<std::int32_t>(n));
            first_.push_back(next[n]);
        }
        next[n + 1] += next[n];
    }
    slots_.resize(next.back());
    first_.push_back(slots_.size());
    // in the order in which add_force() goes through packs
    for (std::size_t pack = first_loose_pack(); pack < n_packs(); ++pack)
        for (std::size_t k = 0; k < joint_nodes; ++k)
            for (std::size_t joint = pack * pack_width; joint < std::min((pack + 1) * pack_width, n_joints_); ++joint)
                slots_[next[static_cast<std::size_t>(node(joint, k))]++] =
                    (pack * n_dof + 2 * k) * pack_width + joint % pack_width;
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::take_chunks(std::span<const std::int32_t> chunk_of_node, std::size_t n_chunks) {
    if (extrinsic) return;
    // joints of a side stay together
    std::vector<std::vector<std::size_t>> inside(n_chunks);
    std::vector<std::size_t> loose, order;
    for (std::size_t first = 0, last = 0; first < n_joints_; first = last) {
        std::int32_t chunk = chunk_of_node[static_cast<std::size_t>(node(first, 0))];
        for (; last < n_joints_ && sides_[last] == sides_[first]; ++last)
            for (std::size_t k = 0; k < joint_nodes; ++k)
                if (chunk_of_node[static_cast<std::size_t>(node(last, k))] != chunk) chunk = -1;
        auto& to = chunk < 0 ? loose : inside[static_cast<std::size_t>(chunk)];
        for (std::size_t joint = first; joint < last; ++joint) to.push_back(joint);
    }
    last_pack_of_chunk_.clear();
    for (const std::vector<std::size_t>& joints : inside) {
        // whole packs; a side has one joint, or two like all others: none is cut in two
        const auto whole = joints.begin() + static_cast<std::ptrdiff_t>(joints.size() / pack_width * pack_width);
        order.insert(order.end(), joints.begin(), whole);
        loose.insert(loose.end(), whole, joints.end());
        last_pack_of_chunk_.push_back(order.size() / pack_width);
    }
    std::ranges::sort(loose);
    order.insert(order.end(), loose.begin(), loose.end());
    const auto reorder = [&](auto& values, std::size_t n_rows) {
        const auto old = values;
        for (std::size_t to = 0; to < n_joints_; ++to)
            for (std::size_t r = 0; r < n_rows; ++r)
                values[(to / pack_width * n_rows + r) * pack_width + to % pack_width] =
                    old[(order[to] / pack_width * n_rows + r) * pack_width + order[to] % pack_width];
    };
    reorder(nodes_, joint_nodes);
    reorder(edges_, 2);
    reorder(weights_, 1);
    reorder(properties_, n_properties);
    if (has_elastic_range) reorder(elastic_, 2);
    const auto sides = sides_;
    for (std::size_t joint = 0; joint < n_joints_; ++joint) {
        sides_[joint] = sides[order[joint]];
        last_of_side_[static_cast<std::size_t>(sides_[joint])] = joint;
    }
    fill_last_pack();
    plan_sums();
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::follow(const Parting& parting, const State&, std::vector<double>& history,
                                        PathEnergies&) {
    if constexpr (extrinsic) {
        const std::size_t n_old = n_packs();
        // sides at the elements whose nodes have changed, once each
        std::vector<std::int32_t> sides;
        for (const std::int32_t e : parting.elements)
            for (int side = 0; side < 3; ++side) {
                const std::int32_t s = inner_->number({e, side});
                if (s >= 0 && static_cast<std::size_t>(s) < last_of_side_.size() &&
                    last_of_side_[static_cast<std::size_t>(s)] != nowhere)
                    sides.push_back(s);
            }
        std::ranges::sort(sides);
        sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
        const std::size_t per_side = parting.mesh.kind == ElementKind::cst ? 1 : 2;
        const auto renamed = joint_edges(parting.mesh, *inner_, sides);
        for (std::size_t i = 0; i < renamed.size(); ++i) {
            const std::size_t joint =
                last_of_side_[static_cast<std::size_t>(renamed[i].side)] + 1 - per_side + i % per_side;
            for (std::size_t k = 0; k < joint_nodes; ++k) node_number(joint, k) = {renamed[i].nodes[k]};
        }
        const auto fresh = joint_edges(parting.mesh, *inner_, parting.opened);
        for (std::size_t i = 0; i < fresh.size(); ++i)
            append(parting.mesh,
                   {fresh[i].nodes, later_[per_side * static_cast<std::size_t>(fresh[i].side) + i % per_side],
                    fresh[i].side});
        fill_last_pack();
        plan_sums();
        history.insert(history.begin() + static_cast<std::ptrdiff_t>(n_old), n_packs() - n_old, 0.0);
        history.resize(n_history(), 0.0);
        for (std::size_t pack = n_old; pack < n_packs(); ++pack)
            for (std::size_t i = 0; i < joint_points; ++i) store(Pack(1.0), history, pack, factor_row + i);
    } else {
        (void)parting;
        (void)history;
    }
}

template <class Law, bool extrinsic>
JointMotion<double> JointBatch<Law, extrinsic>::motion_of(std::size_t joint, std::span<const double> u) const {
    const std::size_t x = 2 * (joint / pack_width) * pack_width + joint % pack_width;
    std::array<Vec2<double>, joint_nodes> at;
    for (std::size_t k = 0; k < joint_nodes; ++k) {
        const auto i = 2 * static_cast<std::size_t>(node(joint, k));
        at[k] = {u[i], u[i + 1]};
    }
    return joint_motion(Vec2<double>{edges_[x], edges_[x + pack_width]}, at);
}

template <class Law, bool extrinsic>
CohesionProperties<double> JointBatch<Law, extrinsic>::given(std::size_t joint) const {
    const std::size_t first = n_properties * (joint / pack_width) * pack_width + joint % pack_width;
    CohesionProperties<double> p{};
    for (std::size_t i = 0; i < n_properties; ++i)
        p.*CohesionProperties<double>::members[i] = properties_[first + i * pack_width];
    return p;
}

template <class Law, bool extrinsic>
JointState JointBatch<Law, extrinsic>::state_of(std::size_t joint, const State& state,
                                                std::span<const double> history) const {
    JointState result{};
    const auto motion = motion_of(joint, state.u);
    const auto member = [&](Pack History::*which, std::size_t point) {
        return history[entry(joint, member_row(point, member_number(which)))];
    };
    for (std::size_t k = 0; k < joint_nodes; ++k) result.nodes[k] = node(joint, k);
    result.side = sides_[joint];
    result.length = length(joint);
    result.properties.fill(given(joint));
    result.strength_factor.fill(1);
    if constexpr (extrinsic)
        for (std::size_t i = 0; i < joint_points; ++i) {
            result.strength_factor[i] = history[entry(joint, factor_row + i)];
            result.properties[i] = scaled_strength(result.properties[i], result.strength_factor[i]);
        }
    double apart = 0, both = 0;
    for (std::size_t i = 0; i < joint_points; ++i) {
        result.opening[i] = motion.opening[i];
        result.slip[i] = motion.slip[i];
        result.damage[i] = member(&History::damage, i);
        result.fracture_i[i] = member(&History::fracture_i, i);
        result.fracture_ii[i] = member(&History::fracture_ii, i);
        result.friction[i] = member(&History::friction, i);
        const double open = std::max(0.0, motion.opening[i]);
        apart += open * open;
        both += open * open + motion.slip[i] * motion.slip[i];
    }
    result.failed_at = std::abs(history[entry(joint, failure_row)]);
    result.mode = result.failed_at > 0 ? history[entry(joint, mode_row)] : both > 0 ? apart / both : 0;
    return result;
}

template <class Law, bool extrinsic>
double JointBatch<Law, extrinsic>::cracked_length(std::span<const double> history) const {
    double sum = 0;
    for (std::size_t joint = 0; joint < n_joints_; ++joint)
        if (history[entry(joint, failure_row)] != 0) sum += length(joint);
    return sum;
}

template <class Law, bool extrinsic>
bool JointBatch<Law, extrinsic>::any_failed(std::span<const double> history) const {
    for (std::size_t pack = 0; pack < n_packs(); ++pack) {
        if (untouched(history, pack)) continue;
        const Pack failed = row(history, pack, failure_row);
        Pack damage(0.0);
        for (std::size_t i = 0; i < joint_points; ++i)
            damage = xsimd::max(damage, row(history, pack, member_row(i, member_number(&History::damage))));
        const auto one_end =
            (failed == Pack(0.0)) && (row(history, pack, mode_row) >= Pack(0.0)) && (damage >= Pack(1.0));
        if (any_lane((failed > Pack(0.0)) || one_end)) return true;
    }
    return false;
}

template <class Law, bool extrinsic>
std::vector<std::int32_t> JointBatch<Law, extrinsic>::sides_let_go(const State& accepted,
                                                                   std::span<const double> history) const {
    const auto lets_go = [&](std::size_t joint) {
        const double failed = history[entry(joint, failure_row)];
        if (untouched(history, joint / pack_width) || failed < 0) return false;
        if (failed == 0 && history[entry(joint, mode_row)] < 0) return false;  // contact sees its faces already
        const auto motion = motion_of(joint, accepted.u);
        bool open = failed > 0, far = false;
        for (std::size_t i = 0; i < joint_points; ++i) {
            // an end that presses from the start does so until it has opened by what its spring was compressed
            double offset = preload_.empty() ? 0 : preload_[preloaded(joint, i)];
            if constexpr (extrinsic)
                offset = history[entry(joint, member_row(i, member_number(&History::opening_offset)))];
            open = open && motion.opening[i] >= std::max(0.0, -offset);
            const bool holds = history[entry(joint, member_row(i, member_number(&History::damage)))] < 1;
            far = far || (!holds && std::max(motion.opening[i], std::abs(motion.slip[i])) > far_way * motion.length);
        }
        return open || far;
    };
    std::vector<std::int32_t> sides;
    for (std::size_t joint = 0; joint < n_joints_; ++joint) {
        const auto side = static_cast<std::size_t>(sides_[joint]);
        if (last_of_side_[side] != joint || !lets_go(joint)) continue;
        if (part_of_side(joint) == 0 || lets_go(joint - 1)) sides.push_back(sides_[joint]);
    }
    std::ranges::sort(sides);
    return sides;
}

template <class Law, bool extrinsic>
double JointBatch<Law, extrinsic>::hand_over(std::span<const std::int32_t> sides, const State& accepted,
                                             std::span<double> history) const {
    StoredEnergies before, after;
    const Trial at = Trial::of(accepted);
    add_stored(at, history, before);
    for (const std::int32_t side : sides) {
        const std::size_t last = last_of_side_[static_cast<std::size_t>(side)];
        for (std::size_t joint = last; joint != nowhere && sides_[joint] == side; --joint) {
            double& failed = history[entry(joint, failure_row)];
            if (failed == 0) history[entry(joint, mode_row)] = -1;  // it goes on to hold
            failed = -std::abs(failed);
            if (joint == 0) break;
        }
    }
    add_stored(at, history, after);
    return before.joints - after.joints;
}

template <class Law, bool extrinsic>
auto JointBatch<Law, extrinsic>::waiting(const State& accepted, std::span<const double> history) const
    -> std::vector<WaitingEnd> {
    std::vector<WaitingEnd> ends;
    if constexpr (extrinsic) {
        constexpr std::size_t lambda_row = 1;
        static_assert(History::members[lambda_row] == &History::lambda_max);
        for (std::size_t joint = 0; joint < n_joints_; ++joint)
            for (std::size_t i = 0; i < joint_points; ++i) {
                if (history[entry(joint, member_row(i, lambda_row))] >= 1 || node(joint, i) == node(joint, i + 2))
                    continue;
                ends.push_back(end_of(joint, i, motion_of(joint, accepted.u)));
            }
    }
    return ends;
}

template <class Law, bool extrinsic>
auto JointBatch<Law, extrinsic>::wake(const WaitingEnd& end, double normal, double shear,
                                      std::span<double> history) const -> Start {
    if constexpr (extrinsic) {
        const InsertedPoint<double> point = insert_point(given(end.joint), normal, shear);
        for (std::size_t k = 0; k < n_members; ++k)
            history[entry(end.joint, member_row(end.end, k))] = point.history.*CohesionHistory<double>::members[k];
        history[entry(end.joint, factor_row + end.end)] = point.strength_factor;
        history[end.joint / pack_width] = 1;
        return {end.weight * point.offset_energy, point.strength_factor - 1};
    } else {
        return {0, 0};
    }
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::corner_forces(const State& accepted, std::span<const double> history,
                                               std::span<const std::uint8_t> wanted,
                                               std::vector<CornerForce>& forces) const {
    if constexpr (extrinsic) {
        const auto wants = [&](std::size_t joint, std::size_t k) {
            return wanted[static_cast<std::size_t>(node(joint, k))] != 0;
        };
        const auto visit = [&](std::size_t pack, const Nodal& f) {
            for (std::size_t joint = pack * pack_width; joint < std::min((pack + 1) * pack_width, n_joints_); ++joint) {
                if (history[entry(joint, failure_row)] < 0) continue;
                const std::size_t lane = joint % pack_width;
                const InnerSide& side = inner_->sides()[static_cast<std::size_t>(sides_[joint])];
                for (std::size_t k = 0; k < joint_nodes; ++k)
                    if (wants(joint, k))
                        forces.push_back({k < joint_points ? side.left.element : side.right.element,
                                          node(joint, k),
                                          {f[k].x.get(lane), f[k].y.get(lane)}});
            }
        };
        for (std::size_t joint = 0; joint < n_joints_; ++joint)
            if (wants(joint, 0) || wants(joint, 1) || wants(joint, 2) || wants(joint, 3)) {
                const std::size_t pack = joint / pack_width;
                for_each_pack(pack, pack + 1, Trial::of(accepted), history, {}, visit);
                joint = (pack + 1) * pack_width - 1;
            }
    }
}

template <class Law, bool extrinsic>
auto JointBatch<Law, extrinsic>::ends() const -> std::vector<WaitingEnd> {
    std::vector<WaitingEnd> all;
    for (std::size_t joint = 0; joint < n_joints_; ++joint)
        for (std::size_t i = 0; i < joint_points; ++i) all.push_back(end_of(joint, i, at_rest(joint)));
    return all;
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::preload(const WaitingEnd& end, double normal, double shear) {
    if constexpr (extrinsic) {
        assert(false);  // ends of extrinsic joints get their tractions when they wake
    } else {
        preload_.resize(n_packs() * 2 * joint_points * pack_width, 0.0);
        const auto start = Law::start(given(end.joint), normal, shear);
        double* to = &preload_[preloaded(end.joint, end.end)];
        to[0] = start.opening;
        to[pack_width] = start.slip;
        if constexpr (!has_elastic_range) {
            start_.resize(n_packs() * joint_points * n_members * pack_width, 0.0);
            const std::size_t pack = end.joint / pack_width, lane = end.joint % pack_width;
            for (std::size_t k = 0; k < n_members; ++k)
                start_[((joint_points * pack + end.end) * n_members + k) * pack_width + lane] =
                    start.history.*Law::template History<double>::members[k];
        }
    }
}

}  // namespace gneiss
