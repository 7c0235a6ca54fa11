// The elements around a node: when they come apart, and with which tractions.

#include "fracture/node_rupture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fracture/envelope.hpp"
#include "materials/point.hpp"

namespace gneiss {
namespace {

using Vector = Vec2<double>;

constexpr CohesionProperties<double> rock{3e6, 8e6, 0.6, 0.4, 50, 150, 1e12};
constexpr double round_off = 1e-12;
/// Of the utilisation at rupture: `accuracy` in node_rupture.cpp, times the slope of the worst fan here.
constexpr double search = 1e-3;

/// A closed ring of elements about the origin: interfaces run outwards from it at these angles.
struct Ring {
    std::vector<FanCorner> corners;
    std::vector<FanInterface> interfaces;

    /// @param lengths  of the sub-edges at the node, m
    Ring(const std::vector<double>& angles, const std::vector<double>& lengths, const Symmetric2<double>& stress,
         const CohesionProperties<double>& properties) {
        const std::size_t n = angles.size();
        std::vector<Vector> of_edge;  // half of a sub-edge's traction times area, on what lies before it
        for (std::size_t j = 0; j < n; ++j) {
            // the walk is counter-clockwise: the interface's normal out of the element before it
            const Vector along{-std::cos(angles[j]), -std::sin(angles[j])}, normal{along.y, -along.x};
            const Vector traction{stress.xx * normal.x + stress.xy * normal.y,
                                  stress.xy * normal.x + stress.yy * normal.y};
            interfaces.push_back({0.5 * lengths[j], normal, along, 1, traction, &properties});
            of_edge.push_back((0.5 * lengths[j]) * traction);
        }
        // what a uniform stress makes an element pull at its corner with: minus the tractions on its two edges there
        for (std::size_t j = 0; j < n; ++j)
            corners.push_back({of_edge[(j + n - 1) % n] - of_edge[j], 1 + 0.1 * double(j)});
    }
};

double utilisation(const FanInterface& at, const Vector& traction) {
    return std::sqrt(envelope_index(*at.properties, dot(traction, at.normal), dot(traction, at.along)));
}

NodeRupture rupture(const std::vector<FanCorner>& corners, const std::vector<FanInterface>& interfaces,
                    std::array<bool, 2> held = {false, false}) {
    NodeRupture found;
    find_rupture(corners, interfaces, held, found);
    return found;
}

/// Angles, rad, with no gap above 1.4.
std::vector<double> random_angles(std::mt19937& random, std::size_t n) {
    std::uniform_real_distribution<double> off(-0.25, 0.25);
    std::vector<double> angles;
    for (std::size_t j = 0; j < n; ++j) angles.push_back(2 * std::numbers::pi * (double(j) + off(random)) / double(n));
    return angles;
}

TEST(NodeRupture, OpenFan_TractionGivesBothCornersOneAcceleration) {
    const std::vector<FanCorner> corners{{{3e3, -1e3}, 2}, {{-1e3, 5e3}, 3}};
    for (const double sense : {1.0, -1.0}) {
        const std::vector<FanInterface> one{{0.01, {0, -1}, {1, 0}, sense, {0, 0}, &rock}};
        const NodeRupture found = rupture(corners, one);
        const Vector a{2e3 / 5, 4e3 / 5}, on_first{2 * a.x - 3e3, 2 * a.y + 1e3};
        EXPECT_NEAR(found.traction[0].x, sense * on_first.x / 0.01, round_off * 3e5);
        EXPECT_NEAR(found.traction[0].y, sense * on_first.y / 0.01, round_off * 3e5);
        EXPECT_EQ(found.utilisation, utilisation(one[0], found.traction[0]));
        EXPECT_TRUE(found.opening.empty());
    }
}

TEST(NodeRupture, OpenFan_OpensWhatIsBeyondTheEnvelope) {
    std::vector<FanCorner> corners{{{0, -3.01e4}, 1}, {{0, 3.01e4}, 1}};
    const std::vector<FanInterface> one{{0.01, {0, -1}, {1, 0}, 1, {0, 0}, &rock}};
    // the first corner pulls away along -y: traction +y on it, that is along -normal: compression
    EXPECT_TRUE(rupture(corners, one).opening.empty());
    std::swap(corners[0], corners[1]);
    const NodeRupture found = rupture(corners, one);
    EXPECT_EQ(found.opening, std::vector<std::size_t>{0});
    EXPECT_NEAR(found.utilisation, 3.01 / 3, round_off);
}

TEST(NodeRupture, UniformStress_TractionsAreThoseOfTheStress) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> length(0.5, 1.5);
    for (std::size_t n = 3; n < 9; ++n) {
        const std::vector<double> angles = random_angles(random, n);
        std::vector<double> lengths;
        for (std::size_t j = 0; j < n; ++j) lengths.push_back(length(random));
        const Ring ring(angles, lengths, {1e6, -2e6, 0.5e6}, rock);
        const NodeRupture found = rupture(ring.corners, ring.interfaces);
        for (std::size_t j = 0; j < n; ++j) {
            EXPECT_NEAR(found.traction[j].x, ring.interfaces[j].stress_traction.x, round_off * 1e7);
            EXPECT_NEAR(found.traction[j].y, ring.interfaces[j].stress_traction.y, round_off * 1e7);
        }
    }
}

/// A straight seam through a node, its two interfaces pulled unequally: one alone beyond the strength cannot open,
/// since the other holds the node; both open once their mean reaches it, each with what it can carry.
TEST(NodeRupture, StraightSeam_PartsAtTheMeanOfItsTwoEnds) {
    const auto seam = [](double first, double second) {
        const std::vector<FanInterface> both{{0.01, {0, -1}, {1, 0}, 1, {0, -first}, &rock},
                                             {0.01, {0, -1}, {1, 0}, -1, {0, -second}, &rock}};
        const double pull = 0.01 * (first + second);
        return rupture({{{0, pull}, 1}, {{0, -pull}, 1}}, both);
    };
    EXPECT_TRUE(seam(4.2e6, 1.7e6).opening.empty());
    EXPECT_LT(seam(4.2e6, 1.7e6).utilisation, 1);
    const NodeRupture found = seam(4.2e6, 1.83e6);
    EXPECT_EQ(found.opening, (std::vector<std::size_t>{0, 1}));
    EXPECT_NEAR(found.utilisation, (4.2 + 1.83) / 6, search);
    for (const Vector& traction : found.traction) EXPECT_NEAR(traction.y, -3.015e6, search * 3e6);
}

TEST(NodeRupture, BoundOfClosedFan_BelowOneHolds) {
    std::mt19937 random(23);
    std::normal_distribution<double> normal;
    const double least = std::min(rock.tensile_strength, rock.cohesion);
    int held = 0, ruptured = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const std::size_t n = 2 + static_cast<std::size_t>(trial) % 7;
        Ring ring(random_angles(random, n), std::vector<double>(n, 0.02),
                  {1.5e6 * normal(random), 1.5e6 * normal(random), 1e6 * normal(random)}, rock);
        for (FanCorner& corner : ring.corners) corner.force += 3e3 * Vector{normal(random), normal(random)};
        std::vector<double> per_force_squared;
        for (const FanInterface& at : ring.interfaces)
            per_force_squared.push_back(1 / (at.weight * least * at.weight * least));
        const NodeRupture found = rupture(ring.corners, ring.interfaces);
        if (bound_of_closed_fan(ring.corners, per_force_squared) < 1) {
            ++held;
            EXPECT_TRUE(found.opening.empty()) << trial;
        }
        if (!found.opening.empty()) ++ruptured;
    }
    EXPECT_GT(held, 1000);
    EXPECT_GT(ruptured, 100);
}

