#include "fracture/joints.hpp"

#include <algorithm>
#include <cmath>
#include <xsimd/xsimd.hpp>

#include "base/dual.hpp"
#include "base/pack.hpp"
#include "base/parallel.hpp"
#include "fracture/cohesion_law.hpp"
#include "fracture/joint_kernel.hpp"
#include "fracture/y_code_law.hpp"

namespace gneiss {
namespace {

using Packs = std::vector<double, xsimd::aligned_allocator<double>>;

constexpr std::size_t n_properties = CohesionProperties<double>::members.size(), n_dof = 2 * joint_nodes;

/// Joints side by side in packs. Lanes behind the last joint repeat it with no weight.
template <class Law>
class Joints final : public Interaction {
    using History = typename Law::template History<Pack>;
    static constexpr std::size_t n_members = History::members.size();

public:
    Joints(const Mesh& mesh, const std::vector<Joint>& joints, double thickness);

    std::string name() const override { return "joints"; }
    /// Packs, their two points, members of the law's history, lanes.
    std::size_t n_history() const override { return n_packs_ * joint_points * n_members * pack_width; }
    void initial_history(std::span<double> history) const override { std::ranges::fill(history, 0.0); }
    void add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                   std::span<double> updated) const override;
    void follow(const Parting&, const State&, std::vector<double>&, PathEnergies&) override {}
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

private:
    static Pack load(const Packs& values, std::size_t row) { return Pack::load_aligned(&values[row * pack_width]); }
    Vec2<Pack> edge(std::size_t pack) const { return {load(edges_, 2 * pack), load(edges_, 2 * pack + 1)}; }
    CohesionProperties<Pack> of(std::size_t pack) const {
        CohesionProperties<Pack> p;
        for (std::size_t i = 0; i < n_properties; ++i)
            p.*CohesionProperties<Pack>::members[i] = load(properties_, n_properties * pack + i);
        return p;
    }
    static History history_of(std::span<const double> history, std::size_t pack, std::size_t point) {
        History h;
        const double* first = history.data() + (pack * joint_points + point) * n_members * pack_width;
        for (std::size_t i = 0; i < n_members; ++i)
            h.*History::members[i] = Pack::load_unaligned(first + i * pack_width);
        return h;
    }
    static void store(const History& h, std::span<double> history, std::size_t pack, std::size_t point) {
        double* first = history.data() + (pack * joint_points + point) * n_members * pack_width;
        for (std::size_t i = 0; i < n_members; ++i) (h.*History::members[i]).store_unaligned(first + i * pack_width);
    }
    std::array<Vec2<Pack>, joint_nodes> gather(std::span<const double> u, std::size_t pack) const {
        std::array<Vec2<Pack>, joint_nodes> at;
        for (std::size_t k = 0; k < joint_nodes; ++k)
            gather_pairs(u.data(), &nodes_[(pack * joint_nodes + k) * pack_width], at[k].x, at[k].y);
        return at;
    }
    /// Stiffness of the springs at an end against the displacement of one node, N/m: in shear that of friction stands
    /// beside the cohesive one.
    double spring(std::size_t pack, std::size_t lane) const {
        const double* p = &properties_[n_properties * pack * pack_width + lane];
        const bool friction = p[2 * pack_width] > 0 || p[3 * pack_width] > 0;
        return p[6 * pack_width] * weights_[pack * pack_width + lane] * (friction ? 2 : 1);
    }
    /// visit(node, stiffness) for every node of every joint.
    template <class Visit>
    void for_each_spring(Visit visit) const {
        for (std::size_t joint = 0; joint < n_joints_; ++joint)
            for (std::size_t k = 0; k < joint_nodes; ++k)
                visit(node(joint, k), spring(joint / pack_width, joint % pack_width));
    }
    std::int32_t node(std::size_t joint, std::size_t k) const {
        return nodes_[(joint / pack_width * joint_nodes + k) * pack_width + joint % pack_width].value;
    }
    void plan_sums();

