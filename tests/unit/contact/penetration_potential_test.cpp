#include "contact/penetration_potential.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "mesh/boundary.hpp"
#include "mesh/make_mesh.hpp"
#include "mesh/sub_triangles.hpp"

namespace gneiss {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Triangle = std::array<std::int32_t, 3>;
using Edge = std::array<std::int32_t, 2>;

constexpr double cap = 2;

/// Distances come from a projection: exact to a few roundings of coordinates of order 10.
constexpr double round_off = 1e-14;

struct Body {
    std::vector<Point2> nodes;
    std::vector<Triangle> triangles;
    std::vector<Edge> boundary;
};

Body body_of(const Mesh& mesh) {
    Body body{mesh.nodes, {}, {}};
    const int per_element = static_cast<int>(sub_triangles(mesh.kind).size());
    for (std::size_t e = 0; e < mesh.n_elements(); ++e)
        for (int sub = 0; sub < per_element; ++sub) {
            const auto nodes = triangle_nodes(mesh, e, sub);
            body.triangles.push_back({nodes[0], nodes[1], nodes[2]});
        }
    for (const BoundaryEdge& edge : contour(mesh)) body.boundary.push_back({edge.a, edge.b});
    return body;
}

/// Sizes from 0.1 at the hole to 0.6 outside.
Body plate_with_hole(bool split) {
    MeshOptions options;
    options.source = MeshOptions::Source::plate_with_hole;
    options.side = 6;
    options.radius = 1;
    options.size = {0.1, 0.6};
    return body_of(make_mesh(options, split, "."));
}

double distance_to(const Body& body, std::int32_t node, const Edge& edge) {
    const Point2 &p = body.nodes[node], &a = body.nodes[edge[0]], &b = body.nodes[edge[1]];
    const double ex = b[0] - a[0], ey = b[1] - a[1];
    const double s = std::clamp(((p[0] - a[0]) * ex + (p[1] - a[1]) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
    return std::hypot(p[0] - a[0] - s * ex, p[1] - a[1] - s * ey);
}

double brute_force_distance(const Body& body, std::int32_t node, const std::vector<Edge>& boundary) {
    double nearest = 1e300;
    for (const Edge& edge : boundary) nearest = std::min(nearest, distance_to(body, node, edge));
    return nearest;
}

double value(const TrianglePotential& potential, const std::array<double, 3>& lambda) {
    double sum = potential.bubble * std::min({lambda[0], lambda[1], lambda[2]});
    for (std::size_t i = 0; i < 3; ++i) sum += lambda[i] * potential.nodal[i];
    return sum;
}

TEST(PenetrationPotential, NodesOfAPlate_StandAtTheirDistanceOrTheirCap) {
    for (const bool split : {false, true}) {
        const Body body = plate_with_hole(split);
        PenetrationPotential potential(body.nodes, body.triangles, cap);
        std::vector<double> caps;
        for (std::size_t n = 0; n < body.nodes.size(); ++n) caps.push_back(potential.at_node(static_cast<int>(n)));
        potential.add_boundary(body.boundary);
        int capped = 0, at_distance = 0;
        for (std::size_t n = 0; n < body.nodes.size(); ++n) {
            const auto node = static_cast<std::int32_t>(n);
            const double exact = brute_force_distance(body, node, body.boundary);
            EXPECT_NEAR(potential.at_node(node), std::min(exact, caps[n]), round_off) << "node " << n;
            (exact < caps[n] ? at_distance : capped) += 1;
        }
        EXPECT_GT(capped, 20);
        EXPECT_GT(at_distance, 20);
        for (const Edge& edge : body.boundary) EXPECT_EQ(potential.at_node(edge[0]), 0);
    }
}

TEST(PenetrationPotential, CapOfEquilateralTriangles_IsAMultipleOfTheirSide) {
    const double side = 0.3, height = side * std::sqrt(3.0) / 2;
    const std::vector<Point2> nodes{{0, 0}, {side, 0}, {side / 2, height}, {1.5 * side, height}};
    const PenetrationPotential potential(nodes, {{0, 1, 2}, {1, 3, 2}}, cap);
    for (int node = 0; node < 4; ++node) EXPECT_NEAR(potential.at_node(node), cap * side, round_off);
}

TEST(PenetrationPotential, CapBesideSmallTriangles_GrowsHalfAsFastAsOneMoves) {
    const Body body = plate_with_hole(false);
    const PenetrationPotential potential(body.nodes, body.triangles, 20);
    double steepest = 0;
    for (const Triangle& triangle : body.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int32_t a = triangle[i], b = triangle[(i + 1) % 3];
            const double rise = std::abs(potential.at_node(a) - potential.at_node(b));
            steepest = std::max(steepest, rise / distance(body.nodes[a], body.nodes[b]));
        }
    EXPECT_NEAR(steepest, 0.5, round_off / 0.05);
}

TEST(PenetrationPotential, CracksOneByOne_GiveWhatAllAtOnceGive) {
    const Body body = plate_with_hole(true);
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> any(0, body.triangles.size() - 1);
    PenetrationPotential grown(body.nodes, body.triangles, cap), at_once(body.nodes, body.triangles, cap);
    grown.add_boundary(body.boundary);
    std::vector<Edge> boundary = body.boundary;
    for (int i = 0; i < 40; ++i) {
        const Triangle& triangle = body.triangles[any(random)];
        const Edge crack{triangle[0], triangle[1]};
        grown.add_boundary({&crack, 1});
        boundary.push_back(crack);
    }
    at_once.add_boundary(boundary);
    for (std::size_t n = 0; n < body.nodes.size(); ++n)
        EXPECT_EQ(grown.at_node(static_cast<int>(n)), at_once.at_node(static_cast<int>(n)));
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        EXPECT_EQ(grown.of_triangle(t).nodal, at_once.of_triangle(t).nodal);
        EXPECT_EQ(grown.of_triangle(t).bubble, at_once.of_triangle(t).bubble);
        EXPECT_EQ(grown.of_triangle(t).reach, at_once.of_triangle(t).reach);
    }
}

TEST(PenetrationPotential, OneCrack_NamesTheTrianglesItChanges) {
    const Body body = plate_with_hole(true);
    PenetrationPotential potential(body.nodes, body.triangles, cap);
    potential.add_boundary(body.boundary);
    std::vector<TrianglePotential> before;
    for (std::size_t t = 0; t < body.triangles.size(); ++t) before.push_back(potential.of_triangle(t));
    const Edge crack{body.triangles[100][0], body.triangles[100][1]};
    potential.add_boundary({&crack, 1});
    std::vector<std::int32_t> changed;
    for (std::size_t t = 0; t < body.triangles.size(); ++t)
        if (before[t].nodal != potential.of_triangle(t).nodal || before[t].bubble != potential.of_triangle(t).bubble)
            changed.push_back(static_cast<std::int32_t>(t));
    EXPECT_THAT(potential.changed(), ::testing::ElementsAreArray(changed));
    EXPECT_THAT(changed, ::testing::Contains(100));
    potential.add_boundary({&crack, 1});
    EXPECT_THAT(potential.changed(), IsEmpty());
}

TEST(PenetrationPotential, EdgesBetweenTriangles_AreNoJump) {
    // with cracks, so that triangles of both kinds meet
    const Body body = plate_with_hole(true);
    PenetrationPotential potential(body.nodes, body.triangles, cap);
    potential.add_boundary(body.boundary);
    for (std::size_t t = 0; t < body.triangles.size(); t += 5) {
        const Edge cracks[]{{body.triangles[t][0], body.triangles[t][1]}, {body.triangles[t][1], body.triangles[t][2]}};
        potential.add_boundary(cracks);
    }
    struct Side {
        std::size_t triangle, opposite;
    };
    std::map<Edge, std::vector<Side>> sides;
    for (std::size_t t = 0; t < body.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(body.triangles[t][(i + 1) % 3], body.triangles[t][(i + 2) % 3]);
            sides[{low, high}].push_back({t, i});
        }
    int mixed = 0;
    for (const auto& [edge, two] : sides) {
        if (two.size() != 2) continue;
        for (const double s : {0.1, 0.5, 0.8}) {
            std::array<double, 2> phi{};
            for (std::size_t k = 0; k < 2; ++k) {
                const Triangle& nodes = body.triangles[two[k].triangle];
                std::array<double, 3> lambda{};
                for (std::size_t i = 0; i < 3; ++i)
                    lambda[i] = nodes[i] == edge[0] ? 1 - s : nodes[i] == edge[1] ? s : 0;
                phi[k] = value(potential.of_triangle(two[k].triangle), lambda);
            }
            EXPECT_NEAR(phi[0], phi[1], round_off);  // the same products, added in another order
        }
        mixed +=
            (potential.of_triangle(two[0].triangle).bubble > 0) != (potential.of_triangle(two[1].triangle).bubble > 0);
    }
    EXPECT_GT(mixed, 20);
}

TEST(PenetrationPotential, LoneTriangle_HasItsInradiusAtTheCentre) {
    PenetrationPotential potential({{0, 0}, {3, 0}, {0, 4}}, {{0, 1, 2}}, cap);
    const Edge contour[]{{0, 1}, {1, 2}, {2, 0}};
    potential.add_boundary(contour);
    const TrianglePotential& alone = potential.of_triangle(0);
    EXPECT_THAT(alone.nodal, ElementsAre(0, 0, 0));
    EXPECT_NEAR(value(alone, {1. / 3, 1. / 3, 1. / 3}), 1, round_off);  // r of the 3-4-5 triangle
    EXPECT_NEAR(alone.reach, trusted_depth, round_off);
}

/// Reach of the triangles between y_low and y_low + 1 of a strip 12 x 4 of unit squares, halved; away from the ends.
double reach_in_strip(double cap_here, double y_low) {
    Body body;
    const auto node = [](int i, int j) { return static_cast<std::int32_t>(13 * j + i); };
    for (int j = 0; j <= 4; ++j)
        for (int i = 0; i <= 12; ++i) body.nodes.push_back({1.0 * i, 1.0 * j});
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 12; ++i) {
            body.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
            body.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
        }
    for (int i = 0; i < 12; ++i)
        for (const int j : {0, 4}) body.boundary.push_back({node(i, j), node(i + 1, j)});
    for (int j = 0; j < 4; ++j)
        for (const int i : {0, 12}) body.boundary.push_back({node(i, j), node(i, j + 1)});
    PenetrationPotential potential(body.nodes, body.triangles, cap_here);
    potential.add_boundary(body.boundary);
    std::vector<double> reaches;
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        Point2 centre{0, 0};
        for (const std::int32_t n : body.triangles[t])
            for (std::size_t k = 0; k < 2; ++k) centre[k] += body.nodes[n][k] / 3;
        if (centre[1] > y_low && centre[1] < y_low + 1 && centre[0] > 4 && centre[0] < 8)
            reaches.push_back(potential.of_triangle(t).reach);
    }
    EXPECT_EQ(*std::min_element(reaches.begin(), reaches.end()), *std::max_element(reaches.begin(), reaches.end()));
    return reaches.front();
}

