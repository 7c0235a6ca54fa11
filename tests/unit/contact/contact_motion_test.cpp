// Bodies that collide and slide under leapfrog: energy, momentum, friction   [VERIFICATION 11, 12].

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "contact/contact_point.hpp"
#include "support/finite_differences.hpp"

namespace gneiss {
namespace {

using V2 = Vec2<double>;

/// Two triangles, each of three masses of 1 kg on three springs, m, kg, N; every one is contactor and target.
struct TwoTriangles {
    std::array<V2, 6> reference{V2{0, 0}, V2{1.6, -2.5}, V2{3, 0}, V2{1.2, 2.6}, V2{2.5, 4.6}, V2{0.1, 4.5}};
    std::array<V2, 6> x{}, v{};
    double spring = 400;
    ContactLaw<double> law{100.0, 60.0, 0.0, 1.0};

    struct Point {
        std::size_t a, b;
        double weight_b;
        ContactHistory<double> accepted, trial;
        bool touched = false;
    };
    std::vector<Point> points;
    double dissipated = 0;
    std::set<int> zones;  ///< of (point, smallest lambda) that contact has seen

    TwoTriangles() {
        x = reference;
        for (const std::size_t first : {0, 3})
            for (std::size_t i = 0; i < 3; ++i)
                for (const double weight : {0.0, 0.5})
                    points.push_back({first + i, first + (i + 1) % 3, weight, {}, {}});
    }

    /// Potential of a lone triangle: three times its inradius.
    ContactTarget<double> target(std::size_t first) const {
        const V2 &p = reference[first], &q = reference[first + 1], &r = reference[first + 2];
        const auto length = [](const V2& d) { return std::sqrt(dot(d, d)); };
        const double inradius = cross(q - p, r - p) / (length(q - p) + length(r - q) + length(p - r));
        return {{p, q, r}, {0, 0, 0}, 3 * inradius, 0.75 * inradius};
    }

    struct Evaluation {
        std::array<V2, 6> force{};
        double stored = 0, dissipated = 0;
    };

    Evaluation evaluate() {
        Evaluation result;
        for (V2& f : result.force) f = {0, 0};
        for (const std::size_t first : {0, 3})
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t a = first + i, b = first + (i + 1) % 3;
                const V2 d = x[b] - x[a], rest = reference[b] - reference[a];
                const double length = std::sqrt(dot(d, d)), stretch = length - std::sqrt(dot(rest, rest));
                const V2 pull = (spring * stretch / length) * d;
                result.force[a] += pull;
                result.force[b] += -pull;
                result.stored += 0.5 * spring * stretch * stretch;
            }
        for (Point& point : points) {
            const std::size_t first = point.a < 3 ? 3 : 0;
            const V2 at = (1 - point.weight_b) * x[point.a] + point.weight_b * x[point.b];
            const std::array<V2, 3> corners{x[first], x[first + 1], x[first + 2]};
            point.trial = {};
            if (!contains(at, corners, {1.0, 1.0, 0.0})) {
                result.dissipated += released_energy(law, point.accepted);
                continue;
            }
            const auto response = contact_response(at, corners, target(first), law, point.accepted);
            EXPECT_FALSE(response.too_deep);
            point.trial = response.next;
            const auto least = std::min_element(response.lambda.begin(), response.lambda.end());
            zones.insert(static_cast<int>(10 * (&point - points.data()) + (least - response.lambda.begin())));
            const auto forces = nodal_forces(response, point.weight_b);
            const std::array<std::size_t, 5> nodes{point.a, point.b, first, first + 1, first + 2};
            for (std::size_t i = 0; i < 5; ++i) result.force[nodes[i]] += forces[i];
            result.stored += response.stored_normal + response.stored_tangential;
            result.dissipated += response.dissipated_normal + response.dissipated_friction;
        }
        return result;
    }

    void accept(const Evaluation& evaluation) {
        dissipated += evaluation.dissipated;
        for (Point& point : points) point.accepted = point.trial;
    }

    double kinetic() const {
        double sum = 0;
        for (const V2& u : v) sum += 0.5 * dot(u, u);
        return sum;
    }
    V2 momentum() const {
        V2 sum{0, 0};
        for (const V2& u : v) sum += u;
        return sum;
    }
    double angular_momentum() const {
        double sum = 0;
        for (std::size_t i = 0; i < 6; ++i) sum += cross(x[i], v[i]);
        return sum;
    }

