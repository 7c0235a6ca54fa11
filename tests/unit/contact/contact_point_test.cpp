#include "contact/contact_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/finite_differences.hpp"
#include "support/packs.hpp"

namespace gneiss {
namespace {

using V2 = Vec2<double>;
using Response = ContactResponse<double, double>;

/// A few hundred operations on numbers of order 1 to 10.
constexpr double round_off = 1e-13;
/// Central difference of order 4 of functions of order 10 that vary over a length of order 1 (finite_differences.hpp).
constexpr double truncation = 1e-8;

/// A pair: positions of the contactor's ends and of the target's nodes, and the rest.
struct Pair {
    std::array<V2, 5> x;  ///< a, b, target 0, 1, 2
    double weight_b = 0.3;
    ContactTarget<double> target;
    ContactLaw<double> law{7.0, 5.0, 0.4, 1.0};
    ContactHistory<double> history;

    template <class T>
    ContactResponse<T, double> response(const std::array<Vec2<T>, 5>& at) const {
        const Vec2<T> point = (1 - weight_b) * at[0] + weight_b * at[1];
        return contact_response(point, std::array<Vec2<T>, 3>{at[2], at[3], at[4]}, target, law, history);
    }
    Response response() const { return response(x); }

    /// Moves the contactor so that its point has these barycentric coordinates.
    void place_at(double lambda_1, double lambda_2) {
        const V2 wanted = (1 - lambda_1 - lambda_2) * x[2] + lambda_1 * x[3] + lambda_2 * x[4];
        const V2 shift = wanted - ((1 - weight_b) * x[0] + weight_b * x[1]);
        x[0] += shift;
        x[1] += shift;
    }
};

enum class Kind { rising, bubble };

Pair deformed_pair(Kind kind, std::mt19937& random) {
    std::uniform_real_distribution<double> wobble(-0.15, 0.15);
    const auto moved = [&](V2 v) { return V2{v.x + wobble(random), v.y + wobble(random)}; };
    Pair pair;
    pair.target.reference = {moved({0, 0}), moved({1, 0}), moved({0.3, 1})};
    for (std::size_t i = 0; i < 3; ++i) pair.x[2 + i] = moved(pair.target.reference[i]);
    pair.x[0] = moved({0.2, -0.3});
    pair.x[1] = moved({0.5, 0.9});
    pair.target.nodal = kind == Kind::rising ? std::array{0.1, 0.0, 0.8} : std::array{0.0, 0.0, 0.0};
    pair.target.bubble = kind == Kind::bubble ? 0.9 : 0.0;
    pair.target.reach = 10;
    pair.place_at(0.5, 0.2);
    return pair;
}

/// The same pair a little later, with what it then remembers; friction holds.
void stick(Pair& pair) {
    pair.law.friction = 5;
    pair.history = pair.response().next;
    pair.place_at(0.42, 0.23);
}

/// ... and slides.
void slide(Pair& pair) {
    stick(pair);
    pair.law.friction = 0.05;
}

/// ... and rebounds, along the unloading branch, while friction holds.
void rebound(Pair& pair) {
    pair.law.returned = 0.64;
    stick(pair);
    pair.history.deepest = 1.1 * pair.response().depth;
}

/// ... and goes on deeper than ever, along p_n, losing what will not come back.
void load(Pair& pair) {
    pair.law.returned = 0.64;
    stick(pair);
    pair.history.deepest = 0.9 * pair.response().depth;
}

constexpr std::array situations{+[](Pair&) {}, &stick, &slide, &rebound, &load};
constexpr std::array kinds{Kind::rising, Kind::bubble};

/// Energy that the pair would give back, J.
double stored(const Response& response) { return response.stored_normal + response.stored_tangential; }

double stored_at(const Pair& pair, std::size_t node, double dx, double dy) {
    std::array<V2, 5> x = pair.x;
    x[node] += V2{dx, dy};
    return stored(pair.response(x));
}

// ---- inside or not --------------------------------------------------------------------------------------------------

std::array<double, 3> rising(const std::array<int, 3>& nodes) {
    std::array<double, 3> result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = nodes[(i + 1) % 3] < nodes[(i + 2) % 3] ? 1 : 0;
    return result;
}

TEST(ContactPoint, PointOnACommonEdge_LiesInExactlyOneTriangle) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-1, 1), along(0.01, 0.99);
    int on_the_line = 0;
    for (int i = 0; i < 20000; ++i) {
        // every third time positions of few bits: the middle is then on the line to the last of them
        const auto position = [&] {
            const double x = place(random);
            return i % 3 == 0 ? std::round(1024 * x) / 1024 : x;
        };
        const V2 a{position(), position()}, b{position(), position()};
        const V2 side = turned(b - a), middle = 0.5 * (a + b);
        const std::array<V2, 3> left{a, b, middle + side}, right{b, a, middle - 0.7 * side};
        const double s = i % 3 == 0 ? 0.5 : along(random);
        const V2 point = (1 - s) * a + s * b;
        const bool a_lower = i % 2 == 0;
        const std::array<int, 3> left_nodes = a_lower ? std::array{1, 2, 3} : std::array{2, 1, 3};
        const std::array<int, 3> right_nodes = a_lower ? std::array{2, 1, 4} : std::array{1, 2, 4};
        const bool in_left = contains(point, left, rising(left_nodes));
        const bool in_right = contains(point, right, rising(right_nodes));
        EXPECT_NE(in_left, in_right) << i;
        on_the_line += cross(b - a, point - a) == 0;
    }
    EXPECT_GT(on_the_line, 1000);
}

