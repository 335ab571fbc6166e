#include "drivers/hourglass/parameters.h"

#include "dem/core/error.h"
#include "drivers/common/grain_parameters.h"

namespace bergamo::driver
{

HourglassParameters::HourglassParameters()
{
  simulation.grain().young_modulus = 1e7;
  simulation.set_damping(0.5);
  simulation.verlet_distance = 0.2;
  simulation.time_step = 8e-6;
  output.n_pictures = 11;
}

void HourglassParameters::declare(ParameterFile &file)
{
  file.add("Glass", "neck radius", glass.neck_radius, "[m]", Range::positive().usual(1e-4, 10));
  file.add("Glass", "chamber radius", glass.chamber_radius, "[m]", Range::positive().usual(1e-4, 10));
  file.add("Glass", "half angle", glass.half_angle, "of the cones, from the axis [degrees]",
           Range::strictly_between(0, 90).usual(2, 88));
  file.add("Glass", "cylinder height", glass.cylinder_height, "above the upper cone, and below the lower one [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Glass", "facets", glass.n_facets, "around", Range::between(3, 1000));
  file.add("Glass", "triangle size", glass.triangle_size, "along the walls at most [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Glass", "friction", friction, "among grains, and of grains and glass", Range::non_negative().usual(0, 2));
  file.add("Glass", "gravity", gravity, "downwards [m/s2]", Range::positive().usual(0.1, 1e4));

  sizes.declare(file);
  declare_grains(file, simulation);
  declare_overlap_tolerance(file, "Grains", simulation.contact.overlap_tolerance);

  file.add("Filling", "bottom", fill_bottom, "of the packing above the neck [m]", Range::non_negative());
  file.add("Filling", "height", fill_height, "of its top above the neck [m]", Range::positive());
  file.add("Filling", "solid fraction", solid_fraction, "of the packing",
           {.lowest = 0, .highest = 0.7, .lowest_included = false});
  file.add("Filling", "seed", seed, "of the random numbers");

  file.add("Discharge", "longest time", longest_time, "simulated [s]", Range::positive());
  file.add("Discharge", "last share", last_discharged, "of the mass that has passed the neck, after which the run ends",
           {.lowest = 0, .highest = 1, .lowest_included = false});
  file.add("Discharge", "patience", patience, "without a grain that passes the neck, after which it ends [s]",
           Range::positive());
  steady.declare(file);

  file.add("Output", "time step", simulation.time_step, "[s]", Range::positive());
  output.declare(file, "grains and glass are");
}

void HourglassParameters::validate() const
{
  sizes.validate(packing());
  simulation_parameters().validate();
  steady.validate(last_discharged);
  if (!(glass.chamber_radius > glass.neck_radius))
    reject("Glass/chamber radius is ", glass.chamber_radius, " m; choose more than Glass/neck radius, ",
           glass.neck_radius, " m");
  if (!(fill_height > fill_bottom))
    reject("Filling/height is ", fill_height, " m; choose more than Filling/bottom, ", fill_bottom, " m");
  if (fill_height > glass.height())
    reject("Filling/height is ", fill_height, " m, but the chamber ends ", glass.height(),
           " m above the neck; choose less, or a higher Glass/cylinder height");
}

dem::PackingParameters HourglassParameters::packing() const
{
  dem::PackingParameters packing;
  packing.solid_fraction = solid_fraction;
  packing.density = simulation.grain().density;
  return packing;
}

dem::SimulationParameters HourglassParameters::simulation_parameters() const
{
  dem::SimulationParameters p = simulation;
  p.wall() = p.grain();
  p.set_damping(simulation.between_grains().damping_ratio);
  for (dem::SurfacePair &pair : p.materials.surface_pairs())
    pair.friction = friction;
  p.gravity = {0., 0., -gravity};
  return p;
}

} // namespace bergamo::driver
