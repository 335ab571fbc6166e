#include "fe_dealii/material/mohr_coulomb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bergamo::fe
{

namespace
{

using PrincipalMatrix = std::array<std::array<double, 3>, 3>;

/// Derivative of the principal stresses after a return by those of the trial stress.
PrincipalMatrix principal_tangent(const MohrCoulombSurface<double> &surface, const Sector sector)
{
  PrincipalMatrix p{};
  const double f = surface.friction;
  switch (sector)
  {
  case Sector::elastic:
    for (int k = 0; k < 3; ++k)
      p[k][k] = 1;
    break;
  case Sector::main_plane:
  {
    const double normal[3] = {1 + f, 0, f - 1};
    for (int l = 0; l < 3; ++l)
    {
      p[1][l] = (l == 1) - surface.plane_middle * normal[l];
      p[2][l] = (l == 2) - surface.plane_minor * normal[l];
      p[0][l] = surface.tensile_slope * p[2][l];
    }
    break;
  }
  case Sector::right_edge:
  {
    const double push = surface.right_minor;
    p[2] = {-push * 2 * (1 + f), 0.5 + push * (1 - f), 0.5 + push * (1 - f)};
    p[1] = p[2];
    for (int l = 0; l < 3; ++l)
      p[0][l] = surface.tensile_slope * p[2][l];
    break;
  }
  case Sector::left_edge:
  {
    const double push = surface.left_minor;
    p[2] = {-push * (1 + f), -push * (1 + f), 1 + push * 2 * (1 - f)};
    for (int l = 0; l < 3; ++l)
      p[0][l] = p[1][l] = surface.tensile_slope * p[2][l];
    break;
  }
  case Sector::apex:
    break;
  }
  return p;
}

} // namespace

Moduli MohrCoulomb::tangent(const Stress &stress_old, const Strain &strain_increment, const double plastic_strain) const
{
  const double stiffness = depends_on_pressure() ? stiffness_factor(mean_stress(stress_old)) : 1;
  const double shear = stiffness * shear_, lame = stiffness * lame_;
  Stress trial = elastic_stress(strain_increment);
  for (int i = 0; i < 6; ++i)
    trial[i] = stress_old[i] + stiffness * trial[i];
  const PrincipalFrame<double> frame = principal_frame(trial);
  const StressUpdate update = return_to_surface(stress_old, trial, frame, stiffness, plastic_strain);
  if (update.sector == Sector::elastic)
    return isotropic_moduli(lame, shear);

  // de Souza Neto, Perić, Owen (2008), app. A: the return changes the principal values alone; the frame turns with the
  // trial stress, and shears between two principal directions are scaled by the ratio of the stress differences.
  const PrincipalMatrix p = principal_tangent(surface(plastic_strain), update.sector);
  double value[3]; // of the new stress
  double dyad[3][6], mixed[3][6];
  const int component[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  for (int k = 0; k < 3; ++k)
  {
    const double *const a = frame.direction[k], *const b = frame.direction[(k + 1) % 3];
    for (int i = 0; i < 6; ++i)
    {
      const auto [x, y] = component[i];
      dyad[k][i] = a[x] * a[y];
      mixed[k][i] = a[x] * b[y] + a[y] * b[x];
    }
    value[k] = energy_density(update.stress,
                              {dyad[k][0], dyad[k][1], dyad[k][2], 2 * dyad[k][3], 2 * dyad[k][4], 2 * dyad[k][5]});
  }
  Moduli moduli{};
  for (int k = 0; k < 3; ++k)
  {
    double row[3];
    for (int l = 0; l < 3; ++l)
      row[l] = 2 * shear * p[k][l] + lame * (p[k][0] + p[k][1] + p[k][2]);
    const int m = (k + 1) % 3;
    const double gap = frame.value[k] - frame.value[m];
    const bool distinct = std::abs(gap) > 1e-9 * std::max(std::abs(frame.value[0]), std::abs(frame.value[2]));
    const double turned = distinct ? (value[k] - value[m]) / gap : p[k][k] - p[k][m];
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
      {
        for (int l = 0; l < 3; ++l)
          moduli[i][j] += row[l] * dyad[k][i] * dyad[l][j];
        moduli[i][j] += turned * shear * mixed[k][i] * mixed[k][j];
      }
  }
  return moduli;
}

} // namespace bergamo::fe
