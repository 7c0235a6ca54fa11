// Assembly, solution and evaluation by deal.II.
//
// p1, p2:       a(u, v) + int M_v div u div v = l(v),   a(u, v) = int eps(v) : C eps(u)
// taylor_hood:  a(u, v) - int p div v = l(v),   - int q div u - int p q / M_v = 0,   p = -M_v div u
//
// The mixed system is solved for the pressures first, by conjugate gradients on B K^-1 B^T + D with K factorised once.
// Being stable, the pair needs a number of iterations that depends neither on the mesh nor on M_v.

#include <deal.II/base/config.h>
#include <deal.II/base/timer.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/block_sparse_matrix.h>
#include <deal.II/lac/block_vector.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/sparse_matrix.h>

#include <algorithm>
#include <map>
#include <set>

#include "finite_elements.hpp"

namespace gneiss::crosscheck {
namespace {

using dealii::SymmetricTensor;
using dealii::Tensor;
using BlockVector = dealii::BlockVector<double>;
using DealVector = dealii::Vector<double>;

constexpr int displacement = 0, pressure = 1;  // blocks
const dealii::FEValuesExtractors::Vector u_part(0);
const dealii::FEValuesExtractors::Scalar p_part(2);

SymmetricTensor<2, 2> edge_and_angle_stress(const Stiffness& stiffness, const SymmetricTensor<2, 2>& strain) {
    const auto row = [&](int i) {
        const auto& c = stiffness.rest[static_cast<std::size_t>(i)];
        return c[0] * strain[0][0] + c[1] * strain[1][1] + 2 * c[2] * strain[0][1];
    };
    SymmetricTensor<2, 2> stress;
    stress[0][0] = row(0);
    stress[1][1] = row(1);
    stress[0][1] = row(2);
    return stress;
}

/// The matrix that the pressures are scaled by: about that of B K^-1 B^T + D.
double pressure_weight(const Stiffness& stiffness) {
    const auto& c = stiffness.rest;
    return 1 / stiffness.M_v + 3 / (c[0][0] + c[1][1] + 2 * c[2][2]);
}

void factorise(DirectSolver& solver, const dealii::SparseMatrix<double>& matrix) {
    std::vector<std::int64_t> row_starts{0}, columns;
    std::vector<double> values;
    columns.reserve(matrix.n_nonzero_elements());
    values.reserve(matrix.n_nonzero_elements());
    std::vector<std::pair<std::int64_t, double>> row;
    for (unsigned int i = 0; i < matrix.m(); ++i) {
        row.clear();
        for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
            row.emplace_back(entry->column(), entry->value());
        std::sort(row.begin(), row.end());  // deal.II puts the diagonal first
        for (const auto& [column, value] : row) {
            columns.push_back(column);
            values.push_back(value);
        }
        row_starts.push_back(static_cast<std::int64_t>(columns.size()));
    }
    solver.factorise(std::move(row_starts), std::move(columns), values);
}

/// B K^-1 B^T + D: symmetric and positive definite, D = int p q / M_v.
struct SchurComplement {
    const dealii::BlockSparseMatrix<double>& matrix;
    DirectSolver& inverse;
    mutable DealVector right, u, d;

    void vmult(DealVector& out, const DealVector& p) const {
        matrix.block(displacement, pressure).vmult(right, p);
        inverse.solve(right.begin(), u.begin());
        matrix.block(pressure, displacement).vmult(out, u);
        matrix.block(pressure, pressure).vmult(d, p);  // -D p
        out -= d;
    }
};

struct Preconditioner {
    DirectSolver& inverse;
    void vmult(DealVector& out, const DealVector& in) const { inverse.solve(in.begin(), out.begin()); }
};

class Computation {
public:
    Computation(const Elasticity& problem, const MakeSolver& make_solver)
        : problem_(problem),
          make_solver_(make_solver),
          fe_(problem),
          constraints_(fe_.constraints(problem.prescribed)) {}

    Solution run() {
        dealii::Timer timer;
        allocate();
        assemble_loads();
        assemble_matrix();
        timer.stop();
        result_.assembly_seconds = timer.wall_time();
        timer.restart();
        fe_.mixed() ? solve_mixed() : solve_displacement();
        timer.stop();
        result_.solve_seconds = timer.wall_time();
        evaluate();
        return result_;
    }

private:
    using Numbers = std::vector<dealii::types::global_dof_index>;

    const Stiffness& stiffness(const FiniteElements::Cell& cell) const {
        return problem_.stiffness[cell->active_cell_index()];
    }

