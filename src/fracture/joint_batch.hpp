#pragma once
// Joints side by side in packs: the Interaction behind joints.hpp, for one law. Included only by joints.cpp.
//
// History: for each pack 1, or 0 while nothing has happened to any of its joints, and then all of it is zero. Behind
// them, pack by pack, members of the law's history at both ends, then when the joints failed and in which mode; of
// extrinsic ones also by how much each end is stronger than its properties say. Packs follow each other, so that joints
// are appended. A time of failure below zero says that contact has taken over; a mode below zero, of a joint that has
// not failed, that contact sees its faces while one end holds.

#include <omp.h>
#include <algorithm>
#include <cmath>
#include <xsimd/xsimd.hpp>

#include "base/dual.hpp"
#include "base/flatten.hpp"
#include "base/pack.hpp"
#include "base/parallel.hpp"
#include "fracture/cohesion_law.hpp"
#include "fracture/envelope.hpp"
#include "fracture/interface_strength.hpp"
#include "fracture/joint_kernel.hpp"
#include "fracture/joints.hpp"

namespace gneiss {

/// Lanes behind the last joint repeat it with no weight.
template <class Law, bool extrinsic>
class JointBatch final : public Joints {
    using History = typename Law::template History<Pack>;
    using Nodal = std::array<Vec2<Pack>, joint_nodes>;
    using Packs = std::vector<double, xsimd::aligned_allocator<double>>;
    static constexpr std::size_t n_members = History::members.size(),
                                 n_properties = CohesionProperties<double>::members.size(), n_dof = 2 * joint_nodes,
                                 failure_row = joint_points * n_members, mode_row = failure_row + 1,
                                 factor_row = mode_row + 1, history_rows = factor_row + (extrinsic ? joint_points : 0);
    /// Whether there is a range in which nothing happens to a joint, and it is a pair of springs.
    static constexpr bool has_elastic_range = requires { &Law::elastic_reach; }
    &&!extrinsic;
    /// Way of an end over the length past which a failed joint no longer speaks for its faces.
    static constexpr double far_way = 0.1;

public:
    /// @param inner, later  of extrinsic joints: those that come into being where sides open
    JointBatch(const Mesh& mesh, const std::vector<Joint>& joints, double thickness, const InnerSides* inner = nullptr,
               std::vector<CohesionProperties<double>> later = {});

    std::string name() const override { return "joints"; }
    std::size_t n_joints() const override { return n_joints_; }
    std::size_t part_of_side(std::size_t joint) const override {
        return joint > 0 && sides_[joint - 1] == sides_[joint] ? 1 : 0;
    }
    bool irreversible() const override { return true; }  // also before the first joint opens
    std::size_t n_history() const override { return n_packs() * (1 + history_rows * pack_width); }
    void initial_history(std::span<double> history) const override;
    void add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                   std::span<double> updated) const override;
    /// Intrinsic ones do, whose nodes never change: joints inside chunks come first, chunk after chunk.
    void take_chunks(std::span<const std::int32_t> chunk_of_node, std::size_t n_chunks) override;
    void add_chunk_force(std::size_t chunk, const Trial& trial, std::span<const double> history, std::span<double> f,
                         std::span<double> updated) const override;
    void follow(const Parting& parting, const State& accepted, std::vector<double>& history,
                PathEnergies& energies) override;
    std::vector<std::array<std::int32_t, 2>> couplings() const override;
    bool symmetric() const override { return false; }  // friction, and damage in mixed mode
    void stiffness(const Trial& trial, std::span<const double> history,
                   std::span<ForceTerm::Stiffness> df_du) const override;
    double omega_squared(const Trial& trial, std::span<const double> history,
                         std::span<const double> lumped_mass) const override;
    void add_stiffness_bound(const Trial& trial, std::span<const double> history,
                             std::span<double> bound) const override;
    void add_stored(const Trial& accepted, std::span<const double> history, StoredEnergies& energies) const override;
    void add_dissipated(std::span<const double> from, std::span<const double> to,
                        PathEnergies& energies) const override;

