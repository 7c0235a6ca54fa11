// A point led along given paths through a body: friction, restitution, and what crosses from triangle to triangle.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "contact/contact_point.hpp"

namespace gneiss {
namespace {

using V2 = Vec2<double>;
using Response = ContactResponse<double, double>;

/// Sums of a few hundred steps of numbers of order 1.
constexpr double round_off = 1e-12;

constexpr ContactLaw<double> law{200.0, 150.0, 0.4, 1.0};

/// One row of unit squares below y = 0, each of two triangles, at rest: the potential is -y.
class Strip {
public:
    explicit Strip(int cells) {
        for (int i = 0; i < cells; ++i) {
            const double x = i;
            add({V2{x, -1}, V2{x + 1, -1}, V2{x + 1, 0}});
            add({V2{x, -1}, V2{x + 1, 0}, V2{x, 0}});
        }
    }

    /// Leads the point to the next place and accepts it.
    Response go_to(const V2& point, const ContactLaw<double>& with = law) {
        for (std::size_t t = 0; t < targets_.size(); ++t) {
            // The flags decide about points on edges, which these paths do not stop at.
            if (!contains(point, targets_[t].reference, {1.0, 1.0, 1.0})) continue;
            const Response response = contact_response(point, targets_[t].reference, targets_[t], with, history);
            history = response.next;
            triangles_seen += t != triangle_;
            triangle_ = t;
            return response;
        }
        ADD_FAILURE() << "the point has left the strip at " << point.x << ", " << point.y;
        return {};
    }

