#include "model/loads.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/dual.hpp"
#include "base/errors.hpp"
#include "mesh/inner_sides.hpp"
#include "model/edge_pressure.hpp"
#include "unit/model/amplitude_options.hpp"
#include "unit/model/tiny_mesh.hpp"

namespace gneiss {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;
using LoadKind = LoadOptions::Kind;

constexpr double not_yet = -std::numeric_limits<double>::infinity();
constexpr double thickness = 0.5;
/// Sums of some ten terms of order one.
constexpr double load_round_off = 64 * std::numeric_limits<double>::epsilon();

LoadOptions load(LoadKind kind, std::string on, Formula x, Formula y = 0.0, AmplitudeOptions amplitude = {}) {
    return {kind, std::move(on), {std::move(x), std::move(y)}, std::move(amplitude)};
}

std::unique_ptr<ForceTerm> make(const Mesh& mesh, const LoadOptions& options) {
    return std::move(make_loads(mesh, {options}, thickness).front());
}

/// A state at rest in the given displacements.
State state_at(double t, std::vector<double> u) {
    State state;
    state.t = t;
    state.v.assign(u.size(), 0.0);
    state.u = std::move(u);
    return state;
}

State undeformed(const Mesh& mesh, double t = 0) { return state_at(t, std::vector<double>(2 * mesh.n_nodes(), 0.0)); }

std::vector<double> force(const ForceTerm& term, const State& state) {
    std::vector<double> f(state.u.size(), 0.0);
    term.add_force(Trial::of(state), f);
    return f;
}

double work(const ForceTerm& term, const State& from, const State& to) {
    PathEnergies energies;
    term.add_path_energies(Trial::of(from), Trial::of(to), energies);
    return energies.external_work;
}

struct Resultant {
    double x = 0, y = 0, moment = 0;  ///< N, N, N m about the origin
};

/// @param u  displacement: the moment is that of the current positions
Resultant resultant(const Mesh& mesh, const std::vector<double>& f, const std::vector<double>& u) {
    Resultant sum;
    for (std::size_t n = 0; n < mesh.n_nodes(); ++n) {
        sum.x += f[2 * n];
        sum.y += f[2 * n + 1];
        sum.moment += (mesh.nodes[n][0] + u[2 * n]) * f[2 * n + 1] - (mesh.nodes[n][1] + u[2 * n + 1]) * f[2 * n];
    }
    return sum;
}

/// A finite displacement without symmetry, m.
std::vector<double> some_displacement(const Mesh& mesh) {
    std::vector<double> u;
    for (const auto& [x, y] : mesh.nodes) {
        u.push_back(0.2 * x - 0.1 * y + 0.05 * x * y + 0.3);
        u.push_back(-0.15 * x + 0.12 * y * y - 0.7);
    }
    return u;
}

/// Area within the current edges of "outer", m2.
double enclosed_area(const Mesh& mesh, const std::vector<double>& u) {
    double area = 0;
    for (const BoundaryEdge& edge : mesh.boundaries.at("outer")) {
        const auto at = [&](std::int32_t n) {
            const auto i = static_cast<std::size_t>(n);
            return Vec2<double>{mesh.nodes[i][0] + u[2 * i], mesh.nodes[i][1] + u[2 * i + 1]};
        };
        area += 0.5 * cross(at(edge.a), at(edge.b));
    }
    return area;
}

// ---- forces at nodes ------------------------------------------------------------------------------------------------

TEST(NodalForce, Set_FormulaOfPosition_ActsOnEachNode) {
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::nodal_force, "right", Formula("10 + y"), -3.0));
    EXPECT_EQ(term->name(), "nodal force on \"right\"");
    EXPECT_THAT(force(*term, undeformed(mesh)), ElementsAre(0, 0, 10, -3, 11, -3, 0, 0));
}

TEST(NodalForce, NodeThatHasParted_ItsCopiesShareIt) {
    Mesh mesh = test::rectangle_mesh();
    InnerSides inner(mesh);
    const std::vector<NodeCopy> copies =
        inner.open(std::vector<std::int32_t>{0});  // the diagonal: two of its nodes part
    ASSERT_EQ(copies.size(), 2u);
    const auto term = make(mesh, load(LoadKind::nodal_force, "right", 10.0));
    const std::vector<double> f = force(*term, undeformed(mesh));
    double sum = 0;
    for (std::size_t i = 0; i < f.size(); i += 2) sum += f[i];
    EXPECT_EQ(sum, 20) << "two nodes of the set, however often they were copied";
    for (const NodeCopy& copy : copies)
        EXPECT_EQ(f[2 * static_cast<std::size_t>(copy.original)], f[2 * static_cast<std::size_t>(copy.copy)]);
}