    double cracked_length(std::span<const double> history) const override;
    std::pair<std::int32_t, bool> failure(std::size_t joint, std::span<const double> history) const override {
        return {sides_[joint], history[entry(joint, failure_row)] != 0};
    }
    JointState state_of(std::size_t joint, const State& state, std::span<const double> history) const override;
    bool any_failed(std::span<const double> history) const override;
    std::vector<std::int32_t> sides_let_go(const State& accepted, std::span<const double> history) const override;
    double hand_over(std::span<const std::int32_t> sides, const State& accepted,
                     std::span<double> history) const override;
    std::vector<WaitingEnd> waiting(const State& accepted, std::span<const double> history) const override;
    Start wake(const WaitingEnd& end, double normal, double shear, std::span<double> history) const override;
    void corner_forces(const State& accepted, std::span<const double> history, std::span<const std::uint8_t> wanted,
                       std::vector<CornerForce>& forces) const override;
    std::vector<WaitingEnd> ends() const override;
    void preload(const WaitingEnd& end, double normal, double shear) override;

private:
    std::size_t n_packs() const { return padded(n_joints_) / pack_width; }
    static Pack load(const Packs& values, std::size_t row) { return Pack::load_aligned(&values[row * pack_width]); }
    /// Where a pack's row begins in the history.
    std::size_t place(std::size_t pack, std::size_t which) const {
        return n_packs() + (pack * history_rows + which) * pack_width;
    }
    Pack row(std::span<const double> history, std::size_t pack, std::size_t which) const {
        return Pack::load_unaligned(&history[place(pack, which)]);
    }
    static constexpr std::size_t member_row(std::size_t point, std::size_t member) {
        return point * n_members + member;
    }
    static constexpr std::size_t member_number(Pack History::*which) {
        std::size_t number = 0;
        while (History::members[number] != which) ++number;
        return number;
    }
    /// Whether nothing has happened to the joints of a pack.
    static bool untouched(std::span<const double> history, std::size_t pack) { return history[pack] == 0; }
    /// Where a joint's entry of a row stands.
    std::size_t entry(std::size_t joint, std::size_t which) const {
        return place(joint / pack_width, which) + joint % pack_width;
    }
    /// Opening and slip as the law takes them: those of the traction at the start come on top.
    template <class T>
    JointMotion<T> of_law(std::size_t pack, JointMotion<T> motion) const {
        if (preload_.empty()) return motion;
        for (std::size_t i = 0; i < joint_points; ++i) {
            motion.opening[i] += T(load(preload_, 4 * pack + 2 * i));
            motion.slip[i] += T(load(preload_, 4 * pack + 2 * i + 1));
        }
        return motion;
    }
    /// Whether untouched joints stay elastic at this trial.
    bool stay_elastic(std::size_t pack, const Nodal& u) const {
        if (preload_.empty()) {
            // most ends are far from their strengths, and from where the direction of the joint matters
            const Vec2<Pack> start = u[2] - u[0], end = u[3] - u[1];
            const Pack reach_squared = load(elastic_, 2 * pack + 1);
            if (every_lane(xsimd::max(dot(start, start), dot(end, end)) <= reach_squared)) return true;
        }
        const auto motion = of_law(pack, joint_motion(edge(pack), u));
        CohesionProperties<Pack> p{};
        for (const std::size_t i : {0, 1, 2, 6})
            p.*CohesionProperties<Pack>::members[i] = load(properties_, n_properties * pack + i);
        const Pack intact(0.0);
        return every_lane(Law::stays_intact(p, intact, motion.opening[0], motion.slip[0]) &&
                          Law::stays_intact(p, intact, motion.opening[1], motion.slip[1]));
    }
    /// Forces of a pack that stays elastic.
    Nodal elastic(std::size_t pack, const Nodal& u) const {
        const Pack stiffness = load(elastic_, 2 * pack);
        if (preload_.empty()) return elastic_forces(stiffness, u);
        const auto motion = joint_motion(edge(pack), u), seen = of_law(pack, motion);
        return joint_forces(
            motion, stiffness,
            std::array{Traction<Pack>{seen.opening[0], seen.slip[0]}, Traction<Pack>{seen.opening[1], seen.slip[1]}});
    }
    Vec2<Pack> edge(std::size_t pack) const { return {load(edges_, 2 * pack), load(edges_, 2 * pack + 1)}; }
    double length(std::size_t joint) const {
        const std::size_t x = 2 * (joint / pack_width) * pack_width + joint % pack_width;
        return std::hypot(edges_[x], edges_[x + pack_width]);
    }
    /// Properties of a joint, without what an end is stronger than them.
    CohesionProperties<double> given(std::size_t joint) const;
    CohesionProperties<Pack> of(std::span<const double> history, std::size_t pack, std::size_t point) const {
        CohesionProperties<Pack> p;
        for (std::size_t i = 0; i < n_properties; ++i)
            p.*CohesionProperties<Pack>::members[i] = load(properties_, n_properties * pack + i);
        if constexpr (extrinsic) {
            const Pack factor = row(history, pack, factor_row + point);
            p.tensile_strength *= factor;
            p.cohesion *= factor;
        }
        return p;
    }
    /// Area that the traction at an end acts on, m2: none where contact has taken over, or the end waits.
    Pack weight(std::span<const double> history, std::size_t pack, const History& at) const {
        Pack w = choose(row(history, pack, failure_row) < Pack(0.0), Pack(0.0), load(weights_, pack));
        if constexpr (extrinsic) w = choose(at.lambda_max < Pack(1.0), Pack(0.0), w);
        return w;
    }
    History history_of(std::span<const double> history, std::size_t pack, std::size_t point) const {
        History h;
        for (std::size_t i = 0; i < n_members; ++i) h.*History::members[i] = row(history, pack, member_row(point, i));
        return h;
    }
    void store(const Pack& value, std::span<double> history, std::size_t pack, std::size_t which) const {
        value.store_unaligned(&history[place(pack, which)]);
    }
    Nodal gather(std::span<const double> u, std::size_t pack) const {
        Nodal at;
        for (std::size_t k = 0; k < joint_nodes; ++k)
            gather_pairs(u.data(), &nodes_[(pack * joint_nodes + k) * pack_width], at[k].x, at[k].y);
        return at;
    }
    JointMotion<double> motion_of(std::size_t joint, std::span<const double> u) const;
    /// Where nothing has moved.
    JointMotion<double> at_rest(std::size_t joint) const {
        const std::size_t x = 2 * (joint / pack_width) * pack_width + joint % pack_width;
        return joint_motion(Vec2<double>{edges_[x], edges_[x + pack_width]}, std::array<Vec2<double>, joint_nodes>{});
    }
    WaitingEnd end_of(std::size_t joint, std::size_t end, const JointMotion<double>& motion) const {
        return {joint,           end,           node(joint, end), node(joint, end + 2),
                weights_[joint], motion.normal, motion.along,     sides_[joint]};
    }
    /// Where the opening of an end stands in preload_; its slip is pack_width behind.
    static std::size_t preloaded(std::size_t joint, std::size_t end) {
        return 2 * (joint / pack_width * joint_points + end) * pack_width + joint % pack_width;
    }
    /// Stiffness of the springs at an end against the displacement of one node, N/m: in shear that of friction stands
    /// beside the cohesive one.
    double spring(std::size_t joint) const {
        const std::size_t pack = joint / pack_width, lane = joint % pack_width;
        const double* p = &properties_[n_properties * pack * pack_width + lane];
        const bool friction = p[2 * pack_width] > 0 || p[3 * pack_width] > 0;
        return p[6 * pack_width] * weights_[pack * pack_width + lane] * (friction ? 2 : 1);
    }
    /// visit(node, stiffness) for every node of every joint that holds or presses still.
    template <class Visit>
    void for_each_spring(std::span<const double> history, Visit visit) const {
        for (std::size_t joint = 0; joint < n_joints_; ++joint) {
            if (history[entry(joint, failure_row)] < 0) continue;
            for (std::size_t k = 0; k < joint_nodes; ++k) visit(node(joint, k), spring(joint));
        }
    }
    PairNumber& node_number(std::size_t joint, std::size_t k) {
        return nodes_[(joint / pack_width * joint_nodes + k) * pack_width + joint % pack_width];
    }
    std::int32_t node(std::size_t joint, std::size_t k) const {
        return nodes_[(joint / pack_width * joint_nodes + k) * pack_width + joint % pack_width].value;
    }
    /// take(pack, forces) for packs of joints, and their updated history. Flattened, so that a pack of elastic ones
    /// stays in registers.
    template <class Take>
    GNEISS_FLATTEN void for_each_pack(std::size_t first, std::size_t last, const Trial& trial,
                                      std::span<const double> history, std::span<double> updated, Take take) const;
    /// Forces of joints to which something has happened, or may, and their updated history.
    [[gnu::noinline]] Nodal soften(double t, std::span<const double> history, std::size_t pack, const Nodal& u,
                                   std::span<double> updated) const;
    void add_packs(std::size_t first, std::size_t last, const Trial& trial, std::span<const double> history,
                   std::span<double> f, std::span<double> updated) const;
    std::size_t first_loose_pack() const { return last_pack_of_chunk_.empty() ? 0 : last_pack_of_chunk_.back(); }
    void append(const Mesh& mesh, const Joint& joint);
    void fill_last_pack();
    void plan_sums();

