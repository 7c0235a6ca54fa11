#pragma once
// From nodal displacements to the derivatives of the nodal forces, for one element or for a pack of them.
//
// With B_s the constant matrix from nodal displacements to the four components of [H alpha, H beta] of sub-triangle s,
// nodal forces are f = -sum_s V_s B_s^T (p_s + q cof F_s)  [triangle_kernel.hpp], where p_s and q_s follow from H_s and
// the volumetric stretch s_v, and q is the mean of the q_s. Dual numbers over these five alone give
//
//   -df/du = sum_s V_s B_s^T (dp_s/dH_s + q dcof/dH) B_s + (r + q' c) t^T + c e^T
//   c = sum_s V_s B_s^T cof F_s,   t = ds_v/du = mean of B_s^T cof F_s (`centre`: that of the central sub-triangle),
//   r = sum_s V_s B_s^T dp_s/ds_v,   e = mean of B_s^T dq_s/dH_s,   q' = mean of dq_s/ds_v
//
// and the same for the viscous forces with the rates in the place of H, s_v'/s_v in that of s_v, and q = 0. A CST is
// its own composite: s_v is det F, and the first sum is everything.

#include "elements/triangle_kernel.hpp"

namespace gneiss {

/// d(force i)/d(displacement j), N/m, or of viscous forces by velocities; unknowns x, y, x, y, ... of the nodes.
template <class Element, class V>
using ElementMatrix = std::array<std::array<V, 2 * Element::n_nodes>, 2 * Element::n_nodes>;

namespace tangents {

/// Number of the dual variable behind the components of H: s_v, or its rate.
inline constexpr std::size_t fifth = 4;

/// Components x, y of alpha, then of beta.
template <class V>
using OnAxes = std::array<V, 4>;
template <class T>
OnAxes<T> on_axes(const Vec2<T>& alpha, const Vec2<T>& beta) {
    return {alpha.x, alpha.y, beta.x, beta.y};
}
/// d det F/d[H alpha, H beta] is linear in [F alpha, F beta]; of rates it is the derivative of (det F)' by H.
template <class T>
OnAxes<T> cofactors(const Vec2<T>& alpha, const Vec2<T>& beta) {
    return {beta.y, -beta.x, -alpha.y, alpha.x};
}

/// H alpha and H beta as the first four variables.
template <class D, class V>
PointKinematics<D> independent(const PointKinematics<V>& point) {
    const OnAxes<V> cof = cofactors(point.alpha(), point.beta());
    PointKinematics<D> dual{{D(point.axis.x), D(point.axis.y)},
                            {D::variable(point.h_alpha.x, 0), D::variable(point.h_alpha.y, 1)},
                            {D::variable(point.h_beta.x, 2), D::variable(point.h_beta.y, 3)},
                            D(point.area_strain)};
    for (std::size_t k = 0; k < 4; ++k) dual.area_strain.derivative[k] = cof[k];
    return dual;
}

/// matrix += factor V B^T a B with the B of sub-triangle s; a: rows P, columns H.
template <class Element, class V>
void add_point(const std::array<OnAxes<V>, 4>& a, const TriangleGeometry<Element, V>& geometry, int s, double factor,
               ElementMatrix<Element, V>& matrix) {
    const auto& sub = geometry.of(s);
    // by the edges u_a - u_b, u_c - u_b: first the columns, then the rows. Turned edges have turned forces.
    std::array<OnAxes<V>, 4> half, whole;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 2; ++k) {
            half[i][k] = a[i][k] * sub.k_a_alpha + a[i][2 + k] * sub.k_a_beta;
            half[i][2 + k] = a[i][k] * sub.k_c_alpha + a[i][2 + k] * sub.k_c_beta;
        }
    }
    const V volume = factor * sub.volume;
    const V a_alpha = volume * sub.k_a_alpha, a_beta = volume * sub.k_a_beta;
    const V c_alpha = volume * sub.k_c_alpha, c_beta = volume * sub.k_c_beta;
    for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t j = 0; j < 4; ++j) {
            whole[k][j] = a_alpha * half[k][j] + a_beta * half[2 + k][j];
            whole[2 + k][j] = c_alpha * half[k][j] + c_beta * half[2 + k][j];
        }
    }
    const auto& nodes = Element::sub_triangles[static_cast<std::size_t>(s)];
    const auto [at_a, at_b, at_c] =
        std::array{static_cast<std::size_t>(2 * nodes[0]), static_cast<std::size_t>(2 * nodes[1]),
                   static_cast<std::size_t>(2 * nodes[2])};
    for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t j = 0; j < 2; ++j) {
            const V aa = whole[k][j], ac = whole[k][2 + j], ca = whole[2 + k][j], cc = whole[2 + k][2 + j];
            const V ab = aa + ac, cb = ca + cc, ba = aa + ca, bc = ac + cc;
            matrix[at_a + k][at_a + j] += aa;
            matrix[at_a + k][at_c + j] += ac;
            matrix[at_c + k][at_a + j] += ca;
            matrix[at_c + k][at_c + j] += cc;
            matrix[at_a + k][at_b + j] = matrix[at_a + k][at_b + j] - ab;
            matrix[at_c + k][at_b + j] = matrix[at_c + k][at_b + j] - cb;
            matrix[at_b + k][at_a + j] = matrix[at_b + k][at_a + j] - ba;
            matrix[at_b + k][at_c + j] = matrix[at_b + k][at_c + j] - bc;
            matrix[at_b + k][at_b + j] += ab + cb;
        }
    }
}

