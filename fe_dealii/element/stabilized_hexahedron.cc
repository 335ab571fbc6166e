#include "fe_dealii/element/stabilized_hexahedron.h"

#include <Eigen/Dense>

namespace bergamo::fe::stabilized
{
namespace
{

/// Values of 1, x, y, z and of the modes at the nodes, one a column. A mode is a product of coordinates in [−1, 1] (ηζ,
/// ζξ, ξη, ξηζ) less the linear function of the place that has its mean gradient.
Eigen::Matrix<double, n_nodes, n_nodes> nodal_values(const std::array<std::array<double, 3>, n_nodes> &corner,
                                                     const Geometry &geometry)
{
  Eigen::Matrix<double, n_nodes, n_nodes> values;
  for (int node = 0; node < n_nodes; ++node)
  {
    const double xi = node & 1 ? 1 : -1, eta = node & 2 ? 1 : -1, zeta = node & 4 ? 1 : -1;
    values.row(node) << 1, corner[node][0], corner[node][1], corner[node][2], eta * zeta, zeta * xi, xi * eta,
        xi * eta * zeta;
  }
  for (int mode = 4; mode < n_nodes; ++mode)
  {
    const Eigen::Matrix<double, n_nodes, 1> product = values.col(mode);
    for (int i = 0; i < 3; ++i)
    {
      double gradient = 0;
      for (int node = 0; node < n_nodes; ++node)
        gradient += geometry.mean_gradient[i][node] * product[node];
      values.col(mode) -= gradient * values.col(1 + i);
    }
  }
  return values;
}

/// Stiffness of the nodes with enhanced strains, 24×24.
Eigen::Matrix<double, n_dofs, n_dofs, Eigen::RowMajor>
nodal_stiffness(const enhanced::Geometry &enhanced, const double bulk_modulus, const double shear_modulus)
{
  const double lame = bulk_modulus - 2 * shear_modulus / 3;
  double all[enhanced::n_all_dofs * enhanced::n_all_dofs];
  enhanced::stiffness(
      enhanced,
      [&](const Points(&strain)[6], Points(&stress)[6])
      {
        for (int i = 0; i < 3; ++i)
        {
          stress[i] = 2 * shear_modulus * strain[i] + lame * (strain[0] + strain[1] + strain[2]);
          stress[3 + i] = shear_modulus * strain[3 + i];
        }
      },
      all);
  Eigen::Matrix<double, n_dofs, n_dofs, Eigen::RowMajor> result;
  enhanced::condense(all, result.data());
  return result;
}

} // namespace

Geometry make_geometry(const std::array<std::array<double, 3>, n_nodes> &corner, const enhanced::Geometry &enhanced,
                       const double bulk_modulus, const double shear_modulus)
{
  Geometry geometry;
  geometry.volume = sum(enhanced.volume);
  for (int i = 0; i < 3; ++i)
    for (int node = 0; node < n_nodes; ++node)
      geometry.mean_gradient[i][node] = sum(enhanced.volume * enhanced.gradient[i][node]) / geometry.volume;

  const auto values = nodal_values(corner, geometry);
  const Eigen::Matrix<double, n_nodes, n_nodes> parts = values.inverse();
  Eigen::Matrix<double, n_dofs, n_amplitudes> of_modes = Eigen::Matrix<double, n_dofs, n_amplitudes>::Zero();
  for (int mode = 0; mode < n_modes; ++mode)
  {
    for (int node = 0; node < n_nodes; ++node)
    {
      geometry.amplitude[mode][node] = parts(4 + mode, node);
      for (int i = 0; i < 3; ++i)
        of_modes(3 * node + i, 3 * mode + i) = values(node, 4 + mode);
    }
    for (int i = 0; i < 3; ++i)
    {
      geometry.mode_gradient[i][mode] = 0.;
      for (int node = 0; node < n_nodes; ++node)
        geometry.mode_gradient[i][mode] += values(node, 4 + mode) * enhanced.gradient[i][node];
    }
  }
  const Eigen::Matrix<double, n_amplitudes, n_amplitudes> stiffness =
      of_modes.transpose() * nodal_stiffness(enhanced, bulk_modulus, shear_modulus) * of_modes;
  for (int k = 0; k < n_amplitudes; ++k)
    for (int l = 0; l < n_amplitudes; ++l)
      geometry.stiffness[k][l] = 0.5 * (stiffness(k, l) + stiffness(l, k));
  return geometry;
}

} // namespace bergamo::fe::stabilized
