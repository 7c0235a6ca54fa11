#include "contact/cell_search.hpp"

#include <gmock/gmock.h>
#include <omp.h>

#include <algorithm>

#include "base/errors.hpp"
#include "contact/radix_sort.hpp"
#include "support/one_thread.hpp"
#include "unit/contact/contact_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::test;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Candidates = std::vector<ContactCandidate>;

/// Distance from a point to a triangle, 0 inside, m.
double distance_to(const Soup& soup, std::size_t t, double px, double py) {
    bool inside = true;
    double nearest = 1e300;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto a = static_cast<std::size_t>(soup.triangles[t][i]);
        const auto b = static_cast<std::size_t>(soup.triangles[t][(i + 1) % 3]);
        const double ex = soup.x[2 * b] - soup.x[2 * a], ey = soup.x[2 * b + 1] - soup.x[2 * a + 1];
        const double dx = px - soup.x[2 * a], dy = py - soup.x[2 * a + 1];
        inside = inside && ex * dy - ey * dx >= 0;
        const double s = std::clamp((ex * dx + ey * dy) / (ex * ex + ey * ey), 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(dx - s * ex, dy - s * ey));
    }
    return inside ? 0 : nearest;
}

/// All pairs whose triangle does not have the point's edge and whose distance is below `reach`, by trying every one.
Candidates within(const Soup& soup, double reach) {
    Candidates pairs;
    for (std::size_t p = 0; p < soup.points.size(); ++p) {
        const auto a = static_cast<std::size_t>(soup.points.a[p]), b = static_cast<std::size_t>(soup.points.b[p]);
        const double w = soup.points.weight_b[p];
        const double px = (1 - w) * soup.x[2 * a] + w * soup.x[2 * b];
        const double py = (1 - w) * soup.x[2 * a + 1] + w * soup.x[2 * b + 1];
        for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
            const auto has = [&](std::int32_t node) {
                return std::ranges::find(soup.triangles[t], node) != soup.triangles[t].end();
            };
            if (!(has(soup.points.a[p]) && has(soup.points.b[p])) && distance_to(soup, t, px, py) <= reach)
                pairs.push_back({static_cast<std::int32_t>(p), static_cast<std::int32_t>(t)});
        }
    }
    return pairs;
}

Candidates searched(const Soup& soup, double skin) {
    CellSearch search;
    const auto found = search.search(soup.surroundings(), skin);
    return {found.begin(), found.end()};
}

/// What the search promises: sorted, each pair once, all pairs within the skin. The half-planes leave a tip before each
/// corner, skin/sin(angle/2) long; no angle of a soup is below 37 degrees.
void expect_complete(const Soup& soup, double skin) {
    const Candidates found = searched(soup, skin);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    const double rounding =
        1e-12 * (1 + skin);  // a distance that differs from the skin by its rounding may go either way
    const Candidates necessary = within(soup, skin - rounding), possible = within(soup, 3.2 * skin + rounding);
    EXPECT_TRUE(std::includes(found.begin(), found.end(), necessary.begin(), necessary.end()));
    EXPECT_TRUE(std::includes(possible.begin(), possible.end(), found.begin(), found.end()));
}

Soup spread(int n, double side, double smallest, double largest, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-side / 2, side / 2);
    std::uniform_real_distribution<double> log_size(std::log(smallest), std::log(largest));
    Soup soup;
    for (int i = 0; i < n; ++i) {
        const double cx = place(random), cy = place(random);
        add_triangle(soup, cx, cy, std::exp(log_size(random)), random);
    }
    return soup;
}

TEST(CellSearch, RandomTriangles_AreThoseOfBruteForce) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Soup soup = spread(200, 10, 0.5, 1.5, seed);
        ASSERT_THAT(within(soup, 0), SizeIs(::testing::Gt(300)));
        for (const double skin : {0.0, 0.05, 0.7}) expect_complete(soup, skin);
    }
}

TEST(CellSearch, SizesOverFourDecades_AreThoseOfBruteForce) {
    for (unsigned seed = 1; seed <= 5; ++seed)
        for (const double skin : {0.0, 1e-3}) expect_complete(spread(300, 1, 1e-4, 1.0, seed), skin);
}

TEST(CellSearch, TipBeforeASharpCorner_EndsAtTheBox) {
    // An angle of 0.02: its half-planes, moved out by the skin, meet ten lengths before the corner.
    Soup soup;
    soup.x = {0, 0, 10, -0.1, 10, 0.1, -0.5, 0, -0.05, 0, 5, 0};
    soup.triangles = {{0, 1, 2}};
    soup.points = {{3, 4, 5}, {3, 4, 5}, {0, 0, 0}, {1, 1, 1}, {}};
    EXPECT_THAT(searched(soup, 0.1), ElementsAre(ContactCandidate{1, 0}, ContactCandidate{2, 0}));
}

TEST(CellSearch, EverythingInOneCell_IsThatOfBruteForce) {
    // Same place, same size: all overlap, every point has dozens of triangles.
    expect_complete(spread(150, 1e-3, 1, 1.01, 3), 0.01);
    // ... and 150 tiny ones in the box of one large triangle
    Soup soup = spread(150, 0.3, 1e-3, 2e-3, 4);
    std::mt19937 random(4);
    add_triangle(soup, 0, 0, 1, random);
    expect_complete(soup, 1e-4);
}

TEST(CellSearch, FastFragment_ChangesNothingForTheOthers) {
    Soup soup = spread(200, 10, 0.8, 1.2, 11);
    const Candidates before = searched(soup, 0.1);
    std::mt19937 random(11);
    add_triangle(soup, -3e9, 8e9, 1, random);
    EXPECT_EQ(searched(soup, 0.1), before);
}