TEST(NodeRupture, BoundOfClosedFan_SimpleTension_IsTheUtilisation) {
    // interfaces along and across the pull: the bound counts the whole tension against the least strength
    const double pull = 1.2e6;
    const std::vector<double> right_angles{0, std::numbers::pi / 2, std::numbers::pi, 1.5 * std::numbers::pi};
    const Ring ring(right_angles, std::vector<double>(4, 0.02), {pull, 0, 0}, rock);
    std::vector<double> per_force_squared;
    for (const FanInterface& at : ring.interfaces)
        per_force_squared.push_back(1 / std::pow(at.weight * rock.tensile_strength, 2));
    EXPECT_NEAR(bound_of_closed_fan(ring.corners, per_force_squared), pull / rock.tensile_strength, round_off);
}

TEST(NodeRupture, ClosedFan_NoOtherDistributionIsAnyBetter) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    int ruptured = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const std::size_t n = 3 + static_cast<std::size_t>(trial) % 6;
        Ring ring(random_angles(random, n), std::vector<double>(n, 0.02),
                  {4e6 * normal(random), 4e6 * normal(random), 2e6 * normal(random)}, rock);
        for (FanCorner& corner : ring.corners) corner.force += 1e4 * Vector{normal(random), normal(random)};
        const NodeRupture found = rupture(ring.corners, ring.interfaces);
        if (found.opening.empty()) {
            EXPECT_LT(found.utilisation, 1);
            double largest = 0;
            for (std::size_t j = 0; j < n; ++j)
                largest = std::max(largest, utilisation(ring.interfaces[j], found.traction[j]));
            EXPECT_LT(largest, 1);  // these tractions are the proof that it holds
            continue;
        }
        ++ruptured;
        EXPECT_GE(found.utilisation, 1);
        // other values of c in rings around what was found, from far to near
        for (int k = 0; k < 4000; ++k) {
            const double angle = 2 * std::numbers::pi * k / 40, far = 1e5 * std::pow(0.93, k / 40);
            const Vector c{far * std::cos(angle), far * std::sin(angle)};
            double largest = 0;
            for (std::size_t j = 0; j < n; ++j) {
                const FanInterface& at = ring.interfaces[j];
                largest = std::max(largest, utilisation(at, found.traction[j] + (at.sense / at.weight) * c));
            }
            EXPECT_GE(largest, found.utilisation * (1 - search)) << trial << " at " << far;
        }
    }
    EXPECT_GT(ruptured, 20);
}

