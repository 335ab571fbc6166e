#pragma once

#include "fe_dealii/element/point_history.h"

namespace bergamo::fe
{

inline SandState sand_state(const SandHistory &history, const int point)
{
  SandState state;
  for (int i = 0; i < 6; ++i)
    state.stress[i] = history.stress[i][point];
  state.void_ratio = history.void_ratio[point];
  return state;
}

/// Carries the stresses and void ratios of eight points over a strain increment, one point after the other: their
/// substeps differ. What a point cannot follow leaves it as it was.
/// @param weighted_volume times the share that the energies count with [m³]; @param report one entry per point
/// @return whether all points could follow
inline bool update_stress(const HypoplasticSand &material, const Points &weighted_volume,
                          const Points (&strain_increment)[6], SandHistory &history, SandUpdateStatus *report)
{
  bool all_followed = true;
  for (int point = 0; point < points_per_pack; ++point)
  {
    Strain increment;
    for (int i = 0; i < 6; ++i)
      increment[i] = strain_increment[i][point];
    const SandState before = sand_state(history, point);
    const SandUpdate result = update(material, before, increment);
    report[point] = result.status;
    if (result.status != SandUpdateStatus::done)
    {
      all_followed = false;
      continue;
    }
    double work = 0;
    for (int i = 0; i < 6; ++i)
    {
      work += 0.5 * (before.stress[i] + result.state.stress[i]) * increment[i];
      history.stress[i][point] = result.state.stress[i];
    }
    history.void_ratio[point] = result.state.void_ratio;
    history.plastic_strain[point] += equivalent_strain(increment);
    history.dissipated_energy[point] += weighted_volume[point] * work;
  }
  return all_followed;
}

} // namespace bergamo::fe