    double thickness_;
    std::size_t n_joints_ = 0;
    std::vector<PairNumber> nodes_;  ///< shape (packs, joint_nodes, lanes)
    Packs edges_;                    ///< a0 to a1 in the reference shape, m, shape (packs, 2, lanes)
    Packs weights_;                  ///< m2, shape (packs, lanes)
    Packs properties_;               ///< shape (packs, n_properties, lanes)
    Packs elastic_;                  ///< w k, N/m, and the square of elastic_reach, m2, shape (packs, 2, lanes)
    Packs preload_;  ///< opening, slip of the tractions at the start, m, shape (packs, ends, 2, lanes); empty: none
    Packs start_;    ///< history at the start, shape (packs, ends, n_members, lanes); empty: all zero
    std::vector<std::int32_t> sides_;        ///< inner side of each joint
    std::vector<std::size_t> last_of_side_;  ///< joint with the highest number, shape (sides); `nowhere`: none
    static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
    const InnerSides* inner_;
    std::vector<CohesionProperties<double>> later_;
    std::vector<std::size_t>
        last_pack_of_chunk_;  ///< behind it are the next chunk's, behind the last one's loose joints
    // which forces of loose joints meet at a node, so that they are summed in one order
    std::vector<std::int32_t> touched_;            ///< nodes, ascending
    std::vector<std::size_t> first_;               ///< in slots_, shape (touched + 1)
    std::vector<std::size_t> slots_;               ///< of forces_: where x stands; y is pack_width behind
    mutable Packs forces_;                         ///< scratch, N, shape (packs, n_dof, lanes)
    mutable std::vector<double> bound_, partial_;  ///< scratch
};

