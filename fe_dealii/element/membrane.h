#pragma once

#include "fe_dealii/material/lanes.h"

#include <array>

/// Membrane of four nodes and 2×2 points for large strains of incompressible rubber: no bending stiffness, plane
/// stress, and a thickness that follows from the constant volume (after Gruttmann and Taylor, Int. J. Numer. Meth. Eng.
/// 35 (1992) 1111-1126; here in principal stretches, with no condensation of the thickness left to do).
///
/// Its law has, for W = w(λ1²) + w(λ2²) + w(λ3²) at λ1 λ2 λ3 = 1,
///   principal_slope(x)  λ ∂W/∂λ at x = λ² [Pa], principal_energy(x)  w [J/m³].
namespace bergamo::fe::membrane
{

inline constexpr int n_nodes = 4, n_points = 4;

/// One double for each of the four points.
using Points [[gnu::vector_size(32)]] = double;

inline double sum(const Points &x)
{
  return (x[0] + x[1]) + (x[2] + x[3]);
}

/// What an element is in the reference configuration. At each point directions 1 and 2 are orthonormal and tangential.
struct Geometry
{
  Points direction[2][3];      ///< [1 or 2][component]
  Points gradient[2][n_nodes]; ///< ∂N_node along direction 1 and 2 [1/m]
  Points volume;               ///< weight times area times thickness [m³]
};

/// @param nodes in deal.II's order: (0, 0), (1, 0), (0, 1), (1, 1) of the unit square [m]; @param thickness [m]
/// @return a geometry in which a point where the element is degenerate or folded over has no positive volume
Geometry reference_geometry(const std::array<std::array<double, 3>, n_nodes> &nodes, double thickness);

/// Internal forces, the derivative of the energy by the displacements.
/// @param u displacements, 3*node + component [m]; @param force the same order [N]
/// @return energy [J]
template <class Law>
double internal_force(const Law &law, const Geometry &element, const double *u, double *force)
{
  Points along[2][3]; // images of the directions
  for (int a = 0; a < 2; ++a)
    for (int i = 0; i < 3; ++i)
    {
      along[a][i] = element.direction[a][i];
      for (int node = 0; node < n_nodes; ++node)
        along[a][i] += u[3 * node + i] * element.gradient[a][node];
    }
  const auto dot = [&](const int a, const int b)
  { return Points(along[a][0] * along[b][0] + along[a][1] * along[b][1] + along[a][2] * along[b][2]); };
  const Points c11 = dot(0, 0), c22 = dot(1, 1), c12 = dot(0, 1);

  // Principal squares of the stretches in the plane, and the angle 2θ of the first one's direction.
  const Points mean = 0.5 * (c11 + c22), half_gap = 0.5 * (c11 - c22);
  const Points radius = lanes::square_root(Points(half_gap * half_gap + c12 * c12));
  const Points safe = radius > 0. ? radius : Points{} + 1.;
  const Points cosine = half_gap / safe, sine = c12 / safe;
  const Points determinant = c11 * c22 - c12 * c12;
  const Points first = mean + radius, second = determinant / first, third = 1. / determinant;

  // Kirchhoff stresses; the pressure of incompressibility is what makes the third one vanish.
  const Points across = law.principal_slope(third);
  const Points s1 = (law.principal_slope(first) - across) / first, s2 = (law.principal_slope(second) - across) / second;
  const Points s_mean = 0.5 * (s1 + s2), s_half = 0.5 * (s1 - s2);
  const Points s11 = element.volume * (s_mean + s_half * cosine), s22 = element.volume * (s_mean - s_half * cosine),
               s12 = element.volume * s_half * sine;
  for (int i = 0; i < 3; ++i)
  {
    const Points p1 = s11 * along[0][i] + s12 * along[1][i], p2 = s12 * along[0][i] + s22 * along[1][i];
    for (int node = 0; node < n_nodes; ++node)
      force[3 * node + i] = sum(p1 * element.gradient[0][node] + p2 * element.gradient[1][node]);
  }
  return sum(element.volume *
             (law.principal_energy(first) + law.principal_energy(second) + law.principal_energy(third)));
}

} // namespace bergamo::fe::membrane
