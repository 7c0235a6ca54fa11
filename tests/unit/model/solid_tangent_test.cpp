// The assembled tangent against central differences of the forces, for every law, element and sampling, for loads and
// boundaries.

#include "model/solid_tangent.hpp"

#include <gmock/gmock.h>
#include <omp.h>

#include <cmath>

#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

struct Choice {
    const char* name;
    bool compt, straight;
    Volumetric volumetric;
    Plane plane;
    LawKind law;
    Form form;
    StressMap map;
    bool viscous, symmetric;
};

constexpr auto munjiza = LawKind::munjiza, neo = LawKind::neo_hookean;
constexpr auto hyper = Form::hyper, hypo = Form::hypo;
constexpr auto conjugate = StressMap::conjugate, direct = StressMap::direct;
constexpr auto mean = Volumetric::mean, centre = Volumetric::centre;
constexpr auto strain = Plane::strain, stress = Plane::stress;

const Choice choices[] = {
    {"CstHyperConjugate", false, false, mean, strain, munjiza, hyper, conjugate, false, true},
    {"CstHyperDirect", false, false, mean, strain, munjiza, hyper, direct, false, false},
    {"CstHypoConjugate", false, false, mean, strain, munjiza, hypo, conjugate, false, false},
    {"CstHypoDirect", false, false, mean, strain, munjiza, hypo, direct, false, false},
    {"CstNeoHookeanStrain", false, false, mean, strain, neo, hyper, conjugate, false, true},
    {"CstNeoHookeanStress", false, false, mean, stress, neo, hyper, conjugate, false, true},
    {"CstHyperViscous", false, false, mean, strain, munjiza, hyper, conjugate, true, false},
    {"ComptHyperConjugate", true, false, mean, strain, munjiza, hyper, conjugate, false, true},
    {"ComptStraightHyperConjugate", true, true, mean, strain, munjiza, hyper, conjugate, false, true},
    {"ComptHyperDirect", true, false, mean, strain, munjiza, hyper, direct, false, false},
    {"ComptHypoConjugate", true, false, mean, strain, munjiza, hypo, conjugate, false, false},
    {"ComptStraightHypoDirect", true, true, mean, strain, munjiza, hypo, direct, false, false},
    {"ComptNeoHookeanStrain", true, false, mean, strain, neo, hyper, conjugate, false, true},
    {"ComptNeoHookeanStress", true, false, mean, stress, neo, hyper, conjugate, false, true},
    {"ComptCentreHyperDirect", true, false, centre, strain, munjiza, hyper, direct, false, false},
    {"ComptCentreHypoDirect", true, true, centre, strain, munjiza, hypo, direct, false, false},
    {"ComptHypoViscous", true, false, mean, strain, munjiza, hypo, conjugate, true, false},
};

