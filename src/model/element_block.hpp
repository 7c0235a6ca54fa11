#pragma once
// All elements of one kind, one law and one set of constants, stored by packs. One virtual call handles a run of packs;
// there is none per element.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/dual.hpp"
#include "base/pack.hpp"
#include "materials/elastic_constants.hpp"
#include "materials/point.hpp"
#include "materials/viscous_stress.hpp"
#include "mesh/mesh.hpp"

namespace gneiss {

/// A vector whose data can be loaded as packs.
using PackVector = std::vector<double, xsimd::aligned_allocator<double, pack_alignment>>;

/// What a block is made from, beside its law.
struct BlockGeometry {
    std::vector<std::int32_t> elements;  ///< numbers in the mesh, ascending
    bool straight = false;               ///< composites: every mid-side node is in the middle of its side
    std::vector<double> axis_angle;      ///< per element of the block: direction of alpha, rad
    std::vector<std::array<double, 3>> in_situ_stress;  ///< per element, Cauchy xx, yy, xy, Pa; empty: none
    bool plane_stress = false;                          ///< else plane strain
    double thickness = 1;                               ///< m
    double density = 0;                                 ///< kg/m3
    ViscousStress viscosity;
};

/// Values at one sub-triangle, for output.
struct PointFields {
    std::array<double, 3> cauchy;       ///< xx, yy, xy, Pa; the law's and the viscous part
    double cauchy_zz;                   ///< across the plane, Pa; 0 in plane stress
    std::array<double, 4> munjiza;      ///< v, alpha, beta, psi, Pa; NaN for laws that know none
    std::array<double, 4> stretch;      ///< s_v (of the composite), s_alpha, s_beta, s_psi
    std::array<double, 2> alpha, beta;  ///< current axes, length = stretch
};

/// A bound on the strength of the sides of a block's elements: what a block compares its stresses with while it
/// computes forces. With s_1 the larger principal stress, m their mean and r half their difference, no side of whatever
/// direction can reach its envelope (src/fracture/envelope.hpp) where
///
///   (<s_1>/f_t)^2 + (<r/cos phi + m tan phi>/c_0)^2 <= 1,
///
/// because the second bracket is the largest |tau| + sigma tan phi over all directions.
struct StrengthWatch {
    double per_tensile_strength = 0;  ///< 1/f_t, 1/Pa, before the factor
    double per_cohesion = 0;          ///< 1/c_0, 1/Pa, before the factor
    double tan_phi = 0;               ///< -, >= 0
    PackVector factor_squared;        ///< of each element, -, shape (packs, pack_width)

    /// Left side over the factor squared, or up to 17 % more: the root of half^2 + xy^2 is at most the larger one of
    /// both and 0.4143 of the smaller one, which costs a fifth of it.
    template <class V>
    V index(const Symmetric2<V>& stress) const {
        const V zero(0.0), mean = 0.5 * (stress.xx + stress.yy), half = 0.5 * (stress.xx - stress.yy);
        const V a = choose(half < zero, V(-half), half), b = choose(stress.xy < zero, V(-stress.xy), stress.xy);
        const auto a_is_larger = a > b;
        const V radius = choose(a_is_larger, a, b) + 0.4143 * choose(a_is_larger, b, a);
        const V first = per_tensile_strength * (mean + radius);
        const V rest = per_cohesion * (std::sqrt(1 + tan_phi * tan_phi) * radius + tan_phi * mean);
        const V tension = choose(first > zero, first, zero), shear = choose(rest > zero, rest, zero);
        return tension * tension + shear * shear;
    }
};

class ElementBlock {
public:
    /// Where to read and where to write. Pointers to z and history are those of this block's own part.
    struct Evaluation {
        const double* u = nullptr;        ///< nodal pairs
        const double* v = nullptr;        ///< nodal pairs; read where the block is viscous
        const double* z = nullptr;        ///< accepted, or given by an ODE solver
        const double* history = nullptr;  ///< accepted
        bool given = false;               ///< stresses from z as it is
        double* z_updated = nullptr;      ///< null: no update wanted
        double* history_updated = nullptr;
        double* beyond = nullptr;  ///< per pack, see Watch; null: nobody watches
    };
    static constexpr std::ptrdiff_t none = -1;

    virtual ~ElementBlock() = default;

    virtual std::size_t n_elements() const = 0;
    virtual int n_nodes() const = 0;          ///< per element
    virtual int n_sub_triangles() const = 0;  ///< per element
    std::size_t n_packs() const { return padded(n_elements()) / pack_width; }
    /// Number of the mesh's element.
    virtual std::int32_t element(std::size_t local) const = 0;

    virtual std::size_t n_internal() const = 0;  ///< z of the block, whole packs
    virtual std::size_t n_history() const = 0;
    virtual bool viscous() const = 0;
    virtual std::size_t bytes_per_element() const = 0;  ///< read in a force evaluation, nodal data apart

