#pragma once

#include <algorithm>

namespace bergamo::fe
{

/// Tangent stiffness by central differences of the forces, row-major, made symmetric [N/m]. With a step of 1e-5 of the
/// element's size its error is about 1e-9 of the largest entry.
/// @param forces forces(displacements, result); @param u displacements of the element [m]; @param step [m]
template <int n, class Forces>
void difference_tangent(const Forces &forces, const double *u, const double step, double *stiffness)
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
      stiffness[n * row + column] = (more[row] - less[row]) / (2. * step);
  }
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < row; ++column)
      stiffness[n * row + column] = stiffness[n * column + row] =
          0.5 * (stiffness[n * row + column] + stiffness[n * column + row]);
}

} // namespace bergamo::fe
