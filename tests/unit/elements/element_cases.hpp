#pragma once
// Every element under contract, with what its header draws.

#include <gtest/gtest.h>

#include <random>

#include "elements/triangle_kernel.hpp"
#include "support/deformation.hpp"
#include "support/laws.hpp"

namespace gneiss {

template <class Element, class T>
using Nodal = std::array<Vec2<T>, Element::n_nodes>;

struct CstCase {
    using Element = Cst;
    /// As drawn in elements/cst.hpp, m.
    static Nodal<Element, double> drawn() { return {{{0, 0}, {1, 0}, {0, 1}}}; }
    /// Where the drawing has the centre of each sub-triangle.
    static std::array<Vec2<double>, 1> sub_centres() { return {{{1.0 / 3, 1.0 / 3}}}; }
    /// Distorted, m.
    static Nodal<Element, double> distorted() { return {{{0.3, -0.2}, {1.4, 0.3}, {-0.1, 0.8}}}; }
};

struct CompositeCase {
    using Element = CompositeTriangle;
    /// As drawn in mesh/composite.hpp, on the unit triangle.
    static Nodal<Element, double> drawn() { return {{{0, 0}, {0.5, 0}, {1, 0}, {0.5, 0.5}, {0, 1}, {0, 0.5}}}; }
    static std::array<Vec2<double>, 4> sub_centres() {
        return {{{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}, {1.0 / 3, 1.0 / 3}}};
    }
    static Nodal<Element, double> distorted() {
        return {{{0.3, -0.2}, {0.8, -0.05}, {1.4, 0.3}, {0.7, 0.5}, {-0.1, 0.8}, {0.15, 0.25}}};
    }
};

struct StraightCompositeCase {
    using Element = StraightCompositeTriangle;
    static Nodal<Element, double> drawn() { return CompositeCase::drawn(); }
    static std::array<Vec2<double>, 4> sub_centres() { return CompositeCase::sub_centres(); }
    /// The corners of CompositeCase::distorted(), mid-sides in the middle.
    static Nodal<Element, double> distorted() {
        Nodal<Element, double> x = CompositeCase::distorted();
        for (std::size_t side = 1; side < 6; side += 2) x[side] = 0.5 * (x[side - 1] + x[(side + 1) % 6]);
        return x;
    }
};

/// To add an element: one struct like those above, one name here.
using Elements = testing::Types<CstCase, CompositeCase, StraightCompositeCase>;

inline constexpr double thickness_under_test = 0.7;  ///< m

/// u_n = H X_n, m.
template <class Element>
Nodal<Element, double> affine(const Nodal<Element, double>& x, const Tensor<double>& h) {
    Nodal<Element, double> u;
    for (std::size_t n = 0; n < x.size(); ++n) u[n] = {h[0] * x[n].x + h[1] * x[n].y, h[2] * x[n].x + h[3] * x[n].y};
    return u;
}

/// H of a finite deformation, and noise on top that moves no sub-triangle near inversion.
template <class Element>
Nodal<Element, double> noisy(const Nodal<Element, double>& x, const Tensor<double>& h, std::mt19937& random,
                             double amplitude = 0.03) {
    std::uniform_real_distribution<double> noise(-amplitude, amplitude);
    Nodal<Element, double> u = affine<Element>(x, h);
    for (Vec2<double>& value : u) value += Vec2<double>{noise(random), noise(random)};
    return u;
}

template <class Element, class Law, class V>
using ElementMemory = std::array<typename Law::template Memory<V>, Element::n_sub>;

/// Forces, N, of one element.
template <class Element, class T, class V, class Law>
Nodal<Element, T> forces(const Law& law, const Nodal<Element, T>& u, const TriangleGeometry<Element, V>& geometry,
                         const ElementMemory<Element, Law, V>& memory, Sampling sampling) {
    const auto kinematics = triangle_kinematics<Element>(u, geometry, sampling);
    const auto stress = triangle_stress<Element, false>(law, kinematics, geometry, memory);
    Nodal<Element, T> f;
    triangle_force(kinematics, geometry, stress, f);
    return f;
}

/// The memory after the element has been led to u.
template <class Element, class Law, class V>
ElementMemory<Element, Law, V> led_to(const Law& law, const Nodal<Element, V>& u,
                                      const TriangleGeometry<Element, V>& geometry,
                                      const ElementMemory<Element, Law, V>& memory, Sampling sampling) {
    const auto kinematics = triangle_kinematics<Element>(u, geometry, sampling);
    const auto stress = triangle_stress<Element, false>(law, kinematics, geometry, memory);
    ElementMemory<Element, Law, V> updated;
    for (std::size_t s = 0; s < updated.size(); ++s)
        updated[s] = law.update(kinematics.point[s], stress.volume, stress.point[s], stress.q, memory[s]);
    return updated;
}
template <class Element, class Law>
ElementMemory<Element, Law, double> element_at_rest(const Law& law, const TriangleGeometry<Element, double>& geometry,
                                                    Sampling sampling) {
    return led_to<Element>(law, Nodal<Element, double>{}, geometry, ElementMemory<Element, Law, double>{}, sampling);
}

template <class Element>
TriangleGeometry<Element, double> geometry_of(const Nodal<Element, double>& x, double axis) {
    return triangle_geometry<Element>(x, {std::cos(axis), std::sin(axis)}, thickness_under_test);
}

template <class Element>
double largest(const Nodal<Element, double>& f) {
    double size = 0;
    for (const Vec2<double>& value : f) size = std::max({size, std::abs(value.x), std::abs(value.y)});
    return size;
}

/// -df/du, N/m, shape (2 n_nodes, 2 n_nodes).
template <class Element, class Law>
Eigen::MatrixXd stiffness(const Law& law, const Nodal<Element, double>& u,
                          const TriangleGeometry<Element, double>& geometry,
                          const ElementMemory<Element, Law, double>& memory, Sampling sampling) {
    constexpr int n = 2 * Element::n_nodes;
    using D = Dual<n>;
    Nodal<Element, D> variable;
    for (int node = 0; node < Element::n_nodes; ++node) {
        const auto at = static_cast<std::size_t>(node);
        variable[at] = {D::variable(u[at].x, 2 * node), D::variable(u[at].y, 2 * node + 1)};
    }
    const Nodal<Element, D> f = forces<Element>(law, variable, geometry, memory, sampling);
    Eigen::MatrixXd k(n, n);
    for (int i = 0; i < n; ++i) {
        const auto& force = f[static_cast<std::size_t>(i / 2)];
        for (int j = 0; j < n; ++j) k(i, j) = -(i % 2 == 0 ? force.x : force.y).derivative[static_cast<std::size_t>(j)];
    }
    return k;
}

}  // namespace gneiss