    ContactHistory<double> history;
    int triangles_seen = 0;

private:
    void add(const std::array<V2, 3>& x) {
        ContactTarget<double> target{x, {-x[0].y, -x[1].y, -x[2].y}, 0, 10};
        targets_.push_back(target);
    }
    std::vector<ContactTarget<double>> targets_;
    std::size_t triangle_ = static_cast<std::size_t>(-1);
};

TEST(ContactPath, SlidingThroughManyTriangles_DissipatesFrictionTimesWay) {
    // At constant depth: the spring is drawn to its limit first, then everything is friction work mu N times the way.
    Strip strip(8);
    const double depth = 0.3, normal = law.normal_stiffness * depth, limit = law.friction * normal;
    const double slip = limit / law.tangential_stiffness, first = 0.2, last = 7.61, step = 0.0317;
    double dissipated = 0, work = 0, x = first;
    Response response = strip.go_to({x, -depth});
    while (x < last) {
        const double before = response.force.x, next = std::min(x + step, last);
        response = strip.go_to({next, -depth});
        work -= 0.5 * (before + response.force.x) * (next - x);
        dissipated += response.dissipated_friction;
        x = next;
        EXPECT_NEAR(response.force.y, normal, round_off * normal);
        EXPECT_LE(std::abs(response.force.x), limit * (1 + round_off));
    }
    EXPECT_NEAR(dissipated, limit * (last - first - slip), round_off * limit * last);
    EXPECT_NEAR(response.stored_tangential, 0.5 * limit * slip, round_off);
    // The force has one kink within a step, where sliding begins: the trapezoidal rule errs there, and nowhere else.
    EXPECT_NEAR(work, dissipated + response.stored_tangential, law.tangential_stiffness * step * step / 8);
    EXPECT_GT(strip.triangles_seen, 14);
}

TEST(ContactPath, ThereAndBack_FollowsCoulombBothWays) {
    Strip strip(4);
    const double depth = 0.2, limit = law.friction * law.normal_stiffness * depth;
    strip.go_to({0.5, -depth});
    EXPECT_NEAR(strip.go_to({2.5, -depth}).force.x, -limit, round_off * limit);
    const Response back = strip.go_to({1.2, -depth});
    EXPECT_NEAR(back.force.x, limit, round_off * limit);
    const double slip = limit / law.tangential_stiffness;
    EXPECT_NEAR(back.dissipated_friction, limit * (1.3 - 2 * slip), round_off * limit);
    // a small way back: the spring only
    const Response rest = strip.go_to({1.2 + 0.5 * slip, -depth});
    EXPECT_NEAR(rest.dissipated_friction, 0, round_off);
    EXPECT_NEAR(rest.force.x, 0.5 * limit, round_off * limit);
}

TEST(ContactPath, RestDepth_GoesDownWithTheOverlap_AndHoldsNoEnergy) {
    Strip strip(1);
    strip.history.in_touch = 1;
    strip.history.rest = 0.2;
    const double k = law.normal_stiffness;
    const auto force_at = [&](double depth) { return strip.go_to({0.3, -depth}).force.y; };
    EXPECT_NEAR(force_at(0.2), 0, round_off * k);
    EXPECT_NEAR(force_at(0.3), k * 0.1, round_off * k);
    EXPECT_NEAR(strip.history.rest, 0.2, round_off) << "pressing does not move it";
    const Response loose = strip.go_to({0.3, -0.12});
    EXPECT_EQ(loose.force.y, 0);
    EXPECT_EQ(loose.stored_normal, 0);
    EXPECT_NEAR(strip.history.rest, 0.12, round_off);
    EXPECT_NEAR(force_at(0.2), k * 0.08, round_off * k);
    EXPECT_NEAR(strip.go_to({0.3, -0.2}).stored_normal, 0.5 * k * 0.08 * 0.08, round_off * k);
}

TEST(ContactPath, ImpactsOnARestDepth_AllReturnTheirPartOfTheEnergy) {
    ContactLaw<double> lossy = law;
    lossy.returned = 0.25;
    Strip strip(1);
    strip.history.in_touch = 1;
    strip.history.rest = 0.2;
    for (int impact = 0; impact < 2; ++impact) {
        const double energy = 0.5 * law.normal_stiffness * 0.1 * 0.1;
        // coming loose has taken a billionth from the rest depth
        EXPECT_NEAR(strip.go_to({0.3, -0.3}, lossy).dissipated_normal, 0.75 * energy,
                    law.normal_stiffness * 0.1 * 1e-9);
        strip.go_to({0.3, -0.2 + 1e-9}, lossy);
    }
}

TEST(ContactPath, OverlapThatRests_IsNotTooDeep) {
    Strip strip(1);
    strip.history.in_touch = 1;
    strip.history.rest = 0.9;
    const ContactTarget<double> shallow{{V2{0, -1}, V2{1, -1}, V2{1, 0}}, {1, 1, 0}, 0, 0.5};
    const auto at = [&](double y) {
        return contact_response(V2{0.9, y}, shallow.reference, shallow, law, strip.history);
    };
    EXPECT_FALSE(at(-0.8).too_deep);
    EXPECT_TRUE(at(-0.95).too_deep);
}

TEST(ContactPath, StepsOfAStraightPath_DoNotChangeTheDissipation) {
    // Depth and way grow together: stick, slide, and less depth again while sliding, in any number of steps.
    for (const V2& end : {V2{0.9, -0.4}, V2{0.9, -0.02}, V2{0.48, -0.11}}) {
        const V2 begin{0.4, -0.1};
        std::vector<double> totals;
        for (const int n : {1, 2, 7, 400}) {
            Strip strip(2);
            strip.go_to(begin);
            double total = 0;
            for (int i = 1; i <= n; ++i)
                total += strip.go_to(begin + (1.0 * i / n) * (end - begin)).dissipated_friction;
            totals.push_back(total);
        }
        EXPECT_GT(totals[0], 0.1);
        for (const double total : totals) EXPECT_NEAR(total, totals[0], round_off * totals[0]);
    }
}

TEST(ContactPath, ShearedTarget_LeansFrictionByTheAngleOfShear) {
    // what contact_point.hpp says of q: from the tangent of the surface, by the shear gamma
    const double gamma = 0.02;
    const ContactTarget<double> target{{V2{0, -1}, V2{1, 0}, V2{0, 0}}, {1, 0, 0}, 0, 10};
    std::array<V2, 3> x = target.reference;
    for (V2& node : x) node.x += gamma * node.y;
    ContactLaw<double> no_friction = law;
    no_friction.friction = 0;
    const auto first = contact_response(V2{0.2, -0.1}, x, target, law, {});
    const V2 point{0.201, -0.1};
    const V2 normal = contact_response(point, x, target, no_friction, first.next).force;
    const V2 both = contact_response(point, x, target, law, first.next).force;
    const V2 friction = both - normal;
    EXPECT_NEAR(normal.x, 0, round_off);  // the gradient of phi is the normal of the deformed surface
    EXPECT_NEAR(friction.x, -law.tangential_stiffness * 0.001, round_off);
    EXPECT_NEAR(friction.y / friction.x, -gamma, round_off / 0.1);
}

TEST(ContactPath, TurnedTangent_KeepsTheProjectionAndBooksTheRest) {
    const ContactTarget<double> target{{V2{0, -1}, V2{1, 0}, V2{0, 0}}, {1, 0, 0}, 0, 10};
    ContactLaw<double> rough = law;
    rough.friction = 10;
    const double angle = 0.7, slip = 0.01;
    ContactHistory<double> history;
    history.in_touch = 1;
    history.slip = {slip * std::cos(angle), slip * std::sin(angle)};
    history.anchor = V2{0.2, -0.1} - history.slip;
    history.slip_limit = 1;
    const auto response = contact_response(V2{0.2, -0.1}, target.reference, target, rough, history);
    EXPECT_NEAR(response.next.slip.x, slip * std::cos(angle), round_off * slip);
    EXPECT_NEAR(response.next.slip.y, 0, round_off * slip);
    EXPECT_GT(response.dissipated_friction, 0);
    EXPECT_NEAR(response.stored_tangential + response.dissipated_friction, released_energy(rough, history),
                round_off * released_energy(rough, history));
}

TEST(ContactPath, FirstTouch_HasNoSlip) {
    Strip strip(2);
    const Response response = strip.go_to({0.6, -0.1});
    EXPECT_EQ(response.force.x, 0);
    EXPECT_EQ(response.dissipated_friction, 0);
    EXPECT_EQ(response.next.anchor.x, 0.6);
}

TEST(ContactPath, Restitution_KeepsBackItsPartOfTheEnergy) {
    // down to d, up, down again, deeper, and out: a quadratic path in every branch, so few points integrate it
    ContactLaw<double> damped = law;
    const double e = 0.6;
    damped.returned = e * e;
    Strip strip(1);
    const auto lead = [&](double from, double to, double& work, double& dissipated) {
        const int n = 1000;
        Response response = strip.go_to({0.6, -from}, damped);
        for (int i = 1; i <= n; ++i) {
            const double before = response.force.y;
            response = strip.go_to({0.6, -(from + (to - from) * i / n)}, damped);
            work += 0.5 * (before + response.force.y) * (to - from) / n;
            dissipated += response.dissipated_normal;
        }
        return response;
    };
    double work = 0, dissipated = 0;
    const double d = 0.2, k = law.normal_stiffness;
    const Response deepest = lead(0.001, d, work, dissipated);
    EXPECT_NEAR(deepest.force.y, k * d, round_off * k * d);
    EXPECT_NEAR(deepest.stored_normal, e * e * 0.5 * k * d * d, round_off);
    const Response higher = lead(d, 0.15, work, dissipated);
    EXPECT_NEAR(higher.force.y, k / (e * e) * (0.15 - (1 - e * e) * d), round_off * k);
    lead(0.15, 0.19, work, dissipated);  // along the same branch
    EXPECT_NEAR(dissipated, 0.5 * k * (1 - e * e) * (d * d - 1e-6), round_off);
    const Response out = lead(0.19, 0.001, work, dissipated);
    EXPECT_EQ(out.force.y, 0);
    // The trapezoidal rule errs by at most one kink of the stiffness k/e^2 in a step of 2e-4.
    const double kink = k / (e * e) * 2e-4 * 2e-4;
    EXPECT_NEAR(work, 0.5 * k * (1 - e * e) * d * d - 0.5 * k * 1e-6, kink);
}

}  // namespace
}  // namespace gneiss
