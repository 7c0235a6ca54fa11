// Observed orders against a field whose body force is known in closed form, on an unstructured mesh cut into four again
// and again.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "crosscheck/crosscheck_testing.hpp"
#include "mesh/make_mesh.hpp"
#include "mesh/measure.hpp"

namespace gneiss::crosscheck {
namespace {

using test::solve_deck;
using test::Solved;

struct Errors {
    double displacement, stress;  ///< root mean squares, m and Pa
};

struct Field {
    std::string body_force, displacement;
    std::function<Vector(const Vector&)> u;
    std::function<std::array<double, 3>(const Vector&)> cauchy;
    std::string material;
};

/// u = (sin(x + 2y), cos(3x - y)) in anisotropic rock with its axes along x and y, moduli of 1 Pa.
Field wavy() {
    constexpr double c11 = 1.2, c22 = 2.0, c12 = 0.4, c66 = 0.45;
    // sums of second derivatives: u_xx = -s, u_xy = -2s, u_yy = -4s, v_xx = -9k, v_xy = 3k, v_yy = -k
    return {fmt::format("[\"{}*sin(x+2*y) - {}*cos(3*x-y)\", \"{}*sin(x+2*y) + {}*cos(3*x-y)\"]", c11 + 4 * c66,
                        3 * c12 + 3 * c66, 2 * c66 + 2 * c12, 9 * c66 + c22),
            "[\"sin(x+2*y)\", \"cos(3*x-y)\"]",
            [](const Vector& x) {
                return Vector{std::sin(x[0] + 2 * x[1]), std::cos(3 * x[0] - x[1])};
            },
            [](const Vector& x) {
                const double c = std::cos(x[0] + 2 * x[1]), s = std::sin(3 * x[0] - x[1]);
                return std::array{c11 * c + c12 * s, c12 * c + c22 * s, c66 * (2 * c - 3 * s)};
            },
            "{ M_v = 0.4, M_alpha = 0.8, M_beta = 1.6, M_psi = 0.9 }"};
}

/// u = (sin x cos y, -cos x sin y), without any change of volume, in an isotropic solid of M = 1 Pa, any M_v.
Field isochoric(double M_v) {
    return {"[\"sin(x)*cos(y)\", \"-cos(x)*sin(y)\"]", "[\"sin(x)*cos(y)\", \"-cos(x)*sin(y)\"]",
            [](const Vector& x) {
                return Vector{std::sin(x[0]) * std::cos(x[1]), -std::cos(x[0]) * std::sin(x[1])};
            },
            [](const Vector& x) {
                const double e = std::cos(x[0]) * std::cos(x[1]);
                return std::array{e, -e, 0.0};
            },
            fmt::format("{{ M_v = {}, M_alpha = 1, M_beta = 1, M_psi = 1 }}", M_v)};
}

std::string deck_of(const Field& field) {
    std::string deck = fmt::format(
        R"toml(mesh = {{ generator = "plate_with_hole", side = 3, radius = 0.5, size = [0.3, 0.5], curved = false }}
solid = {{ plane = "strain" }}
material = [{{ density = 1, constants = {} }}]
load = [{{ type = "body_force", value = {} }}]
boundary = [{{ on = "outer", type = "displacement", value = {} }}, {{ on = "hole", type = "displacement", value = {} }}]
run = {{ t_end = 1 }}
[output]
probes = [
)toml",
        field.material, field.body_force, field.displacement, field.displacement);
    for (int i = 0; i < 40; ++i)  // around the hole, on no node
        deck += fmt::format("{{ name = \"p{}\", at = [{}, {}] }},\n", i, (0.8 + 0.013 * i) * std::cos(0.71 * i),
                            (0.8 + 0.013 * i) * std::sin(0.71 * i));
    return deck + "]\n";
}

Errors errors(const Field& field, Element element, int refine) {
    const std::string deck = deck_of(field);
    const Solved solved = solve_deck(deck, element, refine);
    const CaseOptions options = parse_deck(deck, "deck");
    Errors sum{0, 0};
    const auto& probes = options.output.probes;
    for (std::size_t k = 0; k < probes.size(); ++k) {
        const Vector u = field.u(probes[k].at);
        for (std::size_t i = 0; i < 2; ++i)
            sum.displacement += std::pow(solved.solution.displacement_at[k][i] - u[i], 2);
    }
    const auto places = element_centroids(make_mesh(options.mesh, false, {}));
    for (std::size_t t = 0; t < places.size(); ++t) {
        const auto cauchy = field.cauchy(places[t]);
        for (std::size_t i = 0; i < 3; ++i)
            sum.stress += std::pow(solved.solution.stress_at[t].cauchy[i] - cauchy[i], 2);
    }
    const auto mean = [](double squares, std::size_t n) { return std::sqrt(squares / static_cast<double>(n)); };
    return {mean(sum.displacement, probes.size()), mean(sum.stress, places.size())};
}

/// Per halving of the cells, from the first to the third.
Errors orders(const Field& field, Element element) {
    const Errors coarse = errors(field, element, 1), fine = errors(field, element, 3);
    return {0.5 * std::log2(coarse.displacement / fine.displacement), 0.5 * std::log2(coarse.stress / fine.stress)};
}

/// Forty places lie elsewhere in their cells on each mesh, and errors differ within a cell.
constexpr double order_tolerance = 0.2;

TEST(Convergence, EveryElement_HasItsOrder) {
    for (const Element element : test::every_element) {
        const double degree = element == Element::p1 ? 1 : 2;
        const Errors order = orders(wavy(), element);
        EXPECT_NEAR(order.displacement, degree + 1, order_tolerance) << static_cast<int>(element);
        EXPECT_NEAR(order.stress, degree, order_tolerance) << static_cast<int>(element);
    }
}

TEST(TaylorHood, NearlyIncompressible_KeepsOrderAndError_WhereLinearTrianglesLock) {
    constexpr double M_v = 1e5;
    const Errors order = orders(isochoric(M_v), Element::taylor_hood);
    EXPECT_NEAR(order.displacement, 3, order_tolerance);
    EXPECT_NEAR(order.stress, 2, order_tolerance);
    // as a compressible solid, to some per cent
    const Errors stiff = errors(isochoric(M_v), Element::taylor_hood, 1),
                 soft = errors(isochoric(1), Element::taylor_hood, 1);
    EXPECT_NEAR(stiff.displacement / soft.displacement, 1, 0.05);
    EXPECT_NEAR(stiff.stress / soft.stress, 1, 0.05);
    EXPECT_GT(errors(isochoric(M_v), Element::p1, 1).displacement,
              10 * errors(isochoric(1), Element::p1, 1).displacement);
}

/// u_y of VERIFICATION 6, by elements that are not ours. The clamp ends in a singular corner, so that errors fall by a
/// constant factor from mesh to mesh, which Aitken's extrapolation takes from three of them.
double cooks_deflection(const char* plane, const char* nu, Element element) {
    std::array<double, 3> u{};
    for (int refine = 0; refine < 3; ++refine)
        u[static_cast<std::size_t>(refine)] = solve_deck(fmt::format(R"toml(
mesh = {{ generator = "quadrilateral", corners = [[0, 0], [48, 44], [48, 60], [0, 44]], cells = [16, 16] }}
solid = {{ plane = "{}" }}
material = [{{ density = 1, constants = {{ E = 1, nu = {} }} }}]
load = [{{ on = "right", type = "traction", value = [0, 0.0625] }}]
boundary = [{{ on = "left", type = "fixed" }}]
run = {{ t_end = 1 }}
output = {{ probes = [{{ name = "middle", at = [48, 52] }}] }}
)toml",
                                                                     plane, nu),
                                                         element, refine)
                                                  .solution.displacement_at.at(0)[1];
    return u[2] - (u[2] - u[1]) * (u[2] - u[1]) / ((u[2] - u[1]) - (u[1] - u[0]));
}

TEST(CooksMembrane, QuadraticAndTaylorHood_GiveTheReferenceValues) {
    constexpr double tolerance = 2e-4;  // the last of the steps that are extrapolated are 0.05 and 0.2 %
    EXPECT_NEAR(cooks_deflection("stress", "0.33333333333333333", Element::p2) / 23.968, 1, tolerance);
    EXPECT_NEAR(cooks_deflection("strain", "0.4999", Element::taylor_hood) / 18.512, 1, tolerance);
}

}  // namespace
}  // namespace gneiss::crosscheck
