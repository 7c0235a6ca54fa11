#pragma once
// From nodal displacements to nodal forces, for one element or for a pack of them  [FORMULATION 2 and 3].
// Templates on the scalar: double for reference, Pack for speed, Dual for exact tangents.

#include <array>
#include <cstddef>
#include <type_traits>

#include "base/dual.hpp"
#include "base/functions.hpp"
#include "elements/composite_triangle.hpp"
#include "elements/cst.hpp"
#include "materials/point.hpp"
#include "materials/viscous_stress.hpp"

namespace gneiss {

/// Where the volumetric stretch is taken.
enum class Sampling {
    mean,   ///< current area of the element over its initial area; of a CST its own
    centre  ///< det F of the central sub-triangle (COMPT): the tangent is not symmetric
};

/// In the place of a Sampling that is chosen at run time, for laws that offer no other.
using MeanSampling = std::integral_constant<Sampling, Sampling::mean>;

/// Geometry of the reference shape with the axes folded in.
template <class Element, class V>
struct TriangleGeometry {
    /// K = Xbar^-1 [alpha beta] of one sub-triangle, Xbar = [x_a - x_b, x_c - x_b]: [H alpha, H beta] = [d_a, d_c] K
    /// with the displacement differences d = u_a - u_b, u_c - u_b.
    struct Sub {
        V k_a_alpha, k_a_beta, k_c_alpha, k_c_beta;  ///< 1/m
        V volume;                                    ///< thickness times initial area, m3
    };

    static constexpr int n_stored = Element::similar ? 1 : Element::n_sub;

    Vec2<V> axis;  ///< alpha
    std::array<Sub, n_stored> sub;
    V inverse_volume;  ///< of the whole element, 1/m3; not used where the sub-triangles are similar

