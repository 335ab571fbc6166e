#include "fe_dealii/element/enhanced_hexahedron.h"

#include "fe_dealii/material/deformation.h"

#include <Eigen/Dense>

#include <cmath>

namespace bergamo::fe::enhanced
{
namespace
{

/// Coordinate in [−1, 1] of a point along an axis.
Points local_coordinate(const int axis)
{
  const double gauss = 1 / std::sqrt(3.);
  return Points([&](const auto point) { return (int(point) >> axis) & 1 ? gauss : -gauss; });
}

/// Gram and Schmidt, from the constant on.
void add_linear_functions(Geometry &geometry)
{
  for (int k = 0; k < n_linear; ++k)
  {
    Points function = k == 0 ? Points(1.) : local_coordinate(k - 1);
    for (int l = 0; l < k; ++l)
    {
      const double part = sum(geometry.volume * geometry.linear[l] * function);
      function -= part * geometry.linear[l];
    }
    const double square = sum(geometry.volume * function * function);
    geometry.linear[k] = function / std::sqrt(square);
  }
}

} // namespace

void add_modes(const std::array<std::array<double, 3>, n_nodes> &corner, Geometry &geometry)
{
  add_linear_functions(geometry);
  // ∂x_i/∂ξ_A in the middle, for coordinates in [0, 1], where the volume of a point is an eighth of the determinant.
  Tensor3<double> jacobian{};
  for (int node = 0; node < n_nodes; ++node)
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i)
        jacobian[i][axis] += ((node >> axis) & 1 ? 0.25 : -0.25) * corner[node][i];
  const Tensor3<double> minors = cofactor(jacobian);
  for (int mode = 0; mode < n_modes; ++mode)
    for (int i = 0; i < 3; ++i)
      geometry.gradient[i][n_nodes + mode] = (minors[i][mode] / 8) * local_coordinate(mode) / geometry.volume;
}

void condense(const double *all, double *matrix)
{
  using All = Eigen::Matrix<double, n_all_dofs, n_all_dofs, Eigen::RowMajor>;
  const Eigen::Map<const All, Eigen::Unaligned> whole(all);
  const Eigen::Matrix<double, n_inner_dofs, n_dofs> followed =
      whole.bottomRightCorner<n_inner_dofs, n_inner_dofs>().completeOrthogonalDecomposition().solve(
          whole.bottomLeftCorner<n_inner_dofs, n_dofs>());
  Eigen::Map<Eigen::Matrix<double, n_dofs, n_dofs, Eigen::RowMajor>, Eigen::Unaligned> result(matrix);
  result = whole.topLeftCorner<n_dofs, n_dofs>() - whole.topRightCorner<n_dofs, n_inner_dofs>() * followed;
}

std::array<double, n_inner_dofs * n_inner_dofs> inverse(const std::array<double, n_inner_dofs * n_inner_dofs> &matrix)
{
  using Inner = Eigen::Matrix<double, n_inner_dofs, n_inner_dofs, Eigen::RowMajor>;
  std::array<double, n_inner_dofs * n_inner_dofs> result;
  Eigen::Map<Inner, Eigen::Unaligned>(result.data()) =
      Eigen::Map<const Inner, Eigen::Unaligned>(matrix.data()).inverse();
  return result;
}

} // namespace bergamo::fe::enhanced