    /// Nodes of the elements, shape (packs, n_nodes, pack_width); lanes behind the last element repeat it, without
    /// volume.
    virtual std::span<const std::int32_t> nodes() const = 0;
    /// Those of packs [first, last).
    std::span<const std::int32_t> nodes_of_packs(std::size_t first, std::size_t last) const {
        const std::size_t stride = static_cast<std::size_t>(n_nodes()) * pack_width;
        return nodes().subspan(first * stride, (last - first) * stride);
    }
    /// The same as positions among the nodes of a chunk, set by the assembly: 16 bits that stay in the nearest cache.
    virtual std::span<PairBytes> local_nodes() = 0;

    /// Follows a mesh in which some of its elements have other nodes than before, at the same places.
    virtual void renumber(const Mesh& mesh, std::span<const std::int32_t> locals) = 0;

    /// From here on forces also tell, in Evaluation::beyond, which lanes of each pack have a sub-triangle whose stress
    /// is beyond the watch: bit 0 for the first lane, as a whole number in a double. Viscous stress is left out.
    void watch(StrengthWatch watch) { watch_ = std::move(watch); }
    bool watched() const { return !watch_.factor_squared.empty(); }
    virtual void initial_memory(double* z, double* history) const = 0;
    /// SemiDiscrete::internal_weights() of the block's own z.
    virtual void internal_weights(double* weights) const = 0;
    /// Adds an element's mass at both components of its nodes, kg.
    virtual void add_mass(std::size_t local, std::span<double> mass) const = 0;

    /// Pairs of the nodes of a chunk, by local_nodes().
    struct LocalNodes {
        const double* u;
        const double* v;  ///< read where the block is viscous
        double* f;        ///< added to
    };
    /// Adds the nodal forces of packs [first, last).
    /// @param at  for z and history; u and v come from `local`
    /// @return an inverted element (local number), or `none`
    virtual std::ptrdiff_t add_force(std::size_t first, std::size_t last, const Evaluation& at,
                                     const LocalNodes& local) const = 0;
    /// Whether df/du and df/dv are symmetric.
    virtual bool symmetric_tangent() const = 0;
    /// Where the 2 x 2 blocks of element matrices stand in a matrix of compressed rows, which holds pairs of entries.
    struct MatrixPlaces {
        /// Upper pair of a pair of nodes, shape (packs, n_nodes, n_nodes, pack_width); null: the diagonal alone, a pair
        /// of entries per node.
        const PairNumber* blocks;
        const std::int32_t*
            row_pairs;  ///< from the upper pair to the lower one, of a row node, shape (nodes of the mesh)
    };
    /// Adds c_u df/du + c_v df/dv of packs [first, last), memory updated with u.
    virtual void add_tangent(std::size_t first, std::size_t last, const Evaluation& at, double c_u, double c_v,
                             const MatrixPlaces& places, double* values) const = 0;
    /// Adds the sums of |entries| of the rows of sym(-df/du) of packs [first, last), N/m, memory updated with u.
    virtual void add_row_sums(std::size_t first, std::size_t last, const Evaluation& at,
                              const LocalNodes& local) const = 0;
    /// z' at given z.
    virtual void internal_rate(std::size_t first, std::size_t last, const Evaluation& at, double* rate) const = 0;

    struct Sums {
        double stored = 0;         ///< J, laws with a stored energy
        double stress_power = 0;   ///< J, accumulated, other laws
        double viscous_power = 0;  ///< W, where v is given
    };
    virtual Sums energies(std::size_t first, std::size_t last, const Evaluation& at) const = 0;

    struct Rates {
        double omega_squared = 0;  ///< (rad/s)^2
        double damping = 0;        ///< 1/s
    };
    /// Largest eigenvalues of the elements' mass-weighted tangents, from above.
    virtual Rates largest_rates(std::size_t first, std::size_t last, const Evaluation& at) const = 0;

    /// @param[out] fields  shape (n_sub_triangles)
    virtual void point_fields(std::size_t local, const Evaluation& at, PointFields* fields) const = 0;
    /// Cauchy stresses of a whole pack without their viscous part, and nodal forces with it: far cheaper than
    /// point_fields() of its elements.
    /// @param[out] cauchy  Pa, shape (n_sub_triangles, 3, pack_width): xx, yy, xy
    /// @param[out] force   N, shape (n_nodes, 2, pack_width)
    virtual void pack_response(std::size_t pack, const Evaluation& at, double* cauchy, double* force) const = 0;
    /// "sub-triangle 2, det F = -0.1" of an inverted element.
    virtual std::string describe_inversion(std::size_t local, const Evaluation& at) const = 0;
    /// Stiffness at the start, direction of alpha (rad) and density (kg/m3): what small waves feel.
    virtual MunjizaConstants tangent_constants(std::size_t local) const = 0;
    virtual double axis_angle(std::size_t local) const = 0;
    virtual double density() const = 0;

protected:
    StrengthWatch watch_;
};

/// Packs [first, last) of a block.
struct PackRange {
    std::size_t block, first, last;
};

/// All packs of all blocks, cut into ranges of about n_sub_triangles: what a thread takes at a time.
std::vector<PackRange> pack_ranges(std::span<const std::unique_ptr<ElementBlock>> blocks, std::size_t n_sub_triangles);

}  // namespace gneiss
