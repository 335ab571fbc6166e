#include "fe_dealii/equilibrium/tangent_system.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "fe_dealii/explicit_body.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <ml_MultiLevelPreconditioner.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

namespace bergamo::fe
{
namespace
{

constexpr std::size_t block_elements = 128; // whose matrices are held at the same time

/// Amesos prints what MUMPS says of a singular matrix, which here is an answer like others, and has no switch for it.
class QuietErrors
{
public:
  QuietErrors() : before_(std::cerr.rdstate()) { std::cerr.setstate(std::ios::failbit); }
  ~QuietErrors() { std::cerr.clear(before_); }
  QuietErrors(const QuietErrors &) = delete;
  QuietErrors &operator=(const QuietErrors &) = delete;

private:
  std::ios::iostate before_;
};

/// Throws what deal.II throws.
void solve_directly(const dealii::TrilinosWrappers::SparseMatrix &matrix, dealii::Vector<double> &left,
                    const dealii::Vector<double> &right)
{
  using Direct = dealii::TrilinosWrappers::SolverDirect;
  const QuietErrors quiet;
  dealii::SolverControl control;
  Direct(control, Direct::AdditionalData(false, "Amesos_Mumps")).solve(matrix, left, right);
}

} // namespace

struct TangentSystem::Trilinos
{
  bool is_direct = false, is_symmetric = true;
  dealii::TrilinosWrappers::SparseMatrix matrix;
  dealii::TrilinosWrappers::SparseMatrix elastic; // of the preconditioner
  dealii::TrilinosWrappers::PreconditionAMG preconditioner;
  dealii::Vector<double> right, left;

  /// @param element_matrix element_matrix(element, matrix); for the others see assemble_elastic()
  template <class ElementMatrix>
  void assemble(const ExplicitBody &body, const ElementMatrix &element_matrix, std::span<const double> moved,
                std::span<double> pull);
  void precondition(const ExplicitBody &body);
};

TangentSystem::TangentSystem(const ExplicitBody &body, const std::size_t direct_limit)
    : trilinos(std::make_unique<Trilinos>()), body(body)
{
  if (!dealii::Utilities::MPI::job_supports_mpi())
    throw RunError("static equilibrium: MPI is not initialized; create a MpiSession at the start "
                   "of the program");
  const std::size_t n_dofs = 3 * body.n_nodes();
  trilinos->is_direct = n_dofs <= direct_limit;
  dealii::DynamicSparsityPattern pattern(n_dofs, n_dofs);
  for (const NodeImages::Group &group : body.images().groups())
    for (const unsigned int node : group.nodes)
      for (unsigned int i = 0; i < 3; ++i)
        pattern.add(3 * node + i, 3 * node + i);
  std::vector<unsigned int> columns;
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    columns.clear();
    for (const unsigned int node : body.element_nodes(e))
      for (unsigned int i = 0; i < 3; ++i)
        columns.push_back(3 * body.images().first_of(node) + i);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (const unsigned int row : columns)
      pattern.add_entries(row, columns.begin(), columns.end(), true);
  }
  trilinos->matrix.reinit(pattern);
  trilinos->right.reinit(n_dofs);
  trilinos->left.reinit(n_dofs);
}

TangentSystem::~TangentSystem() = default;

template <class ElementMatrix>
void TangentSystem::Trilinos::assemble(const ExplicitBody &body, const ElementMatrix &element_matrix,
                                       const std::span<const double> moved, const std::span<double> pull)
{
  const ElementGroup &elements = body.elements();
  const std::size_t n = elements.dofs_per_element();
  std::fill(pull.begin(), pull.end(), 0.);
  matrix = 0;
  std::vector<double> matrices(block_elements * n * n), values(n);
  std::vector<dealii::types::global_dof_index> dofs(n), columns(n);
  for (std::size_t first = 0; first < elements.size(); first += block_elements)
  {
    const std::size_t end = std::min(elements.size(), first + block_elements);
    parallel_for(end - first, [&](const std::size_t k) { element_matrix(first + k, &matrices[k * n * n]); });
    for (std::size_t e = first; e < end; ++e)
    {
      for (std::size_t k = 0; k < n; ++k)
        dofs[k] = 3 * std::size_t(body.images().first_of(elements.nodes(e)[k / 3])) + k % 3;
      for (std::size_t row = 0; row < n; ++row)
      {
        const double *const entries = &matrices[((e - first) * n + row) * n];
        if (const std::size_t own = 3 * std::size_t(elements.nodes(e)[row / 3]) + row % 3; own != dofs[row])
          matrix.add(own, own, std::abs(entries[row])); // of an image, whose own equation is empty
        if (body.constraint_of(dofs[row]))
        {
          matrix.add(dofs[row], dofs[row], std::abs(entries[row])); // of the others' size, for their scaling
          continue;
        }
        std::size_t n_free = 0;
        for (std::size_t column = 0; column < n; ++column)
          if (body.constraint_of(dofs[column]))
            pull[dofs[row]] -= entries[column] * moved[dofs[column]];
          else
          {
            columns[n_free] = dofs[column];
            values[n_free++] = entries[column];
          }
        matrix.add(dofs[row], n_free, columns.data(), values.data(), false);
      }
    }
  }
  matrix.compress(dealii::VectorOperation::add);
}