/// -df/d(u or v) at a trial by central differences of order 4, the steps strains of 1e-5: round-off and truncation
/// (moduli that change by 1e-3 in a step, to the fourth power) are below 1e-9 of the largest entry.
Eigen::MatrixXd differences(const SemiDiscrete& system, const State& accepted, const State& at, bool by_velocity) {
    const auto n = static_cast<Eigen::Index>(at.u.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    State moved = at;
    std::vector<double>& x = by_velocity ? moved.v : moved.u;
    const double size = 1e-5 * (by_velocity ? 1 : system.smallest_length());
    Eigen::VectorXd f(n);
    for (Eigen::Index j = 0; j < n; ++j) {
        const double before = x[static_cast<std::size_t>(j)];
        for (const auto& [step, weight] : {std::pair(-2, 1.0), {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
            x[static_cast<std::size_t>(j)] = before + step * size;
            system.force(accepted, Trial::of(moved), {f.data(), at.u.size()});
            matrix.col(j) -= weight / (12 * size) * f;
        }
        x[static_cast<std::size_t>(j)] = before;
    }
    return matrix;
}

/// A smooth motion with strains of a few percent.
State moved(const test::Solid& solid, double size) {
    State state = solid.system->initial_state();
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        const auto& [x, y] = solid.mesh.nodes[node];
        state.u[2 * node] = size * (std::sin(1.5 * y) - 0.6 * x);
        state.u[2 * node + 1] = size * (0.7 * std::cos(2 * x) + 0.4 * y * x);
        state.v[2 * node] = 3 * std::cos(x + y);
        state.v[2 * node + 1] = x * y - 2;
    }
    return state;
}

double largest(const Eigen::MatrixXd& a) { return a.cwiseAbs().maxCoeff(); }

class SolidTangentOf : public testing::TestWithParam<Choice> {
protected:
    SolidTangentOf() {
        const Choice& choice = GetParam();
        test::SolidDescription what;
        what.solid.compt = choice.compt;
        what.solid.plane = choice.plane;
        what.solid.volumetric = choice.volumetric;
        what.solid.thickness = 0.7;
        MaterialOptions& material = what.materials[0];
        material.law = choice.law;
        material.form = choice.form;
        material.stress_map = choice.map;
        material.shear_modulus = 0.6e9;
        material.lame_lambda = 1e9;
        material.axes.angle = Formula("0.3 + x*y");
        if (choice.form == hypo) material.stiffening = {2, 0.05 * 1e9, 0.5};
        if (choice.viscous) material.shear_viscosity = 1e6, material.bulk_viscosity = 2e6;
        Mesh mesh = test::rectangle(choice.compt, 2, 1, {3, 2});
        if (!choice.straight) test::distort(mesh, 0.25, 0.25, 3);
        solid_ = test::make_solid(std::move(mesh), what);
        // the accepted state has a memory, and the trial is elsewhere
        accepted_ = moved(solid_, 0.02);
        const State before = solid_.system->initial_state();
        std::vector<double> f(accepted_.u.size());
        solid_.system->force_and_update(before, Trial::of(accepted_), f, accepted_.z, accepted_.history);
        at_ = moved(solid_, 0.05);
        at_.z = accepted_.z;
        at_.history = accepted_.history;
    }

    test::Solid solid_;
    State accepted_, at_;
};

TEST_P(SolidTangentOf, AwayFromTheAcceptedState_IsTheDerivativeOfTheForce) {
    const Tangent& tangent = *solid_.system->tangent();
    const Eigen::MatrixXd by_u = test::dense(tangent, accepted_, Trial::of(at_), {.stiffness = 1});
    const Eigen::MatrixXd expected = differences(*solid_.system, accepted_, at_, false);
    EXPECT_LE(largest(by_u - expected), 1e-8 * largest(expected));
    const Eigen::MatrixXd by_v = test::dense(tangent, accepted_, Trial::of(at_), {.velocity = 1});
    if (GetParam().viscous) {
        const Eigen::MatrixXd expected_by_v = differences(*solid_.system, accepted_, at_, true);
        EXPECT_LE(largest(by_v - expected_by_v), 1e-8 * largest(expected_by_v));
    } else {
        EXPECT_EQ(largest(by_v), 0);
    }
}

TEST_P(SolidTangentOf, Symmetry_IsWhatItSays) {
    const Tangent& tangent = *solid_.system->tangent();
    EXPECT_EQ(tangent.symmetric(), GetParam().symmetric);
    const Eigen::MatrixXd matrix = test::dense(tangent, accepted_, Trial::of(at_), {.stiffness = 1});
    const double asymmetry = largest(matrix - matrix.transpose()) / largest(matrix);
    if (GetParam().symmetric)
        EXPECT_LE(asymmetry, 1e-14);
    else
        EXPECT_GT(asymmetry, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(EveryLawElementAndSampling, SolidTangentOf, testing::ValuesIn(choices),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(SolidTangent, Pattern_RowsAreAscendingAndOfNeighboursOnly) {
    const test::Solid solid = test::distorted_solid(true);
    const Tangent& tangent = *solid.system->tangent();
    const auto [starts, columns] = tangent.pattern();
    ASSERT_EQ(columns.size(), tangent.n_nonzero());
    ASSERT_EQ(starts.size(), solid.system->layout().n_dof + 1);
    EXPECT_EQ(starts.front(), 0);
    EXPECT_EQ(starts.back(), static_cast<std::int64_t>(columns.size()));
    for (std::size_t row = 0; row + 1 < starts.size(); ++row)
        EXPECT_TRUE(std::is_sorted(columns.begin() + starts[row], columns.begin() + starts[row + 1]));
    // a corner of the rectangle belongs to one or two composites: six or nine nodes
    const auto length = starts[1] - starts[0];
    EXPECT_THAT(length, testing::AnyOf(12, 18));
}

TEST(SolidTangent, MassAndDamping_StandOnTheDiagonal) {
    test::SolidDescription what;
    what.mass_damping = 3;
    BoundaryOptions absorbing;
    absorbing.on = "right";
    absorbing.kind = BoundaryOptions::Kind::absorbing;
    what.boundaries = {absorbing};
    const test::Solid solid = test::distorted_solid(false, what);
    const State state = solid.system->initial_state();
    const Eigen::MatrixXd matrix =
        test::dense(*solid.system->tangent(), state, Trial::of(state), {.mass = 2, .damping = 5});
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        expected(i, i) = (2 + 5 * 3) * solid.system->lumped_mass()[static_cast<std::size_t>(i)];
    for (const Damping::Block& block : solid.system->damping().blocks)
        expected.block<2, 2>(2 * block.node, 2 * block.node) +=
            5 * Eigen::Matrix2d{{block.xx, block.xy}, {block.xy, block.yy}};
    EXPECT_FALSE(solid.system->damping().blocks.empty());
    EXPECT_LE(largest(matrix - expected), 1e-15 * largest(expected));
}

TEST(SolidTangent, FollowerPressure_IsTheDerivativeOfTheForce) {
    test::SolidDescription what;
    LoadOptions pressure;
    pressure.kind = LoadOptions::Kind::pressure;
    pressure.on = "top";
    pressure.value[0] = Formula("1e8*(1 + x)");
    what.loads = {pressure};
    const test::Solid solid = test::distorted_solid(true, what);
    State state = moved(solid, 0.05);
    state.t = 0.5;
    state.last_event = 0;
    const Tangent& tangent = *solid.system->tangent();
    EXPECT_FALSE(tangent.symmetric());
    const Eigen::MatrixXd matrix = test::dense(tangent, state, Trial::of(state), {.stiffness = 1});
    const Eigen::MatrixXd expected = differences(*solid.system, state, state, false);
    EXPECT_LE(largest(matrix - expected), 1e-8 * largest(expected));
    const test::Solid unloaded = test::distorted_solid(true);
    const Eigen::MatrixXd without = test::dense(*unloaded.system->tangent(), state, Trial::of(state), {.stiffness = 1});
    EXPECT_GT(largest(matrix - without), 1e-3 * largest(expected)) << "the pressure is there";
}

TEST(SolidTangent, DiagonalAlone_IsThatOfTheMatrix) {
    test::SolidDescription what;
    what.mass_damping = 3;
    what.materials[0].shear_viscosity = 1e6;
    BoundaryOptions absorbing;
    absorbing.on = "right";
    absorbing.kind = BoundaryOptions::Kind::absorbing;
    what.boundaries = {absorbing};
    LoadOptions pressure;
    pressure.kind = LoadOptions::Kind::pressure;
    pressure.on = "top";
    pressure.value[0] = Formula(1e8);
    what.loads = {pressure};
    for (const bool compt : {false, true}) {
        const test::Solid solid = test::distorted_solid(compt, what);
        const State state = moved(solid, 0.05);
        const Tangent::Factors factors{.mass = 2e5, .damping = 1e3, .stiffness = 1, .velocity = 10};
        std::vector<double> diagonal(state.u.size(), 1e300);
        solid.system->tangent()->assemble_diagonal(state, Trial::of(state), factors, diagonal);
        const Eigen::MatrixXd matrix = test::dense(*solid.system->tangent(), state, Trial::of(state), factors);
        for (std::size_t i = 0; i < diagonal.size(); ++i) {
            const double expected = matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
            EXPECT_NEAR(diagonal[i], expected, 1e-14 * largest(matrix));
        }
    }
}

TEST(SolidTangent, OneAndTwoThreads_SameBits) {
    const test::Solid solid = test::make_solid(test::rectangle(true, 3, 3, {30, 30}), {});
    const State state = moved(solid, 0.01);
    const Tangent& tangent = *solid.system->tangent();
    std::vector<double> one(tangent.n_nonzero()), two(one.size());
    omp_set_num_threads(1);
    tangent.assemble(state, Trial::of(state), {.mass = 1, .stiffness = 1}, one);
    omp_set_num_threads(2);
    tangent.assemble(state, Trial::of(state), {.mass = 1, .stiffness = 1}, two);
    omp_set_num_threads(1);
    EXPECT_EQ(one, two);
}

}  // namespace
}  // namespace gneiss
