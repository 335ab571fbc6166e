#pragma once

#include "dem/packing/space.h"
#include "dem/simulation/simulation.h"
#include "drivers/common/run/run.h"
#include "drivers/common/sand_parameters.h"
#include "drivers/common/summary.h"

#include <memory>

namespace bergamo::driver
{

/// Grains between the six walls of a box, packed without contacts (Wellmann 3.4.4) or read from Sand/grains file, with
/// the parameters of their settling; nothing where the user interrupts it. @param box with the edges of sand.box;
/// @param progress which is told what was read
/// @throws ConfigError for a box that is too small, RunError for a packing that gets stuck
std::unique_ptr<dem::Simulation> pack_sand(Progress &progress, const SandParameters &sand, const dem::Box &box,
                                           const dem::SimulationParameters &settling);

/// The same between four walls, in a cell that repeats itself along x. @param tile box of the cell, from x = 0
std::unique_ptr<dem::Simulation> pack_sand_tile(const SandParameters &sand, const dem::Box &tile,
                                                const dem::SimulationParameters &settling);

/// Lets packed sand settle, as a stage of a run, to the forces of its last step. @return false where the user has
/// stopped the run
bool settle_sand(Run &run, dem::Simulation &sand, const SandParameters &parameters);

/// What sand is like at the end of its settling.
struct SettledSand
{
  double height = 0.;         ///< highest point of any grain, above the box's bottom at z = 0 [m]
  double level = 0.;          ///< of the sand if it were evenly dense: twice the height of its centre of mass [m]
  double solid_fraction = 0.; ///< below the height
  double coordination_number = 0.;
  double floor_share = 0.; ///< force on the bottom over what the grains weigh while they settle
  double mean_speed = 0.;  ///< root of the mean square at the end of the settling [m/s]

  void add_to(Summary &summary) const;

  template <class Visit>
  void visit(Visit &visit)
  {
    visit("settled/height", height);
    visit("settled/level", level);
    visit("settled/solid_fraction", solid_fraction);
    visit("settled/coordination_number", coordination_number);
    visit("settled/floor_share", floor_share);
    visit("settled/mean_speed", mean_speed);
  }
};

/// Measures the sand at the end of its settling, once forces are known, then stops the grains, opens the box, and goes
/// over to other parameters. The walls keep their order: x-, x+, y-, y+, and the bottom; those at the ends of x are
/// missing where the sand was a tile.
SettledSand end_settling(dem::Simulation &sand, const SandParameters &parameters,
                         const dem::SimulationParameters &after);

/// Of the walls of a box once it is open.
inline constexpr std::size_t bottom_wall = 4;

} // namespace bergamo::driver
