#include "fe_dealii/element/bending_geometry.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bergamo::fe::bending
{
namespace
{

constexpr int n_basis = 8; // 1, ξ, η, ζ, ηζ, ζξ, ξη, ξηζ with coordinates in [−1, 1]
constexpr int n_inner = 3;
constexpr int n_columns = 3 * (n_modes + n_inner);

using Vector = Eigen::Vector3d;
using Stiffness = Eigen::Matrix<double, n_columns, n_columns>;
using StrainMatrix = Eigen::Matrix<double, 6, n_columns>;

/// Coordinate of a node or point along an axis, by the bit of its number.
double side(const int number, const int axis)
{
  return (number >> axis) & 1 ? 1 : -1;
}

Vector gauss_point(const int point)
{
  return Vector(side(point, 0), side(point, 1), side(point, 2)) / std::sqrt(3.);
}

std::array<double, n_basis> basis(const Vector &xi)
{
  return {1, xi[0], xi[1], xi[2], xi[1] * xi[2], xi[2] * xi[0], xi[0] * xi[1], xi[0] * xi[1] * xi[2]};
}

/// Derivatives of the basis by the local coordinates, one a column.
Eigen::Matrix<double, 3, n_basis> basis_slopes(const Vector &xi)
{
  Eigen::Matrix<double, 3, n_basis> slopes;
  slopes << 0, 1, 0, 0, 0, xi[2], xi[1], xi[1] * xi[2], //
      0, 0, 1, 0, xi[2], 0, xi[0], xi[2] * xi[0],       //
      0, 0, 0, 1, xi[1], xi[0], 0, xi[0] * xi[1];
  return slopes;
}

/// Part of each basis function in what the nodes have; also the basis at the nodes, transposed, over 8.
Eigen::Matrix<double, n_basis, n_nodes> parts_of_basis()
{
  Eigen::Matrix<double, n_basis, n_nodes> parts;
  for (int node = 0; node < n_nodes; ++node)
  {
    const std::array<double, n_basis> values = basis(Vector(side(node, 0), side(node, 1), side(node, 2)));
    for (int k = 0; k < n_basis; ++k)
      parts(k, node) = values[k] / n_nodes;
  }
  return parts;
}

/// Everything at the points that the making of an element needs.
struct Points8
{
  double weight[n_points]; // share included
  Eigen::Matrix<double, 3, n_basis> basis_gradient[n_points];
  Eigen::Matrix<double, 3, n_inner> inner_gradient[n_points];

  Points8(const Corners &corner, const std::array<double, n_points> &share)
  {
    Eigen::Matrix<double, 3, n_basis> place; // X as a sum of the basis
    const Eigen::Map<const Eigen::Matrix<double, 3, n_nodes>, Eigen::Unaligned> nodes(corner.front().data());
    place = nodes * parts_of_basis().transpose();
    const Eigen::Matrix3d in_the_middle = place.middleCols<3>(1); // Jacobian
    const Eigen::Matrix3d minors = in_the_middle.determinant() * in_the_middle.inverse().transpose();
    for (int point = 0; point < n_points; ++point)
    {
      const Vector xi = gauss_point(point);
      const Eigen::Matrix<double, 3, n_basis> slopes = basis_slopes(xi);
      const Eigen::Matrix3d jacobian = place * slopes.transpose();
      const double determinant = jacobian.determinant();
      weight[point] = determinant * share[point];
      basis_gradient[point] = jacobian.inverse().transpose() * slopes;
      inner_gradient[point] = minors * xi.asDiagonal() / determinant;
    }
  }

  Eigen::Matrix<double, 3, n_basis> mean_gradient(const double volume) const
  {
    Eigen::Matrix<double, 3, n_basis> mean = Eigen::Matrix<double, 3, n_basis>::Zero();
    for (int point = 0; point < n_points; ++point)
      mean += weight[point] / volume * basis_gradient[point];
    return mean;
  }
};

/// Values at the points of an orthonormal set of linear functions, one a column: Gram and Schmidt from the constant on.
Eigen::Matrix<double, n_points, 4> linear_functions(const Points8 &points)
{
  Eigen::Matrix<double, n_points, 4> functions;
  for (int point = 0; point < n_points; ++point)
    functions.row(point) << 1, gauss_point(point).transpose();
  const Eigen::Map<const Eigen::Matrix<double, n_points, 1>> weight(points.weight);
  for (int k = 0; k < 4; ++k)
  {
    for (int l = 0; l < k; ++l)
    {
      const double part = functions.col(k).dot(weight.cwiseProduct(functions.col(l)));
      functions.col(k) -= part * functions.col(l);
    }
    functions.col(k) /= std::sqrt(functions.col(k).dot(weight.cwiseProduct(functions.col(k))));
  }
  return functions;
}

/// Strains at the points of the hourglass modes, then of the inner ones, three components each; engineering shears, the
/// dilatation projected.
std::array<StrainMatrix, n_points> strains_of_modes(const Points8 &points,
                                                    const Eigen::Matrix<double, 3, n_basis> &mean)
{
  std::array<StrainMatrix, n_points> strain;
  Eigen::Matrix<double, n_points, n_columns> dilatation;
  for (int point = 0; point < n_points; ++point)
  {
    strain[point].setZero();
    for (int mode = 0; mode < n_modes + n_inner; ++mode)
    {
      const Vector g = mode < n_modes ? Vector(points.basis_gradient[point].col(4 + mode) - mean.col(4 + mode))
                                      : Vector(points.inner_gradient[point].col(mode - n_modes));
      strain[point].middleCols<3>(3 * mode) << g[0], 0, 0, //
          0, g[1], 0,                                      //
          0, 0, g[2],                                      //
          g[1], g[0], 0,                                   //
          0, g[2], g[1],                                   //
          g[2], 0, g[0];
    }
    dilatation.row(point) = strain[point].topRows<3>().colwise().sum();
  }
  const Eigen::Matrix<double, n_points, 4> linear = linear_functions(points);
  const Eigen::Map<const Eigen::Matrix<double, n_points, 1>> weight(points.weight);
  const Eigen::Matrix<double, n_points, n_columns> projected =
      linear * (linear.transpose() * weight.asDiagonal() * dilatation);
  for (int point = 0; point < n_points; ++point)
    strain[point].topRows<3>().rowwise() += (projected.row(point) - dilatation.row(point)) / 3;
  return strain;
}

/// Of the hourglass modes, the inner ones following; each mode three components.
Eigen::Matrix<double, n_amplitudes, n_amplitudes> stiffness_of_modes(const Points8 &points,
                                                                     const std::array<StrainMatrix, n_points> &strain,
                                                                     const ElasticModuli &elastic)
{
  Eigen::Matrix<double, 6, 6> moduli = Eigen::Matrix<double, 6, 6>::Zero();
  moduli.topLeftCorner<3, 3>().setConstant(elastic.bulk - 2 * elastic.shear / 3);
  moduli.diagonal() << Vector::Constant(2 * elastic.shear) + moduli.diagonal().head<3>(),
      Vector::Constant(elastic.shear);
  Stiffness all = Stiffness::Zero();
  for (int point = 0; point < n_points; ++point)
    all.noalias() += strain[point].transpose() * (points.weight[point] * moduli * strain[point]);
  const Eigen::Matrix<double, 3 * n_inner, n_amplitudes> followed =
      all.bottomRightCorner<3 * n_inner, 3 * n_inner>().ldlt().solve(all.bottomLeftCorner<3 * n_inner, n_amplitudes>());
  return all.topLeftCorner<n_amplitudes, n_amplitudes>() - all.topRightCorner<n_amplitudes, 3 * n_inner>() * followed;
}

} // namespace

GaussPoints::GaussPoints(const Corners &corner)
{
  std::array<double, n_points> whole;
  whole.fill(1);
  const Points8 points(corner, whole);
  const Eigen::Matrix<double, n_basis, n_nodes> parts = parts_of_basis();
  for (int point = 0; point < n_points; ++point)
  {
    weight[point] = points.weight[point];
    const Eigen::Matrix<double, 3, n_nodes> of_nodes = points.basis_gradient[point] * parts;
    for (int node = 0; node < n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
        gradient[point][node][i] = of_nodes(i, node);
  }
}

Geometry<double> make_geometry(const Corners &corner, const ElasticModuli &moduli,
                               const std::array<double, n_points> &share)
{
  if (std::all_of(share.begin(), share.end(), [](const double s) { return s == 0; }))
  {
    std::array<double, n_points> whole;
    whole.fill(1);
    Geometry<double> nothing = make_geometry(corner, moduli, whole); // gradients have to be numbers
    nothing.volume = 0;
    std::fill(std::begin(nothing.stiffness), std::end(nothing.stiffness), 0.);
    return nothing;
  }
  const Points8 points(corner, share);
  Geometry<double> geometry;
  geometry.volume = std::accumulate(std::begin(points.weight), std::end(points.weight), 0.);
  const Eigen::Matrix<double, 3, n_basis> mean = points.mean_gradient(geometry.volume);
  const Eigen::Matrix<double, n_basis, n_nodes> parts = parts_of_basis();
  const Eigen::Matrix<double, 3, n_nodes> of_nodes = mean * parts;

  // Values of 1, X, Y, Z and of the modes at the nodes, one a column: what the nodes have is a sum of these.
  Eigen::Matrix<double, n_nodes, n_nodes> values = n_nodes * parts.transpose();
  for (int node = 0; node < n_nodes; ++node)
  {
    const Vector place(corner[node].data());
    values.row(node).tail<n_modes>() -= place.transpose() * mean.rightCols<n_modes>();
    values.row(node).segment<3>(1) = place.transpose();
  }
  const Eigen::Matrix<double, n_nodes, n_nodes> amplitudes = values.inverse();
  for (int node = 0; node < n_nodes; ++node)
  {
    for (int i = 0; i < 3; ++i)
      geometry.gradient[i][node] = of_nodes(i, node);
    for (int mode = 0; mode < n_modes; ++mode)
      geometry.amplitude[mode][node] = amplitudes(4 + mode, node);
  }
  const auto stiffness = stiffness_of_modes(points, strains_of_modes(points, mean), moduli);
  for (int k = 0; k < n_amplitudes; ++k)
    for (int l = 0; l <= k; ++l)
      geometry.stiffness[packed(k, l)] = 0.5 * (stiffness(k, l) + stiffness(l, k));
  return geometry;
}

} // namespace bergamo::fe::bending
