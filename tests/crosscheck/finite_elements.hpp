#pragma once
// deal.II's side: the mesh, the unknowns and their numbers.

#include <deal.II/base/point.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <vector>

#include "elasticity.hpp"

namespace gneiss::crosscheck {

/// Everything but the equations. Displacements come first, then pressures.
class FiniteElements {
public:
    using Cell = dealii::DoFHandler<2>::active_cell_iterator;

    explicit FiniteElements(const Elasticity& problem);

    const dealii::Mapping<2>& mapping() const { return mapping_; }
    const dealii::FESystem<2>& element() const { return element_; }
    const dealii::DoFHandler<2>& dof_handler() const { return dof_handler_; }
    bool mixed() const { return n_pressures_ > 0; }
    std::size_t n_displacements() const { return n_displacements_; }
    std::size_t n_pressures() const { return n_pressures_; }

    /// deal.II's number of 2 node + component.
    dealii::types::global_dof_index dof(std::size_t ours) const { return dof_of_[ours]; }
    /// The prescribed displacements.
    dealii::AffineConstraints<double> constraints(const std::vector<Prescribed>& prescribed) const;

    /// Exact for products of strains of two functions of the element, and of their values.
    dealii::Quadrature<2> cell_quadrature() const;
    /// For loads, see Elasticity.
    dealii::Quadrature<2> body_force_quadrature() const;
    dealii::Quadrature<1> traction_quadrature() const;

private:
    Element kind_;
    dealii::Triangulation<2> triangulation_;
    dealii::MappingFE<2> mapping_;
    dealii::FESystem<2> element_;
    dealii::DoFHandler<2> dof_handler_;
    std::size_t n_displacements_ = 0, n_pressures_ = 0;
    std::vector<dealii::types::global_dof_index> dof_of_;  ///< shape (2 n_nodes)
};

}  // namespace gneiss::crosscheck
