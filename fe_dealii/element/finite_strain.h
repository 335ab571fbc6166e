#pragma once

#include "fe_dealii/element/difference_tangent.h"
#include "fe_dealii/element/solid_geometry.h"
#include "fe_dealii/material/hyperelastic.h"

#include <algorithm>
#include <cmath>

/// Solid elements of any number of nodes at large strain, total Lagrangian: all geometry is taken once in the reference
/// configuration, forces follow from the first Piola-Kirchhoff stress.
namespace bergamo::fe::finite_strain
{

/// How an element takes the part U(J) of its material.
enum class Dilatation
{
  point, ///< at every quadrature point
  mean   ///< once, at the ratio of the element's volumes: no locking at nearly constant volume
};

/// What a configuration of an element gives beside its forces.
struct Response
{
  double energy = 0.;         ///< [J]
  double smallest_ratio = 0.; ///< least det F at any point; <= 0 where the element has turned inside out. Points
                              ///< without a number do not count: the forces have none then either
};

/// Deformation gradient at the points of a pack. @param u displacements, 3*node + component [m]
template <class Element>
Tensor3<Points> deformation_gradient(const Element &element, const int pack, const double *u)
{
  Tensor3<Points> f;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      Points sum(i == j ? 1. : 0.);
      for (int node = 0; node < Element::nodes; ++node)
        sum += u[3 * node + i] * element.gradient[pack][j][node];
      f[i][j] = sum;
    }
  return f;
}

/// Internal forces, the derivative of the energy by the displacements.
/// @param u displacements, 3*node + component [m]; @param force on the element's nodes, the same order [N]; where the
///        smallest ratio is not positive the forces are no numbers
template <class Law, class Element>
Response internal_force(const Law &law, const Element &element, const Dilatation dilatation, const double *u,
                        double *force)
{
  const VolumetricEnergy volumetric = law.volumetric();
  Tensor3<Points> minors[Element::packs], stress[Element::packs];
  Points ratio[Element::packs], energy{};
  double volume = 0., present_volume = 0.;
  Response response{0., 1e300};
  for (int pack = 0; pack < Element::packs; ++pack)
  {
    const Tensor3<Points> f = deformation_gradient(element, pack, u);
    minors[pack] = cofactor(f);
    ratio[pack] = determinant(f, minors[pack]);
    const PointResponse<Points> response_of_law = law.respond(f, minors[pack], ratio[pack]);
    stress[pack] = response_of_law.stress;
    energy += element.volume[pack] * response_of_law.energy;
    volume += sum(element.volume[pack]);
    present_volume += sum(element.volume[pack] * ratio[pack]);
    response.smallest_ratio = std::min(response.smallest_ratio, least(ratio[pack]));
  }
  const double mean_ratio = present_volume / volume;
  if (dilatation == Dilatation::mean)
    response.energy = volume * volumetric.energy(mean_ratio);
  for (int k = 0; k < 3 * Element::nodes; ++k)
    force[k] = 0.;
  for (int pack = 0; pack < Element::packs; ++pack)
  {
    Points pressure;
    if (dilatation == Dilatation::mean)
      pressure = volumetric.pressure(mean_ratio);
    else
    {
      pressure = volumetric.pressure(ratio[pack]);
      energy += element.volume[pack] * volumetric.energy(ratio[pack]);
    }
    for (int i = 0; i < 3; ++i)
    {
      Points row[3];
      for (int j = 0; j < 3; ++j)
        row[j] = element.volume[pack] * (stress[pack][i][j] + pressure * minors[pack][i][j]);
      for (int node = 0; node < Element::nodes; ++node)
        force[3 * node + i] += sum(row[0] * element.gradient[pack][0][node] + row[1] * element.gradient[pack][1][node] +
                                   row[2] * element.gradient[pack][2][node]);
    }
  }
  response.energy += sum(energy);
  return response;
}

/// Tangent stiffness, see difference_tangent() [N/m].
template <class Law, class Element>
void tangent_stiffness(const Law &law, const Element &element, const Dilatation dilatation, const double *u,
                       double *stiffness)
{
  difference_tangent<3 * Element::nodes>([&](const double *moved, double *force)
                                         { internal_force(law, element, dilatation, moved, force); },
                                         u, 1e-5 * std::cbrt(element.whole_volume()), stiffness);
}

} // namespace bergamo::fe::finite_strain