    void allocate() {
        Numbers sizes(1, static_cast<dealii::types::global_dof_index>(fe_.n_displacements()));
        if (fe_.mixed()) sizes.push_back(static_cast<dealii::types::global_dof_index>(fe_.n_pressures()));
        dealii::BlockDynamicSparsityPattern pattern(sizes, sizes);
        dealii::DoFTools::make_sparsity_pattern(fe_.dof_handler(), pattern, constraints_, true);
        pattern_.copy_from(pattern);
        matrix_.reinit(pattern_);
        for (BlockVector* vector : {&loads_, &right_, &x_}) vector->reinit(sizes);
        if (fe_.mixed()) {
            weight_pattern_.copy_from(pattern.block(pressure, pressure));
            weight_.reinit(weight_pattern_);
        }
        result_.n_unknowns = fe_.n_displacements() + fe_.n_pressures() - problem_.prescribed.size();
    }

    void assemble_matrix() {
        const dealii::Quadrature<2> quadrature = fe_.cell_quadrature();
        dealii::FEValues<2> values(fe_.mapping(), fe_.element(), quadrature,
                                   dealii::update_gradients | dealii::update_values | dealii::update_JxW_values);
        const unsigned int n = fe_.element().n_dofs_per_cell();
        dealii::FullMatrix<double> local(n, n);
        DealVector no_load(n);
        Numbers numbers(n);
        std::vector<SymmetricTensor<2, 2>> strain(n), stress(n);
        std::vector<double> p(n, 0.0);
        for (const auto& cell : fe_.dof_handler().active_cell_iterators()) {
            values.reinit(cell);
            cell->get_dof_indices(numbers);
            local = 0;
            const Stiffness& c = stiffness(cell);
            for (const unsigned int q : values.quadrature_point_indices()) {
                const double volume = problem_.thickness * values.JxW(q);
                for (unsigned int i = 0; i < n; ++i) {
                    strain[i] = values[u_part].symmetric_gradient(i, q);
                    stress[i] = edge_and_angle_stress(c, strain[i]);
                    if (fe_.mixed()) p[i] = values[p_part].value(i, q);
                }
                for (unsigned int i = 0; i < n; ++i)
                    for (unsigned int j = 0; j < n; ++j) {
                        const double div_i = trace(strain[i]), div_j = trace(strain[j]);
                        const double of_volume =
                            fe_.mixed() ? -div_i * p[j] - p[i] * div_j - p[i] * p[j] / c.M_v : c.M_v * div_i * div_j;
                        local(i, j) += volume * (strain[i] * stress[j] + of_volume);
                    }
                if (fe_.mixed()) add_weight(numbers, p, volume * pressure_weight(c));
            }
            constraints_.distribute_local_to_global(local, no_load, numbers, matrix_, right_);
        }
        // what is prescribed has its own rows, without loads
        BlockVector free_loads = loads_;
        constraints_.set_zero(free_loads);
        right_ += free_loads;
    }

    void add_weight(const Numbers& numbers, const std::vector<double>& p, double factor) {
        const auto first = fe_.n_displacements();
        for (unsigned int i = 0; i < numbers.size(); ++i)
            for (unsigned int j = 0; j < numbers.size(); ++j)
                if (numbers[i] >= first && numbers[j] >= first)
                    weight_.add(numbers[i] - first, numbers[j] - first, factor * p[i] * p[j]);
    }

    void assemble_loads() {
        for (const NodalForce& nodal : problem_.nodal_forces)
            for (std::size_t i = 0; i < 2; ++i) loads_(fe_.dof(2 * nodal.node + i)) += nodal.force[i];
        for (const BodyForce& load : problem_.body_forces) assemble(load);
        for (const Traction& load : problem_.tractions) assemble(load);
    }

    void assemble(const BodyForce& load) {
        const dealii::Quadrature<2> quadrature = fe_.body_force_quadrature();
        dealii::FEValues<2> values(
            fe_.mapping(), fe_.element(), quadrature,
            dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values);
        std::vector<bool> loaded(problem_.n_cells(), false);
        for (const std::int32_t cell : load.cells) loaded[static_cast<std::size_t>(cell)] = true;
        for (const auto& cell : fe_.dof_handler().active_cell_iterators()) {
            if (!loaded[cell->active_cell_index()]) continue;
            values.reinit(cell);
            for (const unsigned int q : values.quadrature_point_indices()) {
                const dealii::Point<2> place = values.quadrature_point(q);
                add(cell, values, q, load.value({place[0], place[1]}));
            }
        }
    }

