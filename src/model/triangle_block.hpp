#pragma once
// The block of one element and one law: how it is stored, and what it shows of one element.
// What goes through whole packs is in triangle_block_evaluation.hpp. Included only by the files that instantiate it.

#include <fmt/format.h>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "base/flatten.hpp"
#include "elements/triangle_kernel.hpp"
#include "elements/triangle_tangent.hpp"
#include "model/element_block.hpp"

namespace gneiss {

template <class Element, class Law>
class TriangleBlock final : public ElementBlock {
public:
    /// @param sampling  `mean` where the law offers no `centre`
    TriangleBlock(const Mesh& mesh, BlockGeometry geometry, Law law, Sampling sampling);

    std::size_t n_elements() const override { return info_.elements.size(); }
    int n_nodes() const override { return Element::n_nodes; }
    int n_sub_triangles() const override { return Element::n_sub; }
    std::int32_t element(std::size_t local) const override { return info_.elements[local]; }
    std::size_t n_internal() const override { return n_packs() * z_stride; }
    std::size_t n_history() const override { return n_packs() * history_stride; }
    bool viscous() const override { return info_.viscosity.active(); }
    std::size_t bytes_per_element() const override {
        const std::size_t axis = axis_stride_ / pack_width;
        return (geometry_fields + axis + Element::n_sub * (Law::n_internal + Law::n_history)) * sizeof(double) +
               Element::n_nodes * sizeof(PairBytes);
    }
    std::span<const std::int32_t> nodes() const override { return nodes_; }
    std::span<PairBytes> local_nodes() override { return local_nodes_; }

    void initial_memory(double* z, double* history) const override;
    void internal_weights(double* weights) const override;
    void add_mass(std::size_t local, std::span<double> mass) const override;
    void renumber(const Mesh& mesh, std::span<const std::int32_t> locals) override;
    std::ptrdiff_t add_force(std::size_t first, std::size_t last, const Evaluation& at,
                             const LocalNodes& local) const override;
    bool symmetric_tangent() const override {
        return law_.symmetric_tangent() && sampling_ == Sampling::mean && !viscous();
    }
    void add_tangent(std::size_t first, std::size_t last, const Evaluation& at, double c_u, double c_v,
                     const MatrixPlaces& places, double* values) const override;
    void add_row_sums(std::size_t first, std::size_t last, const Evaluation& at,
                      const LocalNodes& local) const override;
    void internal_rate(std::size_t first, std::size_t last, const Evaluation& at, double* rate) const override;
    GNEISS_FLATTEN Sums energies(std::size_t first, std::size_t last, const Evaluation& at) const override;
    Rates largest_rates(std::size_t first, std::size_t last, const Evaluation& at) const override;
    void point_fields(std::size_t local, const Evaluation& at, PointFields* fields) const override;
    GNEISS_FLATTEN void pack_response(std::size_t pack, const Evaluation& at, double* cauchy,
                                      double* force) const override;
    std::string describe_inversion(std::size_t local, const Evaluation& at) const override;
    MunjizaConstants tangent_constants(std::size_t local) const override;
    double axis_angle(std::size_t local) const override { return info_.axis_angle[local]; }
    double density() const override { return info_.density; }

private:
    static constexpr int n_dof = 2 * Element::n_nodes;
    static constexpr std::size_t geometry_fields = Element::similar ? 5 : 1 + 5 * Element::n_sub;
    static constexpr std::size_t geometry_stride = geometry_fields * pack_width;
    static constexpr std::size_t z_stride = Element::n_sub * Law::n_internal * pack_width;
    static constexpr std::size_t history_stride = Element::n_sub * Law::n_history * pack_width;
    static constexpr std::size_t index_stride = Element::n_nodes * pack_width;

    template <class T>
    using Nodal = std::array<Vec2<T>, Element::n_nodes>;
    template <class T>
    using Memory = std::array<typename Law::template Memory<T>, Element::n_sub>;
    using PackGeometry = TriangleGeometry<Element, Pack>;
    using OfferedSampling = std::conditional_t<Law::offers_centre && (Element::n_sub > 1), Sampling, MeanSampling>;

