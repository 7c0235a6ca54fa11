// The assembled tangent against central differences of the forces, for every combination of element, sampling, law,
// stress map and viscosity with z updated or given, for loads and boundaries.

#include "model/solid_tangent.hpp"

#include <gmock/gmock.h>
#include <omp.h>

#include <cmath>

#include "base/errors.hpp"
#include "mesh/composite.hpp"
#include "mesh/measure.hpp"
#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

enum class Shape { cst, straight, curved };  ///< of elements: CST, COMPT with straight sides, COMPT with curved ones

struct Law {
    const char* name;
    LawKind kind;
    Form form;
    bool stiffening;
    Plane plane;
};

constexpr Law laws[] = {{"Hyper", LawKind::munjiza, Form::hyper, false, Plane::strain},
                        {"Hypo", LawKind::munjiza, Form::hypo, false, Plane::strain},
                        {"HypoStiffening", LawKind::munjiza, Form::hypo, true, Plane::strain},
                        {"NeoHookeanStrain", LawKind::neo_hookean, Form::hyper, false, Plane::strain},
                        {"NeoHookeanStress", LawKind::neo_hookean, Form::hyper, false, Plane::stress}};

struct TangentChoice {
    Shape shape;
    Volumetric volumetric;
    Law law;
    StressMap map;
    bool viscous;
    bool given;  ///< z given, not updated with u

    bool compt() const { return shape != Shape::cst; }
    bool munjiza() const { return law.kind == LawKind::munjiza; }
    bool direct() const { return map == StressMap::direct; }
    bool centre() const { return volumetric == Volumetric::centre; }

    std::string name() const {
        constexpr const char* shapes[] = {"Cst", "Straight", "Curved"};
        return std::string(shapes[static_cast<int>(shape)]) + (centre() ? "Centre" : "") + law.name +
               (direct() ? "Direct" : "") + (viscous ? "Viscous" : "") + (given ? "Given" : "");
    }
    /// It is another case than the same with the other sampling, map or z.
    bool distinct() const {
        return (compt() || !centre()) &&    // a CST is its own composite
               (munjiza() || !direct()) &&  // a law without axes has no stress map
               (has_internal() || !given);  // there is no z to give
    }
    /// FORMULATION 2: sampled at the centre only where no energy is stored anyway.
    bool refused() const { return centre() && !(munjiza() && direct()); }
    /// Stresses or their accumulated power.
    bool has_internal() const { return munjiza() && (law.form == Form::hypo || direct()); }
    /// Forces are a gradient by u: of the stored energy, or of that of the strains since the accepted state.
    bool symmetric() const { return !direct() && !centre() && !viscous && !law.stiffening; }
};

void PrintTo(const TangentChoice& choice, std::ostream* out) { *out << choice.name(); }

std::vector<TangentChoice> tangent_choices(bool refused) {
    std::vector<TangentChoice> all;
    for (const Shape shape : {Shape::cst, Shape::straight, Shape::curved})
        for (const Volumetric volumetric : {Volumetric::mean, Volumetric::centre})
            for (const Law& law : laws)
                for (const StressMap map : {StressMap::conjugate, StressMap::direct})
                    for (const bool viscous : {false, true})
                        for (const bool given : {false, true}) {
                            const TangentChoice choice{shape, volumetric, law, map, viscous, given};
                            if (choice.distinct() && choice.refused() == refused) all.push_back(choice);
                        }
    return all;
}

/// Inner nodes moved; where sides have to be straight the mid-side nodes moved back to their middles.
Mesh distorted_mesh(Shape shape) {
    Mesh mesh = test::rectangle(shape != Shape::cst, 2, 1, {3, 2});
    test::distort(mesh, 0.25, 0.25, 3);
    if (shape == Shape::straight)
        for (std::size_t e = 0; e < mesh.n_elements(); ++e)
            for (const auto& [a, middle, b] : composite_sides) {
                const auto node = [&](int local) -> auto& {
                    return mesh.nodes[static_cast<std::size_t>(mesh.element(e)[local])];
                };
                for (std::size_t k = 0; k < 2; ++k) node(middle)[k] = 0.5 * (node(a)[k] + node(b)[k]);
            }
    return mesh;
}

test::Solid make_solid(const TangentChoice& choice) {
    test::SolidDescription what;
    what.solid.compt = choice.compt();
    what.solid.plane = choice.law.plane;
    what.solid.volumetric = choice.volumetric;
    what.solid.thickness = 0.7;
    MaterialOptions& material = what.materials[0];
    material.law = choice.law.kind;
    material.form = choice.law.form;
    material.stress_map = choice.map;
    material.shear_modulus = 0.6e9;
    material.lame_lambda = 1e9;
    material.axes.angle = Formula("0.3 + x*y");
    if (choice.law.form == Form::hypo)  // stresses that are not those of the strains
        material.in_situ_stress = {Formula("-2e7*(1 + y)"), Formula(-1e7), Formula("5e6*x")};
    if (choice.law.stiffening) material.stiffening = {2, 0.05 * 1e9, 0.5};
    if (choice.viscous) material.shear_viscosity = 1e6, material.bulk_viscosity = 2e6;
    return test::make_solid(distorted_mesh(choice.shape), what);
}

Trial trial_of(const State& state, bool given) {
    Trial trial = Trial::of(state);
    if (given) trial.z = state.z;
    return trial;
}

