#include "contact/contactor_points.hpp"

#include <gmock/gmock.h>

#include <numeric>

namespace gneiss {
namespace {

using ::testing::ElementsAre;

constexpr double round_off = 1e-15;  // lengths of order 1, a few operations

TEST(ContactorPoints, ClosedTriangle_HasAPointPerNodeAndEdge) {
    const std::vector<std::array<double, 2>> nodes{{0, 0}, {3, 0}, {0, 4}};
    const std::vector<BoundaryEdge> edges{{0, 1, 0}, {1, 2, 0}, {2, 0, 0}};
    const ContactorPoints points = contactor_points(edges, nodes);
    EXPECT_THAT(points.a, ElementsAre(0, 1, 0, 2, 1, 2));
    EXPECT_THAT(points.b, ElementsAre(0, 1, 1, 2, 2, 0));
    EXPECT_THAT(points.weight_b, ElementsAre(0, 0, 0.5, 0, 0.5, 0.5));
    EXPECT_NEAR(std::accumulate(points.length.begin(), points.length.end(), 0.0), 12, 12 * round_off);
    EXPECT_NEAR(points.length[0], (3. + 4.) / 6, round_off);
    EXPECT_NEAR(points.length[2], 2, round_off);
}

TEST(ContactorPoints, LinearOpening_HasItsExactEnergy) {
    const std::vector<std::array<double, 2>> nodes{{0, 0}, {0.6, 0.8}};
    const std::vector<BoundaryEdge> edges{{0, 1, 0}};
    const ContactorPoints points = contactor_points(edges, nodes);
    const std::array<double, 2> depth{0.3, 1.1};
    double energy = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double phi = (1 - points.weight_b[i]) * depth[points.a[i]] + points.weight_b[i] * depth[points.b[i]];
        energy += points.length[i] * phi * phi;
    }
    const double exact = (depth[0] * depth[0] + depth[0] * depth[1] + depth[1] * depth[1]) / 3;
    EXPECT_NEAR(energy, exact, 4 * round_off);
}

}  // namespace
}  // namespace gneiss
