#pragma once

#include "fe_dealii/element/points.h"
#include "fe_dealii/material/linear_elastic.h"
#include "fe_dealii/material/mohr_coulomb.h"

/// Laws of small strain at the eight points of a pack. Strains are xx yy zz xy yz zx with engineering shears.
namespace bergamo::fe
{

/// What eight points remember.
struct PointHistory
{
  Points stress[6];         ///< xx yy zz xy yz zx [Pa]
  Points plastic_strain;    ///< accumulated equivalent_strain() of the plastic increments [-]
  Points dissipated_energy; ///< accumulated plastic dissipation, share included [J]
  Points elastic_work;      ///< accumulated stress work without it, share included, where the stiffness varies [J]
};

/// Elastic stress of a strain at all points.
template <class Law>
void elastic_stress(const Law &material, const Points (&strain)[6], Points (&stress)[6])
{
  const Points volumetric = material.lame_modulus() * (strain[0] + strain[1] + strain[2]);
  for (int i = 0; i < 3; ++i)
    stress[i] = 2 * material.shear_modulus() * strain[i] + volumetric;
  for (int i = 3; i < 6; ++i)
    stress[i] = material.shear_modulus() * strain[i];
}

/// Stress of a strain by moduli of each point.
inline void apply_moduli(const Points (&moduli)[6][6], const Points (&strain)[6], Points (&stress)[6])
{
  for (int i = 0; i < 6; ++i)
  {
    stress[i] = moduli[i][0] * strain[0];
    for (int j = 1; j < 6; ++j)
      stress[i] += moduli[i][j] * strain[j];
  }
}

/// Carries the stresses over a strain increment.
inline void update_stress(const LinearElastic &material, const Points &, const Points (&strain_increment)[6],
                          PointHistory &history, Sector *)
{
  Points increment[6];
  elastic_stress(material, strain_increment, increment);
  for (int i = 0; i < 6; ++i)
    history.stress[i] += increment[i];
}

/// Carries the stresses over a strain increment.
/// @param weighted_volume times the share that the energies count with [m³]; @param sector one entry per point
inline void update_stress(const MohrCoulomb &material, const Points &weighted_volume,
                          const Points (&strain_increment)[6], PointHistory &history, Sector *sector)
{
  const Points dissipated_before = history.dissipated_energy;
  Points trial[6], stiffness(1.);
  if (material.depends_on_pressure())
    stiffness = material.stiffness_factor(Points((history.stress[0] + history.stress[1] + history.stress[2]) / 3.));
  elastic_stress(material, strain_increment, trial);
  for (int i = 0; i < 6; ++i)
    trial[i] = history.stress[i] + stiffness * trial[i];
  const Points mean = (trial[0] + trial[1] + trial[2]) / 3.;
  const Points x = trial[0] - mean, y = trial[1] - mean, z = trial[2] - mean;
  const Points j2 = (x * x + y * y + z * z) * 0.5 + trial[3] * trial[3] + trial[4] * trial[4] + trial[5] * trial[5];
  const auto elastic = material.is_surely_elastic(mean, j2);
  for (int point = 0; point < points_per_pack; ++point)
    sector[point] = Sector::elastic;
  if (math::any(!elastic))
  {
    const PrincipalFrame<Points> frames = principal_frame<Points>(trial);
    for (int point = 0; point < points_per_pack; ++point)
    {
      if (elastic[point])
        continue;
      Stress stress_old, stress_trial;
      for (int i = 0; i < 6; ++i)
      {
        stress_old[i] = history.stress[i][point];
        stress_trial[i] = trial[i][point];
      }
      PrincipalFrame<double> frame;
      for (int k = 0; k < 3; ++k)
      {
        frame.value[k] = frames.value[k][point];
        for (int i = 0; i < 3; ++i)
          frame.direction[k][i] = frames.direction[k][i][point];
      }
      const StressUpdate update = material.return_to_surface(stress_old, stress_trial, frame, stiffness[point]);
      sector[point] = update.sector;
      if (update.sector == Sector::elastic)
        continue;
      for (int i = 0; i < 6; ++i)
        trial[i][point] = update.stress[i];
      history.plastic_strain[point] += equivalent_strain(update.plastic_strain);
      history.dissipated_energy[point] += weighted_volume[point] * update.plastic_dissipation;
    }
  }
  if (material.depends_on_pressure())
  {
    Points work = dissipated_before - history.dissipated_energy;
    for (int i = 0; i < 6; ++i)
      work += weighted_volume * 0.5 * (history.stress[i] + trial[i]) * strain_increment[i];
    history.elastic_work += work;
  }
  for (int i = 0; i < 6; ++i)
    history.stress[i] = trial[i];
}

} // namespace bergamo::fe
