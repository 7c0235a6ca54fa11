#include "model/material_axes.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "unit/model/tiny_mesh.hpp"

namespace gneiss {
namespace {

using std::numbers::pi;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Line = std::vector<std::array<double, 2>>;

/// Some tens of operations on angles of order 1.
constexpr double round_off = 100 * std::numeric_limits<double>::epsilon();

/// Difference of two axes, which have no sense: in (-pi/2, pi/2].
double between(double a, double b) { return std::remainder(a - b, pi); }

void expect_axis(double found, double expected, double tolerance = round_off) {
    EXPECT_NEAR(between(found, expected), 0, tolerance) << found << " for " << expected;
}

// ---- bedding
// ------------------------------------------------------------------------------------------------------------

TEST(Bedding, StraightLine_Anywhere_HasItsDirection) {
    const Bedding bedding({{{0, 0}, {2, 1}}});
    for (const std::array<double, 2>& point : {std::array{1.0, 0.5}, {0.3, 4.0}, {-9.0, 2.0}, {40.0, -3.0}})
        expect_axis(bedding.angle(point), std::atan2(1, 2));
}

TEST(Bedding, DrawnFromEitherEnd_Angles_AreTheSame) {
    const Line lower{{0, 0}, {2, 0.5}, {4, 2}}, upper{{0, 3}, {2, 3.2}, {4, 4.5}};
    Line lower_back = lower, upper_back = upper;
    std::reverse(lower_back.begin(), lower_back.end());
    std::reverse(upper_back.begin(), upper_back.end());
    for (double x = -1; x < 5; x += 0.37)
        for (double y = -1; y < 6; y += 0.41) {
            const double angle = Bedding({lower, upper}).angle({x, y});
            expect_axis(Bedding({lower_back, upper}).angle({x, y}), angle);
            expect_axis(Bedding({lower, upper_back}).angle({x, y}), angle);
            expect_axis(Bedding({upper_back, lower_back}).angle({x, y}), angle);
        }
}

/// Two lines at angles 0 and 0.4 that meet far away, so that feet lie above each other at x = 0.
class TwoLines : public testing::Test {
protected:
    const double tilt_ = 0.4;
    const Line level_{{-50, 0}, {50, 0}},
        tilted_{{-5 * std::cos(tilt_), 2 - 5 * std::sin(tilt_)}, {5 * std::cos(tilt_), 2 + 5 * std::sin(tilt_)}};
    const Bedding bedding_{{level_, tilted_}};
};

TEST_F(TwoLines, OnALine_Angle_IsItsOwn) {
    expect_axis(bedding_.angle({0, 0}), 0);
    expect_axis(bedding_.angle({0, 2}), tilt_);
}

TEST_F(TwoLines, AtEqualDistance_Angle_IsHalfway) {
    // y above the level line, (2 - y) cos(tilt) below the tilted one
    const double y = 2 * std::cos(tilt_) / (1 + std::cos(tilt_));
    expect_axis(bedding_.angle({0, y}), tilt_ / 2);
}

TEST_F(TwoLines, Between_Weights_AreTheDistancesFromTheOther) {
    const double y = 0.5, d1 = y, d2 = (2 - y) * std::cos(tilt_);
    // doubled angles are averaged as unit vectors
    const double w = d1 / (d1 + d2);
    expect_axis(bedding_.angle({0, y}), 0.5 * std::atan2(w * std::sin(2 * tilt_), 1 - w + w * std::cos(2 * tilt_)));
}

TEST_F(TwoLines, BeyondTheOutermost_Angle_IsThatOfTheNearest) {
    expect_axis(bedding_.angle({0, -3}), 0);
    expect_axis(bedding_.angle({0, 7}), tilt_);
}

TEST_F(TwoLines, AcrossALine_Angle_IsContinuous) {
    const double step = 1e-9;
    for (const double x : {-1.0, 0.0, 2.0}) {
        const double on_tilted = 2 + x * std::tan(tilt_);
        expect_axis(bedding_.angle({x, on_tilted + step}), bedding_.angle({x, on_tilted - step}), 10 * step);
        expect_axis(bedding_.angle({x, step}), bedding_.angle({x, -step}), 10 * step);
    }
}

TEST(Bedding, SteepLines_AverageOfAxes_DoesNotPassThroughTheOtherDirection) {
    // 80 and 100 degrees: the axis between them stands upright and is not level
    const double steep = 80 * pi / 180;
    const Bedding bedding(
        {{{-1 - 3 * std::cos(steep), -3 * std::sin(steep)}, {-1 + 3 * std::cos(steep), 3 * std::sin(steep)}},
         {{1 + 3 * std::cos(steep), -3 * std::sin(steep)}, {1 - 3 * std::cos(steep), 3 * std::sin(steep)}}});
    expect_axis(bedding.angle({0, 0}), pi / 2);
}

TEST(Bedding, CurvedLine_AlongIt_AngleTurnsContinuouslyFromMiddleToMiddle) {
    const Line bow{{0, 0}, {1, 0}, {2, 1}, {2, 2}};
    const Bedding bedding({bow});
    expect_axis(bedding.angle({0.5, 0}), 0);
    expect_axis(bedding.angle({1.5, 0.5}), pi / 4);
    expect_axis(bedding.angle({2, 1.5}), pi / 2);
    expect_axis(bedding.angle({1, 0}), pi / 8);  // at a corner: halfway
    expect_axis(bedding.angle({0, 0}), 0);       // before the first middle: the first segment's own
    const double step = 1e-6;
    double before = bedding.angle({0, 0});
    double turned = 0;
    for (std::size_t i = 0; i + 1 < bow.size(); ++i)
        for (double s = step; s <= 1; s += step * 100) {
            const double angle = bedding.angle(
                {bow[i][0] + s * (bow[i + 1][0] - bow[i][0]), bow[i][1] + s * (bow[i + 1][1] - bow[i][1])});
            const double change = between(angle, before);
            EXPECT_LT(std::abs(change), 400 * step);
            EXPECT_GT(change, -round_off);  // always the same way round
            turned += change;
            before = angle;
        }
    EXPECT_NEAR(turned, pi / 2, 1e-3);
}

// ---- the three kinds
// --------------------------------------------------------------------------------------------------------

class AxisAngles : public testing::Test {
protected:
    std::vector<double> angles() { return axis_angles(mesh_, elements_, options_, problems_); }

