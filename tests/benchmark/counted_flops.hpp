#pragma once
// Floating-point operations of one element, counted by running the kernel on a scalar that counts.

#include <cstddef>

#include "base/series.hpp"
#include "elements/triangle_kernel.hpp"
#include "materials/munjiza_hyperelastic.hpp"

namespace gneiss::benchmark {

/// Additions, multiplications and divisions of textbook_cst.hpp's loop, counted by hand; the node update adds 8.
inline constexpr double textbook_flops = 105 + 0.5 * 8;

/// A double that counts what is done with it. Series are counted as the multiply-adds they are made of.
struct Counted {
    double value = 0;
    static inline std::size_t operations = 0;

    Counted() = default;
    Counted(double v) : value(v) {}  // NOLINT: constants convert on purpose

    static Counted after(std::size_t n, double v) {
        operations += n;
        return v;
    }
    friend Counted operator+(Counted a, Counted b) { return after(1, a.value + b.value); }
    friend Counted operator-(Counted a, Counted b) { return after(1, a.value - b.value); }
    friend Counted operator-(Counted a) { return after(1, -a.value); }
    friend Counted operator*(Counted a, Counted b) { return after(1, a.value * b.value); }
    friend Counted operator/(Counted a, Counted b) { return after(1, a.value / b.value); }
    Counted& operator+=(Counted b) { return *this = *this + b; }
};

constexpr std::size_t series_operations = 2 * (series::degree - 1) + 1;

// found by argument-dependent lookup, hence in the scalar's own namespace
inline Counted ln1p(Counted x) { return Counted::after(series_operations, std::log1p(x.value)); }
inline Counted angular_response(Counted c) {
    const auto angle = gneiss::angular_strain(c.value);
    return Counted::after(series_operations, angle.strain * angle.ratio);
}

/// Of a hyper-elastic Munjiza element, assembly included.
template <class Element>
double counted_flops() {
    std::array<Vec2<double>, Element::n_nodes> x{};
    constexpr std::array<Vec2<double>, 6> corners_first{{{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {0, 0.5}, {0.5, 0}}};
    constexpr std::array<int, 6> around{0, 5, 1, 3, 2, 4};
    for (int node = 0; node < Element::n_nodes; ++node)
        x[node] = corners_first[Element::n_nodes == 3 ? node : around[node]];
    const auto plain_geometry = triangle_geometry<Element>(x, {1, 0}, 1);
    TriangleGeometry<Element, Counted> geometry{};
    geometry.axis = {plain_geometry.axis.x, plain_geometry.axis.y};
    for (int s = 0; s < TriangleGeometry<Element, double>::n_stored; ++s) {
        const auto& sub = plain_geometry.sub[s];
        geometry.sub[s] = {sub.k_a_alpha, sub.k_a_beta, sub.k_c_alpha, sub.k_c_beta, sub.volume};
    }
    geometry.inverse_volume = plain_geometry.inverse_volume;
    const MunjizaHyperelastic<false> law{{1, 1, 1, 1}};
    const std::array<Vec2<Counted>, Element::n_nodes> u{};
    std::array<Vec2<Counted>, Element::n_nodes> f{};
    Counted::operations = 0;
    const auto kinematics = triangle_kinematics<Element>(u, geometry, Sampling::mean);
    const auto stress = triangle_stress<Element, false>(law, kinematics, geometry,
                                                        std::array<PointMemory<Counted, 0, 0>, Element::n_sub>{});
    triangle_force<Element, MunjizaHyperelastic<false>>(kinematics, geometry, stress, f);
    return static_cast<double>(Counted::operations + 2 * Element::n_nodes);
}

}  // namespace gneiss::benchmark
