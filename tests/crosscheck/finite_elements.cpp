#include "finite_elements.hpp"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <stdexcept>

namespace gneiss::crosscheck {
namespace {

dealii::FESystem<2> element_of(Element kind) {
    const dealii::FE_SimplexP<2> linear(1), quadratic(2);
    if (kind == Element::p1) return dealii::FESystem<2>(linear, 2);
    if (kind == Element::p2) return dealii::FESystem<2>(quadratic, 2);
    return dealii::FESystem<2>(quadratic, 2, linear, 1);
}

/// The cells by their corners; mid-sides are none of deal.II's vertices.
void make_triangulation(const Elasticity& problem, dealii::Triangulation<2>& triangulation) {
    const std::size_t stride = problem.nodes_per_cell();
    std::vector<int> vertex_of(problem.nodes.size(), -1);
    std::vector<dealii::Point<2>> vertices;
    std::vector<dealii::CellData<2>> cells;
    cells.reserve(problem.n_cells());
    for (std::size_t c = 0; c < problem.n_cells(); ++c) {
        dealii::CellData<2> cell(3);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto node = static_cast<std::size_t>(problem.cells[stride * c + k * (stride / 3)]);
            if (vertex_of[node] < 0) {
                vertex_of[node] = static_cast<int>(vertices.size());
                vertices.emplace_back(problem.nodes[node][0], problem.nodes[node][1]);
            }
            cell.vertices[k] = static_cast<unsigned int>(vertex_of[node]);
        }
        cells.push_back(cell);
    }
    triangulation.create_triangulation(vertices, cells, dealii::SubCellData());
}

}  // namespace

FiniteElements::FiniteElements(const Elasticity& problem)
    : kind_(problem.element),
      mapping_(dealii::FE_SimplexP<2>(1)),
      element_(element_of(problem.element)),
      dof_handler_(triangulation_),
      dof_of_(2 * problem.nodes.size(), dealii::numbers::invalid_dof_index) {
    make_triangulation(problem, triangulation_);
    dof_handler_.distribute_dofs(element_);
    if (kind_ == Element::taylor_hood) dealii::DoFRenumbering::component_wise(dof_handler_, {0, 0, 1});
    n_displacements_ = 2 * problem.nodes.size();
    n_pressures_ = dof_handler_.n_dofs() - n_displacements_;

    const std::size_t stride = problem.nodes_per_cell();
    std::vector<dealii::types::global_dof_index> numbers(element_.n_dofs_per_cell());
    for (const Cell& cell : dof_handler_.active_cell_iterators()) {
        const std::int32_t* nodes = problem.cells.data() + stride * cell->active_cell_index();
        cell->get_dof_indices(numbers);
        for (unsigned int i = 0; i < numbers.size(); ++i) {
            const auto [component, shape] = element_.system_to_component_index(i);
            if (component == 2) continue;
            // deal.II counts the corners 0, 1, 2, then the sides 0-1, 1-2, 2-0
            const unsigned int local = stride == 3 ? shape : shape < 3 ? 2 * shape : 2 * (shape - 3) + 1;
            const auto node = static_cast<std::size_t>(nodes[local]);
            const dealii::Point<2> place =
                mapping_.transform_unit_to_real_cell(cell, element_.get_unit_support_points()[i]);
            const dealii::Point<2> ours(problem.nodes[node][0], problem.nodes[node][1]);
            if (place.distance(ours) > 1e-10 * cell->diameter())
                throw std::logic_error("a node of deal.II is not where ours is");
            dof_of_[2 * node + component] = numbers[i];
        }
    }
}

dealii::AffineConstraints<double> FiniteElements::constraints(const std::vector<Prescribed>& prescribed) const {
    dealii::AffineConstraints<double> constraints;
    for (const Prescribed& p : prescribed) {
        constraints.add_line(dof(p.dof));
        constraints.set_inhomogeneity(dof(p.dof), p.value);
    }
    constraints.close();
    return constraints;
}

dealii::Quadrature<2> FiniteElements::cell_quadrature() const {
    return dealii::QWitherdenVincentSimplex<2>(kind_ == Element::p1 ? 1 : 2);
}

dealii::Quadrature<2> FiniteElements::body_force_quadrature() const {
    if (kind_ != Element::p1) return dealii::QWitherdenVincentSimplex<2>(4);
    return dealii::Quadrature<2>({{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}, std::vector<double>(3, 1.0 / 6));
}

dealii::Quadrature<1> FiniteElements::traction_quadrature() const {
    // in halves: a load may jump at a mid-side node
    return dealii::QIterated<1>(dealii::QGauss<1>(kind_ == Element::p1 ? 2 : 4), 2);
}

}  // namespace gneiss::crosscheck
