#pragma once
// Small-strain elasticity on straight triangles as plain data: what passes between gneiss, which reads a deck, and
// deal.II, which computes. C++17 and no header of either: the two sides are compiled with flags of their own.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gneiss::crosscheck {

using Vector = std::array<double, 2>;

/// Linear, quadratic, or quadratic displacement with linear continuous pressure (Taylor and Hood).
enum class Element { p1, p2, taylor_hood };

/// sigma = M_v tr(eps) I + C eps in x and y: C is what the constants of the edges and of the angle give.
struct Stiffness {
    double M_v;                                 ///< Pa
    std::array<std::array<double, 3>, 3> rest;  ///< C, Pa: (xx, yy, xy) from (xx, yy, 2 xy)
};

/// A component of the displacement that is given.
struct Prescribed {
    std::size_t dof;  ///< 2 node + component
    double value;     ///< m
};

struct NodalForce {
    std::size_t node;
    Vector force;  ///< N
};

/// Force per area of sides of cells.
struct Traction {
    /// Corner nodes. p1: sides, each once. Else: halves of sides, each by its corner and the corner at the other end.
    std::vector<std::array<std::int32_t, 2>> sides;
    /// Pa, at a place (m) where the outward unit normal is `normal`.
    std::function<Vector(const Vector& place, const Vector& normal)> value;
};

/// Force per volume of cells.
struct BodyForce {
    std::vector<std::int32_t> cells;
    std::function<Vector(const Vector& place)> value;  ///< N/m3
};

/// A point of a cell, in coordinates in which its corners are (0, 0), (1, 0), (0, 1).
struct Place {
    std::int32_t cell;
    Vector unit;
};

/// Find u with div sigma + f = 0.
///
/// With p1, which is to be what CST is, the loads are taken as CST take them: a traction is linear between its values
/// at the ends of a side, a body force acts by its values at the corners, a third of the area each. The other elements
/// integrate the loads as they are given.
struct Elasticity {
    Element element = Element::p1;
    double thickness = 1;                  ///< m
    std::vector<Vector> nodes;             ///< m; all that carry a displacement
    std::vector<std::int32_t> cells;       ///< shape (n_cells, nodes_per_cell()), counter-clockwise: the corners, or
                                           ///< the six of mesh/composite.hpp with mid-sides in the middle
    std::vector<Stiffness> stiffness;      ///< shape (n_cells)
    std::vector<Prescribed> prescribed;    ///< each dof once
    std::vector<NodalForce> nodal_forces;  ///< a node may occur more than once
    std::vector<Traction> tractions;
    std::vector<BodyForce> body_forces;
    std::vector<Place> stress_at, displacement_at;  ///< where the solution is wanted, beside the nodes

    std::size_t nodes_per_cell() const { return element == Element::p1 ? 3 : 6; }
    std::size_t n_cells() const { return cells.size() / nodes_per_cell(); }
};

struct PointStress {
    std::array<double, 3> cauchy;  ///< xx, yy, xy, Pa
    double pressure;               ///< -M_v tr(eps), Pa; of taylor_hood the unknown itself
};

struct Solution {
    std::vector<Vector> displacement;     ///< m, shape (nodes)
    std::vector<Vector> displacement_at;  ///< m
    std::vector<PointStress> stress_at;
    double compliance = 0;       ///< work of the loads, J: sum of force times displacement
    double strain_energy = 0;    ///< J
    std::size_t n_unknowns = 0;  ///< free displacements and, of taylor_hood, pressures
    int iterations = 0;          ///< of conjugate gradients on the pressures, taylor_hood
    double residual = 0;         ///< |b - A x| / |b|, b without what is prescribed
    double assembly_seconds = 0, solve_seconds = 0;
};

/// Direct solver of symmetric positive definite systems, handed in because deal.II's own (UMFPACK) takes twice the
/// memory and more time.
class DirectSolver {
public:
    virtual ~DirectSolver() = default;
    /// Compressed rows, ascending columns.
    virtual void factorise(std::vector<std::int64_t> row_starts, std::vector<std::int64_t> columns,
                           const std::vector<double>& values) = 0;
    /// @param x  overwritten; both of the size of the matrix
    virtual void solve(const double* b, double* x) = 0;
};
using MakeSolver = std::function<std::unique_ptr<DirectSolver>()>;

/// By deal.II.
/// @throws what the direct solver and the loads throw
Solution solve(const Elasticity& problem, const MakeSolver& make_solver);

/// "9.4.1"
std::string deal_ii_version();

}  // namespace gneiss::crosscheck