    std::size_t n_joints_, n_packs_;
    std::vector<PairNumber> nodes_;  ///< shape (packs, joint_nodes, lanes)
    Packs edges_;                    ///< a0 to a1 in the reference shape, m, shape (packs, 2, lanes)
    Packs weights_;                  ///< m2, shape (packs, lanes)
    Packs properties_;               ///< shape (packs, n_properties, lanes)
    // which forces meet at a node, so that they are summed in one order
    std::vector<std::int32_t> touched_;            ///< nodes, ascending
    std::vector<std::size_t> first_;               ///< in slots_, shape (touched + 1)
    std::vector<std::size_t> slots_;               ///< of forces_: where x stands; y is pack_width behind
    mutable Packs forces_;                         ///< scratch, N, shape (packs, n_dof, lanes)
    mutable std::vector<double> bound_, partial_;  ///< scratch
};

template <class Law>
Joints<Law>::Joints(const Mesh& mesh, const std::vector<Joint>& joints, double thickness)
    : n_joints_(joints.size()),
      n_packs_(padded(joints.size()) / pack_width),
      nodes_(n_packs_ * joint_nodes * pack_width),
      edges_(n_packs_ * 2 * pack_width),
      weights_(n_packs_ * pack_width),
      properties_(n_packs_ * n_properties * pack_width),
      forces_(n_packs_ * n_dof * pack_width) {
    for (std::size_t slot = 0; slot < n_packs_ * pack_width; ++slot) {
        const Joint& joint = joints[std::min(slot, n_joints_ - 1)];
        const std::size_t pack = slot / pack_width, lane = slot % pack_width;
        for (std::size_t k = 0; k < joint_nodes; ++k)
            nodes_[(pack * joint_nodes + k) * pack_width + lane] = {joint.nodes[k]};
        const auto& start = mesh.nodes[static_cast<std::size_t>(joint.nodes[0])];
        const auto& end = mesh.nodes[static_cast<std::size_t>(joint.nodes[1])];
        const double dx = end[0] - start[0], dy = end[1] - start[1];
        edges_[2 * pack * pack_width + lane] = dx;
        edges_[(2 * pack + 1) * pack_width + lane] = dy;
        weights_[slot] = slot < n_joints_ ? 0.5 * thickness * std::hypot(dx, dy) : 0.0;
        for (std::size_t i = 0; i < n_properties; ++i)
            properties_[(n_properties * pack + i) * pack_width + lane] =
                joint.properties.*CohesionProperties<double>::members[i];
    }
    plan_sums();
}

template <class Law>
void Joints<Law>::plan_sums() {
    std::vector<std::pair<std::int32_t, std::size_t>> all;  // node, slot
    for (std::size_t joint = 0; joint < n_joints_; ++joint)
        for (std::size_t k = 0; k < joint_nodes; ++k)
            all.emplace_back(node(joint, k), (joint / pack_width * n_dof + 2 * k) * pack_width + joint % pack_width);
    std::ranges::sort(all);
    for (const auto& [node, slot] : all) {
        if (touched_.empty() || touched_.back() != node) {
            touched_.push_back(node);
            first_.push_back(slots_.size());
        }
        slots_.push_back(slot);
    }
    first_.push_back(slots_.size());
}

template <class Law>
void Joints<Law>::add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                            std::span<double> updated) const {
    const auto n = static_cast<std::ptrdiff_t>(n_packs_);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) {
        const auto pack = static_cast<std::size_t>(p);
        const auto motion = joint_motion(edge(pack), gather(trial.u, pack));
        const CohesionProperties<Pack> law = of(pack);
        std::array<Traction<Pack>, joint_points> tractions;
        for (std::size_t i = 0; i < joint_points; ++i) {
            const History before = history_of(history, pack, i);
            tractions[i] = Law::traction(law, before, motion.opening[i], motion.slip[i]);
            if (!updated.empty()) store(Law::advance(law, before, motion.opening[i], motion.slip[i]), updated, pack, i);
        }
        const auto forces = joint_forces(motion, load(weights_, pack), tractions);
        double* to = &forces_[pack * n_dof * pack_width];
        for (std::size_t k = 0; k < joint_nodes; ++k) {
            forces[k].x.store_aligned(to + 2 * k * pack_width);
            forces[k].y.store_aligned(to + (2 * k + 1) * pack_width);
        }
    }
    parallel_ranges(touched_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            double x = 0, y = 0;
            for (std::size_t s = first_[i]; s < first_[i + 1]; ++s) {
                x += forces_[slots_[s]];
                y += forces_[slots_[s] + pack_width];
            }
            f[2 * static_cast<std::size_t>(touched_[i])] += x;
            f[2 * static_cast<std::size_t>(touched_[i]) + 1] += y;
        }
    });
}

template <class Law>
std::vector<std::array<std::int32_t, 2>> Joints<Law>::couplings() const {
    std::vector<std::array<std::int32_t, 2>> all;
    all.reserve(n_joints_ * joint_nodes * joint_nodes);
    for (std::size_t joint = 0; joint < n_joints_; ++joint)
        for (std::size_t a = 0; a < joint_nodes; ++a)
            for (std::size_t b = 0; b < joint_nodes; ++b) all.push_back({node(joint, a), node(joint, b)});
    return all;
}