    // ---- loads and stores of one pack; the scalar twins pick one lane
    // ------------------------------------------------
    /// Axis and fields in the order in which the constructor writes them, a pack's width apart.
    template <class V, class Load>
    static TriangleGeometry<Element, V> read_geometry(const double* axis, const double* field, Load load);
    PackGeometry geometry(std::size_t pack) const;
    TriangleGeometry<Element, double> geometry_of(std::size_t local) const;
    template <class Index>
    static Nodal<Pack> gather(const double* pairs, const Index* index);
    Nodal<Pack> gather(const double* pairs, std::size_t pack) const {
        return gather(pairs, reinterpret_cast<const PairNumber*>(nodes_.data() + pack * index_stride));
    }
    Nodal<double> gather_one(const double* pairs, std::size_t local) const;
    /// What a sub-triangle remembers at the start: the stress in situ, on the axes.
    typename Law::template Memory<double> memory_at_rest(std::size_t local) const;
    static Memory<Pack> load_memory(const Evaluation& at, std::size_t pack);
    Memory<double> memory_of(const Evaluation& at, std::size_t local) const;
    static void store_memory(const Memory<Pack>& memory, double* z, double* history, std::size_t pack);

    /// Flattened: everything is inlined, so that a pack stays in registers from the gather to the scatter.
    template <bool given>
    GNEISS_FLATTEN std::ptrdiff_t add_force_packs(std::size_t first, std::size_t last, const Evaluation& at,
                                                  const LocalNodes& local) const;
    /// Evaluation::beyond of a pack.
    double beyond_watch(const TriangleKinematics<Element, Pack>& kinematics,
                        const TriangleStress<Element, Law, Pack>& stress, std::size_t pack) const;
    std::ptrdiff_t inverted_lane(std::size_t pack, const Pack::batch_bool_type& upright) const;
    struct Response {
        TriangleKinematics<Element, Pack> kinematics;
        TriangleStress<Element, Law, Pack> stress;
    };
    /// Strains and stresses of a pack, where a call per pack costs little beside the rest.
    template <bool given>
    [[gnu::noinline]] GNEISS_FLATTEN Response response(const PackGeometry& g, const Nodal<Pack>& u,
                                                       const Memory<Pack>& memory) const;
    /// factor df/du of the law's forces at the pack's displacements u. One function for all that ask for tangents: it
    /// is long, and most of what takes a block to compile.
    template <bool given>
    [[gnu::noinline]] GNEISS_FLATTEN ElementMatrix<Element, Pack> law_tangent(const PackGeometry& g,
                                                                              const Nodal<Pack>& u,
                                                                              const Memory<Pack>& memory,
                                                                              double factor) const;
    /// Adds c_u df/du + c_v df/dv of the viscous forces.
    [[gnu::noinline]] GNEISS_FLATTEN void add_viscosity(const PackGeometry& g, const Nodal<Pack>& u,
                                                        const Nodal<Pack>& v, double c_u, double c_v,
                                                        ElementMatrix<Element, Pack>& matrix) const;
    /// Largest eigenvalue of M^-1/2 sym(-tangent) M^-1/2.
    Pack mass_weighted_bound(const PackGeometry& geometry, const ElementMatrix<Element, Pack>& tangent) const;

