#pragma once

#include "fe_dealii/element/points.h"
#include "fe_dealii/material/linear_elastic.h"
#include "fe_dealii/material/mohr_coulomb.h"
#include "fe_dealii/material/plastic_flow.h"

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

/// Takes the trial stresses of a register of points back to the yield surface, and books their plastic flow.
/// @param volume what their dissipation counts with [m³]; @param first of the points
inline void flow_plastically(const MohrCoulomb &material, const Points &volume, const Points &softness, const int first,
                             Points (&trial)[6], PointHistory &history, Sector *sector)
{
  Pack stress_old[6], stress_trial[6];
  for (int i = 0; i < 6; ++i)
  {
    stress_old[i] = part(history.stress[i], first);
    stress_trial[i] = part(trial[i], first);
  }
  const PlasticFlow<Pack> flow = plastic_flow(material, stress_old, stress_trial, part(softness, first));
  for (int i = 0; i < 6; ++i)
    set_part(flow.stress[i], first, trial[i]);
  set_part(part(history.plastic_strain, first) + flow.strain, first, history.plastic_strain);
  set_part(part(history.dissipated_energy, first) + part(volume, first) * flow.dissipation, first,
           history.dissipated_energy);
  for (int point = 0; point < pack_width; ++point)
    sector[first + point] = static_cast<Sector>(static_cast<int>(flow.sector[point]));
}

/// Carries the stresses over a strain increment.
/// @param weighted_volume times the share that the energies count with [m³]; @param sector one entry per point
inline void update_stress(const MohrCoulomb &material, const Points &weighted_volume,
                          const Points (&strain_increment)[6], PointHistory &history, Sector *sector)
{
  const Points dissipated_before = history.dissipated_energy;
  Points trial[6], stiffness(1.), softness(1.);
  if (material.depends_on_pressure())
  {
    stiffness = material.stiffness_factor(Points((history.stress[0] + history.stress[1] + history.stress[2]) / 3.));
    softness = 1. / stiffness;
  }
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
    for (int first = 0; first < points_per_pack; first += pack_width)
      flow_plastically(material, weighted_volume, softness, first, trial, history, sector);
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