template <class Law>
void Joints<Law>::stiffness(const Trial& trial, std::span<const double> history,
                            std::span<ForceTerm::Stiffness> df_du) const {
    using D = Dual<n_dof, Pack>;
    const auto n = static_cast<std::ptrdiff_t>(n_packs_);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t p = 0; p < n; ++p) {
        const auto pack = static_cast<std::size_t>(p);
        const auto u = gather(trial.u, pack);
        std::array<Vec2<D>, joint_nodes> moved;
        for (int k = 0; k < static_cast<int>(joint_nodes); ++k) {
            const auto node = static_cast<std::size_t>(k);
            moved[node] = {D::variable(u[node].x, 2 * k), D::variable(u[node].y, 2 * k + 1)};
        }
        const auto motion = joint_motion(edge(pack), moved);
        std::array<Traction<D>, joint_points> tractions;
        for (std::size_t i = 0; i < joint_points; ++i)
            tractions[i] = Law::traction(of(pack), history_of(history, pack, i), motion.opening[i], motion.slip[i]);
        const auto f = joint_forces(motion, load(weights_, pack), tractions);
        for (std::size_t lane = 0; lane < pack_width && pack * pack_width + lane < n_joints_; ++lane) {
            ForceTerm::Stiffness* to = &df_du[(pack * pack_width + lane) * joint_nodes * joint_nodes];
            for (std::size_t a = 0; a < joint_nodes; ++a)
                for (std::size_t b = 0; b < joint_nodes; ++b)
                    *to++ = {f[a].x.derivative[2 * b].get(lane), f[a].x.derivative[2 * b + 1].get(lane),
                             f[a].y.derivative[2 * b].get(lane), f[a].y.derivative[2 * b + 1].get(lane)};
        }
    }
}

template <class Law>
double Joints<Law>::omega_squared(const Trial&, std::span<const double>, std::span<const double> lumped_mass) const {
    // sums of magnitudes along the rows of M^-1 K: each spring ties a node to one other
    bound_.assign(lumped_mass.size() / 2, 0.0);
    for_each_spring([&](std::int32_t node, double k) { bound_[static_cast<std::size_t>(node)] += 2 * k; });
    double largest = 0;
    for (const std::int32_t node : touched_)
        largest =
            std::max(largest, bound_[static_cast<std::size_t>(node)] / lumped_mass[2 * static_cast<std::size_t>(node)]);
    return largest;
}

template <class Law>
void Joints<Law>::add_stiffness_bound(const Trial&, std::span<const double>, std::span<double> bound) const {
    for_each_spring([&](std::int32_t node, double k) {
        bound[2 * static_cast<std::size_t>(node)] += 2 * k;
        bound[2 * static_cast<std::size_t>(node) + 1] += 2 * k;
    });
}

template <class Law>
void Joints<Law>::add_stored(const Trial& accepted, std::span<const double> history, StoredEnergies& energies) const {
    energies.joints += ordered_sum(n_packs_, partial_, [&](std::size_t first, std::size_t last) {
        Pack sum(0.0);
        for (std::size_t pack = first; pack < last; ++pack) {
            const auto motion = joint_motion(edge(pack), gather(accepted.u, pack));
            for (std::size_t i = 0; i < joint_points; ++i)
                sum += load(weights_, pack) *
                       Law::stored_energy(of(pack), history_of(history, pack, i), motion.opening[i], motion.slip[i]);
        }
        return xsimd::hadd(sum);
    });
}

template <class Law>
void Joints<Law>::add_dissipated(std::span<const double> from, std::span<const double> to,
                                 PathEnergies& energies) const {
    const auto sum_of = [&](Pack History::*member) {
        return ordered_sum(n_packs_, partial_, [&](std::size_t first, std::size_t last) {
            Pack sum(0.0);
            for (std::size_t pack = first; pack < last; ++pack)
                for (std::size_t i = 0; i < joint_points; ++i)
                    sum += load(weights_, pack) * (history_of(to, pack, i).*member - history_of(from, pack, i).*member);
            return xsimd::hadd(sum);
        });
    };
    energies.fracture += sum_of(&History::fracture);
    energies.friction += sum_of(&History::friction);
}

}  // namespace

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

std::unique_ptr<Interaction> make_joints(const Mesh& mesh, const std::vector<Joint>& joints, JointLaw law,
                                         double thickness) {
    if (law == JointLaw::y_code) return std::make_unique<Joints<YCodeLaw>>(mesh, joints, thickness);
    return std::make_unique<Joints<MixedModeLaw<Insertion::intrinsic>>>(mesh, joints, thickness);
}

}  // namespace gneiss
