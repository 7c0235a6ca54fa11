// What is Noh and Bathe's own: its limit, its dissipation, its range.

#include "integrators/noh_bathe.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "base/errors.hpp"
#include "support/amplification.hpp"
#include "support/one_thread.hpp"

namespace gneiss {
namespace {

const double splits[] = {0.5, 0.51, 0.54, 0.6, 0.7};

test::MakeIntegrator scheme(double split) {
    return [split](double dt) { return std::make_unique<NohBathe>(NohBathe::Options{{.safety = 1, .dt = dt}, split}); };
}

TEST(NohBathe, StabilityLimit_IsWhereStepsBeginToGrow) {
    for (const double split : splits) {
        const double limit = NohBathe::stability_limit(split).omega_dt;
        // growth of 1e-6 a step begins that much later
        EXPECT_NEAR(test::stability_limit(scheme(split), 4.2), limit, 1e-4) << split;
    }
    EXPECT_NEAR(NohBathe::stability_limit(0.54).omega_dt, 3.745, 5e-4);
    EXPECT_DOUBLE_EQ(NohBathe::stability_limit(0.5).omega_dt, 4);
}

TEST(NohBathe, Amplification_HasTheTraceAndTheDeterminantThatAreDerived) {
    for (const double p : splits) {
        for (const double omega : {0.1, 1.0, 2.5, 3.4}) {
            const auto matrix = test::amplification(scheme(p), omega);
            const double s = 1 - p, w = omega * omega;
            EXPECT_NEAR(matrix.trace(), 2 - w + w * w * p * p * s / 2, 1e-12 * w * w + 1e-13);
            EXPECT_NEAR(matrix.determinant(), 1 - w * w * s * s * (2 * p - 1) / 4, 1e-12 * w * w + 1e-13);
        }
    }
}

TEST(NohBathe, HighFrequencies_AreDampedAndLowOnesAreNot) {
    const auto radius = [](double omega) { return test::spectral_radius(test::amplification(scheme(0.54), omega)); };
    // |lambda|^2 is the determinant while the eigenvalues are complex: 1 - 0.0042 W^2
    EXPECT_GT(radius(0.3), 0.9999);
    EXPECT_NEAR(radius(0.7 * 3.745), 0.894, 1e-3);
    EXPECT_LT(radius(0.95 * 3.745), 0.6);
}

TEST(NohBathe, DampedInAnyWay_AtTheCriticalStep_StaysBounded) {
    // just below the limit the amplitude may be larger than at the start, by about (1 - 0.999^2)^-1/2
    for (const double split : splits) {
        const auto make = [split] { return std::make_unique<NohBathe>(NohBathe::Options{{.safety = 0.999}, split}); };
        EXPECT_LT(test::largest_under_damping(make), 30) << split;
    }
}

TEST(NohBathe, Options_AllProblemsAtOnce) {
    for (const double split : {0.4999, 0.7001, std::nan("")}) {
        try {
            NohBathe integrator({{.safety = 2}, split});
            FAIL() << split;
        } catch (const InputError& error) {
            ASSERT_EQ(error.problems().size(), 2u);
            EXPECT_EQ(error.problems()[1].where, "integrator.split");
            EXPECT_THAT(error.problems()[1].message, testing::HasSubstr("must be in [0.5, 0.7]"));
        }
    }
}

}  // namespace
}  // namespace gneiss