/// -df/d(u or v) at a trial by central differences of order 4, the steps strains of 1e-5: round-off and truncation
/// (moduli that change by 1e-3 in a step, to the fourth power) are below 1e-9 of the largest entry.
/// @param given  z of the trial is that of `at`
Eigen::MatrixXd differences(const SemiDiscrete& system, const State& accepted, const State& at, bool by_velocity,
                            bool given = false) {
    const auto n = static_cast<Eigen::Index>(at.u.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    State displaced = at;
    std::vector<double>& x = by_velocity ? displaced.v : displaced.u;
    const double size = 1e-5 * (by_velocity ? 1 : system.smallest_length());
    Eigen::VectorXd f(n);
    for (Eigen::Index j = 0; j < n; ++j) {
        const double before = x[static_cast<std::size_t>(j)];
        for (const auto& [step, weight] : {std::pair(-2, 1.0), {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
            x[static_cast<std::size_t>(j)] = before + step * size;
            system.force(accepted, trial_of(displaced, given), {f.data(), at.u.size()});
            matrix.col(j) -= weight / (12 * size) * f;
        }
        x[static_cast<std::size_t>(j)] = before;
    }
    return matrix;
}

/// A smooth motion with strains of a few percent.
State displaced(const test::Solid& solid, double size) {
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

class SolidTangentOf : public testing::TestWithParam<TangentChoice> {
protected:
    SolidTangentOf() : solid_(make_solid(GetParam())) {
        // the accepted state has a memory, and the trial is elsewhere
        accepted_ = displaced(solid_, 0.02);
        const State before = solid_.system->initial_state();
        std::vector<double> f(accepted_.u.size());
        solid_.system->force_and_update(before, Trial::of(accepted_), f, accepted_.z, accepted_.history);
        at_ = displaced(solid_, 0.05);
        at_.z = accepted_.z;
        at_.history = accepted_.history;
        trial_ = trial_of(at_, GetParam().given);
    }
    Eigen::MatrixXd assembled(const Tangent::Factors& factors) const {
        return test::dense(*solid_.system->tangent(), accepted_, trial_, factors);
    }

    test::Solid solid_;
    State accepted_, at_;
    Trial trial_;
};

TEST_P(SolidTangentOf, AwayFromTheAcceptedState_IsTheDerivativeOfTheForce) {
    const TangentChoice& choice = GetParam();
    ASSERT_EQ(solid_.system->layout().n_internal > 0, choice.has_internal());
    for (std::size_t e = 0; choice.compt() && e < solid_.mesh.n_elements(); ++e)
        ASSERT_EQ(has_straight_sides(solid_.mesh, e), choice.shape == Shape::straight);
    const Eigen::MatrixXd expected = differences(*solid_.system, accepted_, at_, false, choice.given);
    EXPECT_LE(largest(assembled({.stiffness = 1}) - expected), 1e-8 * largest(expected));
    const Eigen::MatrixXd by_v = assembled({.velocity = 1});
    if (choice.viscous) {
        const Eigen::MatrixXd expected_by_v = differences(*solid_.system, accepted_, at_, true, choice.given);
        EXPECT_LE(largest(by_v - expected_by_v), 1e-8 * largest(expected_by_v));
    } else {
        EXPECT_EQ(largest(by_v), 0);
    }
}

TEST_P(SolidTangentOf, Symmetry_IsWhatItSays) {
    EXPECT_EQ(solid_.system->tangent()->symmetric(), GetParam().symmetric());
    const Eigen::MatrixXd matrix = assembled({.stiffness = 1});
    const double asymmetry = largest(matrix - matrix.transpose()) / largest(matrix);
    if (GetParam().symmetric()) {
        EXPECT_LE(asymmetry, 1e-14);
    } else if (!GetParam().given) {  // what makes it unsymmetric may be the update of z
        EXPECT_GT(asymmetry, 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(EveryCombination, SolidTangentOf, testing::ValuesIn(tangent_choices(false)),
                         [](const auto& test_case) { return test_case.param.name(); });

TEST(SolidTangent, EveryOtherCombination_IsRefused) {
    // CST: 12 of Munjiza's material and 4 of the neo-Hookean one, 10 of them with z that may be given. COMPT of either
    // shape: the same, and at the centre 6 with `direct`, all with z; what has no energy to give up is refused.
    EXPECT_EQ(tangent_choices(false).size(), 26u + 2 * (26 + 12));
    EXPECT_EQ(tangent_choices(true).size(), 2u * (10 + 4));
    for (const TangentChoice& choice : tangent_choices(true)) {
        try {
            make_solid(choice);
            ADD_FAILURE() << choice.name();
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("volumetric = \"centre\" has no stored energy"))
                << choice.name();
        }
    }
}

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
    for (const bool compt : {false, true}) {
        const test::Solid solid = test::distorted_solid(compt, what);
        State state = displaced(solid, 0.05);
        state.t = 0.5;
        state.last_event = 0;
        const Tangent& tangent = *solid.system->tangent();
        EXPECT_FALSE(tangent.symmetric());
        const Eigen::MatrixXd matrix = test::dense(tangent, state, Trial::of(state), {.stiffness = 1});
        EXPECT_GT(largest(matrix - matrix.transpose()), 1e-6 * largest(matrix));
        const Eigen::MatrixXd expected = differences(*solid.system, state, state, false);
        EXPECT_LE(largest(matrix - expected), 1e-8 * largest(expected));
        const test::Solid unloaded = test::distorted_solid(compt);
        const Eigen::MatrixXd without =
            test::dense(*unloaded.system->tangent(), state, Trial::of(state), {.stiffness = 1});
        EXPECT_GT(largest(matrix - without), 1e-3 * largest(expected)) << "the pressure is there";
    }
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
        const State state = displaced(solid, 0.05);
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
    const State state = displaced(solid, 0.01);
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