/// A vector over the unknowns of an element.
template <class Element, class V>
struct NodalVector {
    std::array<V, 2 * Element::n_nodes> value;

    NodalVector() { value.fill(V(0.0)); }
    /// Adds weight B^T w with the B of sub-triangle s.
    void add(const OnAxes<V>& w, const TriangleGeometry<Element, V>& geometry, int s, const V& weight) {
        const auto& sub = geometry.of(s);
        const V sign = geometry.is_turned(s) ? -weight : weight;
        const auto& nodes = Element::sub_triangles[static_cast<std::size_t>(s)];
        for (std::size_t k = 0; k < 2; ++k) {
            const V at_a = sign * (sub.k_a_alpha * w[k] + sub.k_a_beta * w[2 + k]);
            const V at_c = sign * (sub.k_c_alpha * w[k] + sub.k_c_beta * w[2 + k]);
            value[static_cast<std::size_t>(2 * nodes[0]) + k] += at_a;
            value[static_cast<std::size_t>(2 * nodes[2]) + k] += at_c;
            value[static_cast<std::size_t>(2 * nodes[1]) + k] -= at_a + at_c;
        }
    }
    /// Adds factor x.
    void add(const V& factor, const NodalVector& x) {
        for (std::size_t i = 0; i < value.size(); ++i) value[i] += factor * x.value[i];
    }
};

/// sum_s V_s x_s = total sum_s weight(s) x_s, and the mean of x_s by volume is mean sum_s weight(s) x_s.
template <class Element, class V>
struct VolumeWeights {
    const TriangleGeometry<Element, V>& geometry;
    V weight(int s) const {
        if constexpr (Element::similar)
            return V(1.0);
        else
            return geometry.of(s).volume;
    }
    V total() const {
        if constexpr (Element::similar)
            return geometry.of(0).volume;
        else
            return V(1.0);
    }
    V mean() const {
        if constexpr (Element::similar)
            return V(1.0 / Element::n_sub);
        else
            return geometry.inverse_volume;
    }
};

/// sum_s weight(s) B_s^T w(s).
template <class Element, class V, class W>
NodalVector<Element, V> weighted_sum(const TriangleGeometry<Element, V>& geometry, W w) {
    NodalVector<Element, V> sum;
    for (int s = 0; s < Element::n_sub; ++s) sum.add(w(s), geometry, s, VolumeWeights<Element, V>{geometry}.weight(s));
    return sum;
}

