#pragma once
// The yardstick of bench_explicit: the explicit loop of older FDEM codes, written as such codes write it. Scalar, plain
// arrays, linear isotropic elasticity on the left Cauchy-Green strain, constant strain triangles, about 100 flops each.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"

namespace gneiss::benchmark {

class TextbookCst {
public:
    TextbookCst(const Mesh& mesh, double lambda, double mu, double density, double thickness)
        : n_elements_(mesh.n_elements()), n_nodes_(mesh.n_nodes()), lambda_(lambda), mu_(mu) {
        for (std::size_t k = 0; k < 3; ++k) node_[k].resize(n_elements_);
        for (auto* values : {&x0_, &y0_, &x_, &y_, &vx_, &vy_, &fx_, &fy_, &mass_}) values->assign(n_nodes_, 0.0);
        for (std::size_t i = 0; i < n_nodes_; ++i) {
            x_[i] = x0_[i] = mesh.nodes[i][0];
            y_[i] = y0_[i] = mesh.nodes[i][1];
        }
        for (std::size_t e = 0; e < n_elements_; ++e) {
            for (std::size_t k = 0; k < 3; ++k) node_[k][e] = mesh.element(e)[k];
            const auto i = static_cast<std::size_t>(node_[0][e]), j = static_cast<std::size_t>(node_[1][e]),
                       l = static_cast<std::size_t>(node_[2][e]);
            const double area = 0.5 * ((x0_[j] - x0_[i]) * (y0_[l] - y0_[i]) - (x0_[l] - x0_[i]) * (y0_[j] - y0_[i]));
            for (const std::size_t n : {i, j, l}) mass_[n] += density * thickness * area / 3;
        }
    }

    std::vector<double>& vx() { return vx_; }
    double kinetic_energy() const {
        double sum = 0;
        for (std::size_t i = 0; i < n_nodes_; ++i) sum += 0.5 * mass_[i] * (vx_[i] * vx_[i] + vy_[i] * vy_[i]);
        return sum;
    }

    void step(double dt) {
        for (std::size_t i = 0; i < n_nodes_; ++i) fx_[i] = fy_[i] = 0;
        for (std::size_t e = 0; e < n_elements_; ++e) {
            const auto i = static_cast<std::size_t>(node_[0][e]), j = static_cast<std::size_t>(node_[1][e]),
                       l = static_cast<std::size_t>(node_[2][e]);
            // initial and current base
            const double a0 = x0_[j] - x0_[i], b0 = x0_[l] - x0_[i], c0 = y0_[j] - y0_[i], d0 = y0_[l] - y0_[i];
            const double a = x_[j] - x_[i], b = x_[l] - x_[i], c = y_[j] - y_[i], d = y_[l] - y_[i];
            const double inverse = 1 / (a0 * d0 - b0 * c0);
            const double i00 = d0 * inverse, i01 = -b0 * inverse, i10 = -c0 * inverse, i11 = a0 * inverse;
            // deformation gradient, left Cauchy-Green strain
            const double f00 = a * i00 + b * i10, f01 = a * i01 + b * i11, f10 = c * i00 + d * i10,
                         f11 = c * i01 + d * i11;
            const double jacobian = f00 * f11 - f01 * f10;
            const double e00 = 0.5 * (f00 * f00 + f01 * f01 - 1), e11 = 0.5 * (f10 * f10 + f11 * f11 - 1),
                         e01 = 0.5 * (f00 * f10 + f01 * f11);
            // Cauchy stress
            const double scale = 1 / jacobian, trace = lambda_ * (e00 + e11);
            const double s00 = (2 * mu_ * e00 + trace) * scale, s11 = (2 * mu_ * e11 + trace) * scale,
                         s01 = 2 * mu_ * e01 * scale;
            // half the traction of the opposite edge on each node
            const auto add = [&](std::size_t n, std::size_t from, std::size_t to) {
                const double nx = 0.5 * (y_[to] - y_[from]), ny = -0.5 * (x_[to] - x_[from]);
                fx_[n] += s00 * nx + s01 * ny;
                fy_[n] += s01 * nx + s11 * ny;
            };
            add(i, j, l);
            add(j, l, i);
            add(l, i, j);
        }
        for (std::size_t i = 0; i < n_nodes_; ++i) {
            const double factor = dt / mass_[i];
            vx_[i] += factor * fx_[i];
            vy_[i] += factor * fy_[i];
            x_[i] += dt * vx_[i];
            y_[i] += dt * vy_[i];
        }
    }

private:
    std::size_t n_elements_, n_nodes_;
    double lambda_, mu_;
    std::array<std::vector<std::int32_t>, 3> node_;
    std::vector<double> x0_, y0_, x_, y_, vx_, vy_, fx_, fy_, mass_;
};

}  // namespace gneiss::benchmark
