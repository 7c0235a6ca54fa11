#pragma once
// Soups of triangles, each a body of its own, and other surroundings for tests of contact.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "contact/cell_search.hpp"

namespace gneiss::test {

/// Triangles and contactor points, with the storage that a search refers to.
struct Soup {
    std::vector<double> x;  ///< m, shape (2 n_nodes)
    std::vector<std::array<std::int32_t, 3>> triangles;
    ContactorPoints points;

    ContactSurroundings surroundings() const { return {x, triangles, &points}; }
};

/// A triangle of about the given size around a centre; its nodes are its own.
template <class Random>
void add_triangle(Soup& soup, double cx, double cy, double size, Random& random) {
    std::uniform_real_distribution<double> wobble(-0.4, 0.4);
    const double turn = wobble(random);
    const auto first = static_cast<std::int32_t>(soup.x.size() / 2);
    for (int i = 0; i < 3; ++i) {
        const double angle = turn + wobble(random) + 2 * std::numbers::pi * i / 3;
        soup.x.push_back(cx + 0.5 * size * std::cos(angle));
        soup.x.push_back(cy + 0.5 * size * std::sin(angle));
    }
    soup.triangles.push_back({first, first + 1, first + 2});
    for (std::int32_t i = 0; i < 3; ++i) {
        const std::int32_t a = first + i, b = first + (i + 1) % 3;
        for (const double weight : {0.0, 0.5}) {
            soup.points.a.push_back(a);
            soup.points.b.push_back(weight == 0 ? a : b);
            soup.points.weight_b.push_back(weight);
            soup.points.length.push_back(size);
        }
    }
}

/// n triangles of size 1 at a mean distance of 1 in a square, row after row, as a renumbered mesh would be.
inline Soup bed(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> wobble(-0.2, 0.2);
    Soup soup;
    const int columns = static_cast<int>(std::ceil(std::sqrt(n)));
    for (int i = 0; i < n; ++i)
        add_triangle(soup, i % columns + wobble(random), i / columns + wobble(random), 1.0, random);
    return soup;
}

}  // namespace gneiss::test
