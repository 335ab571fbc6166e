#pragma once

#include "fe_dealii/explicit_body.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_matrix.h>

#include <map>
#include <vector>

/// Displacement of a linear elastic body in equilibrium, from the elements' own stiffness.
/// @param load nodal forces [N]; @param prescribed displacements by dof, 3 node + component [m]
inline dealii::Vector<double> equilibrium(const bergamo::fe::ExplicitBody &body, const dealii::Vector<double> &load,
                                          const std::map<unsigned int, double> &prescribed)
{
  dealii::AffineConstraints<double> constraints;
  for (const auto &[dof, value] : prescribed)
  {
    constraints.add_line(dof);
    constraints.set_inhomogeneity(dof, value);
  }
  constraints.close();
  const std::size_t n_dofs = 3 * body.n_nodes(), n = body.elements().dofs_per_element();
  dealii::DynamicSparsityPattern pattern(n_dofs);
  dealii::DoFTools::make_sparsity_pattern(body.dof_handler(), pattern, constraints);
  dealii::SparsityPattern fixed_pattern;
  fixed_pattern.copy_from(pattern);
  dealii::SparseMatrix<double> matrix(fixed_pattern);
  dealii::Vector<double> right(load), solution(n_dofs);
  constraints.set_zero(right);
  std::vector<double> stiffness(n * n);
  dealii::FullMatrix<double> local(n, n);
  dealii::Vector<double> nothing(n);
  std::vector<dealii::types::global_dof_index> dofs(n);
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    body.elements().stiffness(e, body.displacement().begin(), stiffness.data());
    local.fill(stiffness.data());
    for (std::size_t i = 0; i < n; ++i)
      dofs[i] = 3 * std::size_t(body.element_nodes(e)[i / 3]) + i % 3;
    constraints.distribute_local_to_global(local, nothing, dofs, matrix, right);
  }
  dealii::SolverControl control(20000, 1e-12 * right.l2_norm());
  dealii::PreconditionSSOR<dealii::SparseMatrix<double>> preconditioner;
  preconditioner.initialize(matrix, 1.2);
  dealii::SolverCG<dealii::Vector<double>>(control).solve(matrix, solution, right, preconditioner);
  constraints.distribute(solution);
  return solution;
}
