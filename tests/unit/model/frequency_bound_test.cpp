// The bound of an explicit step against dense eigenvalues.

#include <gtest/gtest.h>

#include <cmath>

#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

// --------------------------------------------------------------------------------------------------------

/// A worst element among neighbours that hold it back: the bound must not be uselessly large.
constexpr double largest_excess = 2.2;

/// One element alone: the bound is at most n^(1/64) above its largest eigenvalue, n = degrees of freedom.
TEST(FrequencyBound, SingleElement_StrainedState_IsJustAboveItsLargestFrequency) {
    for (const bool compt : {false, true}) {
        Mesh mesh = test::rectangle(compt, 1, 1, {1, 1});
        const std::size_t nodes = compt ? 6 : 3;
        Mesh one = mesh;
        one.connectivity.assign(mesh.connectivity.begin(),
                                mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(nodes));
        one.nodes.clear();
        for (std::size_t i = 0; i < nodes; ++i) {
            one.nodes.push_back(mesh.nodes[static_cast<std::size_t>(one.connectivity[i])]);
            one.connectivity[i] = static_cast<std::int32_t>(i);
        }
        one.region = {0};
        one.boundaries.clear();
        one.node_sets.clear();
        const test::Solid solid = test::make_solid(one, {});
        State state = solid.system->initial_state();
        for (std::size_t i = 0; i < state.u.size(); ++i) state.u[i] = 0.01 * std::sin(3.0 * static_cast<double>(i));
        const double exact = test::dense_frequencies(*solid.system, state).maxCoeff();
        const double bound = solid.system->frequency_bound(state).omega;
        const double n = 2 * static_cast<double>(nodes);
        EXPECT_GE(bound, exact * (1 - 1e-8)) << compt;  // differences of forces
        EXPECT_LE(bound, exact * std::pow(n, 0.5 / 64) * (1 + 1e-8)) << compt;
    }
}

TEST(FrequencyBound, AssembledSolid_AnyState_IsNeverBelowTheLargestFrequency) {
    for (const bool compt : {false, true}) {
        for (const double strain : {0.0, 0.02, 0.1}) {
            const test::Solid solid = test::distorted_solid(compt);
            State state = solid.system->initial_state();
            for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
                const auto& [x, y] = solid.mesh.nodes[node];
                state.u[2 * node] = -strain * (x + 0.5 * y * x);
                state.u[2 * node + 1] = strain * (std::sin(x) - y);
            }
            const double exact = test::dense_frequencies(*solid.system, state).maxCoeff();
            const double bound = solid.system->frequency_bound(state).omega;
            EXPECT_GE(bound, exact) << compt << " " << strain;
            EXPECT_LE(bound, largest_excess * exact) << compt << " " << strain;
        }
    }
}

TEST(StiffnessBound, AssembledSolid_AnyState_IsNotBelowTheStiffness) {
    for (const Volumetric volumetric : {Volumetric::mean, Volumetric::centre}) {
        for (const bool compt : {false, true}) {
            if (!compt && volumetric == Volumetric::centre) continue;
            for (const double strain : {0.0, 0.1}) {
                test::SolidDescription what;
                what.solid.volumetric = volumetric;
                if (volumetric == Volumetric::centre) what.materials[0].stress_map = StressMap::direct;
                const test::Solid solid = test::distorted_solid(compt, what);
                const State rest = solid.system->initial_state();
                State strained = rest;
                for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
                    const auto& [x, y] = solid.mesh.nodes[node];
                    strained.u[2 * node] = -strain * (x + 0.5 * y * x);
                    strained.u[2 * node + 1] = strain * (std::sin(x) - y);
                }
                std::vector<double> bound(rest.u.size());
                // at a trial, not at the accepted state
                solid.system->stiffness_bound(rest, {0, 0, strained.u, strained.v, {}}, bound);
                const Eigen::VectorXd scale =
                    Eigen::Map<const Eigen::VectorXd>(bound.data(), static_cast<Eigen::Index>(bound.size()))
                        .cwiseSqrt()
                        .cwiseInverse();
                const Eigen::MatrixXd stiffness = test::dense_stiffness(*solid.system, strained);
                const Eigen::MatrixXd scaled =
                    0.5 * scale.asDiagonal() * (stiffness + stiffness.transpose()) * scale.asDiagonal();
                const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues().maxCoeff();
                EXPECT_LE(largest, 1 + 1e-8) << compt << " " << strain;  // differences of forces
                EXPECT_GE(largest, 1 / largest_excess) << compt << " " << strain;
            }
        }
    }
}

TEST(FrequencyBound, ViscousSolid_DampingRate_IsNeverBelowTheLargestOfTheAssembly) {
    test::SolidDescription what;
    what.materials[0].shear_viscosity = 3e4;
    what.materials[0].bulk_viscosity = 1e4;
    for (const bool compt : {false, true}) {
        const test::Solid solid = test::distorted_solid(compt, what);
        const State state = solid.system->initial_state();
        // f is linear in v: columns of the damping matrix are forces at unit velocities
        const auto n = static_cast<Eigen::Index>(state.v.size());
        Eigen::MatrixXd damping(n, n);
        std::vector<double> v(state.v.size(), 0.0), f(v.size());
        for (Eigen::Index j = 0; j < n; ++j) {
            v[static_cast<std::size_t>(j)] = 1;
            solid.system->force(state, {0, 0, state.u, v, {}}, f);
            v[static_cast<std::size_t>(j)] = 0;
            for (Eigen::Index i = 0; i < n; ++i)
                damping(i, j) = -f[static_cast<std::size_t>(i)] /
                                std::sqrt(solid.system->lumped_mass()[static_cast<std::size_t>(i)] *
                                          solid.system->lumped_mass()[static_cast<std::size_t>(j)]);
        }
        const double exact = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(damping).eigenvalues().maxCoeff();
        const double bound = solid.system->frequency_bound(state).damping_rate;
        EXPECT_GE(bound, exact) << compt;
        EXPECT_LE(bound, largest_excess * largest_excess * exact) << compt;
    }
}

}  // namespace
}  // namespace gneiss