    void assemble(const Traction& load) {
        const dealii::Quadrature<1> quadrature = fe_.traction_quadrature();
        dealii::FEFaceValues<2> values(fe_.mapping(), fe_.element(), quadrature,
                                       dealii::update_values | dealii::update_quadrature_points |
                                           dealii::update_normal_vectors | dealii::update_JxW_values);
        // by the positions of corners: deal.II has numbers of its own for them
        const auto key = [](const dealii::Point<2>& a, const dealii::Point<2>& b) {
            return std::array<double, 4>{a[0], a[1], b[0], b[1]};
        };
        const auto corner = [&](std::int32_t node) {
            const Vector& x = problem_.nodes[static_cast<std::size_t>(node)];
            return dealii::Point<2>(x[0], x[1]);
        };
        const bool linear = problem_.element == Element::p1;
        std::set<std::array<double, 4>> loaded;
        for (const auto& [a, b] : load.sides) {
            loaded.insert(key(corner(a), corner(b)));
            if (linear) loaded.insert(key(corner(b), corner(a)));
        }
        for (const auto& cell : fe_.dof_handler().active_cell_iterators())
            for (const unsigned int f : cell->face_indices()) {
                const auto& face = cell->face(f);
                const std::array ends{face->vertex(0), face->vertex(1)};
                if (loaded.count(key(ends[0], ends[1])) + loaded.count(key(ends[1], ends[0])) == 0 ||
                    !face->at_boundary())
                    continue;
                values.reinit(cell, f);
                for (const unsigned int q : values.quadrature_point_indices()) {
                    const dealii::Point<2> place = values.quadrature_point(q);
                    const Vector normal{values.normal_vector(q)[0], values.normal_vector(q)[1]};
                    const auto at = [&](const dealii::Point<2>& x) { return load.value({x[0], x[1]}, normal); };
                    const double s = place.distance(ends[0]) / face->diameter();
                    const bool second = s > 0.5;
                    if (loaded.count(key(ends[second], ends[!second])) == 0) continue;
                    if (!linear) {
                        add(cell, values, q, at(place));
                        continue;
                    }
                    const Vector first = at(ends[0]), last = at(ends[1]);
                    add(cell, values, q, {(1 - s) * first[0] + s * last[0], (1 - s) * first[1] + s * last[1]});
                }
            }
    }

    template <class Values>
    void add(const FiniteElements::Cell& cell, const Values& values, unsigned int q, const Vector& force) {
        Numbers numbers(fe_.element().n_dofs_per_cell());
        cell->get_dof_indices(numbers);
        const Tensor<1, 2> f({force[0], force[1]});
        for (unsigned int i = 0; i < numbers.size(); ++i)
            loads_(numbers[i]) += problem_.thickness * values.JxW(q) * (values[u_part].value(i, q) * f);
    }

    void solve_displacement() {
        const auto inverse = make_solver_();
        const auto& matrix = matrix_.block(displacement, displacement);
        const auto& f = right_.block(displacement);
        auto& u = x_.block(displacement);
        factorise(*inverse, matrix);
        inverse->solve(f.begin(), u.begin());
        DealVector left_over(f.size()), change(f.size());
        matrix.residual(left_over, u, f);
        inverse->solve(left_over.begin(), change.begin());
        u += change;  // what the condition of nearly incompressible solids has cost comes back
        finish();
    }

    void solve_mixed() {
        const auto inverse = make_solver_(), inverse_weight = make_solver_();
        factorise(*inverse, matrix_.block(displacement, displacement));
        factorise(*inverse_weight, weight_);
        const auto &f = right_.block(displacement), &g = right_.block(pressure);
        auto &u = x_.block(displacement), &p = x_.block(pressure);
        DealVector right(p.size()), change(f.size());
        inverse->solve(f.begin(), u.begin());
        matrix_.block(pressure, displacement).vmult(right, u);
        right -= g;

        constexpr double tolerance = 1e-13;  // of the pressures' equations; the displacements follow to as many digits
        dealii::SolverControl control(1000, tolerance * right.l2_norm());
        SchurComplement complement{matrix_, *inverse, DealVector(f.size()), DealVector(f.size()), DealVector(p.size())};
        dealii::SolverCG<DealVector>(control).solve(complement, p, right, Preconditioner{*inverse_weight});
        result_.iterations = static_cast<int>(control.last_step());

        matrix_.block(displacement, pressure).vmult(change, p);
        change.sadd(-1, f);
        inverse->solve(change.begin(), u.begin());
        finish();
    }

    void finish() {
        BlockVector residual(right_);
        matrix_.vmult(residual, x_);
        residual -= right_;
        constraints_.set_zero(residual);
        BlockVector free_right(right_);
        constraints_.set_zero(free_right);
        const double size = free_right.l2_norm();
        result_.residual = size > 0 ? residual.l2_norm() / size : residual.l2_norm();
        constraints_.distribute(x_);
    }