TEST(NodalForce, AddForce_OtherForces_AreKept) {
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::nodal_force, "corner", 1.0));
    const State state = undeformed(mesh);
    std::vector<double> f(8, 5.0);
    term->add_force(Trial::of(state), f);
    EXPECT_THAT(f, ElementsAre(5, 5, 5, 5, 6, 5, 5, 5));
}

TEST(NodalForce, Amplitude_Heaviside_SwitchesWithTheEvent) {
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::nodal_force, "corner", 7.0, 0.0, test::heaviside(1)));
    EXPECT_THAT(term->switch_times(), ElementsAre(1));
    State state = undeformed(mesh, 1);
    EXPECT_EQ(force(*term, state)[4], 0);
    state.last_event = 1;
    EXPECT_EQ(force(*term, state)[4], 7);
}

// ---- traction -------------------------------------------------------------------------------------------------------

TEST(Traction, Constant_Boundary_SharesItEvenly) {
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::traction, "top", 100.0, -40.0));  // 2 m x 0.5 m
    EXPECT_THAT(force(*term, undeformed(mesh)),
                Pointwise(DoubleNear(100 * load_round_off), {0.0, 0.0, 0.0, 0.0, 50.0, -20.0, 50.0, -20.0}));
}

TEST(Traction, Linear_Boundary_HasTheExactResultantAndMoment) {
    // t_y = 6 x on 0 <= x <= 2: resultant h 12 N at x = 4/3
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::traction, "bottom", 0.0, Formula("6*x")));
    const State state = undeformed(mesh);
    const Resultant sum = resultant(mesh, force(*term, state), state.u);
    EXPECT_NEAR(sum.y, thickness * 12, 12 * load_round_off);
    EXPECT_NEAR(sum.moment, thickness * 16, 16 * load_round_off);
    EXPECT_EQ(sum.x, 0);
}

TEST(Traction, Dead_LargeDisplacement_ChangesNothing) {
    const Mesh mesh = test::composite_mesh();
    const auto term = make(mesh, load(LoadKind::traction, "outer", Formula("x - y"), Formula("1 + x")));
    EXPECT_EQ(force(*term, state_at(0, some_displacement(mesh))), force(*term, undeformed(mesh)));
}

TEST(Traction, AmplitudeOfPosition_BothEndsOfAnEdge_AreWeighedTheirOwnWay) {
    // the same traction written once as value and once as amplitude
    const Mesh mesh = test::composite_mesh();
    const auto by_value =
        make(mesh, load(LoadKind::traction, "outer", Formula("2*(3 + x - y)"), Formula("5*(3 + x - y)")));
    const auto by_amplitude =
        make(mesh, load(LoadKind::traction, "outer", 2.0, 5.0, test::expression("t*(3 + x - y)")));
    const State from = undeformed(mesh, 1), to = state_at(1, some_displacement(mesh));
    constexpr double scale = 30;  // N
    EXPECT_THAT(force(*by_amplitude, from), Pointwise(DoubleNear(scale * load_round_off), force(*by_value, from)));
    EXPECT_NEAR(work(*by_amplitude, from, to), work(*by_value, from, to), scale * load_round_off);
}

TEST(Traction, Work_ForceThatGrowsWithTime_IsTrapezoidal) {
    // force on "right" in all (4 t) N, displacement u_x = 0.1: 1/2 (4 + 12) 0.1 J
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::traction, "right", 4 / thickness, 0.0, test::expression("t")));
    EXPECT_NEAR(work(*term, undeformed(mesh, 1), state_at(3, {0.1, 0, 0.1, 0, 0.1, 0, 0.1, 0})), 0.8, load_round_off);
}

// ---- body force -----------------------------------------------------------------------------------------------------

TEST(BodyForce, Region_Triangle_GivesAThirdToEachNode) {
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::body_force, "clay", 0.0, -12.0));  // 1 m2 x 0.5 m: -6 N
    EXPECT_THAT(force(*term, undeformed(mesh)),
                Pointwise(DoubleNear(6 * load_round_off), {0.0, -2.0, 0.0, 0.0, 0.0, -2.0, 0.0, -2.0}));
}

TEST(BodyForce, Everything_EmptyName_HasTheExactResultant) {
    for (const Mesh& mesh : {test::rectangle_mesh(), test::composite_mesh()}) {
        const auto term = make(mesh, load(LoadKind::body_force, "", 3.0, -7.0));
        EXPECT_EQ(term->name(), "body force");
        const State state = undeformed(mesh);
        const Resultant sum = resultant(mesh, force(*term, state), state.u);
        const double volume = thickness * enclosed_area(mesh, state.u);
        EXPECT_NEAR(sum.x, 3 * volume, 10 * load_round_off);
        EXPECT_NEAR(sum.y, -7 * volume, 10 * load_round_off);
    }
}