TEST(PenetrationPotential, Reach_EndsBelowCrestsAndCapsOnly) {
    // Nobody is capped: the potential rises to 2 in the middle of the strip, and answers from below for all of it.
    EXPECT_EQ(reach_in_strip(20, 0), std::numeric_limits<double>::infinity());
    EXPECT_EQ(reach_in_strip(20, 1), trusted_depth * 2);
    EXPECT_EQ(reach_in_strip(20, 2), trusted_depth * 2);
    // Capped between the first and the second row, and below the first. All triangles are of the same size.
    const double size = std::sqrt(4 * 0.5 / std::sqrt(3.0));
    EXPECT_EQ(reach_in_strip(1, 0), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(reach_in_strip(1, 1), trusted_depth * size, round_off);
    EXPECT_NEAR(reach_in_strip(0.5, 0), trusted_depth * 0.5 * size, round_off);
}

TEST(PenetrationPotential, CappedNodes_AreCrestsWhereTheCapItselfRises) {
    // between the small triangles at the hole and the large ones outside
    const Body body = plate_with_hole(false);
    PenetrationPotential potential(body.nodes, body.triangles, 1);
    std::vector<double> caps;
    for (std::size_t n = 0; n < body.nodes.size(); ++n) caps.push_back(potential.at_node(static_cast<int>(n)));
    potential.add_boundary(body.boundary);
    int all_capped = 0;
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        double highest = 0;
        bool capped = true;
        for (const std::int32_t n : body.triangles[t]) {
            capped = capped && potential.at_node(n) == caps[n];
            highest = std::max(highest, caps[n]);
        }
        if (!capped) continue;
        EXPECT_EQ(potential.of_triangle(t).reach, trusted_depth * highest);
        ++all_capped;
    }
    EXPECT_GT(all_capped, 100);
}

}  // namespace
}  // namespace gneiss
