#include "model/eigenvalue_bound.hpp"
#include "support/eps.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

namespace gneiss {
namespace {

using test::eps;

template <int n>
using Square = Eigen::Matrix<double, n, n>;

/// The bound of the same matrices, one per lane.
template <int n>
std::array<double, pack_width> bounds(const std::array<Square<n>, pack_width>& matrices) {
    std::array<Pack, n * n> packed;
    for (int k = 0; k < n * n; ++k) {
        alignas(pack_alignment) std::array<double, pack_width> lanes;
        for (std::size_t lane = 0; lane < pack_width; ++lane) lanes[lane] = matrices[lane](k / n, k % n);
        packed[k] = Pack::load_aligned(lanes.data());
    }
    std::array<double, pack_width> result;
    largest_eigenvalue_bound<n>(packed).store_unaligned(result.data());
    return result;
}

template <int n>
void expect_just_above_the_largest(bool definite, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (int repeat = 0; repeat < 50; ++repeat) {
        std::array<Square<n>, pack_width> matrices;
        for (auto& matrix : matrices) {
            Square<n> a;
            for (double& value : a.reshaped()) value = normal(random);
            // columns of very different length, as in slender elements
            for (int j = 0; j < n; ++j) a.col(j) *= std::pow(10.0, -j % 3);
            matrix = size * (definite ? Square<n>(a * a.transpose()) : Square<n>(a + a.transpose()));
        }
        const auto found = bounds<n>(matrices);
        for (std::size_t lane = 0; lane < pack_width; ++lane) {
            const auto values =
                Eigen::SelfAdjointEigenSolver<Square<n>>(matrices[lane], Eigen::EigenvaluesOnly).eigenvalues();
            const double largest = values.cwiseAbs().maxCoeff();
            constexpr double round_off = 100 * n * eps;
            EXPECT_GE(found[lane], largest * (1 - round_off));
            EXPECT_LE(found[lane], largest * std::pow(n, 1.0 / 64) * (1 + round_off));
        }
    }
}

TEST(EigenvalueBound, RandomDefiniteMatrices_Bound_IsJustAboveTheLargestEigenvalue) {
    expect_just_above_the_largest<6>(true, 1, 1);
    expect_just_above_the_largest<12>(true, 1, 2);
}

TEST(EigenvalueBound, IndefiniteMatrices_Bound_IsThatOfTheLargestModulus) {
    expect_just_above_the_largest<6>(false, 1, 3);
    expect_just_above_the_largest<12>(false, 1, 4);
}

TEST(EigenvalueBound, AnyUnit_Bound_NeitherOverflowsNorUnderflows) {
    for (const double size : {1e-60, 1e-12, 1e20, 1e60}) expect_just_above_the_largest<6>(true, size, 5);
}

TEST(EigenvalueBound, MultiplesOfTheIdentity_AreTheWorstCase) {
    std::array<Square<6>, pack_width> matrices;
    for (std::size_t lane = 0; lane < pack_width; ++lane)
        matrices[lane] = (static_cast<double>(lane) + 1) * Square<6>::Identity();
    const auto found = bounds<6>(matrices);
    for (std::size_t lane = 0; lane < pack_width; ++lane)
        EXPECT_NEAR(found[lane], (static_cast<double>(lane) + 1) * std::pow(6, 1.0 / 64), 1e3 * eps * 6);
}

TEST(EigenvalueBound, ZeroMatrix_Bound_IsNegligibleAndFinite) {
    std::array<Square<6>, pack_width> matrices;
    matrices.fill(Square<6>::Zero());
    for (const double bound : bounds<6>(matrices)) EXPECT_LT(bound, 1e-100);
}

}  // namespace
}  // namespace gneiss