TEST(BodyForce, Composite_SubTriangles_ShareAsWithTheirMass) {
    // straight sides: four equal sub-triangles of 0.75 m2, corners belong to one of them, mid-sides to three
    Mesh mesh = test::composite_mesh();
    mesh.nodes = {{0, 0}, {1.5, 0}, {3, 0}, {1.5, 1}, {0, 2}, {0, 1}};
    const auto term = make(mesh, load(LoadKind::body_force, "rock", 8.0));  // a third of a sub-triangle: 1 N
    std::vector<double> x_components;
    const std::vector<double> f = force(*term, undeformed(mesh));
    for (std::size_t n = 0; n < 6; ++n) x_components.push_back(f[2 * n]);
    EXPECT_THAT(x_components, Pointwise(DoubleNear(load_round_off), {1.0, 3.0, 1.0, 3.0, 1.0, 3.0}));
}

TEST(BodyForce, LinearField_Resultant_IsExact) {
    // integral of 6 y over the rectangle 2 m x 1 m
    const Mesh mesh = test::rectangle_mesh();
    const State state = undeformed(mesh);
    const auto term = make(mesh, load(LoadKind::body_force, "", Formula("6*y")));
    EXPECT_NEAR(resultant(mesh, force(*term, state), state.u).x, thickness * 6, 6 * load_round_off);
}

// ---- follower pressure ----------------------------------------------------------------------------------------------

TEST(Pressure, Positive_FlatBoundary_PushesOntoTheSolid) {
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::pressure, "top", 100.0));
    EXPECT_EQ(term->name(), "pressure on \"top\"");
    EXPECT_THAT(force(*term, undeformed(mesh)),
                Pointwise(DoubleNear(100 * load_round_off), {0.0, 0.0, 0.0, 0.0, 0.0, -50.0, 0.0, -50.0}));
}

TEST(Pressure, Linear_FlatBoundary_HasTheExactResultantAndMoment) {
    // p = 6 x under the bottom edge: h 12 N upwards at x = 4/3
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::pressure, "bottom", Formula("6*x")));
    const State state = undeformed(mesh);
    const Resultant sum = resultant(mesh, force(*term, state), state.u);
    EXPECT_NEAR(sum.y, thickness * 12, 12 * load_round_off);
    EXPECT_NEAR(sum.moment, thickness * 16, 16 * load_round_off);
}

TEST(Pressure, ClosedContour_AnyDeformation_HasNoResultantAndNoMoment) {
    for (const Mesh& mesh : {test::rectangle_mesh(), test::composite_mesh()}) {
        const auto term = make(mesh, load(LoadKind::pressure, "outer", 10.0));
        const State state = state_at(0, some_displacement(mesh));
        const Resultant sum = resultant(mesh, force(*term, state), state.u);
        constexpr double scale = 100;  // N m
        EXPECT_NEAR(sum.x, 0, scale * load_round_off);
        EXPECT_NEAR(sum.y, 0, scale * load_round_off);
        EXPECT_NEAR(sum.moment, 0, scale * load_round_off);
    }
}

TEST(Pressure, Constant_AnyDeformation_IsTheGradientOfPressureTimesEnclosedArea) {
    const Mesh mesh = test::composite_mesh();
    const double p = 10;
    const auto term = make(mesh, load(LoadKind::pressure, "outer", p));
    const State state = state_at(0, some_displacement(mesh));
    const std::vector<double> f = force(*term, state);
    // The area is linear in each coordinate: a central difference of any step is exact but for round-off / step.
    const double step = 0.5, tolerance = p * 10 * load_round_off / step;
    for (std::size_t i = 0; i < f.size(); ++i) {
        std::vector<double> more = state.u, less = state.u;
        more[i] += step;
        less[i] -= step;
        const double gradient = (enclosed_area(mesh, more) - enclosed_area(mesh, less)) / (2 * step);
        EXPECT_NEAR(f[i], -p * thickness * gradient, tolerance) << i;
    }
}

TEST(Pressure, Work_ConstantPressure_IsPressureTimesTheLossOfArea) {
    // the area is quadratic in u, so the trapezoidal rule along a straight step is exact
    const Mesh mesh = test::composite_mesh();
    const auto term = make(mesh, load(LoadKind::pressure, "outer", 10.0));
    const State from = undeformed(mesh), to = state_at(1, some_displacement(mesh));
    const double loss = enclosed_area(mesh, from.u) - enclosed_area(mesh, to.u);
    ASSERT_GT(std::abs(loss), 0.1);
    EXPECT_NEAR(work(*term, from, to), 10 * thickness * loss, 100 * load_round_off);
}