    Mesh mesh_ = test::rectangle_mesh();  // centroids (4/3, 1/3) and (2/3, 2/3)
    std::vector<std::int32_t> elements_{0, 1};
    AxesOptions options_;
    std::vector<Problem> problems_;
};

TEST_F(AxisAngles, Default_Axes_AreThoseOfThePlane) { EXPECT_THAT(angles(), ElementsAre(0, 0)); }

TEST_F(AxisAngles, Formula_OfPosition_IsTakenAtTheCentroid) {
    options_.angle = Formula("x + 10*y");
    EXPECT_THAT(angles(), ElementsAre(DoubleNear(14.0 / 3, round_off), DoubleNear(22.0 / 3, 2 * round_off)));
    elements_ = {1};
    EXPECT_THAT(angles(), ElementsAre(DoubleNear(22.0 / 3, 2 * round_off)));
    EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(AxisAngles, Formula_Faulty_IsReported) {
    options_.angle = Formula("x + z");
    angles();
    ASSERT_EQ(problems_.size(), 1u);
    EXPECT_EQ(problems_[0].where, "axes.angle");
    EXPECT_THAT(problems_[0].message, HasSubstr("`z`"));
}

TEST_F(AxisAngles, Bedding_IsTakenAtTheCentroid) {
    options_.kind = AxesOptions::Kind::bedding;
    options_.bedding = {{{0, 0}, {2, 0}}, {{0, 1}, {2, 1}}};
    EXPECT_THAT(angles(), ElementsAre(0, 0));
    options_.bedding = {{{0, 0}, {1, 1}}};
    EXPECT_THAT(angles(), ElementsAre(DoubleNear(pi / 4, round_off), DoubleNear(pi / 4, round_off)));
}

TEST_F(AxisAngles, Data_IsTakenByElement) {
    options_.kind = AxesOptions::Kind::data;
    options_.data = "dip";
    mesh_.element_data = {{"dip", {0.1, 0.2}}};
    elements_ = {1};
    EXPECT_THAT(angles(), ElementsAre(0.2));
    EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(AxisAngles, Data_OfSomeElements_AreAskedForWhereTheMaterialIs) {
    options_.kind = AxesOptions::Kind::data;
    options_.data = "dip";
    mesh_.element_data = {{"dip", {std::numeric_limits<double>::quiet_NaN(), 0.2}}};
    elements_ = {1};
    EXPECT_THAT(angles(), ElementsAre(0.2));
    EXPECT_THAT(problems_, IsEmpty());
    elements_ = {0, 1};
    angles();
    ASSERT_EQ(problems_.size(), 1u);
    EXPECT_EQ(problems_[0].message,
              "element data `dip` of the mesh file have no number for element 1: one component is needed, given once");
}

TEST_F(AxisAngles, Data_Missing_IsReportedWithWhatThereIs) {
    options_.kind = AxesOptions::Kind::data;
    options_.data = "dip";
    angles();
    mesh_.element_data = {{"angle", {0, 0}}, {"porosity", {0, 0}}};
    angles();
    ASSERT_EQ(problems_.size(), 2u);
    EXPECT_EQ(problems_[0].where, "axes.data");
    EXPECT_EQ(problems_[0].message, "the mesh file has no element data `dip`; it has: none");
    EXPECT_EQ(problems_[1].message, "the mesh file has no element data `dip`; it has: angle, porosity");
}

}  // namespace
}  // namespace gneiss
