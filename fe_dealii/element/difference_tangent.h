#pragma once

#include <algorithm>

namespace bergamo::fe
{

/// Derivative of forces by displacements, by central differences, row-major [N/m]. With a step of 1e-5 of the element's
/// size its error is about 1e-9 of the largest entry.
/// @param forces forces(displacements, result); @param u displacements of the element [m]; @param step [m]
template <int n, class Forces>
void difference_matrix(const Forces &forces, const double *u, const double step, double *matrix)
{
  double moved[n], more[n], less[n];
  std::copy(u, u + n, moved);
  for (int column = 0; column < n; ++column)
  {
    moved[column] = u[column] + step;
    forces(moved, more);
    moved[column] = u[column] - step;
    forces(moved, less);
    moved[column] = u[column];
    for (int row = 0; row < n; ++row)
      matrix[n * row + column] = (more[row] - less[row]) / (2. * step);
  }
}

/// The same of forces that have a potential: made symmetric.
template <int n, class Forces>
void difference_tangent(const Forces &forces, const double *u, const double step, double *stiffness)
{
  difference_matrix<n>(forces, u, step, stiffness);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < row; ++column)
      stiffness[n * row + column] = stiffness[n * column + row] =
          0.5 * (stiffness[n * row + column] + stiffness[n * column + row]);
}

} // namespace bergamo::fe