/// B_s^T w(s) where the volumetric stretch is taken: the mean by volume, or that of the central sub-triangle.
template <class S, class Element, class V, class W>
NodalVector<Element, V> sampled(S sampling, const TriangleGeometry<Element, V>& geometry, W w) {
    NodalVector<Element, V> t;
    if constexpr (Element::n_sub > 1) {
        if (sampling == Sampling::centre) {
            t.add(w(Element::central), geometry, Element::central, V(1.0));
            return t;
        }
    }
    t.add(VolumeWeights<Element, V>{geometry}.mean(), weighted_sum(geometry, w));
    return t;
}

/// matrix += factor left right^T
template <class Element, class V>
void add_product(const V& factor, const NodalVector<Element, V>& left, const NodalVector<Element, V>& right,
                 ElementMatrix<Element, V>& matrix) {
    for (std::size_t i = 0; i < left.value.size(); ++i) {
        const V scaled = factor * left.value[i];
        for (std::size_t j = 0; j < right.value.size(); ++j) matrix[i][j] += scaled * right.value[j];
    }
}

/// d(p alpha, p beta)/d(variables 0 to 3): rows p.
template <class D>
auto by_axes(const PointStress<D>& stress) {
    const OnAxes<D> p = on_axes(stress.p_alpha, stress.p_beta);
    std::array<OnAxes<decltype(D::value)>, 4> a;
    for (std::size_t i = 0; i < 4; ++i) std::copy_n(p[i].derivative.begin(), 4, a[i].begin());
    return a;
}
/// The same by the fifth variable.
template <class D>
auto by_fifth(const PointStress<D>& stress) {
    return on_axes(Vec2{stress.p_alpha.x.derivative[fifth], stress.p_alpha.y.derivative[fifth]},
                   Vec2{stress.p_beta.x.derivative[fifth], stress.p_beta.y.derivative[fifth]});
}

/// dq/ds_v where q follows from s_v alone, Pa.
template <class Element, class Law, class V, class Memories>
V uniform_q_slope(const Law& law, const TriangleKinematics<Element, V>& kinematics, const Memories& memory) {
    using D = Dual<1, V>;
    const PointKinematics<V>& at = kinematics.point[0];
    const PointKinematics<D> point{{D(at.axis.x), D(at.axis.y)},
                                   {D(at.h_alpha.x), D(at.h_alpha.y)},
                                   {D(at.h_beta.x), D(at.h_beta.y)},
                                   D(at.area_strain)};
    return law.stress(point, law.volume(D::variable(kinematics.volume_strain, 0)), memory[0]).q.derivative[0];
}

}  // namespace tangents

/// Adds factor df/du of a law's nodal forces, memory updated with u unless given.
/// @param kinematics  at the displacements of the derivative
/// @param sampling    Sampling or MeanSampling
template <class Element, bool given, class Law, class V, class S>
void add_law_tangent(const Law& law, const TriangleKinematics<Element, V>& kinematics,
                     const TriangleGeometry<Element, V>& geometry,
                     const std::array<typename Law::template Memory<V>, Element::n_sub>& memory, double factor,
                     S sampling, ElementMatrix<Element, V>& matrix) {
    using namespace tangents;
    constexpr bool own_volume = Element::n_sub == 1;
    constexpr bool by_axes_alone = own_volume || Law::uniform_q;
    using D = Dual<by_axes_alone ? 4 : 5, V>;
    TriangleKinematics<Element, D> dual;
    for (std::size_t s = 0; s < Element::n_sub; ++s) dual.point[s] = independent<D>(kinematics.point[s]);
    if constexpr (own_volume)
        dual.volume_strain = dual.point[0].area_strain;
    else if constexpr (by_axes_alone)
        dual.volume_strain = D(kinematics.volume_strain);
    else
        dual.volume_strain = D::variable(kinematics.volume_strain, fifth);
    const auto stress = triangle_stress<Element, given>(law, dual, geometry, memory);

    const auto cofactor = [&](int s) {
        const auto& point = kinematics.point[static_cast<std::size_t>(s)];
        return cofactors(point.alpha(), point.beta());
    };
    const V& q = stress.q.value;
    for (int s = 0; s < Element::n_sub; ++s) {
        auto a = by_axes(stress.point[static_cast<std::size_t>(s)]);
        if constexpr (own_volume) {
            const OnAxes<V> cof = cofactor(s);
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 4; ++j) a[i][j] += cof[i] * stress.q.derivative[j];
        }
        // q dcof/dH
        a[0][3] += q;
        a[1][2] -= q;
        a[2][1] -= q;
        a[3][0] += q;
        add_point(a, geometry, s, -factor, matrix);
    }
    if constexpr (!own_volume) {
        const VolumeWeights<Element, V> weights{geometry};
        const V total = -factor * weights.total();
        const NodalVector<Element, V> c = weighted_sum(geometry, cofactor);
        NodalVector<Element, V> r;
        if constexpr (!Law::uniform_q) {
            r = weighted_sum(geometry, [&](int s) { return by_fifth(stress.point[static_cast<std::size_t>(s)]); });
            const NodalVector<Element, V> e = weighted_sum(geometry, [&](int s) {
                const auto& by = stress.point[static_cast<std::size_t>(s)].q.derivative;
                return OnAxes<V>{by[0], by[1], by[2], by[3]};
            });
            add_product(V(total * weights.mean()), c, e, matrix);
        }
        if constexpr (Law::uniform_q)
            r.add(uniform_q_slope(law, kinematics, memory), c);
        else
            r.add(stress.q.derivative[fifth], c);
        if (sampling == Sampling::mean)  // t is c, but for its factor
            add_product(V(total * weights.mean()), r, c, matrix);
        else
            add_product(total, r, sampled(sampling, geometry, cofactor), matrix);
    }
}

