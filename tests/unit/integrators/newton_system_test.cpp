// The systems solved in the n free displacements against the dense matrix I - gamma J over (u, v, z), J by differences
// of the right-hand side.

#include "integrators/newton_system.hpp"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <sundials/sundials_context.hpp>

#include "support/one_thread.hpp"
#include "support/oscillator_problems.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

using test::Matrix;
using test::Vector;

/// About one over the middle of the natural frequencies: M, gamma D and gamma^2 K are then all of a size, and so are
/// the three parts of the right side.
constexpr double gamma_of_solids = 2e-4;  // s; rock of 1e9 Pa and 1000 kg/m3 in edges of 0.25 m
constexpr double young_modulus = 1e9;     // Pa

struct Case {
    std::string name;
    test::SolidDescription what;
    bool compt = true;

    bool damped() const {
        return what.mass_damping > 0 || what.materials[0].shear_viscosity > 0 ||
               std::ranges::any_of(what.boundaries, [](const BoundaryOptions& boundary) {
                   return boundary.kind == BoundaryOptions::Kind::absorbing;
               });
    }
    bool stressed() const { return what.materials[0].form == Form::hypo; }
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

BoundaryOptions on(const char* boundary, BoundaryOptions::Kind kind, std::optional<Formula> x = {},
                   std::optional<Formula> y = {}) {
    BoundaryOptions options;
    options.on = boundary;
    options.kind = kind;
    options.value = {std::move(x), std::move(y)};
    return options;
}

test::SolidDescription of(Form form, StressMap map, bool viscous, double mass_damping) {
    test::SolidDescription what;
    what.solid.thickness = 0.7;
    what.mass_damping = mass_damping;
    MaterialOptions& material = what.materials[0];
    material.form = form;
    material.stress_map = map;
    if (form == Form::hypo) material.stiffening = {2, 0.05 * young_modulus, 0.5};
    if (viscous) material.shear_viscosity = 0.5 * young_modulus * gamma_of_solids, material.bulk_viscosity = 1e5;
    return what;
}

/// All that a solid can have at once: unsymmetric, damped in three ways, with z, partly held, under a follower load.
test::SolidDescription all_at_once() {
    test::SolidDescription what = of(Form::hypo, StressMap::direct, true, 1 / gamma_of_solids);
    what.boundaries = {on("left", BoundaryOptions::Kind::displacement, Formula(0.0), std::nullopt),
                       on("bottom", BoundaryOptions::Kind::velocity, std::nullopt, Formula("0.5*x")),
                       on("right", BoundaryOptions::Kind::absorbing)};
    LoadOptions pressure;
    pressure.kind = LoadOptions::Kind::pressure;
    pressure.on = "top";
    pressure.value[0] = Formula(0.1 * young_modulus);
    what.loads = {pressure};
    return what;
}

test::SolidDescription held(test::SolidDescription what) {
    what.boundaries.push_back(on("left", BoundaryOptions::Kind::displacement, Formula(0.0), Formula(0.0)));
    what.boundaries.push_back(on("right", BoundaryOptions::Kind::displacement, Formula(0.01), std::nullopt));
    return what;
}

test::SolidDescription absorbing() {
    test::SolidDescription what = of(Form::hyper, StressMap::conjugate, false, 0);
    what.boundaries = {on("right", BoundaryOptions::Kind::absorbing)};
    return what;
}

/// The same z, and a symmetric matrix.
test::SolidDescription constant_moduli() {
    test::SolidDescription what = held(of(Form::hypo, StressMap::conjugate, false, 1 / gamma_of_solids));
    what.materials[0].stiffening = {};
    return what;
}

std::vector<Case> cases() {
    constexpr auto hyper = Form::hyper, hypo = Form::hypo;
    constexpr auto conjugate = StressMap::conjugate, direct = StressMap::direct;
    constexpr double damping = 1 / gamma_of_solids;
    return {{"Undamped", of(hyper, conjugate, false, 0)},
            {"MassDamping", of(hyper, conjugate, false, damping)},
            {"AbsorbingEdge", absorbing()},
            {"ViscousStress", of(hyper, conjugate, true, 0)},
            {"FixedDegreesOfFreedom", held(of(hyper, conjugate, false, damping))},
            {"Unsymmetric", of(hyper, direct, false, 0)},
            {"HypoElastic", of(hypo, conjugate, false, 0)},
            {"HypoElasticConstantModuli", constant_moduli()},
            {"HypoElasticViscousFixed", held(of(hypo, direct, true, damping))},
            {"HypoElasticCst", held(of(hypo, conjugate, false, damping)), false},
            {"Everything", all_at_once()}};
}

/// A system at a state where nothing is zero, far from the accepted one.
struct At {
    const SemiDiscrete& system;
    State accepted;
    std::vector<double> y;
    double t = 1e-5;                        // s
    double u_step = 1, z_step = 1;          // of differences, m and Pa
    bool damped = false, stressed = false;  // D and df/dz are not zero
    FirstOrderForm form = {};               // bound
};

/// dF/dy over (u, v, z) by central differences: of order 4 in u, where the steps are strains of 1e-5; in v and z, of
/// which F is an affine function, by any step.
Matrix jacobian(At& at) {
    const std::size_t n = at.form.size(), n_free = at.form.n_free();
    Matrix matrix = Matrix::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    std::vector<double> y = at.y, rate(n);
    for (std::size_t j = 0; j < n; ++j) {
        const double size = j < n_free ? at.u_step : j < 2 * n_free ? 1.0 : at.z_step;
        for (const auto& [step, weight] : {std::pair(-2, 1.0), {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
            y[j] = at.y[j] + step * size;
            at.form.rate(at.system, at.accepted, at.t, y, FirstOrderForm::Part::all, rate);
            matrix.col(static_cast<Eigen::Index>(j)) += weight / (12 * size) * test::Oscillator::vector(rate);
        }
        y[j] = at.y[j];
    }
    return matrix;
}

/// What is kept of it [docs/decisions/014]: dg/du and dg/dz are left out.
void leave_out(Matrix& jacobian, std::size_t n_free) {
    const auto n = static_cast<Eigen::Index>(n_free), n_z = jacobian.rows() - 2 * n;
    jacobian.bottomLeftCorner(n_z, n).setZero();
    jacobian.bottomRightCorner(n_z, n_z).setZero();
}

/// x of the linear solver that SUNDIALS sees.
Vector solved(NewtonSystem& newton, const Vector& b, bool in_place, SUNContext context) {
    const auto n = static_cast<std::size_t>(b.size());
    const OwnedVector left = new_vector(n, context), right = new_vector(n, context);
    std::copy_n(b.data(), n, values_of(right.get()).begin());
    std::ranges::fill(values_of(left.get()), 1e300);
    N_Vector x = in_place ? right.get() : left.get();
    if (SUNLinSolSetup(newton.linear_solver(), newton.matrix()) != 0 ||
        SUNLinSolSolve(newton.linear_solver(), newton.matrix(), x, right.get(), 0) != 0)
        throw std::runtime_error(newton.guard().failure());
    return test::Oscillator::vector(values_of(x));
}

/// Unit of each entry of y: u in m, v in m/gamma, z in Pa of a strain of 1.
Vector units(const FirstOrderForm& form, double gamma, double stress) {
    const auto n = static_cast<Eigen::Index>(form.n_free());
    Vector unit = Vector::Constant(static_cast<Eigen::Index>(form.size()), stress);
    unit.head(n).setOnes();
    unit.segment(n, n).setConstant(1 / gamma);
    return unit;
}

/// The largest difference over the largest entry.
double relative_difference(const Vector& a, const Vector& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// Differences by u: round-off of forces over a strain of 1e-5, 2e-11, a few of which add up. The matrix, in which mass
/// and stiffness are alike, hands them on as they are.
constexpr double of_dense_solution = 2e-10;
/// An answer of which a part is missing or has the other sign is off by far more than that.
constexpr double every_part_counts = 1e-3;

/// Solves at three values of gamma and two scales with one linearisation, in place or not.
void expect_dense_solution(At& at, double gamma, double stress) {
    sundials::Context context;
    NewtonSystem newton(at.system, at.form, {}, context);
    newton.linearise(at.accepted, at.t, at.y);
    const Vector unit = units(at.form, gamma, stress);
    Matrix kept = unit.cwiseInverse().asDiagonal() * jacobian(at) * unit.asDiagonal();
    leave_out(kept, at.form.n_free());
    const Matrix one = Matrix::Identity(kept.rows(), kept.cols());
    // between 0.5 and 1.5, of either sign
    Vector b(kept.rows());
    for (Eigen::Index i = 0; i < b.size(); ++i)
        b[i] = (1 + 0.5 * std::sin(2.3 * static_cast<double>(i))) * (i % 3 == 1 ? -1 : 1);
    for (const double factor : {1.0, 0.3, 2.0}) {
        for (const double right_scale : {1.0, 0.37}) {
            newton.set(factor * gamma, right_scale);
            const Vector expected = (one - factor * gamma * kept).partialPivLu().solve(right_scale * b);
            for (const bool in_place : {false, true}) {
                const Vector found = solved(newton, b.cwiseProduct(unit), in_place, context).cwiseQuotient(unit);
                EXPECT_LE(relative_difference(found, expected), of_dense_solution)
                    << "gamma " << factor * gamma << ", right side times " << right_scale;
            }
        }
    }
    EXPECT_EQ(newton.counts().linearisations, 1u);
    EXPECT_EQ(newton.counts().factorisations, 12u);
    EXPECT_EQ(newton.counts().solves, 12u);

    // the case is one in which every part of J that it has counts
    const auto n = static_cast<Eigen::Index>(at.form.n_free()), n_z = kept.rows() - 2 * n;
    const Vector expected = (one - gamma * kept).partialPivLu().solve(b);
    struct Part {
        const char* name;
        bool there;
        Eigen::Index row, column, n_rows, n_columns;
    };
    for (const Part& part : {Part{"K", true, n, 0, n, n}, Part{"D", at.damped, n, n, n, n},
                             Part{"df/dz", at.stressed, n, 2 * n, n, n_z}, Part{"G", n_z > 0, 2 * n, n, n_z, n}}) {
        Matrix without = kept;
        without.block(part.row, part.column, part.n_rows, part.n_columns).setZero();
        const double change = relative_difference((one - gamma * without).partialPivLu().solve(b), expected);
        if (part.there)
            EXPECT_GT(change, every_part_counts) << part.name;
        else
            EXPECT_LE(change, of_dense_solution) << part.name;
    }
}

class NewtonSystemOf : public testing::TestWithParam<Case> {};

TEST_P(NewtonSystemOf, FarFromRest_SolvesTheDenseSystem) {
    const test::Solid solid = test::distorted_solid(GetParam().compt, GetParam().what);
    const SemiDiscrete& system = *solid.system;
    At at{system, system.initial_state(), {}};
    at.form.bind(system, system.frequency_bound(at.accepted).omega);
    at.form.motion().step_from(system, at.accepted);
    State state = at.accepted;
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        const auto& [x, y] = solid.mesh.nodes[node];
        state.u[2 * node] = 0.04 * (std::sin(1.5 * y) - 0.6 * x);
        state.u[2 * node + 1] = 0.04 * (0.7 * std::cos(2 * x) + 0.4 * y * x);
        state.v[2 * node] = 3 * std::cos(x + y);
        state.v[2 * node + 1] = x * y - 2;
    }
    // stresses that are not those of u: some compress, and stiffen
    for (std::size_t k = 0; k < state.z.size(); ++k)
        state.z[k] = 0.03 * young_modulus * std::sin(1.7 * static_cast<double>(k) + 0.3);
    at.y.resize(at.form.size());
    at.form.pack(state, at.y);
    at.u_step = 1e-5 * system.smallest_length();
    at.z_step = 1e-3 * young_modulus;
    at.damped = GetParam().damped();
    at.stressed = GetParam().stressed();
    expect_dense_solution(at, gamma_of_solids, young_modulus);
}

INSTANTIATE_TEST_SUITE_P(Solids, NewtonSystemOf, testing::ValuesIn(cases()),
                         [](const auto& test_case) { return test_case.param.name; });

class NewtonSystemOfOscillator : public testing::TestWithParam<test::OscillatorProblem> {};

/// z here decays by itself, what is left out of J is not small, and damping has off-diagonal entries.
TEST_P(NewtonSystemOfOscillator, OffItsEquilibrium_SolvesTheDenseSystem) {
    const test::Oscillator system(GetParam().model());
    At at{system, system.initial_state(), {}};
    at.t = 0.3;
    at.form.bind(system, system.exact_bound().omega);
    at.form.motion().step_from(system, at.accepted);
    State state = at.accepted;
    for (std::size_t k = 0; k < state.z.size(); ++k) state.z[k] = 1.0 + static_cast<double>(k);
    at.y.resize(at.form.size());
    at.form.pack(state, at.y);
    at.u_step = at.z_step = 1.0;  // the problem is linear
    at.damped = !system.nodal_damping().isZero() || system.model().viscosity.size() > 0;
    at.stressed = !state.z.empty();
    constexpr double gamma = 0.2, stiffness = 20;
    expect_dense_solution(at, gamma, stiffness);
}

INSTANTIATE_TEST_SUITE_P(Oscillators, NewtonSystemOfOscillator, testing::ValuesIn(test::oscillator_problems()),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(NewtonSystem, NothingFree_OnlyInternalVariablesAreThere) {
    test::OscillatorModel model = test::two_nodes();
    model.maxwell = Matrix{{1, 0, -1, 0}, {0.5, 1, 0, -1}};
    model.maxwell_stiffness = 20;
    for (std::size_t dof = 0; dof < 4; ++dof)
        model.prescribed.push_back(test::moving(dof, Constraint::Kind::displacement, 0.1));
    const test::Oscillator system(model);
    const State state = system.initial_state();
    FirstOrderForm form;
    form.bind(system, system.exact_bound().omega);
    form.motion().step_from(system, state);
    ASSERT_EQ(form.n_free(), 0u);
    sundials::Context context;
    NewtonSystem newton(system, form, {}, context);
    newton.linearise(state, 0, state.z);
    newton.set(0.1, 0.5);
    const Vector b{{3.0, -7.0}};
    EXPECT_EQ(solved(newton, b, false, context), 0.5 * b);
}

}  // namespace
}  // namespace gneiss
