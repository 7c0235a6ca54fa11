// What every cohesion law fulfils: energy, tangent, packs.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "fracture/cohesion_law.hpp"
#include "fracture/envelope.hpp"
#include "fracture/y_code_law.hpp"
#include "support/finite_differences.hpp"
#include "support/packs.hpp"
#include "unit/fracture/loaded_point.hpp"

namespace gneiss {
namespace {

template <class Law>
struct Start {
    static LoadedPoint<Law> point() { return {}; }
};
template <>
struct Start<MixedModeLaw<Insertion::extrinsic>> {
    static LoadedPoint<MixedModeLaw<Insertion::extrinsic>> point() {
        return {.history = insert_point(rock_joint(), 1.8e6, 4.8e6).history};
    }
};

template <class Law>
class CohesionLaw : public testing::Test {};
using Laws = testing::Types<MixedModeLaw<Insertion::extrinsic>, MixedModeLaw<Insertion::intrinsic>, YCodeLaw>;
TYPED_TEST_SUITE(CohesionLaw, Laws);

struct Place {
    double opening, slip;  // in units of the peaks
};
/// Opens, shears both ways, unloads, closes under pressure with friction, opens again.
constexpr Place tour[] = {{0.5, 0.3}, {4, 3},  {1, 8},  {-0.4, 2}, {-4, 9}, {-6, -5},
                          {-2, -12},  {3, -6}, {9, 14}, {0, 0},    {12, -4}};

/// Pressed before anything else: an intrinsic joint parts shear into friction and cohesion.
constexpr Place pressed_tour[] = {{-3, 0}, {-3, 9}, {-5, -4}, {2, -6}, {6, 3}};

/// What is left over when stored and dissipated energy are taken from the work, J/m2, after a tour.
template <class Law>
double left_over(std::span<const Place> places, int steps_per_leg) {
    LoadedPoint<Law> joint = Start<Law>::point();
    const double stored = joint.stored();
    for (const Place& place : places)
        joint.move_to(place.opening * peak_opening, place.slip * peak_slip, steps_per_leg);
    return joint.work() - (joint.stored() - stored) - joint.history.fracture() - joint.history.friction;
}

// The trapezoidal rule of the work is of order 2; kinks that fall within a step make single runs uneven, so the order
// is taken over a factor of 16, with a factor of 2 for kinks. The tours dissipate some hundred J/m2.
TYPED_TEST(CohesionLaw, AlongAnyPath_WorkIsStoredPlusFracturePlusFriction) {
    for (const std::span<const Place> places : {std::span<const Place>(tour), std::span<const Place>(pressed_tour)}) {
        const double coarse = left_over<TypeParam>(places, 50), fine = left_over<TypeParam>(places, 800);
        EXPECT_LT(std::abs(coarse), 0.3);
        EXPECT_LT(std::abs(fine), 0.3 / 128);
    }
}

/// What is left over of the work of opening when what its springs store and fracture in opening are taken from it,
/// J/m2. Opening has no friction: sliding has the rest, by the balance above.
template <class Law>
double left_over_of_opening(std::span<const Place> places, int steps_per_leg) {
    LoadedPoint<Law> joint = Start<Law>::point();
    // without its slip, and so without the springs of sliding
    const auto stored = [&] {
        auto history = joint.history;
        if constexpr (requires { history.slip_offset; }) history.slip_offset = 0;
        history.slider = 0;
        return Law::stored_energy(joint.properties, history, joint.opening, 0.0);
    };
    const double at_start = stored();
    for (const Place& place : places)
        joint.move_to(place.opening * peak_opening, place.slip * peak_slip, steps_per_leg);
    return joint.work_normal - (stored() - at_start) - joint.history.fracture_i;
}

// Truncation as above.
TYPED_TEST(CohesionLaw, AlongAnyPath_WorkOfOpeningIsStoredPlusFractureInOpening) {
    for (const std::span<const Place> places : {std::span<const Place>(tour), std::span<const Place>(pressed_tour)}) {
        const double coarse = left_over_of_opening<TypeParam>(places, 50);
        const double fine = left_over_of_opening<TypeParam>(places, 800);
        EXPECT_LT(std::abs(coarse), 0.3);
        EXPECT_LT(std::abs(fine), 0.3 / 128);
    }
}

TYPED_TEST(CohesionLaw, AlongAnyPath_DissipationNeverFallsAndDamageNeverHeals) {
    LoadedPoint<TypeParam> joint = Start<TypeParam>::point();
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const double round_off = 1e-13 * 300;  // of the largest energy
    for (int i = 0; i < 3000; ++i) {
        const auto before = joint.history;
        joint.move_to(0.97 * joint.opening + normal(random) * 3 * peak_opening,
                      0.97 * joint.slip + normal(random) * 3 * peak_slip);
        ASSERT_GE(joint.history.damage, before.damage);
        ASSERT_LE(joint.history.damage, 1);
        ASSERT_GE(joint.history.fracture_i, before.fracture_i - round_off);
        ASSERT_GE(joint.history.fracture_ii, before.fracture_ii - round_off);
        ASSERT_GE(joint.history.friction, before.friction - round_off);
        ASSERT_GE(joint.stored(), 0);
    }
    EXPECT_GT(joint.history.damage, 0.5);
}

/// Histories of all kinds: intact, softening in several modes, unloaded, sliding under pressure, failed.
template <class Law>
std::vector<LoadedPoint<Law>> points() {
    std::vector<LoadedPoint<Law>> found;
    LoadedPoint<Law> joint = Start<Law>::point();
    found.push_back(joint);
    for (const Place& place : tour) {
        joint.move_to(place.opening * peak_opening, place.slip * peak_slip, 3);
        found.push_back(joint);
    }
    joint.move_to(200 * peak_opening, 0, 3);
    found.push_back(joint);
    return found;
}

/// Trials of all kinds from each of them.
std::vector<Place> trials() {
    std::vector<Place> found;
    for (const double o : {-7.3, -1.1, -0.21, 0.13, 0.83, 2.9, 16.7})
        for (const double s : {-17.3, -4.7, -0.57, 0.37, 1.21, 6.3, 31.0}) found.push_back({o, s});
    return found;
}

// Difference of order 4 in steps of 1e-3 peaks: truncation h^4/30 times a fifth derivative of a few k per peak^4,
// round-off eps t/h with t up to 20 strengths. Trials have odd numbers so that no kink lies within two steps.
TYPED_TEST(CohesionLaw, Tangent_ByDuals_IsTheDerivativeOfDifferences) {
    using D = Dual<2>;
    constexpr double h = 1e-3, tolerance = 3e-10, round_off = 1e-14;
    int softening = 0;
    for (const auto& point : points<TypeParam>()) {
        const auto at = [&](double o, double s) {
            return TypeParam::traction(point.properties, point.history, o * peak_opening, s * peak_slip);
        };
        for (const Place& trial : trials()) {
            const Traction<D> t =
                TypeParam::traction(point.properties, point.history, D::variable(trial.opening * peak_opening, 0),
                                    D::variable(trial.slip * peak_slip, 1));
            const double k = point.properties.penalty;
            const auto compare = [&](double exact, auto difference, double peak, const char* what) {
                EXPECT_NEAR(exact / k, derivative_at_zero(difference, h) / (k * peak), tolerance)
                    << what << " at " << trial.opening << " " << trial.slip << ", D = " << point.history.damage;
            };
            EXPECT_NEAR(t.normal.value, at(trial.opening, trial.slip).normal, round_off * 60e6);
            EXPECT_NEAR(t.shear.value, at(trial.opening, trial.slip).shear, round_off * 60e6);
            const auto opened = [&](double x) { return at(trial.opening + x, trial.slip); };
            const auto slipped = [&](double x) { return at(trial.opening, trial.slip + x); };
            compare(
                t.normal.derivative[0], [&](double x) { return opened(x).normal; }, peak_opening, "dt_n/do");
            compare(
                t.shear.derivative[0], [&](double x) { return opened(x).shear; }, peak_opening, "dt_s/do");
            compare(
                t.normal.derivative[1], [&](double x) { return slipped(x).normal; }, peak_slip, "dt_n/ds");
            compare(
                t.shear.derivative[1], [&](double x) { return slipped(x).shear; }, peak_slip, "dt_s/ds");
            softening += t.normal.derivative[0] < 0 ? 1 : 0;
        }
    }
    EXPECT_GT(softening, 10);  // the trials are not all elastic
}

// No number is lost where a root or a quotient degenerates: trial equal to accepted, zero, along a tangent.
TYPED_TEST(CohesionLaw, Tangent_AtDegenerateTrials_IsFinite) {
    using D = Dual<2>;
    for (const auto& point : points<TypeParam>()) {
        for (const Place& trial :
             {Place{point.opening / peak_opening, point.slip / peak_slip}, Place{0, 0},
              Place{point.opening / peak_opening, point.slip / peak_slip + 3}, Place{1, 0}, Place{0, 1}}) {
            const auto t =
                TypeParam::traction(point.properties, point.history, D::variable(trial.opening * peak_opening, 0),
                                    D::variable(trial.slip * peak_slip, 1));
            for (const int i : {0, 1}) {
                EXPECT_TRUE(std::isfinite(t.normal.derivative[i])) << trial.opening << " " << trial.slip;
                EXPECT_TRUE(std::isfinite(t.shear.derivative[i])) << trial.opening << " " << trial.slip;
            }
        }
    }
}

template <class History>
History lane_of(const auto& packs, std::size_t lane) {
    History history;
    for (std::size_t i = 0; i < history.members.size(); ++i)
        history.*history.members[i] = lanes(packs.*packs.members[i])[lane];
    return history;
}

// Every lane another history and another trial: selection must not mix them. The exponential of packs and of doubles
// agree to a few eps.
TYPED_TEST(CohesionLaw, InPacks_DoesInEachLaneWhatItDoesAlone) {
    const auto joints = points<TypeParam>();
    const auto places = trials();
    constexpr double round_off = 1e-13;
    const auto p = rock_joint();
    const CohesionProperties<Pack> packed{
        Pack(p.tensile_strength),  Pack(p.cohesion),           Pack(p.tan_phi_initial), Pack(p.tan_phi_residual),
        Pack(p.fracture_energy_i), Pack(p.fracture_energy_ii), Pack(p.penalty)};
    for (std::size_t n = 0; n < 2000; ++n) {
        const auto joint = [&](std::size_t lane) { return joints[(n + 5 * lane) % joints.size()]; };
        const auto place = [&](std::size_t lane) { return places[(3 * n + 11 * lane) % places.size()]; };
        typename TypeParam::template History<Pack> history;
        for (std::size_t i = 0; i < history.members.size(); ++i)
            history.*history.members[i] = pack_of([&](std::size_t lane) {
                const auto one = joint(lane).history;
                return one.*one.members[i];
            });
        const Pack o = pack_of([&](std::size_t lane) { return place(lane).opening * peak_opening; });
        const Pack s = pack_of([&](std::size_t lane) { return place(lane).slip * peak_slip; });
        const auto t = TypeParam::traction(packed, history, o, s);
        using D = Dual<2, Pack>;
        const auto tangent = TypeParam::traction(packed, history, D::variable(o, 0), D::variable(s, 1));
        const auto after = TypeParam::advance(packed, history, o, s);
        const Pack stored = TypeParam::stored_energy(packed, after, o, s);
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            const auto one = joint(lane).history;
            const double o_1 = lanes(o)[lane], s_1 = lanes(s)[lane];
            const auto alone = TypeParam::traction(p, one, o_1, s_1);
            EXPECT_NEAR(lanes(t.normal)[lane], alone.normal, round_off * 60e6);
            EXPECT_NEAR(lanes(t.shear)[lane], alone.shear, round_off * 60e6);
            const auto slopes = TypeParam::traction(p, one, Dual<2>::variable(o_1, 0), Dual<2>::variable(s_1, 1));
            for (const int i : {0, 1}) {
                EXPECT_NEAR(lanes(tangent.normal.derivative[i])[lane], slopes.normal.derivative[i], round_off * 1e13);
                EXPECT_NEAR(lanes(tangent.shear.derivative[i])[lane], slopes.shear.derivative[i], round_off * 1e13);
            }
            const auto expected = TypeParam::advance(p, one, o_1, s_1);
            const auto found = lane_of<typename TypeParam::template History<double>>(after, lane);
            // lengths of some peaks; terms of the loss in one mode, f o_p each, may cancel
            using Alone = std::remove_const_t<decltype(expected)>;
            for (const auto member : expected.members) {
                const bool energy = member == &Alone::fracture_i || member == &Alone::fracture_ii;
                const double scale = (energy ? 3.0 : 1e-5) + std::abs(expected.*member);
                EXPECT_NEAR(found.*member, expected.*member, round_off * scale * 10);
            }
            EXPECT_NEAR(lanes(stored)[lane], TypeParam::stored_energy(p, expected, o_1, s_1), round_off * 300);
        }
    }
}

}  // namespace
}  // namespace gneiss