TEST(CellSearch, CellsThatShareANumber_AreToldApart) {
    // 2^40 cells in either direction are more than a number can hold beside level and item.
    std::mt19937 random(2);
    Soup soup;
    for (int i = 0; i < 60; ++i) {
        const double cx = i % 2 == 0 ? 0.0 : std::ldexp(1.0, 40), cy = i % 3 == 0 ? 0.0 : -std::ldexp(1.0, 40);
        add_triangle(soup, cx + 0.3 * (i / 6), cy, 1, random);
    }
    // Positions near 2^40 are known to 2^-13: brute force and search round alike, but distances to 1e-3 only.
    const Candidates found = searched(soup, 0.1), necessary = within(soup, 0.099), possible = within(soup, 0.3);
    EXPECT_TRUE(std::includes(found.begin(), found.end(), necessary.begin(), necessary.end()));
    EXPECT_TRUE(std::includes(possible.begin(), possible.end(), found.begin(), found.end()));
}

TEST(CellSearch, TrianglesOfThePointsEdge_StayOutOfTheList) {
    // two triangles on a common edge, one's own nodes, and the middles of edges
    Soup shared;
    shared.x = {0, 0, 1, 0, 0, 1, 1, 1};
    shared.triangles = {{0, 1, 2}, {1, 3, 2}};
    shared.points = {{0, 1, 2, 1, 0, 1}, {1, 2, 0, 3, 0, 1}, {0.5, 0.5, 0.5, 0.5, 0, 0}, {1, 1, 1, 1, 1, 1}, {}};
    EXPECT_THAT(searched(shared, 0.1), IsEmpty());
    // the middle of an edge that only touches a triangle's corner is its own business: a wedge may close
    EXPECT_THAT(searched(shared, 0.6),
                ElementsAre(ContactCandidate{0, 1}, ContactCandidate{2, 1}, ContactCandidate{3, 0}));
    // parted, at one end only
    Soup wedge;
    wedge.x = {0, 0, 1, 0, 0, 1, 1, 0, 1, 1};
    wedge.triangles = {{0, 1, 2}, {3, 4, 2}};
    wedge.points = {{1, 1}, {2, 1}, {0.5, 0}, {1, 1}, {}};
    EXPECT_THAT(searched(wedge, 0.1), ElementsAre(ContactCandidate{0, 1}, ContactCandidate{1, 1}));
}

TEST(CellSearch, PairsWithinHalfTheSkin_StayComplete) {
    // No node has moved more than half the skin: every pair that touches now was in the list.
    Soup soup = spread(200, 8, 0.5, 1.5, 5);
    const double skin = 0.2;
    CellSearch search;
    search.search(soup.surroundings(), skin);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    for (std::size_t k = 0; k < soup.x.size(); k += 2) {
        const double direction = angle(random);
        soup.x[k] += 0.4999 * skin * std::cos(direction);
        soup.x[k + 1] += 0.4999 * skin * std::sin(direction);
    }
    const auto listed = search.candidates();
    const Candidates touching = within(soup, 0);
    EXPECT_TRUE(std::includes(listed.begin(), listed.end(), touching.begin(), touching.end()));
    EXPECT_NE(searched(soup, skin), Candidates(listed.begin(), listed.end()));  // the motion did matter
}

TEST(CellSearch, AnyNumberOfThreads_GivesTheSameList) {
    const Soup soup = bed(5000, 3);
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const Candidates one = searched(soup, 0.1);
    for (const int n : {2, 3, 7}) {
        omp_set_num_threads(n);
        EXPECT_EQ(searched(soup, 0.1), one) << n << " threads";
    }
    omp_set_num_threads(before);
    ASSERT_GT(one.size(), 3000);
}

TEST(CellSearch, NothingToSearch_IsAnEmptyList) {
    Soup soup;
    EXPECT_THAT(searched(soup, 0.1), IsEmpty());
    soup.x = {0, 0, 1, 0, 0, 1};
    soup.triangles = {{0, 1, 2}};
    EXPECT_THAT(searched(soup, 0.1), IsEmpty());
}

TEST(CellSearch, PositionThatIsNoNumber_IsNamed) {
    Soup soup = bed(4, 1);
    const auto message = [&](double x) {
        soup.x[9] = x;
        try {
            searched(soup, 0.1);
        } catch (const RecoverableError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(message(NAN), HasSubstr("node 4"));
    EXPECT_THAT(message(-INFINITY), HasSubstr("node 4"));
    // one node out there makes a triangle as large as all; three make a small one, far away
    EXPECT_EQ(message(1e300), "");
    soup.x[7] = soup.x[11] = 1e300;
    EXPECT_THAT(message(1e300), HasSubstr("more than 2^40 cells"));
}

TEST(RadixSort, SomeBits_AreSortedAndTheRestKeepsItsOrder) {
    std::mt19937_64 random(1);
    std::vector<std::uint64_t> numbers(5000), scratch;
    for (auto& number : numbers) number = random() & 0xfffff;  // 12 bits to sort by above 8 that keep their order
    std::vector<std::uint64_t> expected = numbers;
    std::stable_sort(expected.begin(), expected.end(), [](auto p, auto q) { return p >> 8 < q >> 8; });
    radix_sort(numbers, scratch, 8, 20);
    EXPECT_THAT(numbers, ElementsAreArray(expected));
}

}  // namespace
}  // namespace gneiss
