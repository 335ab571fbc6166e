#include "dem/simulation/simulation_parameters.h"

#include "dem/core/error.h"

#include <cmath>

namespace bergamo::dem
{

SimulationParameters::SimulationParameters() : materials({Material(), Material()})
{
  with_walls().friction = 0.;
}

void SimulationParameters::set_damping(const double ratio, const double relaxation_time)
{
  for (SurfacePair &pair : materials.surface_pairs())
  {
    pair.damping_ratio = ratio;
    pair.relaxation_time = relaxation_time;
  }
}

void SimulationParameters::validate() const
{
  materials.validate();
  contact.validate();
  require(time_step > 0. && std::isfinite(time_step), "time step", time_step, "positive [s]");
  require(verlet_distance > 0. && verlet_distance <= 2., "Verlet distance", verlet_distance,
          "in (0, 2] mean bounding radii");
  require(sort_interval >= 1, "interval of sorting", sort_interval, "at least 1 renewal of the neighbours");
  require(gravity.allFinite(), "gravity", gravity.norm(), "finite [m/s^2]");
}

} // namespace bergamo::dem