    /// n steps of leapfrog from rest of the springs.
    /// @returns the largest energy error on the way, J
    double march(int n, double dt) {
        Evaluation now = evaluate();
        accept(now);
        const double before = kinetic() + now.stored + dissipated;
        double worst = 0;
        for (int step = 0; step < n; ++step) {
            for (std::size_t i = 0; i < 6; ++i) {
                v[i] += (0.5 * dt) * now.force[i];
                x[i] += dt * v[i];
            }
            now = evaluate();
            accept(now);
            for (std::size_t i = 0; i < 6; ++i) v[i] += (0.5 * dt) * now.force[i];
            worst = std::max(worst, std::abs(kinetic() + now.stored + dissipated - before));
        }
        return worst;
    }
};

/// The upper triangle comes down on the flat top of the lower one, corner first.
TwoTriangles closing(double gap, double x, const V2& velocity) {
    TwoTriangles pair;
    const V2 shift = V2{x, gap} - pair.x[3];
    for (std::size_t i = 3; i < 6; ++i) {
        pair.x[i] += shift;
        pair.v[i] = velocity;
    }
    return pair;
}

/// Root mean square over 40 gaps of the largest energy error, for steps T/100, T/200, ... of a run of T = 1.5 s.
/// @param n_zones  receives the least and the largest number of zones that contact saw
std::vector<double> energy_errors(double x, const V2& velocity, std::array<std::size_t, 2>& n_zones) {
    std::vector<double> errors;
    n_zones = {100, 0};
    for (int halving = 0; halving <= 4; ++halving) {
        const int n = 100 << halving;
        double sum = 0;
        const int gaps = 40;
        for (int i = 0; i < gaps; ++i) {
            TwoTriangles pair = closing(0.1 + 0.03 * i / gaps, x, velocity);
            const double error = pair.march(n, 1.5 / n);
            sum += error * error;
            n_zones = {std::min(n_zones[0], pair.zones.size()), std::max(n_zones[1], pair.zones.size())};
        }
        errors.push_back(std::sqrt(sum / gaps));
    }
    return errors;
}

TEST(ContactMotion, WithinOneTriangle_EnergyErrorIsOfOrderTwo) {
    std::array<std::size_t, 2> n_zones;
    const std::vector<double> errors = energy_errors(1.0, {0.2, -0.5}, n_zones);
    EXPECT_EQ(n_zones, (std::array<std::size_t, 2>{1, 1}));
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) EXPECT_GT(observed_order(errors[i], errors[i + 1]), 1.8);
    EXPECT_GT(errors.back(), 1e-7);  // errors of the step, not of round-off
}

TEST(ContactMotion, AcrossARidge_EnergyErrorIsOfOrderOne) {
    // grad phi jumps where another lambda becomes the smallest
    std::array<std::size_t, 2> n_zones;
    const std::vector<double> errors = energy_errors(0.35, {-0.7, -0.5}, n_zones);
    EXPECT_GE(n_zones[0], 2);
    RecordProperty("order", std::to_string(observed_order(errors.front(), errors.back()) / 4));
    EXPECT_GT(observed_order(errors.front(), errors.back()) / 4, 0.8);
}

TEST(ContactMotion, FrictionAndRestitution_KeepMomentumToRoundOff) {
    for (const double friction : {0.0, 0.5})
        for (const double e : {1.0, 0.7}) {
            TwoTriangles pair = closing(0.1, 1.0, {0.9, -1.0});
            pair.law.friction = friction;
            pair.law.returned = e * e;
            const V2 before = pair.momentum();
            const double spin = pair.angular_momentum();
            const int n = 4000;
            pair.march(n, 1e-3);
            EXPECT_FALSE(pair.zones.empty());
            EXPECT_GT(pair.kinetic(), 0.1);
            // one rounding of a momentum of about 3 per node and step, adding up like a random walk
            const double limit = 4 * 2.2e-16 * 3 * std::sqrt(6.0 * n);
            EXPECT_NEAR(pair.momentum().x, before.x, limit);
            EXPECT_NEAR(pair.momentum().y, before.y, limit);
            EXPECT_NEAR(pair.angular_momentum(), spin, 10 * limit);  // arms up to 10 m
        }
}

TEST(ContactMotion, FrictionAndRestitution_CloseTheEnergyBalance) {
    std::vector<double> errors;
    double dissipated = 0;
    for (const int n : {1000, 2000, 4000, 8000}) {
        TwoTriangles pair = closing(0.1, 1.0, {0.9, -1.0});
        pair.law.friction = 0.5;
        pair.law.returned = 0.49;
        errors.push_back(pair.march(n, 3.0 / n));
        dissipated = pair.dissipated;
    }
    EXPECT_GT(dissipated, 0.1);
    EXPECT_LT(errors.back(), 1e-4 * dissipated);  // that is what step 3/8000 s leaves at order 2
    EXPECT_GT(observed_order(errors.front(), errors.back()) / 3, 1.8);
}

TEST(ContactMotion, BlockOnARoughBase_StopsWhereItShould) {
    // A point of mass m on a fixed base under gravity: L = v^2/(2 mu g).
    const double m = 2, g = 9.81, mu = 0.5, v_0 = 2, dt = 1e-4;
    const ContactTarget<double> base{{V2{-10, -10}, V2{20, 0}, V2{-10, 0}}, {10, 0, 0}, 0, 5};
    const ContactLaw<double> law{1e5, 1e5, mu, 1.0};
    V2 x{0, -m * g / law.normal_stiffness}, v{v_0, 0};
    ContactHistory<double> history;
    const auto force = [&] {
        const auto response = contact_response(x, base.reference, base, law, history);
        history = response.next;
        return response.force + V2{0, -m * g};
    };
    V2 f = force();
    double farthest = 0;
    for (int step = 0; step < 20000; ++step) {
        v += (0.5 * dt / m) * f;
        x += dt * v;
        f = force();
        v += (0.5 * dt / m) * f;
        farthest = std::max(farthest, x.x);
    }
    const double exact = v_0 * v_0 / (2 * mu * g);
    // The spring is drawn before it slides: mu m g / (2 k_t) of the way costs half the friction.
    EXPECT_NEAR(farthest, exact, 2 * mu * m * g / law.tangential_stiffness);
    EXPECT_NEAR(x.x, farthest, 2 * mu * m * g / law.tangential_stiffness);  // it stays where it stops
}

}  // namespace
}  // namespace gneiss
