#include "mesh/composite.hpp"

#include <gtest/gtest.h>

#include <set>

#include "mesh/geometry.hpp"
#include "mesh/hilbert.hpp"

namespace gneiss {
namespace {

/// The drawing in composite.hpp.
constexpr std::array<Point2, 6> drawing{{{0, 0}, {1, 0}, {2, 0}, {1.5, 1}, {1, 2}, {0.5, 1}}};

double area(const SubTriangle& nodes) { return triangle_area(drawing[nodes[0]], drawing[nodes[1]], drawing[nodes[2]]); }

TEST(Composite, SubTriangles_AreThoseOfThePaper) {
    const std::array<SubTriangle, 4> paper{{{2, 1, 6}, {3, 2, 4}, {5, 4, 6}, {4, 2, 6}}};
    for (std::size_t s = 0; s < 4; ++s)
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(composite_sub_triangles[s][i] + 1, paper[s][i]);
}

TEST(Composite, SubTriangles_FillTheDrawnTriangleInQuarters) {
    for (const SubTriangle& abc : composite_sub_triangles) {
        EXPECT_DOUBLE_EQ(area(abc), -0.5);
        EXPECT_DOUBLE_EQ(area(counter_clockwise(abc)), 0.5);
    }
}

TEST(Composite, Sides_WalkAroundTheDrawnTriangle) {
    for (std::size_t s = 0; s < 3; ++s) {
        const auto [from, mid, to] = composite_sides[s];
        EXPECT_EQ(midpoint(drawing[from], drawing[to]), drawing[mid]);
        EXPECT_EQ(to, composite_sides[(s + 1) % 3][0]);
    }
}

TEST(HilbertIndex, AllCells_VisitsEachOnceFromNeighbourToNeighbour) {
    constexpr int levels = 4, n = 1 << levels;
    std::vector<std::array<int, 2>> visited(n * n, {-1, -1});
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            visited.at(hilbert_index(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), levels)) = {x, y};
    for (std::size_t i = 0; i < visited.size(); ++i) {
        ASSERT_GE(visited[i][0], 0) << "nothing at " << i;
        if (i == 0) continue;
        EXPECT_EQ(std::abs(visited[i][0] - visited[i - 1][0]) + std::abs(visited[i][1] - visited[i - 1][1]), 1);
    }
}

}  // namespace
}  // namespace gneiss
