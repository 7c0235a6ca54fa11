#pragma once
// Forces, rates, energies and bounds of the packs of a block: the second half of triangle_block.hpp.

#include <algorithm>
#include <array>

#include "base/prefetch.hpp"
#include "model/eigenvalue_bound.hpp"
#include "model/triangle_block.hpp"

namespace gneiss {

template <class Element, class Law>
double TriangleBlock<Element, Law>::beyond_watch(const TriangleKinematics<Element, Pack>& kinematics,
                                                 const TriangleStress<Element, Law, Pack>& stress,
                                                 std::size_t pack) const {
    Pack largest(0.0);
    for (int s = 0; s < Element::n_sub; ++s)
        largest = xsimd::max(largest, watch_.index(cauchy_stress(kinematics.point[s], stress.point[s], stress.q)));
    const Pack allowed = Pack::load_aligned(watch_.factor_squared.data() + pack * pack_width);
    const auto beyond = largest > allowed;
    if (!any_lane(beyond)) return 0;
    int bits = 0;
    for (std::size_t lane = 0; lane < pack_width; ++lane) bits |= static_cast<int>(beyond.get(lane)) << lane;
    return bits;
}

// ---- forces
// ----------------------------------------------------------------------------------------------------------

template <class Element, class Law>
template <bool given>
std::ptrdiff_t TriangleBlock<Element, Law>::add_force_packs(std::size_t first, std::size_t last, const Evaluation& at,
                                                            const LocalNodes& nodal) const {
    // A few packs go through each stage together: the chain of operations from a pack's displacements to its forces is
    // longer than the window in which the processor finds independent work.
    constexpr std::size_t depth = 4, ahead = 12;
    std::array<TriangleKinematics<Element, Pack>, depth> kinematics;
    std::array<TriangleStress<Element, Law, Pack>, depth> stress;
    const auto index = [this](std::size_t pack) { return local_nodes_.data() + pack * index_stride; };
    const bool is_viscous = viscous(), update = !given && at.z_updated != nullptr;
    for (std::size_t begin = first; begin < last; begin += depth) {
        const std::size_t n = std::min(depth, last - begin);
        prefetch(geometry_.data(), (begin + ahead) * geometry_stride, (begin + ahead + depth) * geometry_stride,
                 geometry_.size());
        prefetch(local_nodes_.data(), (begin + ahead) * index_stride, (begin + ahead + depth) * index_stride,
                 local_nodes_.size());
        for (std::size_t i = 0; i < n; ++i) {
            kinematics[i] =
                triangle_kinematics<Element>(gather(nodal.u, index(begin + i)), geometry(begin + i), sampling_);
            const auto upright = is_upright(kinematics[i]);
            if (!every_lane(upright)) [[unlikely]]
                return inverted_lane(begin + i, upright);
        }
        for (std::size_t i = 0; i < n; ++i)
            stress[i] =
                triangle_stress<Element, given>(law_, kinematics[i], geometry(begin + i), load_memory(at, begin + i));
        if (at.beyond != nullptr)
            for (std::size_t i = 0; i < n; ++i)
                at.beyond[begin + i] = beyond_watch(kinematics[i], stress[i], begin + i);
        for (std::size_t i = 0; i < n; ++i) {
            const PackGeometry g = geometry(begin + i);
            Nodal<Pack> f;
            triangle_force(kinematics[i], g, stress[i], f);
            if (is_viscous) {
                const auto rates =
                    triangle_rates<Element>(gather(nodal.v, index(begin + i)), kinematics[i], g, sampling_);
                add_viscous_force<Element>(info_.viscosity, kinematics[i], rates, g, f);
            }
            if constexpr (Law::n_internal > 0) {
                if (update) {
                    const Memory<Pack> memory = load_memory(at, begin + i);
                    Memory<Pack> updated;
                    for (std::size_t s = 0; s < Element::n_sub; ++s)
                        updated[s] = law_.update(kinematics[i].point[s], stress[i].volume, stress[i].point[s],
                                                 stress[i].q, memory[s]);
                    store_memory(updated, at.z_updated, at.history_updated, begin + i);
                }
            }
#pragma GCC unroll 6
            for (int node = 0; node < Element::n_nodes; ++node)
                scatter_add_pairs(nodal.f, index(begin + i) + node * pack_width, f[node].x, f[node].y);
        }
    }
    return none;
}

template <class Element, class Law>
std::ptrdiff_t TriangleBlock<Element, Law>::add_force(std::size_t first, std::size_t last, const Evaluation& at,
                                                      const LocalNodes& local) const {
    if constexpr (TakesGivenStress<Law>)
        if (at.given) return add_force_packs<true>(first, last, at, local);
    return add_force_packs<false>(first, last, at, local);
}

template <class Element, class Law>
template <bool given>
auto TriangleBlock<Element, Law>::response(const PackGeometry& g, const Nodal<Pack>& u,
                                           const Memory<Pack>& memory) const -> Response {
    Response response;
    response.kinematics = triangle_kinematics<Element>(u, g, sampling_);
    response.stress = triangle_stress<Element, given>(law_, response.kinematics, g, memory);
    return response;
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::internal_rate(std::size_t first, std::size_t last, const Evaluation& at,
                                                double* rate) const {
    if constexpr (Law::n_internal > 0) {
        for (std::size_t pack = first; pack < last; ++pack) {
            const PackGeometry g = geometry(pack);
            const Memory<Pack> memory = load_memory(at, pack);
            const auto [kinematics, stress] = response<TakesGivenStress<Law>>(g, gather(at.u, pack), memory);
            const auto rates = triangle_rates<Element>(gather(at.v, pack), kinematics, g, sampling_);
            for (std::size_t s = 0; s < Element::n_sub; ++s) {
                const auto z_rate =
                    law_.rate(kinematics.point[s], stress.volume, rates[s], stress.point[s], stress.q, memory[s]);
                for (std::size_t k = 0; k < Law::n_internal; ++k)
                    z_rate[k].store_unaligned(rate + pack * z_stride + (s * Law::n_internal + k) * pack_width);
            }
        }
    }
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::pack_response(std::size_t pack, const Evaluation& at, double* cauchy,
                                                double* force) const {
    const PackGeometry g = geometry(pack);
    const auto [kinematics, stress] = response<false>(g, gather(at.u, pack), load_memory(at, pack));
    for (int s = 0; s < Element::n_sub; ++s, cauchy += 3 * pack_width) {
        const auto sigma = cauchy_stress(kinematics.point[s], stress.point[s], stress.q);
        sigma.xx.store_unaligned(cauchy);
        sigma.yy.store_unaligned(cauchy + pack_width);
        sigma.xy.store_unaligned(cauchy + 2 * pack_width);
    }
    Nodal<Pack> f;
    triangle_force(kinematics, g, stress, f);
    if (viscous()) {
        const auto rates = triangle_rates<Element>(gather(at.v, pack), kinematics, g, sampling_);
        add_viscous_force<Element>(info_.viscosity, kinematics, rates, g, f);
    }
    for (int node = 0; node < Element::n_nodes; ++node, force += 2 * pack_width) {
        f[node].x.store_unaligned(force);
        f[node].y.store_unaligned(force + pack_width);
    }
}

// ---- tangents
// ---------------------------------------------------------------------------------------------------------

template <class Element, class Law>
template <bool given>
auto TriangleBlock<Element, Law>::law_tangent(const PackGeometry& g, const Nodal<Pack>& u, const Memory<Pack>& memory,
                                              double factor) const -> ElementMatrix<Element, Pack> {
    ElementMatrix<Element, Pack> matrix;
    for (auto& row : matrix) row.fill(Pack(0.0));
    add_law_tangent<Element, given>(law_, triangle_kinematics<Element>(u, g, sampling_), g, memory, factor, sampling_,
                                    matrix);
    return matrix;
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::add_viscosity(const PackGeometry& g, const Nodal<Pack>& u, const Nodal<Pack>& v,
                                                double c_u, double c_v, ElementMatrix<Element, Pack>& matrix) const {
    const auto kinematics = triangle_kinematics<Element>(u, g, sampling_);
    const auto rates = triangle_rates<Element>(v, kinematics, g, sampling_);
    add_viscous_tangent<Element>(info_.viscosity, kinematics, rates, g, c_u, c_v, sampling_, matrix);
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::add_tangent(std::size_t first, std::size_t last, const Evaluation& at, double c_u,
                                              double c_v, const MatrixPlaces& places, double* values) const {
    constexpr std::size_t n_pairs = Element::n_nodes * Element::n_nodes;
    for (std::size_t pack = first; pack < last; ++pack) {
        const PackGeometry g = geometry(pack);
        const Nodal<Pack> u = gather(at.u, pack);
        const Memory<Pack> memory = load_memory(at, pack);
        ElementMatrix<Element, Pack> matrix = TakesGivenStress<Law> && at.given
                                                  ? law_tangent<TakesGivenStress<Law>>(g, u, memory, c_u)
                                                  : law_tangent<false>(g, u, memory, c_u);
        if (viscous()) add_viscosity(g, u, gather(at.v, pack), c_u, c_v, matrix);
        // lanes behind the last element have no volume: they add zeros
        const std::int32_t* row_nodes = nodes_.data() + pack * index_stride;
        if (places.blocks == nullptr) {
            const auto* row = reinterpret_cast<const PairNumber*>(row_nodes);
            for (std::size_t a = 0; a < Element::n_nodes; ++a, row += pack_width)
                scatter_add_pairs(values, row, matrix[2 * a][2 * a], matrix[2 * a + 1][2 * a + 1]);
            continue;
        }
        const PairNumber* upper = places.blocks + pack * n_pairs * pack_width;
        for (std::size_t a = 0; a < Element::n_nodes; ++a, row_nodes += pack_width) {
            std::array<std::int32_t, pack_width> row_pairs;
            for (std::size_t lane = 0; lane < pack_width; ++lane) row_pairs[lane] = places.row_pairs[row_nodes[lane]];
            for (std::size_t b = 0; b < Element::n_nodes; ++b, upper += pack_width) {
                std::array<PairNumber, pack_width> lower;
                for (std::size_t lane = 0; lane < pack_width; ++lane)
                    lower[lane].value = upper[lane].value + row_pairs[lane];
                scatter_add_pairs(values, upper, matrix[2 * a][2 * b], matrix[2 * a][2 * b + 1]);
                scatter_add_pairs(values, lower.data(), matrix[2 * a + 1][2 * b], matrix[2 * a + 1][2 * b + 1]);
            }
        }
    }
}

template <class Element, class Law>
void TriangleBlock<Element, Law>::add_row_sums(std::size_t first, std::size_t last, const Evaluation& at,
                                               const LocalNodes& local) const {
    for (std::size_t pack = first; pack < last; ++pack) {
        const auto* index = local_nodes_.data() + pack * index_stride;
        const PackGeometry g = geometry(pack);
        const auto matrix = law_tangent<false>(g, gather(local.u, index), load_memory(at, pack), 1.0);
        std::array<Pack, n_dof> sums;
        sums.fill(Pack(0.0));
        for (std::size_t i = 0; i < n_dof; ++i)
            for (std::size_t j = 0; j < n_dof; ++j) sums[i] += Pack(0.5) * xsimd::abs(matrix[i][j] + matrix[j][i]);
        for (int node = 0; node < Element::n_nodes; ++node)
            scatter_add_pairs(local.f, index + node * pack_width, sums[2 * node], sums[2 * node + 1]);
    }
}

// ---- energies and bounds
// -----------------------------------------------------------------------------------------------

template <class Element, class Law>
auto TriangleBlock<Element, Law>::energies(std::size_t first, std::size_t last, const Evaluation& at) const -> Sums {
    Pack stored(0.0), stress_power(0.0), viscous_power(0.0);
    for (std::size_t pack = first; pack < last; ++pack) {
        const PackGeometry g = geometry(pack);
        if constexpr (Law::has_stored_energy) {
            const auto kinematics = triangle_kinematics<Element>(gather(at.u, pack), g, sampling_);
            const auto volume = law_.volume(kinematics.volume_strain);
            for (int s = 0; s < Element::n_sub; ++s)
                stored += g.of(s).volume * law_.energy_density(kinematics.point[s], volume);
        } else {
            const Memory<Pack> memory = load_memory(at, pack);
            for (int s = 0; s < Element::n_sub; ++s) stress_power += g.of(s).volume * memory[s].z[Law::n_internal - 1];
        }
        if (viscous() && at.v != nullptr) {
            const auto kinematics = triangle_kinematics<Element>(gather(at.u, pack), g, sampling_);
            const auto rates = triangle_rates<Element>(gather(at.v, pack), kinematics, g, sampling_);
            Nodal<Pack> f{};
            viscous_power += add_viscous_force<Element>(info_.viscosity, kinematics, rates, g, f);
        }
    }
    return {sum_of_lanes(stored), sum_of_lanes(stress_power), sum_of_lanes(viscous_power)};
}

template <class Element, class Law>
Pack TriangleBlock<Element, Law>::mass_weighted_bound(const PackGeometry& g,
                                                      const ElementMatrix<Element, Pack>& tangent) const {
    std::array<Pack, Element::n_nodes> mass;
    mass.fill(Pack(0.0));
    for (int s = 0; s < Element::n_sub; ++s)
        for (const int node : Element::sub_triangles[s]) mass[node] += g.of(s).volume;
    // padded lanes have no mass: any number does, they have no stiffness either
    for (Pack& m : mass) m = Pack(1.0) / xsimd::sqrt(xsimd::max(m * Pack(info_.density / 3), Pack(1e-300)));
    std::array<Pack, n_dof * n_dof> a;
    for (int i = 0; i < n_dof; ++i)
        for (int j = 0; j < n_dof; ++j)
            a[i * n_dof + j] = Pack(-0.5) * (tangent[i][j] + tangent[j][i]) * mass[i / 2] * mass[j / 2];
    return largest_eigenvalue_bound<n_dof>(a);
}

template <class Element, class Law>
auto TriangleBlock<Element, Law>::largest_rates(std::size_t first, std::size_t last, const Evaluation& at) const
    -> Rates {
    Pack omega_squared(0.0), damping(0.0);
    for (std::size_t pack = first; pack < last; ++pack) {
        const PackGeometry g = geometry(pack);
        const Nodal<Pack> u = gather(at.u, pack);
        omega_squared =
            xsimd::max(omega_squared, mass_weighted_bound(g, law_tangent<false>(g, u, load_memory(at, pack), 1.0)));
        if (viscous()) {
            ElementMatrix<Element, Pack> matrix;
            for (auto& row : matrix) row.fill(Pack(0.0));
            add_viscosity(g, u, gather(at.v, pack), 0.0, 1.0, matrix);
            damping = xsimd::max(damping, mass_weighted_bound(g, matrix));
        }
    }
    const auto largest = [](const Pack& pack) {
        std::array<double, pack_width> values;
        pack.store_unaligned(values.data());
        return *std::max_element(values.begin(), values.end());
    };
    return {largest(omega_squared), largest(damping)};
}

}  // namespace gneiss