TEST(ContactPoint, PointsOfPacks_LieWhereEachAloneLies) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-0.2, 1.2);
    const std::array<V2, 3> x{V2{0, 0}, V2{1, 0.1}, V2{0.2, 1}};
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
        std::vector<V2> points(pack_width);
        for (V2& point : points) point = {place(random), place(random)};
        const auto pack = [&](auto value) { return pack_of(value); };
        const Vec2<Pack> point{pack([&](std::size_t k) { return points[k].x; }),
                               pack([&](std::size_t k) { return points[k].y; })};
        std::array<Vec2<Pack>, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = {Pack(x[k].x), Pack(x[k].y)};
        const auto flags = rising({5, 7, 6});
        const auto in = contains(point, corners, {Pack(flags[0]), Pack(flags[1]), Pack(flags[2])});
        for (std::size_t k = 0; k < pack_width; ++k) {
            const bool alone = contains(points[k], x, flags);
            EXPECT_EQ(lanes(choose(in, Pack(1.0), Pack(0.0)))[k], alone ? 1 : 0);
            inside += alone;
        }
    }
    EXPECT_GT(inside, 100);
}

// ---- normal force ---------------------------------------------------------------------------------------------------

TEST(ContactPoint, UndeformedHalfSpace_IsALinearSpring) {
    Pair pair;
    pair.target = {{V2{0, 0}, V2{2, 0}, V2{1, -1}}, {0, 0, 1}, 0, 10};
    std::swap(pair.target.reference[0], pair.target.reference[1]);  // counter-clockwise
    for (std::size_t i = 0; i < 3; ++i) pair.x[2 + i] = pair.target.reference[i];
    pair.x[0] = pair.x[1] = {0.9, -0.25};
    const Response response = pair.response();
    EXPECT_NEAR(response.depth, 0.25, round_off);
    EXPECT_NEAR(response.force.x, 0, round_off);
    EXPECT_NEAR(response.force.y, 7 * 0.25, round_off);
    EXPECT_NEAR(response.stored_normal, 0.5 * 7 * 0.0625, round_off);
    EXPECT_FALSE(response.too_deep);
}

TEST(ContactPoint, Forces_AreTheGradientOfWhatIsStored) {
    // Pressing, sticking and rebounding store what they take; sliding and loading with restitution dissipate.
    std::mt19937 random(3);
    for (const Kind kind : kinds)
        for (const auto situation : {situations[0], situations[1], situations[3]}) {
            Pair pair = deformed_pair(kind, random);
            situation(pair);
            const auto forces = nodal_forces(pair.response(), pair.weight_b);
            for (std::size_t node = 0; node < 5; ++node) {
                const double dx = derivative_at_zero([&](double h) { return stored_at(pair, node, h, 0); });
                const double dy = derivative_at_zero([&](double h) { return stored_at(pair, node, 0, h); });
                EXPECT_NEAR(forces[node].x, -dx, truncation);
                EXPECT_NEAR(forces[node].y, -dy, truncation);
            }
            EXPECT_GT(dot(forces[0], forces[0]), 1e-2);
        }
}

