#pragma once

#include "fe_dealii/element/points.h"

#include <vector>

namespace bergamo::fe
{

/// What a solid element of any number of nodes is in the reference configuration.
/// @tparam n_nodes of the element; @tparam n_packs of eight quadrature points
template <int n_nodes, int n_packs>
struct SolidGeometry
{
  static constexpr int nodes = n_nodes, packs = n_packs;

  Points gradient[n_packs][3][n_nodes]; ///< ∂N_node/∂X_component [1/m]; 0 at points of no volume
  Points volume[n_packs];               ///< weight times Jacobian determinant [m³]

  double whole_volume() const
  {
    double result = 0.;
    for (const Points &v : volume)
      result += sum(v);
    return result;
  }
};

/// Parts of the nodes in the masses of their elements, one element after the other; those of an element add up to 1.
struct MassShares
{
  std::vector<double> lumped;  ///< all positive: of the inertia
  std::vector<double> row_sum; ///< ∫ N dV over the volume: of a body force; may be negative
};

/// Packs for as many Gauss points as nodes, which is full integration of a Lagrange element.
constexpr int packs_of(const int n_points)
{
  return (n_points + points_per_pack - 1) / points_per_pack;
}

} // namespace bergamo::fe
