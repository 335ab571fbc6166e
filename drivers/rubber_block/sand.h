#pragma once

#include "dem/simulation/simulation.h"
#include "drivers/common/summary.h"
#include "drivers/rubber_block/parameters.h"

#include <memory>

namespace bergamo::driver
{

/// Grains between the six walls of the box, packed without contacts (Wellmann 3.4.4); nothing where the user interrupts
/// it. @throws ConfigError for a box that is too small, RunError for a packing that gets stuck
std::unique_ptr<dem::Simulation> pack_sand(const RubberBlockParameters &parameters);

/// The highest point of any grain [m].
double top_of(const dem::Particles &grains);

/// What the sand is like where the block comes onto it.
struct SettledSand
{
  double height = 0.;         ///< highest point of any grain [m]
  double solid_fraction = 0.; ///< below it
  double coordination_number = 0.;
  double floor_share = 0.; ///< force on the bottom over what the grains weigh while they settle
  double mean_speed = 0.;  ///< root of the mean square at the end of the settling [m/s]

  void add_to(Summary &summary) const;

  template <class Visit>
  void visit(Visit &visit)
  {
    visit("settled/height", height);
    visit("settled/solid_fraction", solid_fraction);
    visit("settled/coordination_number", coordination_number);
    visit("settled/floor_share", floor_share);
    visit("settled/mean_speed", mean_speed);
  }
};

/// Measures the sand at the end of its settling, once forces are known, then stops the grains, opens the box and goes
/// over to the parameters of the pull.
SettledSand end_settling(dem::Simulation &sand, const RubberBlockParameters &parameters);

} // namespace bergamo::driver
