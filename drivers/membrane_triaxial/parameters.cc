#include "drivers/membrane_triaxial/parameters.h"

#include "dem/core/error.h"
#include "dem/motion/stable_step.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/run/step_count.h"
#include "drivers/common/smooth_step.h"

#include <algorithm>

namespace bergamo::driver
{

MembraneParameters::MembraneParameters()
{
  rubber.density = 5000.;
}

void MembraneParameters::declare_surface(ParameterFile &file)
{
  file.add("Membrane", "elements around", n_around, "", Range::between(6, 1000));
  file.add("Membrane", "elements high", n_high, "", Range::between(2, 1000));
  file.add("Membrane", "contact modulus", contact_modulus,
           "Young's modulus of its skin in Hertz's law; grains sink into one as soft as rubber [Pa]",
           Range::positive().usual(1e4, 1e12));
}

void MembraneParameters::declare_rubber(ParameterFile &file)
{
  file.add("Membrane", "thickness", thickness, "where it is free of stress [m]", Range::positive().usual(1e-5, 0.02));
  file.add("Membrane", "density", rubber.density, "more than rubber's allows longer steps [kg/m3]",
           Range::positive().usual(500, 2e4));
  file.add("Membrane", "moduli", std::span<double>(rubber.modulus), "mu of Ogden's three terms [Pa]");
  file.add("Membrane", "exponents", std::span<double>(rubber.exponent), "alpha of Ogden's three terms");
  file.add("Membrane", "friction", friction, "Coulomb's coefficient between grains and membrane",
           Range::non_negative().usual(0, 2));
}

void MouldParameters::declare(ParameterFile &file)
{
  file.add("Mould", "diameter", diameter, "of the loose packing [m]", Range::positive().usual(1e-3, 2));
  file.add("Mould", "height", height, "of the loose packing [m]", Range::positive().usual(1e-3, 4));
  file.add("Mould", "solid fraction", solid_fraction, "of the loose packing",
           {.lowest = 0, .highest = 0.6, .lowest_included = false});
  file.add("Mould", "seed", seed, "of all random numbers");
  file.add("Mould", "friction", friction, "between grains while it shrinks: less gives denser samples",
           Range::non_negative().usual(0, 2));
  file.add("Mould", "pressure", pressure, "at which its shrinking ends [Pa]", Range::positive().usual(100, 1e9));
  file.add("Mould", "largest rate", largest_rate, "of its shrinking [1/s]", Range::positive());
  file.add("Mould", "pressure tolerance", pressure_tolerance, "at its end, over the pressure",
           Range::strictly_between(0, 1));
  file.add("Mould", "force tolerance", force_tolerance, "mean unbalanced over mean contact force at its end",
           Range::strictly_between(0, 1));
  file.add("Mould", "time step", time_step, "[s]", Range::positive());
  file.add("Mould", "longest time", longest_time, "simulated, then the shrinking has failed [s]", Range::positive());
}

MembraneTriaxialParameters::MembraneTriaxialParameters()
{
  sizes.kind = SizeKind::uniform;
  sizes.uniform = {.smallest_diameter = 3.3e-3, .largest_diameter = 3.6e-3, .shapes = {1., 0.}};
  simulation.grain() = {.young_modulus = 63e9, .poisson_ratio = 0.23, .density = 2550.};
  simulation.between_grains().friction = 0.16;
  simulation.with_walls().friction = 0.1;
  simulation.verlet_distance = 0.25;
  simulation.time_step = 8e-7;
  output.snapshot_interval = 60;
  output.n_samples = 400;
}

void MembraneTriaxialParameters::declare_sample(ParameterFile &file)
{
  sizes.declare(file);
  declare_grains(file, simulation);
  mould.declare(file);
  membrane.declare_surface(file);
}

std::string MembraneTriaxialParameters::sample_text() const
{
  MembraneTriaxialParameters own = *this;
  ParameterFile file("A sample for a triaxial test in a membrane");
  own.declare_sample(file);
  return file.resolved_text();
}

void MembraneTriaxialParameters::declare(ParameterFile &file)
{
  declare_sample(file);
  membrane.declare_rubber(file);
  file.add("Mould", "sample", sample,
           "sample.h5 of an earlier run's folder with the same grains, mould and elements of the membrane; empty: one "
           "is made");
  file.add("Grains", "friction", simulation.between_grains().friction, "Coulomb's coefficient between grains",
           Range::non_negative().usual(0, 2));
  file.add("Grains", "plate friction", simulation.with_walls().friction, "the same between grains and the rigid plates",
           Range::non_negative().usual(0, 2));
  declare_overlap_tolerance(file, "Grains", simulation.contact.overlap_tolerance);
  file.add("Test", "gravity", gravity, "once the mould is gone [m/s2]", Range::non_negative());
  file.add("Test", "lateral pressure", pressure, "of the air around the membrane [Pa]",
           Range::positive().usual(100, 1e9));
  file.add("Test", "loading time", loading_time, "over which it grows from that of the mould, smoothly [s]",
           Range::positive());
  file.add("Test", "pressure tolerance", pressure_tolerance, "of the plates before the compression, over the pressure",
           Range::strictly_between(0, 1));
  file.add("Test", "force tolerance", force_tolerance, "mean unbalanced over mean contact force before the compression",
           Range::strictly_between(0, 1));
  file.add("Test", "longest loading", longest_loading, "simulated, then the loading has failed [s]", Range::positive());
  file.add("Test", "inertial number", inertial_number, "of the compression",
           {.lowest = 0, .highest = 0.1, .lowest_included = false});
  file.add("Test", "axial strain", axial_strain, "at the end, of the height under pressure",
           {.lowest = 0, .highest = 0.5, .lowest_included = false});
  file.add("Test", "start strain", start_strain, "over which the plates come to their speed, smoothly",
           {.lowest = 0, .highest = 0.1, .lowest_included = false});
  file.add("Test", "time step", simulation.time_step, "[s]", Range::positive());
  output.declare(file, "grains and membrane are");
}

void MembraneTriaxialParameters::validate() const
{
  dem::PackingParameters packing;
  packing.solid_fraction = mould.solid_fraction;
  sizes.validate(packing);
  membrane.rubber.validate();
  shrinking().validate();
  testing().validate();
  if (pressure < mould.pressure)
    reject("Test/lateral pressure is ", pressure, " Pa, less than Mould/pressure, ", mould.pressure,
           " Pa: the sample is not unloaded before the test");
  if (!(start_strain < axial_strain))
    reject("Test/start strain is ", start_strain, ": it must stay below Test/axial strain, ", axial_strain);
  require_stable(mould.time_step, "Mould/time step");
  require_stable(simulation.time_step, "Test/time step");
}

double MembraneTriaxialParameters::smallest_radius() const
{
  return sizes.kind == SizeKind::gaussian  ? sizes.gaussian.smallest_half_axis
         : sizes.kind == SizeKind::uniform ? 0.5 * sizes.uniform.smallest_diameter
                                           : 0.5 * sizes.d10;
}

/// At an overlap of 1e-5 radii: no packing under load is softer.
void MembraneTriaxialParameters::require_stable(const double time_step, const char *name) const
{
  const double limit = dem::stable_step_of_two_spheres(smallest_radius(), simulation.grain(), 1e-5);
  if (time_step > limit)
    reject(name, " is ", time_step, " s: it must stay below ", limit,
           " s, the stable step of two small grains in contact");
}

dem::SimulationParameters MembraneTriaxialParameters::testing() const
{
  dem::SimulationParameters p = simulation;
  p.wall() = p.grain();
  p.gravity = {0., 0., -gravity};
  p.materials.add({membrane.contact_modulus, 0.49, membrane.rubber.density});
  p.materials.between(dem::grain_material, membrane_material).friction = membrane.friction;
  p.set_damping(simulation.between_grains().damping_ratio);
  return p;
}

dem::SimulationParameters MembraneTriaxialParameters::shrinking() const
{
  dem::SimulationParameters p = testing();
  p.gravity = Vec3::Zero();
  p.between_grains().friction = mould.friction;
  p.with_walls().friction = p.materials.between(dem::grain_material, membrane_material).friction = 0.;
  p.time_step = mould.time_step;
  return p;
}

double MembraneTriaxialParameters::pressure_at(const double time) const
{
  return mould.pressure + (pressure - mould.pressure) * smooth_step(time / loading_time);
}

double MembraneTriaxialParameters::strain_rate(const dem::MeanGrain &grain) const
{
  return dem::strain_rate_of(grain, inertial_number, pressure);
}

/// A smooth start takes twice as long as full speed.
double MembraneTriaxialParameters::duration(const dem::MeanGrain &grain) const
{
  return (axial_strain + start_strain) / strain_rate(grain);
}

double MembraneTriaxialParameters::rate_at(const double time, const dem::MeanGrain &grain) const
{
  const double rate = strain_rate(grain);
  return rate * smooth_step(time * rate / (2. * start_strain));
}

std::int64_t MembraneTriaxialParameters::n_steps(const dem::MeanGrain &grain) const
{
  return steps_over({"Test/axial strain at Test/inertial number", duration(grain)},
                    {"Test/time step", simulation.time_step});
}

} // namespace bergamo::driver