TEST(Pressure, AmplitudeOfPosition_ReferencePositions_Decide) {
    const Mesh mesh = test::composite_mesh();
    const auto by_value = make(mesh, load(LoadKind::pressure, "outer", Formula("2*(3 + x - y)")));
    const auto by_amplitude =
        make(mesh, load(LoadKind::pressure, "outer", 2.0, 0.0, test::expression("t*(3 + x - y)")));
    const State from = undeformed(mesh, 1), to = state_at(1, some_displacement(mesh));
    constexpr double scale = 30;  // N
    EXPECT_THAT(force(*by_amplitude, to), Pointwise(DoubleNear(scale * load_round_off), force(*by_value, to)));
    EXPECT_NEAR(work(*by_amplitude, from, to), work(*by_value, from, to), scale * load_round_off);
}

TEST(Pressure, Work_PressureThatGrowsWithTime_IsTrapezoidal) {
    // "right" moves inwards by 0.1 under p = 4 t: 1/2 (4 + 12) x 1 m x 0.5 m x 0.1 m
    const Mesh mesh = test::rectangle_mesh();
    const auto term = make(mesh, load(LoadKind::pressure, "right", 4.0, 0.0, test::expression("t")));
    EXPECT_NEAR(work(*term, undeformed(mesh, 1), state_at(3, {0, 0, -0.1, 0, -0.1, 0, 0, 0})), 0.4, load_round_off);
}

TEST(EdgePressure, Dual_Derivatives_AreThoseOfTheForces) {
    using D = Dual<2>;
    const Vec2<D> edge{D::variable(1.5, 0), D::variable(-0.4, 1)};
    const auto [on_a, on_b] = edge_pressure_forces(edge, 2.0, 5.0, thickness);
    const auto [plain_a, plain_b] = edge_pressure_forces(Vec2<double>{1.5, -0.4}, 2.0, 5.0, thickness);
    EXPECT_EQ(on_a.x.value, plain_a.x);
    EXPECT_EQ(on_b.y.value, plain_b.y);
    EXPECT_THAT(on_a.x.derivative, ElementsAre(0, DoubleNear(-thickness * 9 / 6, load_round_off)));
    EXPECT_THAT(on_b.y.derivative, ElementsAre(DoubleNear(thickness * 12 / 6, load_round_off), 0));
}

// ---- bad input ------------------------------------------------------------------------------------------------------

TEST(Loads, BadInput_EveryProblemOfEveryEntry_IsReportedAtOnce) {
    const Mesh mesh = test::rectangle_mesh();
    try {
        make_loads(mesh,
                   {load(LoadKind::pressure, "rihgt_", Formula("z"), 0.0, test::ramp(2, 1)),
                    load(LoadKind::traction, "rock", 1.0), load(LoadKind::traction, "top", 1.0),
                    load(LoadKind::body_force, "clai", 1.0), load(LoadKind::nodal_force, "corners", 1.0, Formula("(")),
                    load(LoadKind::traction, "left", Formula("1/x"))},
                   thickness);
        FAIL();
    } catch (const InputError& error) {
        std::vector<std::string> found;
        for (const Problem& problem : error.problems()) found.push_back(problem.where + ": " + problem.message);
        EXPECT_THAT(
            found,
            ElementsAre(
                HasSubstr("[[load]] 1: on = \"rihgt_\": the mesh has no boundary of this name"), HasSubstr("`z`"),
                "[[load]] 1: a ramp must end after its start: start = 2 s, end = 1 s",
                HasSubstr("[[load]] 2: on = \"rock\": this is a region, needed: boundary; there are: \"bottom\""),
                "[[load]] 4: on = \"clai\": the mesh has no region of this name; there are: \"rock\", \"clay\"; did "
                "you "
                "mean \"clay\"?",
                HasSubstr("[[load]] 5: on = \"corners\": the mesh has no boundary or nodes of this name"),
                HasSubstr("[[load]] 5: expression \"(\""), HasSubstr("[[load]] 6: expression \"1/x\"")));
    }
}

TEST(Loads, Several_Entries_KeepTheirOrder) {
    const auto loads =
        make_loads(test::rectangle_mesh(),
                   {load(LoadKind::body_force, "rock", 1.0), load(LoadKind::pressure, "top", 1.0)}, thickness);
    ASSERT_EQ(loads.size(), 2u);
    EXPECT_EQ(loads[0]->name(), "body force on \"rock\"");
    EXPECT_EQ(loads[1]->name(), "pressure on \"top\"");
}

}  // namespace
}  // namespace gneiss
