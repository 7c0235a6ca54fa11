// Newton's linear systems of statics, with a matrix and without; and whole load steps by every linear solver.

#include "integrators/static_tangent.hpp"

#include <gmock/gmock.h>

#include "integrators/quasi_static.hpp"
#include "support/one_thread.hpp"
#include "unit/integrators/static_cases.hpp"

namespace gneiss {
namespace {

using test::held;
using test::loaded;
using test::run;
using test::sheared;
using test::Solution;
using testing::HasSubstr;

LinearSolverOptions solver(const char* name, const char* preconditioner = "incomplete") {
    LinearSolverOptions options(name);
    options.preconditioner = preconditioner;
    return options;
}

/// Sheared, and half of it moved by its supports.
test::SolidDescription supported() {
    test::SolidDescription what = sheared(1e8);
    what.boundaries.push_back(held("right", Formula("0.01*y"), {}));
    return what;
}

double largest(std::span<const double> x) {
    double size = 0;
    for (const double value : x) size = std::max(size, std::abs(value));
    return size;
}

TEST(StaticTangent, WithoutAMatrix_DoesWhatTheMatrixDoes) {
    const test::Solid solid = test::distorted_solid(true, supported());
    const State rest = solid.system->initial_state();
    State at = rest;
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        at.u[2 * node] = 0.02 * std::sin(2 * solid.mesh.nodes[node][1]);
        at.u[2 * node + 1] = 0.03 * solid.mesh.nodes[node][0] * solid.mesh.nodes[node][1];
    }
    sundials::Context context;
    const auto assembled = make_assembled_tangent(*solid.system, {}, context);
    const auto matrix_free = make_matrix_free_tangent(*solid.system, solver("pcg", "diagonal"), context);
    ASSERT_EQ(matrix_free->n(), assembled->n());
    const std::size_t n = assembled->n();
    std::vector<double> x(n), changes(solid.system->constraints().size());
    for (std::size_t i = 0; i < n; ++i) x[i] = std::cos(3.0 * static_cast<double>(i));
    for (std::size_t k = 0; k < changes.size(); ++k) changes[k] = 0.1 * std::sin(static_cast<double>(k));
    std::vector<double> right[2], product[2], solution[2];
    int which = 0;
    for (StaticTangent* tangent : {assembled.get(), matrix_free.get()}) {
        right[which].assign(n, 0.0);
        product[which].resize(n);
        solution[which].resize(n);
        tangent->linearise(rest, Trial::of(at));
        tangent->subtract_fixed(changes, right[which]);
        tangent->factorise();
        tangent->multiply(x, product[which]);
        tangent->solve(x, solution[which]);
        ++which;
    }
    // products: second-order terms of strains of 1e-8, and round-off of strains of 5 percent over them
    constexpr double product_error = 1e-6;
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(product[1][i], product[0][i], product_error * largest(product[0]));
        EXPECT_NEAR(right[1][i], right[0][i], product_error * largest(right[0]));
        // times the condition of a few hundred
        EXPECT_NEAR(solution[1][i], solution[0][i], 300 * product_error * largest(solution[0]));
    }
    EXPECT_GT(largest(right[0]), 0);
    EXPECT_GT(matrix_free->iterations(), 10u);
    EXPECT_GE(matrix_free->evaluations(), matrix_free->iterations());
    EXPECT_LT(matrix_free->bytes(), assembled->bytes());
}

TEST(StaticTangent, WithoutAMatrix_AFineMeshFarFromItsPlaceIsNoWorse) {
    const test::Solid solid = test::make_solid(test::rectangle(true, 2, 1, {40, 20}), supported());
    const State rest = solid.system->initial_state();
    State at = rest;
    for (std::size_t i = 0; i < at.u.size(); ++i) at.u[i] = 3;
    sundials::Context context;
    const auto assembled = make_assembled_tangent(*solid.system, {}, context);
    const auto matrix_free = make_matrix_free_tangent(*solid.system, solver("pcg", "diagonal"), context);
    const std::size_t n = assembled->n();
    std::vector<double> rough(n), smooth(n), expected(n), found(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto& [x, y] = solid.mesh.nodes[assembled->free().free()[i] / 2];
        rough[i] = std::cos(3.0 * static_cast<double>(i));
        smooth[i] = y * (0.5 + 0.1 * x);
    }
    // sqrt(eps (1 + |u|/h)), h = 0.025 m; smooth over 1/h as many edges
    const double error = std::sqrt(2.2e-16 * 120);
    for (const auto& [x, tolerance] : {std::pair{&rough, 4 * error}, std::pair{&smooth, 4 * 40 * error}}) {
        for (StaticTangent* tangent : {assembled.get(), matrix_free.get()}) {
            tangent->linearise(rest, Trial::of(at));
            tangent->factorise();
            tangent->multiply(*x, tangent == assembled.get() ? expected : found);
        }
        for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i], expected[i], tolerance * largest(expected));
    }
}