TEST(ContactPoint, Forces_KeepLinearAndAngularMomentum) {
    std::mt19937 random(4);
    for (const Kind kind : kinds)
        for (const auto situation : situations)
            for (int i = 0; i < 20; ++i) {
                Pair pair = deformed_pair(kind, random);
                situation(pair);
                const auto forces = nodal_forces(pair.response(), pair.weight_b);
                V2 sum{0, 0};
                double moment = 0, scale = 0;
                for (std::size_t node = 0; node < 5; ++node) {
                    sum += forces[node];
                    moment += cross(pair.x[node], forces[node]);
                    scale += std::abs(forces[node].x) + std::abs(forces[node].y);
                }
                // a dozen roundings of numbers of the size of the forces; arms are of order 1
                const double few_roundings = 3e-15 * scale;
                EXPECT_NEAR(sum.x, 0, few_roundings);
                EXPECT_NEAR(sum.y, 0, few_roundings);
                EXPECT_NEAR(moment, 0, few_roundings);
            }
}

TEST(ContactPoint, Tangent_IsTheDerivativeOfTheForces) {
    using D = Dual<10>;
    std::mt19937 random(5);
    for (const Kind kind : kinds)
        for (const auto situation : situations) {
            Pair pair = deformed_pair(kind, random);
            situation(pair);
            std::array<Vec2<D>, 5> x;
            for (int node = 0; node < 5; ++node)
                x[static_cast<std::size_t>(node)] = {
                    D::variable(pair.x[static_cast<std::size_t>(node)].x, 2 * node),
                    D::variable(pair.x[static_cast<std::size_t>(node)].y, 2 * node + 1)};
            const auto exact = nodal_forces(pair.response(x), pair.weight_b);
            const auto plain_forces = nodal_forces(pair.response(), pair.weight_b);
            for (std::size_t k = 0; k < 10; ++k)
                for (std::size_t node = 0; node < 5; ++node) {
                    const auto moved = [&](double h) {
                        std::array<V2, 5> at = pair.x;
                        (k % 2 == 0 ? at[k / 2].x : at[k / 2].y) += h;
                        return nodal_forces(pair.response(at), pair.weight_b)[node];
                    };
                    const double dx = derivative_at_zero([&](double h) { return moved(h).x; });
                    const double dy = derivative_at_zero([&](double h) { return moved(h).y; });
                    EXPECT_NEAR(exact[node].x.derivative[k], dx, truncation);
                    EXPECT_NEAR(exact[node].y.derivative[k], dy, truncation);
                    EXPECT_NEAR(exact[node].x.value, plain_forces[node].x, round_off);
                }
        }
}

TEST(ContactPoint, LanesOfAPack_AreWhatEachAloneIs) {
    std::mt19937 random(6);
    for (int i = 0; i < 20; ++i) {
        std::vector<Pair> pairs;
        for (std::size_t k = 0; k < pack_width; ++k) {
            pairs.push_back(deformed_pair(kinds[(k + i) % 2], random));
            situations[(k + i) % situations.size()](pairs.back());
        }
        const auto pack = [&](auto value) { return pack_of([&](std::size_t k) { return value(pairs[k]); }); };
        std::array<Vec2<Pack>, 3> x;
        ContactTarget<Pack> target;
        for (std::size_t n = 0; n < 3; ++n) {
            x[n] = {pack([n](const Pair& p) { return p.x[2 + n].x; }),
                    pack([n](const Pair& p) { return p.x[2 + n].y; })};
            target.reference[n] = {pack([n](const Pair& p) { return p.target.reference[n].x; }),
                                   pack([n](const Pair& p) { return p.target.reference[n].y; })};
            target.nodal[n] = pack([n](const Pair& p) { return p.target.nodal[n]; });
        }
        target.bubble = pack([](const Pair& p) { return p.target.bubble; });
        target.reach = pack([](const Pair& p) { return p.target.reach; });
        const ContactLaw<Pack> law{pack([](const Pair& p) { return p.law.normal_stiffness; }),
                                   pack([](const Pair& p) { return p.law.tangential_stiffness; }),
                                   pack([](const Pair& p) { return p.law.friction; }),
                                   pack([](const Pair& p) { return p.law.returned; })};
        ContactHistory<Pack> history;
        history.in_touch = pack([](const Pair& p) { return p.history.in_touch; });
        history.anchor = {pack([](const Pair& p) { return p.history.anchor.x; }),
                          pack([](const Pair& p) { return p.history.anchor.y; })};
        history.slip = {pack([](const Pair& p) { return p.history.slip.x; }),
                        pack([](const Pair& p) { return p.history.slip.y; })};
        history.slip_limit = pack([](const Pair& p) { return p.history.slip_limit; });
        history.deepest = pack([](const Pair& p) { return p.history.deepest; });
        const Vec2<Pack> point{pack([](const Pair& p) { return (1 - p.weight_b) * p.x[0].x + p.weight_b * p.x[1].x; }),
                               pack([](const Pair& p) { return (1 - p.weight_b) * p.x[0].y + p.weight_b * p.x[1].y; })};
        const auto together = contact_response(point, x, target, law, history);
        for (std::size_t k = 0; k < pack_width; ++k) {
            const Response alone = pairs[k].response();
            EXPECT_NEAR(lanes(together.force.x)[k], alone.force.x, round_off);
            EXPECT_NEAR(lanes(together.force.y)[k], alone.force.y, round_off);
            EXPECT_NEAR(lanes(together.stored_normal)[k], alone.stored_normal, round_off);
            EXPECT_NEAR(lanes(together.stored_tangential)[k], alone.stored_tangential, round_off);
            EXPECT_NEAR(lanes(together.dissipated_normal)[k], alone.dissipated_normal, round_off);
            EXPECT_NEAR(lanes(together.dissipated_friction)[k], alone.dissipated_friction, round_off);
            EXPECT_NEAR(lanes(together.next.anchor.x)[k], alone.next.anchor.x, round_off);
            EXPECT_NEAR(lanes(together.next.slip.y)[k], alone.next.slip.y, round_off);
            EXPECT_NEAR(lanes(together.next.slip_limit)[k], alone.next.slip_limit, round_off);
            EXPECT_NEAR(lanes(together.next.deepest)[k], alone.next.deepest, round_off);
        }
    }
}

