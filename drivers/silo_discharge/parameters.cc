#include "drivers/silo_discharge/parameters.h"

#include "dem/core/error.h"
#include "dem/packing/largest_grain.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/number_text.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

SiloParameters::SiloParameters()
{
  sizes.kind = SizeKind::uniform;
  sizes.uniform = {.smallest_diameter = 2.9e-3, .largest_diameter = 3.1e-3, .shapes = {1., 0.}};
  simulation.grain() = {.young_modulus = 0.2e9, .poisson_ratio = 0.22, .density = 2500.};
  simulation.set_damping(0., 5.3e-7);
  simulation.verlet_distance = 0.25;
  simulation.time_step = 2e-5;
  output.n_samples = 300;
}

void SiloParameters::declare(ParameterFile &file)
{
  file.add("Silo", "width", width, "across the orifice [m]", Range::positive().usual(1e-4, 10));
  file.add("Silo", "depth", depth, "along the orifice, which is as long [m]", Range::positive().usual(1e-4, 10));
  file.add("Silo", "fill height", fill_height, "of the settled grains at the expected solid fraction [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Silo", "triangle size", triangle_size, "longest leg of the triangles of walls and floor [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Silo", "orifice widths", orifice_widths,
           "one discharge each, all of the same filled silo; three and more give Beverloo's law [m]",
           Range::positive().usual(1e-4, 10));
  file.add("Silo", "friction", friction, "among grains, and of grains and silo", Range::non_negative().usual(0, 2));
  file.add("Silo", "gravity", gravity, "downwards [m/s2]", Range::positive().usual(0.1, 1e4));

  sizes.declare(file);
  declare_grains(file, simulation);
  file.add("Grains", "relaxation time", simulation.between_grains().relaxation_time,
           "A of the viscoelastic damping at all contacts [s]", Range::non_negative().usual(1e-10, 1e-2));
  declare_overlap_tolerance(file, "Grains", simulation.contact.overlap_tolerance);

  file.add("Filling", "solid fraction", packing_solid_fraction, "of the packing from which the grains settle",
           {.lowest = 0, .highest = 0.7, .lowest_included = false});
  file.add("Filling", "expected solid fraction", expected_solid_fraction, "of the settled grains",
           {.lowest = 0, .highest = 0.8, .lowest_included = false});
  file.add("Filling", "damping ratio", filling_damping_ratio,
           "dashpot while the grains settle, share of critical damping; they come to rest sooner",
           Range::between(0, 10).usual(0, 1));
  file.add("Filling", "rest share", rest_share,
           "mean kinetic energy of a grain over its weight times its diameter, below which all are at rest",
           Range::positive());
  file.add("Filling", "longest time", longest_filling, "simulated, then the filling has failed [s]", Range::positive());
  file.add("Filling", "seed", seed, "of the random numbers");

  file.add("Discharge", "time", discharge_time, "at most, simulated [s]", Range::positive());
  file.add("Discharge", "last share", last_discharged, "of the mass that is discharged, after which it ends",
           {.lowest = 0, .highest = 1, .lowest_included = false});
  file.add("Discharge", "patience", patience, "without a grain that passes the orifice, after which it ends [s]",
           Range::positive());
  file.add("Discharge", "outlet depth", outlet_depth, "below the floor, where grains are taken away [m]",
           Range::positive());
  file.add("Discharge", "outlet interval", outlet_interval, "between two looks for such grains [s]", Range::positive());

  steady.declare(file);

  file.add("Velocity field", "height", field_height, "of the grid above the whole floor [m]", Range::positive());
  file.add("Velocity field", "cells", field_cells, "linear hexahedra along x, y and z", Range::between(1, 10000));
  file.add("Velocity field", "profile heights", profile_heights,
           "at which the mean velocity of the steady flow goes into profiles.csv [m]", Range::non_negative());

  file.add("Output", "time step", simulation.time_step, "[s]", Range::positive());
  output.declare(file, "grains, surfaces and velocity field of a discharge are");
}

void SiloParameters::validate() const
{
  sizes.validate(packing());
  discharge_simulation().validate();
  field_grid().validate();
  if (orifice_widths.empty())
    reject("Silo/orifice widths has no number; give one at least");
  for (std::size_t k = 1; k < orifice_widths.size(); ++k)
    if (!(orifice_widths[k] > orifice_widths[k - 1]))
      reject("Silo/orifice widths: ", orifice_widths[k], " follows ", orifice_widths[k - 1],
             "; give them from the least to the most");
  if (!(orifice_widths.back() < width))
    reject("Silo/orifice widths: ", orifice_widths.back(), " m leaves no floor in a silo of width ", width,
           " m; choose a smaller orifice or a wider silo");
  if (expected_solid_fraction < packing_solid_fraction)
    reject("Filling/expected solid fraction is ", expected_solid_fraction, ", below Filling/solid fraction, ",
           packing_solid_fraction, "; grains grow denser as they settle");
  steady.validate(last_discharged);
  for (const double cells : field_cells)
    if (cells != std::floor(cells))
      reject("Velocity field/cells: ", cells, " is no whole number");
  for (const double height : profile_heights)
    if (height > field_height)
      reject("Velocity field/profile heights: ", height, " m is above the grid, whose height is ", field_height, " m");
}

dem::PackingParameters SiloParameters::packing() const
{
  dem::PackingParameters packing;
  packing.solid_fraction = packing_solid_fraction;
  packing.density = simulation.grain().density;
  return packing;
}

dem::HexahedronGrid SiloParameters::field_grid() const
{
  const Vec3 half(0.5 * width, 0.5 * depth, 0.);
  dem::HexahedronGrid grid{.box = {-half, half + field_height * Vec3::UnitZ()}};
  for (int d = 0; d < 3; ++d)
    grid.n_cells[d] = static_cast<std::int32_t>(field_cells[d]);
  return grid;
}

dem::SimulationParameters SiloParameters::discharge_simulation() const
{
  dem::SimulationParameters p = simulation;
  p.wall() = p.grain();
  p.set_damping(simulation.between_grains().damping_ratio, simulation.between_grains().relaxation_time);
  for (dem::SurfacePair &pair : p.materials.surface_pairs())
    pair.friction = friction;
  p.gravity = {0., 0., -gravity};
  return p;
}

dem::SimulationParameters SiloParameters::filling_simulation() const
{
  dem::SimulationParameters p = discharge_simulation();
  p.set_damping(simulation.between_grains().damping_ratio + filling_damping_ratio,
                simulation.between_grains().relaxation_time);
  return p;
}

std::string SiloParameters::orifice_name(const double width)
{
  return short_text(1e3 * width) + "mm";
}

bool SiloParameters::has_choi_orifice() const
{
  constexpr double rounding = 1e-9;
  return std::abs(depth - 0.025) < rounding &&
         std::any_of(orifice_widths.begin(), orifice_widths.end(),
                     [](const double w) { return std::abs(w - 0.016) < rounding; });
}

} // namespace bergamo::driver