TEST(StaticTangent, WithoutAMatrix_WhatNeedsOneIsRefused) {
    const test::Solid solid = test::distorted_solid(true, supported());
    sundials::Context context;
    const auto refused = [&](const SemiDiscrete& system, const LinearSolverOptions& options) -> std::string {
        try {
            make_matrix_free_tangent(system, options, context);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refused(*solid.system, solver("klu", "diagonal")), HasSubstr("`klu` has nothing to factorise"));
    EXPECT_THAT(refused(*solid.system, solver("pcg")), HasSubstr("needs preconditioner = \"diagonal\""));
    test::SolidDescription what = supported();
    what.loads = {loaded(LoadOptions::Kind::pressure, 1e7, 0)};
    const test::Solid follower = test::distorted_solid(true, what);
    EXPECT_THAT(refused(*follower.system, solver("pcg", "diagonal")), HasSubstr("not symmetric: take gmres"));
    EXPECT_EQ(refused(*follower.system, solver("gmres", "diagonal")), "");
}

struct Way {
    const char *name, *solver, *preconditioner;
    bool matrix_free;
};

class StaticSolver : public testing::TestWithParam<Way> {};

TEST_P(StaticSolver, FiniteLoad_IsTheEquilibriumOfADirectSolver) {
    for (const test::FiniteLoad& c : test::finite_loads()) {
        const test::Solid solid = test::distorted_solid(c.compt, c.what);
        const Way& way = GetParam();
        if (std::string(way.solver) == "pcg" && !solid.system->tangent()->symmetric()) continue;
        QuasiStatic direct({{.tolerance = 1e-9, .step = 0.5}, "klu"});
        QuasiStatic iterative(
            {{.tolerance = 1e-9, .step = 0.5}, solver(way.solver, way.preconditioner), way.matrix_free});
        const Solution expected = run(*solid.system, direct), found = run(*solid.system, iterative);
        // forces out of balance by 1e-9, times the condition of some thousand
        for (std::size_t i = 0; i < found.state.u.size(); ++i)
            EXPECT_NEAR(found.state.u[i], expected.state.u[i], 1e-6 * largest(expected.state.u));
        EXPECT_EQ(direct.counts().linear_iterations, 0u);
        EXPECT_GT(iterative.counts().linear_iterations, iterative.counts().iterations);
        if (way.matrix_free) {
            EXPECT_GT(iterative.counts().evaluations, iterative.counts().linear_iterations);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Iterative, StaticSolver,
                         testing::Values(Way{"PcgDiagonal", "pcg", "diagonal", false},
                                         Way{"PcgIncomplete", "pcg", "incomplete", false},
                                         Way{"PcgMatrixFree", "pcg", "diagonal", true},
                                         Way{"GmresIncomplete", "gmres", "incomplete", false},
                                         Way{"GmresMatrixFree", "gmres", "diagonal", true}),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(StaticSolver, IterationsThatRunOut_CutTheLoadStepAndAreNamed) {
    const test::Solid solid = test::distorted_solid(true, supported());
    LinearSolverOptions options = solver("pcg", "diagonal");
    options.most_iterations = 3;
    for (const bool matrix_free : {false, true}) {
        QuasiStatic integrator({{.shortest = 0.2}, options, matrix_free});
        State state = solid.system->initial_state();
        integrator.start(*solid.system, state, StartReason::fresh);
        const State before = state;
        try {
            integrator.advance(*solid.system, state, 1);
            FAIL() << "no error";
        } catch (const RecoverableError& error) {
            EXPECT_THAT(error.what(),
                        HasSubstr("no equilibrium found after load time t = 0 s, with load steps down to"));
            EXPECT_THAT(error.what(), HasSubstr("after 3 iterations"));
        }
        EXPECT_EQ(state, before);
        EXPECT_GE(integrator.counts().linear_iterations, 6u);
    }
}

}  // namespace
}  // namespace gneiss
