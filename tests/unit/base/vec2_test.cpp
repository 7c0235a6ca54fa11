#include "base/vec2.hpp"

#include <gtest/gtest.h>

namespace gneiss {
namespace {

TEST(Turned, AnyVector_IsAtARightAngleCounterClockwise) {
    const Vec2<double> n{3, 4}, t = turned(n);
    EXPECT_EQ(dot(n, t), 0);
    EXPECT_EQ(cross(n, t), 25) << "counter-clockwise, of the same length";
    EXPECT_EQ(cross(t, n), -25);
}

TEST(Vec2, Operators_ActOnBothComponents) {
    Vec2<double> a{1, 2};
    const Vec2<double> b{10, 40};
    a += b;
    EXPECT_EQ(a.x, 11);
    EXPECT_EQ(a.y, 42);
    const Vec2<double> c = 0.5 * (a - b) + -b;
    EXPECT_EQ(c.x, -9.5);
    EXPECT_EQ(c.y, -39);
}

}  // namespace
}  // namespace gneiss
