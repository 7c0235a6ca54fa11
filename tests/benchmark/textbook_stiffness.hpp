#pragma once
// The yardstick of bench_implicit: the stiffness matrix of linear isotropic constant strain triangles, written out by
// hand as textbooks give it, with the place of every entry found beforehand.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace gneiss::benchmark {

class TextbookStiffness {
public:
    /// @param row_starts, columns  compressed rows over 2 n_nodes unknowns, columns ascending
    TextbookStiffness(const Mesh& mesh, double lambda, double mu, double thickness,
                      std::span<const std::int64_t> row_starts, std::span<const std::int64_t> columns)
        : lambda_(lambda), mu_(mu), thickness_(thickness) {
        for (const auto& node : mesh.nodes) {
            x_.push_back(node[0]);
            y_.push_back(node[1]);
        }
        for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
            Triangle& triangle = triangles_.emplace_back();
            for (std::size_t a = 0; a < 3; ++a) {
                triangle.node[a] = mesh.element(e)[a];
                for (std::size_t b = 0; b < 3; ++b) {
                    for (int component = 0; component < 2; ++component) {
                        const auto row = static_cast<std::size_t>(2 * mesh.element(e)[a] + component);
                        const auto first = columns.begin() + row_starts[row],
                                   last = columns.begin() + row_starts[row + 1];
                        const auto found = std::lower_bound(first, last, std::int64_t{2} * mesh.element(e)[b]);
                        triangle.place[a][b][static_cast<std::size_t>(component)] =
                            static_cast<std::uint32_t>(found - columns.begin());
                    }
                }
            }
        }
    }

    /// @param[out] values  overwritten
    void assemble(std::span<double> values) const {
        std::ranges::fill(values, 0.0);
        for (const Triangle& triangle : triangles_) {
            const auto [i, j, k] = triangle.node;
            const auto at = [](const std::vector<double>& v, std::int32_t n) { return v[static_cast<std::size_t>(n)]; };
            // N_a = (a_a + b_a x + c_a y) / (2 A)
            const std::array<double, 3> b{at(y_, j) - at(y_, k), at(y_, k) - at(y_, i), at(y_, i) - at(y_, j)};
            const std::array<double, 3> c{at(x_, k) - at(x_, j), at(x_, i) - at(x_, k), at(x_, j) - at(x_, i)};
            const double factor = thickness_ / (2 * (b[0] * c[1] - b[1] * c[0]));  // thickness / (4 A)
            const double shear = factor * mu_, cross = factor * lambda_, normal = cross + 2 * shear;
            for (std::size_t p = 0; p < 3; ++p) {
                for (std::size_t q = 0; q < 3; ++q) {
                    double* upper = values.data() + triangle.place[p][q][0];
                    double* lower = values.data() + triangle.place[p][q][1];
                    upper[0] += normal * b[p] * b[q] + shear * c[p] * c[q];
                    upper[1] += cross * b[p] * c[q] + shear * c[p] * b[q];
                    lower[0] += cross * c[p] * b[q] + shear * b[p] * c[q];
                    lower[1] += normal * c[p] * c[q] + shear * b[p] * b[q];
                }
            }
        }
    }

private:
    struct Triangle {
        std::array<std::int32_t, 3> node;
        std::uint32_t place[3][3][2];  ///< of the upper and the lower row of a 2 x 2 block
    };

    double lambda_, mu_, thickness_;
    std::vector<double> x_, y_;
    std::vector<Triangle> triangles_;
};

}  // namespace gneiss::benchmark