void TangentSystem::assemble_elastic(const double *displacement, const std::span<const double> moved,
                                     const std::span<double> pull)
{
  trilinos->assemble(
      body, [&](const std::size_t e, double *matrix) { body.elements().stiffness(e, displacement, matrix); }, moved,
      pull);
  trilinos->is_symmetric = true;
  if (!trilinos->is_direct)
    trilinos->precondition(body);
}

void TangentSystem::assemble_tangent(const double *displacement, const double *before)
{
  const std::vector<double> moved(3 * body.n_nodes(), 0.);
  std::vector<double> pull(moved.size());
  trilinos->assemble(
      body, [&](const std::size_t e, double *matrix) { body.elements().tangent(e, displacement, before, matrix); },
      moved, pull);
  trilinos->is_symmetric = body.elements().has_symmetric_tangent();
}

void TangentSystem::Trilinos::precondition(const ExplicitBody &body)
{
  elastic.copy_from(matrix);
  const std::size_t n_dofs = matrix.m();
  std::array<double, 3> centre{};
  for (const auto &position : body.node_position())
    for (int i = 0; i < 3; ++i)
      centre[i] += position[i] / body.n_nodes();
  std::vector<double> rigid(6 * n_dofs, 0.); // motions one after the other
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (int axis = 0; axis < 3; ++axis)
    {
      const int j = (axis + 1) % 3, k = (axis + 2) % 3;
      const auto &position = body.node_position()[node];
      rigid[axis * n_dofs + 3 * node + axis] = 1;
      rigid[(3 + axis) * n_dofs + 3 * node + j] = -(position[k] - centre[k]);
      rigid[(3 + axis) * n_dofs + 3 * node + k] = position[j] - centre[j];
    }
  for (std::size_t dof = 0; dof < n_dofs; ++dof)
    if (body.constraint_of(dof))
      for (int mode = 0; mode < 6; ++mode)
        rigid[mode * n_dofs + dof] = 0;
  Teuchos::ParameterList list;
  ML_Epetra::SetDefaults("SA", list);
  list.set("ML output", 0);
  list.set("PDE equations", 3);
  list.set("aggregation: type", "Uncoupled");
  list.set("aggregation: threshold", 0.02);
  list.set("smoother: type", "Chebyshev");
  list.set("smoother: sweeps", 2);
  list.set("coarse: type", "Amesos-KLU");
  list.set("null space: type", "pre-computed");
  list.set("null space: dimension", 6);
  list.set("null space: vectors", rigid.data());
  preconditioner.initialize(elastic, list);
}

unsigned int TangentSystem::solve(const std::span<const double> residual, const double tolerance,
                                  const std::span<double> increment)
{
  double square = 0;
  for (std::size_t dof = 0; dof < residual.size(); ++dof)
  {
    trilinos->right[dof] = body.constraint_of(dof) ? 0 : residual[dof];
    square += trilinos->right[dof] * trilinos->right[dof];
  }
  trilinos->left = 0;
  unsigned int n_iterations = 0;
  try
  {
    dealii::SolverControl control(2000, tolerance * std::sqrt(square));
    if (square == 0)
      ;
    else if (trilinos->is_direct)
      solve_directly(trilinos->matrix, trilinos->left, trilinos->right);
    else if (trilinos->is_symmetric)
      dealii::TrilinosWrappers::SolverCG(control).solve(trilinos->matrix, trilinos->left, trilinos->right,
                                                        trilinos->preconditioner);
    else
      dealii::TrilinosWrappers::SolverGMRES(control, dealii::TrilinosWrappers::SolverGMRES::AdditionalData(false, 200))
          .solve(trilinos->matrix, trilinos->left, trilinos->right, trilinos->preconditioner);
    n_iterations = trilinos->is_direct ? 0 : control.last_step();
  }
  catch (const dealii::ExceptionBase &) // whose text is a stack trace
  {
    throw RunError("static equilibrium: the linear system has no solution, its stiffness is singular or close to it");
  }
  for (std::size_t dof = 0; dof < increment.size(); ++dof)
  {
    increment[dof] =
        body.constraint_of(dof) ? 0 : trilinos->left[3 * std::size_t(body.images().first_of(dof / 3)) + dof % 3];
    if (!std::isfinite(increment[dof]))
      throw RunError("static equilibrium: the linear system has no finite solution, its stiffness is singular");
  }
  return n_iterations;
}

} // namespace bergamo::fe