/// Adds c_u df/du + c_v df/dv of the viscous forces.
/// @param rates  of the sub-triangles, from triangle_rates()
template <class Element, class V, class S>
void add_viscous_tangent(const ViscousStress& viscosity, const TriangleKinematics<Element, V>& kinematics,
                         const std::array<PointRates<V>, Element::n_sub>& rates,
                         const TriangleGeometry<Element, V>& geometry, double c_u, double c_v, S sampling,
                         ElementMatrix<Element, V>& matrix) {
    using namespace tangents;
    using D = Dual<5, V>;
    std::array<PointStress<D>, Element::n_sub> by_u, by_v;
    for (std::size_t s = 0; s < Element::n_sub; ++s) {
        const auto& [alpha, beta, volume_rate] = rates[s];
        const D rate = D::variable(volume_rate, fifth);
        by_u[s] = viscosity.stress(independent<D>(kinematics.point[s]),
                                   PointRates<D>{{D(alpha.x), D(alpha.y)}, {D(beta.x), D(beta.y)}, rate});
        by_v[s] =
            viscosity.stress(kinematics.point[s], PointRates<D>{{D::variable(alpha.x, 0), D::variable(alpha.y, 1)},
                                                                {D::variable(beta.x, 2), D::variable(beta.y, 3)},
                                                                rate});
    }
    for (int s = 0; s < Element::n_sub; ++s) {
        add_point(by_axes(by_u[static_cast<std::size_t>(s)]), geometry, s, -c_u, matrix);
        add_point(by_axes(by_v[static_cast<std::size_t>(s)]), geometry, s, -c_v, matrix);
    }
    const NodalVector<Element, V> r =
        weighted_sum(geometry, [&](int s) { return by_fifth(by_v[static_cast<std::size_t>(s)]); });
    // (s_v'/s_v) = (mean of cof F : F')/s_v by v and by u
    const NodalVector<Element, V> by_velocity = sampled(sampling, geometry, [&](int s) {
        const auto& point = kinematics.point[static_cast<std::size_t>(s)];
        return cofactors(point.alpha(), point.beta());
    });
    NodalVector<Element, V> t = sampled(sampling, geometry, [&](int s) {
        const auto& rate = rates[static_cast<std::size_t>(s)];
        return cofactors(rate.alpha, rate.beta);
    });
    t.add(-rates[0].volume, by_velocity);
    const V scale = -VolumeWeights<Element, V>{geometry}.total() / (V(1.0) + kinematics.volume_strain);
    add_product(V(c_u * scale), r, t, matrix);
    add_product(V(c_v * scale), r, by_velocity, matrix);
}

}  // namespace gneiss
