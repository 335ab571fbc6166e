#pragma once

#include "fe_dealii/element/stress_update.h"

#include <type_traits>

/// What a law of small strain, asked at the mean strain of an element, lets the element's hourglass forces do in a
/// step. They follow a = kept (a + stiffness Δq): elastic, and where the mean flows they fade with its deviator, as
/// that of every point would that flows by the same amount. So they stay of the size of the strength times the ratio of
/// both strain rates, where forces of the elastic stiffness alone would grow without a bound.
namespace bergamo::fe::bending
{

struct HourglassStep
{
  Points stiffness; ///< factor of the moduli
  Points kept;      ///< in [0, 1]; 1 where nothing flows
};

/// Share of `of` that `kept` has in its direction, in [0, 1]; none of nothing. Stresses xx yy zz xy yz zx.
template <class Real>
Real kept_share(const Real (&kept)[6], const Real (&of)[6])
{
  Real along = 2. * (kept[3] * of[3] + kept[4] * of[4] + kept[5] * of[5]);
  Real square = 2. * (of[3] * of[3] + of[4] * of[4] + of[5] * of[5]);
  for (int i = 0; i < 3; ++i)
  {
    along += kept[i] * of[i];
    square += of[i] * of[i];
  }
  const Real share = along / math::select(square > 0., square, Real(1.));
  return math::select(share > 1., Real(1.), math::select(share > 0., share, Real(0.)));
}

template <class Real>
void take_off_mean(Real (&stress)[6])
{
  const Real mean = (stress[0] + stress[1] + stress[2]) / 3.;
  for (int i = 0; i < 3; ++i)
    stress[i] -= mean;
}

/// @param before, after the step; @param strain its increment; @param report one entry a lane
inline HourglassStep hourglass_step(const MohrCoulomb &law, const PointHistory &before, const Points (&strain)[6],
                                    const PointHistory &after, const Sector *report)
{
  HourglassStep step{Points(1.), Points(1.)};
  if (law.depends_on_pressure())
    step.stiffness = law.stiffness_factor(invariants_of(before.stress).mean);
  if (std::all_of(report, report + points_per_pack, [](const Sector sector) { return sector == Sector::elastic; }))
    return step;
  Points trial[6], deviator[6];
  elastic_stress(law, strain, trial);
  for (int i = 0; i < 6; ++i)
  {
    trial[i] = before.stress[i] + step.stiffness * trial[i];
    deviator[i] = after.stress[i];
  }
  take_off_mean(trial);
  take_off_mean(deviator);
  const Points share = kept_share(deviator, trial);
  for (int lane = 0; lane < points_per_pack; ++lane)
    if (report[lane] != Sector::elastic)
      step.kept[lane] = share[lane];
  return step;
}

/// Of sand, which has no elastic part, the whole stress fades: its deviator may be nothing while it forgets as fast.
inline HourglassStep hourglass_step(const HypoplasticSand &law, const SandHistory &before, const Points (&strain)[6],
                                    const SandHistory &after, const SandUpdateStatus *)
{
  HourglassStep step;
  for (int lane = 0; lane < points_per_pack; ++lane)
    step.stiffness[lane] = law.stiffness_factor(sand_state(before, lane));
  Points trial[6];
  elastic_stress(law, strain, trial);
  for (int i = 0; i < 6; ++i)
    trial[i] = before.stress[i] + step.stiffness * trial[i];
  step.kept = kept_share(after.stress, trial);
  return step;
}

} // namespace bergamo::fe::bending