    const Sub& of(int s) const { return sub[Element::similar ? 0 : s]; }
    /// True if the sub-triangle is the stored one turned by 180 degrees: its K has the other sign.
    static constexpr bool is_turned(int s) { return Element::similar && Element::n_sub > 1 && s == Element::central; }
    /// The mean of values of the sub-triangles by volume.
    template <class T>
    T mean(const std::array<T, Element::n_sub>& values) const {
        if constexpr (Element::n_sub == 1) {
            return values[0];
        } else {
            T sum(0.0);
            for (int s = 0; s < Element::n_sub; ++s) {
                if constexpr (Element::similar)
                    sum += values[s];
                else
                    sum += sub[s].volume * values[s];
            }
            if constexpr (Element::similar)
                return (1.0 / Element::n_sub) * sum;
            else
                return inverse_volume * sum;
        }
    }
};

/// From node positions, m, shape (n_nodes), the unit vector alpha, and the thickness, m.
template <class Element>
TriangleGeometry<Element, double> triangle_geometry(const std::array<Vec2<double>, Element::n_nodes>& x,
                                                    const Vec2<double>& axis, double thickness) {
    using Geometry = TriangleGeometry<Element, double>;
    Geometry geometry{};
    geometry.axis = axis;
    const Vec2<double> beta = turned(axis);
    double volume = 0;
    for (int s = 0; s < Geometry::n_stored; ++s) {
        const auto& [a, b, c] = Element::sub_triangles[s];
        const Vec2<double> edge_a = x[a] - x[b], edge_c = x[c] - x[b];
        const double determinant = cross(edge_a, edge_c);
        geometry.sub[s] = {cross(axis, edge_c) / determinant, cross(beta, edge_c) / determinant,
                           cross(edge_a, axis) / determinant, cross(edge_a, beta) / determinant,
                           0.5 * thickness * determinant};
        volume += geometry.of(s).volume;
    }
    geometry.inverse_volume = 1 / (Element::similar ? Element::n_sub * volume : volume);
    return geometry;
}

template <class Element, class T>
struct TriangleKinematics {
    std::array<PointKinematics<T>, Element::n_sub> point;
    T volume_strain;  ///< s_v - 1
};

/// [F' alpha, F' beta] or [H alpha, H beta] of sub-triangle s from nodal velocities or displacements.
/// @param[out] alpha, beta  written component by component: GCC copies whole aggregates of packs by way of the stack
template <class Element, class T, class V>
void axes_images(const std::array<Vec2<T>, Element::n_nodes>& u, const TriangleGeometry<Element, V>& geometry, int s,
                 Vec2<T>& alpha, Vec2<T>& beta) {
    const auto& [a, b, c] = Element::sub_triangles[s];
    const auto& sub = geometry.of(s);
    const bool is_turned = geometry.is_turned(s);
    const Vec2<T> d_a = is_turned ? u[b] - u[a] : u[a] - u[b], d_c = is_turned ? u[b] - u[c] : u[c] - u[b];
    alpha.x = sub.k_a_alpha * d_a.x + sub.k_c_alpha * d_c.x;
    alpha.y = sub.k_a_alpha * d_a.y + sub.k_c_alpha * d_c.y;
    beta.x = sub.k_a_beta * d_a.x + sub.k_c_beta * d_c.x;
    beta.y = sub.k_a_beta * d_a.y + sub.k_c_beta * d_c.y;
}

/// The volumetric quantity of an element from those of its sub-triangles.
/// @tparam S  Sampling or MeanSampling
template <class Element, class T, class V, class S>
T sampled_volume(const std::array<T, Element::n_sub>& values, const TriangleGeometry<Element, V>& geometry,
                 S sampling) {
    if constexpr (Element::n_sub > 1)
        if (sampling == Sampling::centre) return values[Element::central];
    return geometry.mean(values);
}

template <class Element, class T, class V, class S>
TriangleKinematics<Element, T> triangle_kinematics(const std::array<Vec2<T>, Element::n_nodes>& u,
                                                   const TriangleGeometry<Element, V>& geometry, S sampling) {
    TriangleKinematics<Element, T> kinematics{};
    const Vec2<T> axis{T(geometry.axis.x), T(geometry.axis.y)};
    std::array<T, Element::n_sub> change;
#pragma GCC unroll 4
    for (int s = 0; s < Element::n_sub; ++s) {
        PointKinematics<T>& point = kinematics.point[s];
        point.axis.x = axis.x;
        point.axis.y = axis.y;
        axes_images(u, geometry, s, point.h_alpha, point.h_beta);
        point.area_strain = area_strain(axis, point.h_alpha, point.h_beta);
        change[s] = point.area_strain;
    }
    kinematics.volume_strain = sampled_volume(change, geometry, sampling);
    return kinematics;
}

/// Whether s_v and det F of every sub-triangle are positive, of packs lane by lane. NaN is not.
template <class Element, class T>
auto is_upright(const TriangleKinematics<Element, T>& kinematics) {
    auto upright = plain(kinematics.volume_strain) > -1.0;
    if constexpr (Element::n_sub > 1)
        for (const auto& point : kinematics.point) upright = upright && plain(point.area_strain) > -1.0;
    return upright;
}

/// Adds the nodal forces -V [P alpha, P beta] K^T of sub-triangle s.
template <class Element, class T, class V>
void subtract_stress(const Vec2<T>& p_alpha, const Vec2<T>& p_beta, const TriangleGeometry<Element, V>& geometry, int s,
                     std::array<Vec2<T>, Element::n_nodes>& f) {
    const auto& [a, b, c] = Element::sub_triangles[s];
    const auto& sub = geometry.of(s);
    // V K first: one product for all four sub-triangles where they are similar
    const Vec2<T> g_a = (sub.volume * sub.k_a_alpha) * p_alpha + (sub.volume * sub.k_a_beta) * p_beta;
    const Vec2<T> g_c = (sub.volume * sub.k_c_alpha) * p_alpha + (sub.volume * sub.k_c_beta) * p_beta;
    if (geometry.is_turned(s)) {
        f[a] += g_a;
        f[c] += g_c;
        f[b] = f[b] - (g_a + g_c);
    } else {
        f[a] = f[a] - g_a;
        f[c] = f[c] - g_c;
        f[b] += g_a + g_c;
    }
}

/// What a law answers in one element.
template <class Element, class Law, class T>
struct TriangleStress {
    typename Law::template Volume<T> volume;
    std::array<PointStress<T>, Element::n_sub> point;
    T q;  ///< average of the points' q by reference volume, Pa
};

template <class Law>
concept TakesGivenStress = requires {
    &Law::template stress_at<double, double>;
};

/// @param given  false: stresses follow from u and the accepted memory; true: from the memory's z as it is
template <class Element, bool given, class Law, class T, class V>
TriangleStress<Element, Law, T> triangle_stress(
    const Law& law, const TriangleKinematics<Element, T>& kinematics, const TriangleGeometry<Element, V>& geometry,
    const std::array<typename Law::template Memory<V>, Element::n_sub>& memory) {
    TriangleStress<Element, Law, T> stress{};
    stress.volume = law.volume(kinematics.volume_strain);
    std::array<T, Element::n_sub> q;
#pragma GCC unroll 4
    for (int s = 0; s < Element::n_sub; ++s) {
        if constexpr (given && TakesGivenStress<Law>)
            stress.point[s] = law.stress_at(kinematics.point[s], stress.volume, memory[s]);
        else
            stress.point[s] = law.stress(kinematics.point[s], stress.volume, memory[s]);
        q[s] = stress.point[s].q;
    }
    if constexpr (Law::uniform_q)
        stress.q = q[0];
    else
        stress.q = geometry.mean(q);
    return stress;
}

/// Nodal forces of one element, the negative gradient of its energy where the law has one.
/// @param[out] f  overwritten, N, shape (n_nodes, 2)
template <class Element, class Law, class T, class V>
void triangle_force(const TriangleKinematics<Element, T>& kinematics, const TriangleGeometry<Element, V>& geometry,
                    const TriangleStress<Element, Law, T>& stress, std::array<Vec2<T>, Element::n_nodes>& f) {
    f.fill({T(0.0), T(0.0)});
#pragma GCC unroll 4
    for (int s = 0; s < Element::n_sub; ++s) {
        const PointKinematics<T>& point = kinematics.point[s];
        subtract_stress(stress.point[s].p_alpha + stress.q * cofactor_alpha(point),
                        stress.point[s].p_beta + stress.q * cofactor_beta(point), geometry, s, f);
    }
}

/// Rates of the sub-triangles from nodal velocities, m/s; T may be a dual over the velocities where K is plain.
template <class Element, class T, class K, class V, class S>
std::array<PointRates<T>, Element::n_sub> triangle_rates(const std::array<Vec2<T>, Element::n_nodes>& v,
                                                         const TriangleKinematics<Element, K>& kinematics,
                                                         const TriangleGeometry<Element, V>& geometry, S sampling) {
    std::array<PointRates<T>, Element::n_sub> rates{};
    const K inverse_s_v = K(1.0) / (K(1.0) + kinematics.volume_strain);
    std::array<T, Element::n_sub> area_rate;
    for (int s = 0; s < Element::n_sub; ++s) {
        auto& [alpha, beta, volume_rate] = rates[s];
        axes_images(v, geometry, s, alpha, beta);
        const Vec2<K> c_alpha = cofactor_alpha(kinematics.point[s]), c_beta = cofactor_beta(kinematics.point[s]);
        area_rate[s] = c_alpha.x * alpha.x + c_alpha.y * alpha.y + c_beta.x * beta.x + c_beta.y * beta.y;
    }
    const T change = sampled_volume(area_rate, geometry, sampling);
    for (auto& rate : rates) rate.volume = inverse_s_v * change;
    return rates;
}

/// Adds the nodal forces of the viscous stress, N; returns the power it dissipates, W.
template <class Element, class T, class K, class V>
T add_viscous_force(const ViscousStress& viscosity, const TriangleKinematics<Element, K>& kinematics,
                    const std::array<PointRates<T>, Element::n_sub>& rates,
                    const TriangleGeometry<Element, V>& geometry, std::array<Vec2<T>, Element::n_nodes>& f) {
    T power(0.0);
    for (int s = 0; s < Element::n_sub; ++s) {
        const PointStress<T> stress = viscosity.stress(kinematics.point[s], rates[s]);
        subtract_stress(stress.p_alpha, stress.p_beta, geometry, s, f);
        power += geometry.of(s).volume * (dot(stress.p_alpha, rates[s].alpha) + dot(stress.p_beta, rates[s].beta));
    }
    return power;
}

}  // namespace gneiss