template <class Law, bool extrinsic>
JointBatch<Law, extrinsic>::JointBatch(const Mesh& mesh, const std::vector<Joint>& joints, double thickness,
                                       const InnerSides* inner, std::vector<CohesionProperties<double>> later)
    : thickness_(thickness), inner_(inner), later_(std::move(later)) {
    for (const Joint& joint : joints) append(mesh, joint);
    fill_last_pack();
    plan_sums();
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::append(const Mesh& mesh, const Joint& joint) {
    const std::size_t pack = n_joints_ / pack_width, lane = n_joints_ % pack_width;
    if (lane == 0) {
        nodes_.resize((pack + 1) * joint_nodes * pack_width);
        edges_.resize((pack + 1) * 2 * pack_width);
        weights_.resize((pack + 1) * pack_width);
        properties_.resize((pack + 1) * n_properties * pack_width);
        if (has_elastic_range) elastic_.resize((pack + 1) * 2 * pack_width);
        forces_.resize((pack + 1) * n_dof * pack_width);
    }
    ++n_joints_;
    for (std::size_t k = 0; k < joint_nodes; ++k) node_number(n_joints_ - 1, k) = {joint.nodes[k]};
    const auto& start = mesh.nodes[static_cast<std::size_t>(joint.nodes[0])];
    const auto& end = mesh.nodes[static_cast<std::size_t>(joint.nodes[1])];
    const double dx = end[0] - start[0], dy = end[1] - start[1];
    edges_[2 * pack * pack_width + lane] = dx;
    edges_[(2 * pack + 1) * pack_width + lane] = dy;
    weights_[pack * pack_width + lane] = 0.5 * thickness_ * std::hypot(dx, dy);
    for (std::size_t i = 0; i < n_properties; ++i)
        properties_[(n_properties * pack + i) * pack_width + lane] =
            joint.properties.*CohesionProperties<double>::members[i];
    if constexpr (has_elastic_range) {
        const double reach = Law::elastic_reach(joint.properties);
        elastic_[2 * pack * pack_width + lane] = weights_[pack * pack_width + lane] * joint.properties.penalty;
        elastic_[(2 * pack + 1) * pack_width + lane] = reach * reach;
    }
    sides_.push_back(joint.side);
    const auto side = static_cast<std::size_t>(joint.side);
    if (side >= last_of_side_.size()) last_of_side_.resize(side + 1, nowhere);
    last_of_side_[side] = n_joints_ - 1;
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::fill_last_pack() {
    if (n_joints_ == 0) return;
    const auto repeat = [&](auto& values, std::size_t n_rows) {
        const std::size_t pack = (n_joints_ - 1) / pack_width, lane = (n_joints_ - 1) % pack_width;
        for (std::size_t r = 0; r < n_rows; ++r)
            for (std::size_t k = lane + 1; k < pack_width; ++k)
                values[(pack * n_rows + r) * pack_width + k] = values[(pack * n_rows + r) * pack_width + lane];
    };
    repeat(nodes_, joint_nodes);
    repeat(edges_, 2);
    repeat(properties_, n_properties);
    if (has_elastic_range) repeat(elastic_, 2);
    for (std::size_t slot = n_joints_; slot < n_packs() * pack_width; ++slot) {
        weights_[slot] = 0;
        if (has_elastic_range) elastic_[2 * (slot - slot % pack_width) + slot % pack_width] = 0;
    }
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::initial_history(std::span<double> history) const {
    std::ranges::fill(history, 0.0);
    constexpr std::size_t n_rows = joint_points * n_members;
    for (std::size_t pack = 0; pack < start_.size() / (n_rows * pack_width); ++pack) {
        history[pack] = 1;
        for (std::size_t r = 0; r < n_rows; ++r) store(load(start_, n_rows * pack + r), history, pack, r);
    }
    if constexpr (extrinsic)
        for (std::size_t pack = 0; pack < n_packs(); ++pack)
            for (std::size_t i = 0; i < joint_points; ++i) store(Pack(1.0), history, pack, factor_row + i);
}

template <class Law, bool extrinsic>
auto JointBatch<Law, extrinsic>::soften(double t, std::span<const double> history, std::size_t pack, const Nodal& u,
                                        std::span<double> updated) const -> Nodal {
    const auto motion = joint_motion(edge(pack), u), seen = of_law(pack, motion);
    std::array<Traction<Pack>, joint_points> tractions;
    Pack damage(1.0), apart(0.0), along(0.0);
    for (std::size_t i = 0; i < joint_points; ++i) {
        const CohesionProperties<Pack> law = of(history, pack, i);
        const History before = history_of(history, pack, i);
        const Pack w = weight(history, pack, before);
        tractions[i] = Law::traction(law, before, seen.opening[i], seen.slip[i]);
        tractions[i].normal *= w;
        tractions[i].shear *= w;
        if (updated.empty()) continue;
        // where no traction acts, nothing is dissipated either
        const History after =
            choose_history(w > Pack(0.0), Law::advance(law, before, seen.opening[i], seen.slip[i]), before);
        for (std::size_t k = 0; k < n_members; ++k) store(after.*History::members[k], updated, pack, member_row(i, k));
        damage = xsimd::min(damage, after.damage);
        const Pack opening = positive_part(seen.opening[i]);
        apart += opening * opening;
        along += motion.slip[i] * motion.slip[i];
        if constexpr (extrinsic) store(row(history, pack, factor_row + i), updated, pack, factor_row + i);
    }
    const auto forces = joint_forces(motion, Pack(1.0), tractions);
    if (updated.empty()) return forces;
    const Pack failed = row(history, pack, failure_row);
    const auto fails = (failed == Pack(0.0)) && (damage >= Pack(1.0));
    store(choose(fails, Pack(t), failed), updated, pack, failure_row);
    const Pack both = apart + along;
    store(choose(fails, Pack(apart / choose(both > Pack(0.0), both, Pack(1.0))), row(history, pack, mode_row)), updated,
          pack, mode_row);
    updated[pack] = 1;
    return forces;
}

// ---- forces --------------------------------------------------------------------------------------------------------

template <class Law, bool extrinsic>
template <class Take>
void JointBatch<Law, extrinsic>::for_each_pack(std::size_t first, std::size_t last, const Trial& trial,
                                               std::span<const double> history, std::span<double> updated,
                                               Take take) const {
    for (std::size_t pack = first; pack < last; ++pack) {
        const Nodal u = gather(trial.u, pack);
        if constexpr (has_elastic_range)
            if (untouched(history, pack) && stay_elastic(pack, u)) {
                // what stands there is from a trial that was given up, or nothing
                if (!updated.empty() && !untouched(updated, pack)) {
                    updated[pack] = 0;
                    std::ranges::fill(updated.subspan(place(pack, 0), history_rows * pack_width), 0.0);
                }
                take(pack, elastic(pack, u));
                continue;
            }
        take(pack, soften(trial.t, history, pack, u, updated));
    }
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::add_packs(std::size_t first, std::size_t last, const Trial& trial,
                                           std::span<const double> history, std::span<double> f,
                                           std::span<double> updated) const {
    for_each_pack(first, last, trial, history, updated, [&](std::size_t pack, const Nodal& forces) {
        for (std::size_t k = 0; k < joint_nodes; ++k)
            scatter_add_pairs(f.data(), &nodes_[(pack * joint_nodes + k) * pack_width], forces[k].x, forces[k].y);
    });
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::add_chunk_force(std::size_t chunk, const Trial& trial, std::span<const double> history,
                                                 std::span<double> f, std::span<double> updated) const {
    if (chunk < last_pack_of_chunk_.size())
        add_packs(chunk == 0 ? 0 : last_pack_of_chunk_[chunk - 1], last_pack_of_chunk_[chunk], trial, history, f,
                  updated);
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                                           std::span<double> updated) const {
    // one thread adds joint by joint; several leave it to the sum below, which adds in the same order
    if (omp_get_max_threads() == 1) {
        add_packs(first_loose_pack(), n_packs(), trial, history, f, updated);
        return;
    }
    const std::size_t before = first_loose_pack();
    parallel_ranges(n_packs() - before, [&](std::size_t first, std::size_t last) {
        for_each_pack(before + first, before + last, trial, history, updated,
                      [&](std::size_t pack, const Nodal& forces) {
                          double* to = &forces_[pack * n_dof * pack_width];
                          for (std::size_t k = 0; k < joint_nodes; ++k) {
                              forces[k].x.store_aligned(to + 2 * k * pack_width);
                              forces[k].y.store_aligned(to + (2 * k + 1) * pack_width);
                          }
                      });
    });
    parallel_ranges(touched_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            double& to_x = f[2 * static_cast<std::size_t>(touched_[i])];
            double& to_y = f[2 * static_cast<std::size_t>(touched_[i]) + 1];
            double x = to_x, y = to_y;
            for (std::size_t s = first_[i]; s < first_[i + 1]; ++s) {
                x += forces_[slots_[s]];
                y += forces_[slots_[s] + pack_width];
            }
            to_x = x;
            to_y = y;
        }
    });
}

template <class Law, bool extrinsic>
std::vector<std::array<std::int32_t, 2>> JointBatch<Law, extrinsic>::couplings() const {
    std::vector<std::array<std::int32_t, 2>> all;
    all.reserve(n_joints_ * joint_nodes * joint_nodes);
    for (std::size_t joint = 0; joint < n_joints_; ++joint)
        for (std::size_t a = 0; a < joint_nodes; ++a)
            for (std::size_t b = 0; b < joint_nodes; ++b) all.push_back({node(joint, a), node(joint, b)});
    return all;
}

template <class Law, bool extrinsic>
void JointBatch<Law, extrinsic>::stiffness(const Trial& trial, std::span<const double> history,
                                           std::span<ForceTerm::Stiffness> df_du) const {
    using D = Dual<n_dof, Pack>;
    const auto n = static_cast<std::ptrdiff_t>(n_packs());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) {
        const auto pack = static_cast<std::size_t>(p);
        const auto u = gather(trial.u, pack);
        std::array<Vec2<D>, joint_nodes> moved;
        for (int k = 0; k < static_cast<int>(joint_nodes); ++k) {
            const auto node = static_cast<std::size_t>(k);
            moved[node] = {D::variable(u[node].x, 2 * k), D::variable(u[node].y, 2 * k + 1)};
        }
        const auto motion = joint_motion(edge(pack), moved), seen = of_law(pack, motion);
        std::array<Traction<D>, joint_points> tractions;
        for (std::size_t i = 0; i < joint_points; ++i) {
            const History before = history_of(history, pack, i);
            const Pack w = weight(history, pack, before);
            tractions[i] = Law::traction(of(history, pack, i), before, seen.opening[i], seen.slip[i]);
            tractions[i] = {w * tractions[i].normal, w * tractions[i].shear};
        }
        const auto f = joint_forces(motion, Pack(1.0), tractions);
        for (std::size_t lane = 0; lane < pack_width && pack * pack_width + lane < n_joints_; ++lane) {
            ForceTerm::Stiffness* to = &df_du[(pack * pack_width + lane) * joint_nodes * joint_nodes];
            for (std::size_t a = 0; a < joint_nodes; ++a)
                for (std::size_t b = 0; b < joint_nodes; ++b)
                    *to++ = {f[a].x.derivative[2 * b].get(lane), f[a].x.derivative[2 * b + 1].get(lane),
                             f[a].y.derivative[2 * b].get(lane), f[a].y.derivative[2 * b + 1].get(lane)};
        }
    }
}

}  // namespace gneiss