    BlockGeometry info_;
    Law law_;
    [[no_unique_address]] OfferedSampling sampling_{};
    PackVector axes_;                  ///< (packs, 2, width); one pack for all where all axes are parallel
    std::size_t axis_stride_;          ///< from pack to pack; 0 where all axes are parallel
    PackVector geometry_;              ///< (packs, fields, width): sub-triangles, inverse volume
    std::vector<std::int32_t> nodes_;  ///< (packs, n_nodes, width); padded lanes repeat the last element, volume 0
    std::vector<PairBytes> local_nodes_;
};

// ---- construction --------------------------------------------------------------------------------------------------

template <class Element, class Law>
TriangleBlock<Element, Law>::TriangleBlock(const Mesh& mesh, BlockGeometry info, Law law, Sampling sampling)
    : info_(std::move(info)), law_(std::move(law)) {
    if constexpr (std::is_same_v<OfferedSampling, Sampling>) sampling_ = sampling;
    assert(sampling_ == sampling);
    const bool parallel =
        std::ranges::adjacent_find(info_.axis_angle, std::ranges::not_equal_to()) == info_.axis_angle.end();
    axis_stride_ = parallel ? 0 : 2 * pack_width;
    axes_.resize((parallel ? 1 : n_packs()) * 2 * pack_width);
    geometry_.resize(n_packs() * geometry_stride);
    nodes_.resize(n_packs() * index_stride);
    for (std::size_t slot = 0; slot < n_packs() * pack_width; ++slot) {
        const bool padding = slot >= n_elements();
        const std::size_t local = padding ? n_elements() - 1 : slot;
        const std::int32_t* element_nodes = mesh.element(static_cast<std::size_t>(info_.elements[local]));
        std::array<Vec2<double>, Element::n_nodes> x;
        const std::size_t pack = slot / pack_width, lane = slot % pack_width;
        for (int node = 0; node < Element::n_nodes; ++node) {
            const auto& position = mesh.nodes[static_cast<std::size_t>(element_nodes[node])];
            x[node] = {position[0], position[1]};
            nodes_[pack * index_stride + node * pack_width + lane] = element_nodes[node];
        }
        const double angle = info_.axis_angle[local];
        const auto g = triangle_geometry<Element>(x, {std::cos(angle), std::sin(angle)}, info_.thickness);
        double* field = geometry_.data() + pack * geometry_stride + lane;
        const auto put = [&field](double value) {
            *field = value;
            field += pack_width;
        };
        axes_[pack * axis_stride_ + lane] = g.axis.x;
        axes_[pack * axis_stride_ + pack_width + lane] = g.axis.y;
        for (const auto& sub : g.sub) {
            put(sub.k_a_alpha);
            put(sub.k_a_beta);
            put(sub.k_c_alpha);
            put(sub.k_c_beta);
            put(padding ? 0.0 : sub.volume);  // exerts no force, has no energy
        }
        if constexpr (!Element::similar) put(g.inverse_volume);
    }
    local_nodes_.resize(nodes_.size());
}

template <class Element, class Law>
auto TriangleBlock<Element, Law>::memory_at_rest(std::size_t local) const -> typename Law::template Memory<double> {
    if constexpr (requires { &Law::initial_memory; }) {
        if (!info_.in_situ_stress.empty()) {
            const auto& [xx, yy, xy] = info_.in_situ_stress[local];
            const double c = std::cos(info_.axis_angle[local]), s = std::sin(info_.axis_angle[local]);
            return law_.initial_memory({c * c * xx + s * s * yy + 2 * s * c * xy,
                                        s * s * xx + c * c * yy - 2 * s * c * xy,
                                        s * c * (yy - xx) + (c * c - s * s) * xy});
        }
    }
    (void)local;
    return {};
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::initial_memory(double* z, double* history) const {
    if constexpr (Law::n_internal > 0) {
        for (std::size_t slot = 0; slot < n_packs() * pack_width; ++slot) {
            const std::size_t local = std::min(slot, n_elements() - 1);
            const auto g = geometry_of(local);
            Memory<double> memory;
            memory.fill(memory_at_rest(local));
            // one update without a step puts strains and stresses at rest into the history
            const Nodal<double> rest{};
            const auto kinematics = triangle_kinematics<Element>(rest, g, sampling_);
            const auto stress = triangle_stress<Element, false>(law_, kinematics, g, memory);
            const std::size_t pack = slot / pack_width, lane = slot % pack_width;
            for (std::size_t s = 0; s < Element::n_sub; ++s) {
                const auto updated =
                    law_.update(kinematics.point[s], stress.volume, stress.point[s], stress.q, memory[s]);
                for (std::size_t k = 0; k < Law::n_internal; ++k)
                    z[pack * z_stride + (s * Law::n_internal + k) * pack_width + lane] = updated.z[k];
                for (std::size_t k = 0; k < Law::n_history; ++k)
                    history[pack * history_stride + (s * Law::n_history + k) * pack_width + lane] = updated.history[k];
            }
        }
    }
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::internal_weights(double* weights) const {
    if constexpr (Law::n_internal > 0) {
        // the last of a law without stored energy is its accumulated stress power
        constexpr std::size_t counted = Law::has_stored_energy ? Law::n_internal : Law::n_internal - 1;
        for (std::size_t k = 0; k < n_internal(); ++k)
            weights[k] = k / pack_width % Law::n_internal < counted ? 1.0 : 0.0;
    }
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::add_mass(std::size_t local, std::span<double> mass) const {
    const auto g = geometry_of(local);
    const std::size_t pack = local / pack_width, lane = local % pack_width;
    for (int s = 0; s < Element::n_sub; ++s) {
        for (const int node : Element::sub_triangles[s]) {
            const auto n = static_cast<std::size_t>(nodes_[pack * index_stride + node * pack_width + lane]);
            mass[2 * n] += info_.density * g.of(s).volume / 3;
            mass[2 * n + 1] += info_.density * g.of(s).volume / 3;
        }
    }
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::renumber(const Mesh& mesh, std::span<const std::int32_t> locals) {
    for (const std::int32_t which : locals) {
        const auto local = static_cast<std::size_t>(which);
        const std::int32_t* element_nodes = mesh.element(static_cast<std::size_t>(info_.elements[local]));
        // lanes behind the last element repeat it
        const std::size_t end = local + 1 == n_elements() ? n_packs() * pack_width : local + 1;
        for (std::size_t slot = local; slot < end; ++slot)
            for (int node = 0; node < Element::n_nodes; ++node)
                nodes_[slot / pack_width * index_stride + node * pack_width + slot % pack_width] = element_nodes[node];
    }
}

// ---- packs
// -----------------------------------------------------------------------------------------------------------

template <class Element, class Law>
template <class V, class Load>
auto TriangleBlock<Element, Law>::read_geometry(const double* axis, const double* field, Load load)
    -> TriangleGeometry<Element, V> {
    const auto take = [&] {
        const V value = load(field);
        field += pack_width;
        return value;
    };
    TriangleGeometry<Element, V> g;
    g.axis.x = load(axis);
    g.axis.y = load(axis + pack_width);
    for (auto& sub : g.sub) {
        sub.k_a_alpha = take();
        sub.k_a_beta = take();
        sub.k_c_alpha = take();
        sub.k_c_beta = take();
        sub.volume = take();
    }
    if constexpr (!Element::similar) g.inverse_volume = take();
    return g;
}

template <class Element, class Law>
auto TriangleBlock<Element, Law>::geometry(std::size_t pack) const -> PackGeometry {
    return read_geometry<Pack>(axes_.data() + pack * axis_stride_, geometry_.data() + pack * geometry_stride,
                               [](const double* field) { return Pack::load_aligned(field); });
}

template <class Element, class Law>
auto TriangleBlock<Element, Law>::geometry_of(std::size_t local) const -> TriangleGeometry<Element, double> {
    const std::size_t pack = local / pack_width, lane = local % pack_width;
    return read_geometry<double>(axes_.data() + pack * axis_stride_ + lane,
                                 geometry_.data() + pack * geometry_stride + lane,
                                 [](const double* field) { return *field; });
}

template <class Element, class Law>
template <class Index>
auto TriangleBlock<Element, Law>::gather(const double* pairs, const Index* index) -> Nodal<Pack> {
    Nodal<Pack> values;
#pragma GCC unroll 6
    for (int node = 0; node < Element::n_nodes; ++node, index += pack_width)
        gather_pairs(pairs, index, values[node].x, values[node].y);
    return values;
}

template <class Element, class Law>
auto TriangleBlock<Element, Law>::gather_one(const double* pairs, std::size_t local) const -> Nodal<double> {
    Nodal<double> values;
    const std::int32_t* index = nodes_.data() + local / pack_width * index_stride + local % pack_width;
    for (int node = 0; node < Element::n_nodes; ++node, index += pack_width)
        values[node] = {pairs[2 * *index], pairs[2 * *index + 1]};
    return values;
}

template <class Element, class Law>
auto TriangleBlock<Element, Law>::load_memory(const Evaluation& at, std::size_t pack) -> Memory<Pack> {
    Memory<Pack> memory;
    for (std::size_t s = 0; s < Element::n_sub; ++s) {
        for (std::size_t k = 0; k < Law::n_internal; ++k)
            memory[s].z[k] = Pack::load_unaligned(at.z + pack * z_stride + (s * Law::n_internal + k) * pack_width);
        for (std::size_t k = 0; k < Law::n_history; ++k)
            memory[s].history[k] =
                Pack::load_unaligned(at.history + pack * history_stride + (s * Law::n_history + k) * pack_width);
    }
    return memory;
}

template <class Element, class Law>
auto TriangleBlock<Element, Law>::memory_of(const Evaluation& at, std::size_t local) const -> Memory<double> {
    Memory<double> memory{};
    const std::size_t pack = local / pack_width, lane = local % pack_width;
    for (std::size_t s = 0; s < Element::n_sub; ++s) {
        for (std::size_t k = 0; k < Law::n_internal; ++k)
            memory[s].z[k] = at.z[pack * z_stride + (s * Law::n_internal + k) * pack_width + lane];
        for (std::size_t k = 0; k < Law::n_history; ++k)
            memory[s].history[k] = at.history[pack * history_stride + (s * Law::n_history + k) * pack_width + lane];
    }
    return memory;
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::store_memory(const Memory<Pack>& memory, double* z, double* history,
                                               std::size_t pack) {
    for (std::size_t s = 0; s < Element::n_sub; ++s) {
        for (std::size_t k = 0; k < Law::n_internal; ++k)
            memory[s].z[k].store_unaligned(z + pack * z_stride + (s * Law::n_internal + k) * pack_width);
        for (std::size_t k = 0; k < Law::n_history; ++k)
            memory[s].history[k].store_unaligned(history + pack * history_stride +
                                                 (s * Law::n_history + k) * pack_width);
    }
}

template <class Element, class Law>
std::ptrdiff_t TriangleBlock<Element, Law>::inverted_lane(std::size_t pack,
                                                          const Pack::batch_bool_type& upright) const {
    for (std::size_t lane = 0; lane < pack_width; ++lane)
        if (!upright.get(lane))
            return static_cast<std::ptrdiff_t>(std::min(pack * pack_width + lane, n_elements() - 1));
    return none;
}

// ---- output
// ------------------------------------------------------------------------------------------------------------

template <class Element, class Law>
void TriangleBlock<Element, Law>::point_fields(std::size_t local, const Evaluation& at, PointFields* fields) const {
    const auto g = geometry_of(local);
    const auto kinematics = triangle_kinematics<Element>(gather_one(at.u, local), g, sampling_);
    const Memory<double> memory = memory_of(at, local);
    auto stress = triangle_stress<Element, false>(law_, kinematics, g, memory);
    std::array<PointRates<double>, Element::n_sub> rates{};
    if (viscous()) rates = triangle_rates<Element>(gather_one(at.v, local), kinematics, g, sampling_);
    for (int s = 0; s < Element::n_sub; ++s) {
        const PointKinematics<double>& point = kinematics.point[s];
        const Vec2<double> alpha = point.alpha(), beta = point.beta();
        const PointStress<double> viscous_stress = info_.viscosity.stress(point, rates[s]);
        stress.point[s].p_alpha += viscous_stress.p_alpha;
        stress.point[s].p_beta += viscous_stress.p_beta;
        const auto sigma = cauchy_stress(point, stress.point[s], stress.q);
        PointFields& out = fields[s];
        out.cauchy = {sigma.xx, sigma.yy, sigma.xy};
        out.cauchy_zz = info_.plane_stress ? 0.0
                                           : law_.stress_across(point, stress.volume, memory[s], stress.q) +
                                                 info_.viscosity.bulk * rates[s].volume;
        out.munjiza.fill(std::numeric_limits<double>::quiet_NaN());
        if constexpr (requires { law_.munjiza_stress(point, stress.volume, memory[s]); }) {
            const auto m = law_.munjiza_stress(point, stress.volume, memory[s]);
            out.munjiza = {m.v, m.alpha, m.beta, m.psi};
        }
        const double psi = std::atan2(cross(alpha, beta), dot(alpha, beta));
        out.stretch = {1 + kinematics.volume_strain, std::sqrt(dot(alpha, alpha)), std::sqrt(dot(beta, beta)),
                       psi / (2 * std::atan(1.0))};
        out.alpha = {alpha.x, alpha.y};
        out.beta = {beta.x, beta.y};
    }
}

template <class Element, class Law>
std::string TriangleBlock<Element, Law>::describe_inversion(std::size_t local, const Evaluation& at) const {
    const auto kinematics = triangle_kinematics<Element>(gather_one(at.u, local), geometry_of(local), sampling_);
    for (int s = 0; s < Element::n_sub; ++s) {
        const double jacobian = kinematics.point[s].jacobian();
        if (!(jacobian > 0)) return fmt::format("sub-triangle {}, det F = {:.6g}", s + 1, jacobian);
    }
    return fmt::format("s_v = {:.6g}", 1 + kinematics.volume_strain);
}

template <class Element, class Law>
MunjizaConstants TriangleBlock<Element, Law>::tangent_constants(std::size_t local) const {
    return law_.tangent_constants(memory_at_rest(local));
}

}  // namespace gneiss

#include "model/triangle_block_evaluation.hpp"