TEST(NodeRupture, ClosedFan_TractionsKeepTheAcceleration) {
    std::mt19937 random(13);
    std::normal_distribution<double> normal;
    Ring ring(random_angles(random, 6), std::vector<double>(6, 0.02), {9e6, 2e6, 1e6}, rock);
    for (FanCorner& corner : ring.corners) corner.force += 1e3 * Vector{normal(random), normal(random)};
    Vector force{0, 0};
    double mass = 0;
    for (const FanCorner& corner : ring.corners) {
        force += corner.force;
        mass += corner.mass;
    }
    const NodeRupture found = rupture(ring.corners, ring.interfaces);
    ASSERT_FALSE(found.opening.empty());
    for (std::size_t j = 0; j < 6; ++j) {
        const std::size_t before = (j + 5) % 6;
        const Vector sum = ring.corners[j].force + ring.interfaces[j].weight * found.traction[j] -
                           ring.interfaces[before].weight * found.traction[before];
        EXPECT_NEAR(sum.x / ring.corners[j].mass, force.x / mass, 1e-9 * 1e5);
        EXPECT_NEAR(sum.y / ring.corners[j].mass, force.y / mass, 1e-9 * 1e5);
    }
}

/// Pulled alike from all sides, a star of three interfaces can part in three at once only: no two of them are opposite.
TEST(NodeRupture, StarOfThree_PartsInThree) {
    const double third = 2 * std::numbers::pi / 3;
    const Ring ring({0, third, 2 * third}, {0.02, 0.02, 0.02}, {3.1e6, 3.1e6, 0}, rock);
    const NodeRupture found = rupture(ring.corners, ring.interfaces);
    EXPECT_EQ(found.opening, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_NEAR(found.utilisation, 3.1 / 3, search);
}

TEST(NodeRupture, HeldComponent_TakesTheTractionsOfTheStresses) {
    const std::vector<FanInterface> one{{0.01, {0, -1}, {1, 0}, 1, {1e6, -2.9e6}, &rock}};
    const std::vector<FanCorner> corners{{{0, 9e4}, 1}, {{0, -7e4}, 1}};
    const NodeRupture found = rupture(corners, one, {false, true});
    EXPECT_NEAR(found.traction[0].y, -2.9e6, round_off * 1e7);
    EXPECT_NEAR(found.traction[0].x, 0, round_off * 1e7);
    EXPECT_TRUE(found.opening.empty());
}

}  // namespace
}  // namespace gneiss
