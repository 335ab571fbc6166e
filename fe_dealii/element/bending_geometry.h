#pragma once

#include "fe_dealii/element/bending_hexahedron.h"

#include <array>
#include <span>
#include <vector>

namespace bergamo::fe::bending
{

/// Places of an element's nodes in deal.II's order, x fastest [m].
using Corners = std::array<std::array<double, 3>, n_nodes>;

/// The 2×2×2 Gauss points of an element in the reference configuration, in deal.II's order.
struct GaussPoints
{
  double weight[n_points];               ///< weight times Jacobian determinant [m³]
  double gradient[n_points][n_nodes][3]; ///< ∂N_node/∂X [1/m]

  explicit GaussPoints(const Corners &corner);
};

/// Moduli at small strain of the hourglass modes [Pa].
struct ElasticModuli
{
  double bulk, shear;
};

/// One element. The hourglass stiffness is that of enhanced strains (Simo and Rifai, Int. J. Numer. Meth. Eng. 29
/// (1990) 1595–1638): the element finds three inner displacements itself, of the modes ½(ξ_I² − 1) with the Jacobian of
/// its middle (Wilson; Taylor, Beresford, Wilson, Int. J. Numer. Meth. Eng. 10 (1976) 1211–1219), and as all is linear
/// they are condensed here once. The dilatation of all modes is projected on the element's linear functions, in the
/// volume's measure: bending loses nothing, and what a trilinear displacement cannot avoid at a constant volume, ξη and
/// the like, costs no energy (Simo, Armero, Taylor, Comput. Methods Appl. Mech. Eng. 110 (1993) 359–386, for the same
/// add three more enhanced strains).
/// @param share of the body at the points, in [0, 1], which multiplies volume and stiffness; means are weighted with it
Geometry<double> make_geometry(const Corners &corner, const ElasticModuli &moduli,
                               const std::array<double, n_points> &share);

} // namespace bergamo::fe::bending
