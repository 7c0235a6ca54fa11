#include "contact/penalty.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace gneiss {
namespace {

using ::testing::HasSubstr;

constexpr double round_off = 4e-16;  // a handful of operations

TEST(Penalty, TwoLayersInSeries_YieldAsMuchAsTheJoint) {
    const ContactSide rock{60e9, 0.1}, sand{1e9, 0.05};
    const double traction = 1e6;
    const double layers = traction * (rock.size / rock.modulus + sand.size / sand.modulus);
    EXPECT_NEAR(traction / penalty_of(rock, sand, 1), layers, round_off * layers);
    EXPECT_NEAR(traction / penalty_of(sand, rock, 10), layers / 10, round_off * layers);
}

TEST(Penalty, UnsoundArgument_IsRefusedWithItsValue) {
    const ContactSide good{1e9, 0.1};
    const auto message = [](const ContactSide& one, const ContactSide& other, double factor) {
        try {
            penalty_of(one, other, factor);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(message({-1, 0.1}, good, 1), HasSubstr("modulus = -1"));
    EXPECT_THAT(message(good, {1e9, 0}, 1), HasSubstr("element size = 0"));
    EXPECT_THAT(message(good, {INFINITY, 0.1}, 1), HasSubstr("modulus = inf"));
    EXPECT_THAT(message(good, good, NAN), HasSubstr("factor = nan"));
}

}  // namespace
}  // namespace gneiss
