#pragma once
// A material point by itself: it is its own composite, s_v = det F.

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "base/dual.hpp"
#include "materials/point.hpp"

namespace gneiss {

/// A tensor of the plane, row by row: xx, xy, yx, yy. H = F - I unless said otherwise.
template <class T>
using Tensor = std::array<T, 4>;
inline constexpr Tensor<double> at_rest{};

inline Eigen::Matrix2d matrix(const Tensor<double>& t) { return Eigen::Matrix2d{{t[0], t[1]}, {t[2], t[3]}}; }
inline Tensor<double> tensor(const Eigen::Matrix2d& m) { return {m(0, 0), m(0, 1), m(1, 0), m(1, 1)}; }

inline Eigen::Matrix2d rotation(double angle) {
    return Eigen::Matrix2d{{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
}
/// H of a rigid rotation; cos - 1 without loss of digits.
inline Tensor<double> rigid_rotation(double angle) {
    const double s = std::sin(angle / 2);
    return {-2 * s * s, -std::sin(angle), std::sin(angle), -2 * s * s};
}
/// H of R F, from H of F.
inline Tensor<double> rotated(double angle, const Tensor<double>& h) {
    return tensor(matrix(rigid_rotation(angle)) + rotation(angle) * matrix(h));
}
inline Tensor<double> scaled(double factor, const Tensor<double>& h) {
    return {factor * h[0], factor * h[1], factor * h[2], factor * h[3]};
}
inline Tensor<double> sum(const Tensor<double>& a, const Tensor<double>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}

/// Finite deformations of all kinds: stretch, compression, shear, and both with a large rotation.
inline std::array<Tensor<double>, 6> finite_deformations() {
    return {{{0.10, 0.00, 0.00, -0.06},
             {-0.12, 0.05, 0.02, -0.09},
             {0.03, 0.25, -0.04, 0.02},
             {0.07, -0.10, 0.16, 0.12},
             rotated(2.1, {-0.05, 0.08, -0.11, 0.09}),
             rotated(-0.8, {-0.10, -0.12, 0.03, -0.02})}};
}
/// Angles of the material axis alpha, rad, without symmetry.
inline constexpr std::array<double, 4> axis_angles_under_test{0.0, 0.4, -1.3, 2.5};

template <class T>
PointKinematics<T> point_at(const Tensor<T>& h, double axis_angle) {
    const double c = std::cos(axis_angle), s = std::sin(axis_angle);
    const Vec2<T> axis{T(c), T(s)};
    const Vec2<T> h_alpha{c * h[0] + s * h[1], c * h[2] + s * h[3]}, h_beta{c * h[1] - s * h[0], c * h[3] - s * h[2]};
    return {axis, h_alpha, h_beta, area_strain(axis, h_alpha, h_beta)};
}

/// F' alpha, F' beta and s_v'/s_v from F', row by row, 1/s.
inline PointRates<double> rates_at(const PointKinematics<double>& point, const Tensor<double>& f_rate) {
    const Vec2<double> a = point.axis, b = turned(point.axis);
    const Vec2<double> alpha{f_rate[0] * a.x + f_rate[1] * a.y, f_rate[2] * a.x + f_rate[3] * a.y};
    const Vec2<double> beta{f_rate[0] * b.x + f_rate[1] * b.y, f_rate[2] * b.x + f_rate[3] * b.y};
    const double area_rate = cross(alpha, point.beta()) + cross(point.alpha(), beta);
    return {alpha, beta, area_rate / point.jacobian()};
}

/// P = (P alpha) alpha^T + (P beta) beta^T in x and y.
template <class T>
Tensor<T> on_xy(const PointKinematics<T>& point, const Vec2<T>& p_alpha, const Vec2<T>& p_beta) {
    const Vec2<T> a = point.axis, b = turned(point.axis);
    return {p_alpha.x * a.x + p_beta.x * b.x, p_alpha.x * a.y + p_beta.x * b.y, p_alpha.y * a.x + p_beta.y * b.x,
            p_alpha.y * a.y + p_beta.y * b.y};
}

/// First Piola-Kirchhoff stress, Pa.
template <class T, class Law, class Memory>
Tensor<T> first_piola(const Law& law, const Tensor<T>& h, double axis_angle, const Memory& accepted) {
    const auto point = point_at(h, axis_angle);
    const auto stress = law.stress(point, law.volume(point.area_strain), accepted);
    return on_xy<T>(point, stress.p_alpha + stress.q * cofactor_alpha(point),
                    stress.p_beta + stress.q * cofactor_beta(point));
}

/// Cauchy stress P F^T / det F, Pa: both shear entries as they come out.
inline Eigen::Matrix2d cauchy_of(const Tensor<double>& p, const Tensor<double>& h) {
    const Eigen::Matrix2d f = Eigen::Matrix2d::Identity() + matrix(h);
    return matrix(p) * f.transpose() / f.determinant();
}

/// The next accepted memory.
template <class Law, class Memory>
Memory updated(const Law& law, const Tensor<double>& h, double axis_angle, const Memory& accepted) {
    const auto point = point_at(h, axis_angle);
    const auto volume = law.volume(point.area_strain);
    const auto stress = law.stress(point, volume, accepted);
    return law.update(point, volume, stress, stress.q, accepted);
}
/// The memory of a point that has been led to H = 0: what a law without initial stress starts with.
template <class Law>
typename Law::template Memory<double> memory_at_rest(const Law& law, double axis_angle) {
    return updated(law, at_rest, axis_angle, typename Law::template Memory<double>{});
}

/// dP/dF, Pa, by dual numbers, shape (4, 4), rows and columns in the order of Tensor.
template <class Law, class Memory>
Eigen::Matrix4d tangent(const Law& law, const Tensor<double>& h, double axis_angle, const Memory& accepted) {
    using D = Dual<4>;
    Tensor<D> variable;
    for (std::size_t k = 0; k < 4; ++k) variable[k] = D::variable(h[k], static_cast<int>(k));
    const Tensor<D> p = first_piola(law, variable, axis_angle, accepted);
    Eigen::Matrix4d derivative;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            derivative(i, j) = p[static_cast<std::size_t>(i)].derivative[static_cast<std::size_t>(j)];
    return derivative;
}

}  // namespace gneiss
