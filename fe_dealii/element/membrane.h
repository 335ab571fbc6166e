#pragma once

#include "dem/core/pack.h"

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
using Points = Lanes<n_points>;

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

/// How an element is stretched.
struct Stretches
{
  Points along[2][3];          ///< images of the directions
  Points first, second, third; ///< squares of the principal stretches: first >= second in the plane, third across
  Points cosine, sine;         ///< of twice the angle from direction 1 to that of the first; 0 where both are equal
};

/// @param u displacements, 3*node + component [m]
inline Stretches stretches(const Geometry &element, const double *u)
{
  Stretches s;
  for (int a = 0; a < 2; ++a)
    for (int i = 0; i < 3; ++i)
    {
      s.along[a][i] = element.direction[a][i];
      for (int node = 0; node < n_nodes; ++node)
        s.along[a][i] += u[3 * node + i] * element.gradient[a][node];
    }
  const auto dot = [&](const int a, const int b)
  { return Points(s.along[a][0] * s.along[b][0] + s.along[a][1] * s.along[b][1] + s.along[a][2] * s.along[b][2]); };
  const Points c11 = dot(0, 0), c22 = dot(1, 1), c12 = dot(0, 1);
  const Points mean = 0.5 * (c11 + c22), half_gap = 0.5 * (c11 - c22);
  const Points radius = math::sqrt(Points(half_gap * half_gap + c12 * c12));
  const Points safe = math::select(radius > 0., radius, Points(1.));
  s.cosine = half_gap / safe;
  s.sine = c12 / safe;
  const Points determinant = c11 * c22 - c12 * c12;
  s.first = mean + radius;
  s.second = determinant / s.first;
  s.third = 1. / determinant;
  return s;
}

/// Stresses of an element.
struct Stresses
{
  Points principal[2];       ///< Cauchy, in the directions of the stretches [Pa]
  Points second_piola[2][2]; ///< in directions 1 and 2 [Pa]
};

template <class Law>
Stresses stresses(const Law &law, const Stretches &s)
{
  Stresses result;
  // The pressure of incompressibility is what makes the third one vanish.
  const Points across = law.principal_slope(s.third);
  result.principal[0] = law.principal_slope(s.first) - across;
  result.principal[1] = law.principal_slope(s.second) - across;
  const Points s1 = result.principal[0] / s.first, s2 = result.principal[1] / s.second;
  const Points mean = 0.5 * (s1 + s2), half = 0.5 * (s1 - s2);
  result.second_piola[0][0] = mean + half * s.cosine;
  result.second_piola[1][1] = mean - half * s.cosine;
  result.second_piola[0][1] = result.second_piola[1][0] = half * s.sine;
  return result;
}

/// What a configuration of an element gives beside its forces.
struct Response
{
  double energy = 0.;       ///< [J]
  double least_growth = 0.; ///< least square of present over reference area at any point
};

/// Internal forces, the derivative of the energy by the displacements.
/// @param u displacements, 3*node + component [m]; @param force the same order [N]
template <class Law>
Response internal_force(const Law &law, const Geometry &element, const double *u, double *force)
{
  const Stretches stretch = stretches(element, u);
  const Stresses stress = stresses(law, stretch);
  const Points s11 = element.volume * stress.second_piola[0][0], s22 = element.volume * stress.second_piola[1][1],
               s12 = element.volume * stress.second_piola[0][1];
  for (int i = 0; i < 3; ++i)
  {
    const Points p1 = s11 * stretch.along[0][i] + s12 * stretch.along[1][i],
                 p2 = s12 * stretch.along[0][i] + s22 * stretch.along[1][i];
    for (int node = 0; node < n_nodes; ++node)
      force[3 * node + i] = math::sum(p1 * element.gradient[0][node] + p2 * element.gradient[1][node]);
  }
  const Points growth = 1. / stretch.third;
  return {math::sum(element.volume * (law.principal_energy(stretch.first) + law.principal_energy(stretch.second) +
                                      law.principal_energy(stretch.third))),
          math::least(growth)};
}

/// Value of a shape function at a point, the quadrature point of the same number in Geometry.
double shape_value(int node, int point);

} // namespace bergamo::fe::membrane