TEST(ContactPoint, RigidMotion_TurnsTheForcesAndNothingElse) {
    std::mt19937 random(7);
    for (const Kind kind : kinds)
        for (const auto situation : situations) {
            Pair pair = deformed_pair(kind, random);
            situation(pair);
            const Response before = pair.response();
            const double c = std::cos(2.3), s = std::sin(2.3);
            const auto turn = [&](const V2& v) { return V2{c * v.x - s * v.y, s * v.x + c * v.y}; };
            for (V2& x : pair.x) x = turn(x) + V2{3, -2};
            const Response after = pair.response();
            EXPECT_NEAR(after.force.x, turn(before.force).x, round_off);
            EXPECT_NEAR(after.force.y, turn(before.force).y, round_off);
            EXPECT_NEAR(stored(after), stored(before), round_off);
            EXPECT_NEAR(after.next.slip.x, before.next.slip.x, round_off);
            EXPECT_NEAR(after.dissipated_friction, before.dissipated_friction, round_off);
        }
}

TEST(ContactPoint, SlidingInADeformedBody_MeetsCoulombsLimit) {
    std::mt19937 random(10);
    for (const Kind kind : kinds) {
        Pair pair = deformed_pair(kind, random);
        slide(pair);
        Pair smooth = pair;
        smooth.law.friction = 0;
        const V2 normal = smooth.response().force, friction = pair.response().force - normal;
        EXPECT_NEAR(std::sqrt(dot(friction, friction)), pair.law.friction * std::sqrt(dot(normal, normal)), round_off);
    }
}

TEST(ContactPoint, DeeperThanThePotentialReaches_IsReported) {
    std::mt19937 random(8);
    Pair pair = deformed_pair(Kind::bubble, random);
    pair.target.reach = 0.75 * 0.3;  // of 3 r = 0.9
    pair.place_at(1. / 3, 0.24);
    EXPECT_FALSE(pair.response().too_deep);
    pair.place_at(1. / 3, 0.26);
    EXPECT_TRUE(pair.response().too_deep);
}

TEST(ContactPoint, PlateauOfThePotential_IsReportedAndHasFiniteNumbers) {
    std::mt19937 random(9);
    Pair pair = deformed_pair(Kind::rising, random);
    pair.history = pair.response().next;
    pair.target.nodal = {0.8, 0.8, 0.8};
    pair.target.reach = 0.6;
    std::array<Vec2<Dual<2>>, 5> x;
    for (std::size_t node = 0; node < 5; ++node) x[node] = {Dual<2>(pair.x[node].x), Dual<2>(pair.x[node].y)};
    x[0] = {Dual<2>::variable(pair.x[0].x, 0), Dual<2>::variable(pair.x[0].y, 1)};
    const auto response = pair.response(x);
    EXPECT_TRUE(response.too_deep);
    EXPECT_EQ(response.force.x.value, 0);
    EXPECT_EQ(response.force.y.derivative[1], 0);
    EXPECT_EQ(response.next.slip.x, 0);
}

}  // namespace
}  // namespace gneiss
