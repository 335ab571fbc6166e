#pragma once

#include "fe_dealii/element/point_history.h"
#include "fe_dealii/element/points.h"
#include "fe_dealii/element/sand_update.h"
#include "fe_dealii/material/linear_elastic.h"
#include "fe_dealii/material/mohr_coulomb.h"
#include "fe_dealii/material/plastic_flow.h"

/// Laws of small strain at the eight points of a pack. Strains are xx yy zz xy yz zx with engineering shears.
namespace bergamo::fe
{

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

/// Carries the stresses over a strain increment. @return whether all points could follow: any increment can be
inline bool update_stress(const LinearElastic &material, const Points &, const Points (&strain_increment)[6],
                          PointHistory &history, Sector *)
{
  Points increment[6];
  elastic_stress(material, strain_increment, increment);
  for (int i = 0; i < 6; ++i)
    history.stress[i] += increment[i];
  return true;
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
  const PlasticFlow<Pack> flow =
      plastic_flow(material, stress_old, stress_trial, part(softness, first), part(history.plastic_strain, first));
  for (int i = 0; i < 6; ++i)
    set_part(flow.stress[i], first, trial[i]);
  set_part(part(history.plastic_strain, first) + flow.strain, first, history.plastic_strain);
  set_part(part(history.dissipated_energy, first) + part(volume, first) * flow.dissipation, first,
           history.dissipated_energy);
  for (int point = 0; point < pack_width; ++point)
    sector[first + point] = static_cast<Sector>(static_cast<int>(flow.sector[point]));
}

/// Mean stress and second invariant of the deviator.
struct Invariants
{
  Points mean, j2;
};
inline Invariants invariants_of(const Points (&stress)[6])
{
  const Points mean = (stress[0] + stress[1] + stress[2]) / 3.;
  const Points x = stress[0] - mean, y = stress[1] - mean, z = stress[2] - mean;
  return {mean, (x * x + y * y + z * z) * 0.5 + stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5]};
}

/// What a step of changing stiffness takes of the elastic work beyond the energy that it stores: the work is
/// ½(σ_old + σ_new) : Δε_e, with the elastic strain of the stresses' own change. @param softness of this increment
inline Points stiffness_loss(const MohrCoulomb &material, const Invariants &before, const Invariants &after,
                             const Points &softness)
{
  const Points work =
      softness * ((after.mean * after.mean - before.mean * before.mean) * (0.5 / material.bulk_modulus()) +
                  (after.j2 - before.j2) * (0.5 / material.shear_modulus()));
  return work - (material.elastic_energy_density(after.mean, after.j2) -
                 material.elastic_energy_density(before.mean, before.j2, softness));
}

/// Carries the stresses over a strain increment.
/// @param weighted_volume times the share that the energies count with [m³]; @param sector one entry per point
/// @return whether all points could follow: any increment can be
inline bool update_stress(const MohrCoulomb &material, const Points &weighted_volume,
                          const Points (&strain_increment)[6], PointHistory &history, Sector *sector)
{
  Points trial[6], stiffness(1.), softness(1.);
  Invariants before{};
  if (material.depends_on_pressure())
  {
    before = invariants_of(history.stress);
    stiffness = material.stiffness_factor(before.mean);
    softness = 1. / stiffness;
  }
  elastic_stress(material, strain_increment, trial);
  for (int i = 0; i < 6; ++i)
    trial[i] = history.stress[i] + stiffness * trial[i];
  const Invariants of_trial = invariants_of(trial);
  const auto elastic = material.is_surely_elastic(of_trial.mean, of_trial.j2, history.plastic_strain);
  for (int point = 0; point < points_per_pack; ++point)
    sector[point] = Sector::elastic;
  if (math::any(!elastic))
    for (int first = 0; first < points_per_pack; first += pack_width)
      flow_plastically(material, weighted_volume, softness, first, trial, history, sector);
  if (material.depends_on_pressure())
    history.stiffness_loss += weighted_volume * stiffness_loss(material, before, invariants_of(trial), softness);
  for (int i = 0; i < 6; ++i)
    history.stress[i] = trial[i];
  return true;
}

} // namespace bergamo::fe