    void evaluate() {
        result_.compliance = loads_ * x_;
        result_.displacement.resize(problem_.nodes.size());
        for (std::size_t node = 0; node < problem_.nodes.size(); ++node)
            result_.displacement[node] = {x_(fe_.dof(2 * node)), x_(fe_.dof(2 * node + 1))};
        evaluate_energy();
        result_.stress_at.resize(problem_.stress_at.size());
        at_places(problem_.stress_at, dealii::update_gradients | dealii::update_values,
                  [&](std::size_t k, const dealii::FEValues<2>& values, const FiniteElements::Cell& cell) {
                      result_.stress_at[k] = stress(values, stiffness(cell));
                  });
        result_.displacement_at.resize(problem_.displacement_at.size());
        at_places(problem_.displacement_at, dealii::update_values,
                  [&](std::size_t k, const dealii::FEValues<2>& values, const FiniteElements::Cell&) {
                      std::vector<Tensor<1, 2>> u(1);
                      values[u_part].get_function_values(x_, u);
                      result_.displacement_at[k] = {u[0][0], u[0][1]};
                  });
    }

    PointStress stress(const dealii::FEValues<2>& values, const Stiffness& c) const {
        std::vector<SymmetricTensor<2, 2>> strain(1);
        values[u_part].get_function_symmetric_gradients(x_, strain);
        std::vector<double> p{-c.M_v * trace(strain[0])};
        if (fe_.mixed()) values[p_part].get_function_values(x_, p);
        const SymmetricTensor<2, 2> rest = edge_and_angle_stress(c, strain[0]);
        return {{rest[0][0] - p[0], rest[1][1] - p[0], rest[0][1]}, p[0]};
    }

    void evaluate_energy() {
        const dealii::Quadrature<2> quadrature = fe_.cell_quadrature();
        dealii::FEValues<2> values(fe_.mapping(), fe_.element(), quadrature,
                                   dealii::update_gradients | dealii::update_values | dealii::update_JxW_values);
        std::vector<SymmetricTensor<2, 2>> strain(quadrature.size());
        std::vector<double> p(quadrature.size());
        for (const auto& cell : fe_.dof_handler().active_cell_iterators()) {
            values.reinit(cell);
            const Stiffness& c = stiffness(cell);
            values[u_part].get_function_symmetric_gradients(x_, strain);
            if (fe_.mixed()) values[p_part].get_function_values(x_, p);
            for (const unsigned int q : values.quadrature_point_indices()) {
                const double dilation = trace(strain[q]);
                const double of_volume = fe_.mixed() ? p[q] * p[q] / c.M_v : c.M_v * dilation * dilation;
                result_.strain_energy += 0.5 * problem_.thickness * values.JxW(q) *
                                         (strain[q] * edge_and_angle_stress(c, strain[q]) + of_volume);
            }
        }
    }

    /// Calls visit(number, values, cell) for every place: places at one point of their cells share the shape functions.
    template <class Visit>
    void at_places(const std::vector<Place>& places, dealii::UpdateFlags flags, Visit visit) const {
        std::map<Vector, std::map<std::int32_t, std::vector<std::size_t>>> by_point;
        for (std::size_t k = 0; k < places.size(); ++k) by_point[places[k].unit][places[k].cell].push_back(k);
        for (const auto& [unit, by_cell] : by_point) {
            dealii::FEValues<2> values(fe_.mapping(), fe_.element(),
                                       dealii::Quadrature<2>(dealii::Point<2>(unit[0], unit[1])), flags);
            for (const auto& [number, list] : by_cell) {
                const FiniteElements::Cell cell(&fe_.dof_handler().get_triangulation(), 0, number, &fe_.dof_handler());
                values.reinit(cell);
                for (const std::size_t k : list) visit(k, values, cell);
            }
        }
    }

    const Elasticity& problem_;
    const MakeSolver& make_solver_;
    FiniteElements fe_;
    dealii::AffineConstraints<double> constraints_;
    dealii::BlockSparsityPattern pattern_;
    dealii::BlockSparseMatrix<double> matrix_;
    dealii::SparsityPattern weight_pattern_;
    dealii::SparseMatrix<double> weight_;
    BlockVector loads_, right_, x_;
    Solution result_;
};

}  // namespace

Solution solve(const Elasticity& problem, const MakeSolver& make_solver) {
    return Computation(problem, make_solver).run();
}

std::string deal_ii_version() { return DEAL_II_PACKAGE_VERSION; }

}  // namespace gneiss::crosscheck
