#include "drivers/two_scale_triaxial/parameters.h"

#include "dem/core/error.h"
#include "dem/motion/stable_step.h"
#include "drivers/common/coupling_parameters.h"
#include "drivers/common/grain_parameters.h"
#include "drivers/common/loading_parameters.h"
#include "drivers/common/number_text.h"
#include "drivers/common/run/step_count.h"

#include <cmath>
#include <utility>

namespace bergamo::driver
{

TriaxialParameters::TriaxialParameters()
{
  simulation.time_step = 1.2e-7;
  continuum.mohr_coulomb.density = 1780.;
}

void TriaxialParameters::declare(ParameterFile &file)
{
  file.add("Model", "kind", kind, "which models share the cube",
           {{"two-scale", ModelKind::two_scale}, {"grains", ModelKind::grains}, {"continuum", ModelKind::continuum}});
  file.add("Model", "edge", edge, "edge of the cube [m]", Range::positive().usual(1e-4, 10));
  file.add("Model", "elements per edge", layers.per_edge, "hexahedra along an edge of the cube",
           Range::between(2, 200));
  file.add("Model", "elements per height", layers.per_height,
           "layers of elements, or of grains as thick, along z of a periodic cell; 0: as many as along an edge",
           Range::between(0, 1000));
  file.add("Model", "continuum layers", layers.continuum, "layers of elements, from the bottom",
           Range::between(1, 200));
  file.add("Model", "overlap layers", layers.overlap, "of these, the layers shared with the grains",
           Range::between(1, 200));
  file.add("Model", "interface", interface_shape, "how the continuum's upper face goes along x",
           {{"flat", InterfaceShape::flat},
            {"inclined", InterfaceShape::inclined},
            {"stepped", InterfaceShape::stepped},
            {"curved", InterfaceShape::curved}});
  file.add("Model", "weight", weight, "how the grains' weights grow through the overlap",
           {{"linear", coupling::WeightShape::linear}, {"smooth", coupling::WeightShape::smooth}});
  file.add("Model", "bending elements", bending_elements,
           "one law for each hexahedron, and a stiffness of its own where it bends");
  file.add("Model", "large strain", large_strain,
           "elements of the present shape, for soil that strains by more than a percent or turns; not of bending ones");

  declare_sample(file);
  file.add("Grains", "friction", simulation.between_grains().friction,
           "Coulomb's coefficient between grains during the loading", Range::non_negative().usual(0, 10));
  declare_overlap_tolerance(file, "Grains", simulation.contact.overlap_tolerance);
  file.add("Packing", "sample", sample,
           "sample.h5 of an earlier run's folder with the same grains, packing and edges; empty: one is made");

  continuum.declare(file);
  file.add("Continuum", "damping", continuum_damping, "mass-proportional [1/s]", Range::non_negative());

  file.add("Continuum", "steps per force", steps_per_force,
           "of the grains, from one computation of the elements' forces to the next, where both are joined",
           Range::between(1, 1000));

  declare_coupling(file, coupling);

  declare_strain_program(file, program);
  file.add("Loading", "time step", simulation.time_step, "[s]", Range::positive());

  output.declare(file, "grains and mesh are");
}

/// All but the edges of the specimen.
void TriaxialParameters::declare_sample(ParameterFile &file)
{
  file.add(
      "Model", "sides", sides,
      "what bounds the specimen: smooth walls, or a cell that repeats itself in all directions, with the continuum "
      "half-way up and an overlap at either face of it",
      {{"walls", Sides::walls}, {"periodic", Sides::periodic}});
  declare_distribution(file, "Grains", distribution);
  declare_grains(file, simulation);
  file.add("Packing", "seed", seed, "of all random numbers");
  file.add("Packing", "initial solid fraction", initial_solid_fraction, "of the grains placed at random",
           {.lowest = 0, .highest = 1, .lowest_included = false});
  file.add("Packing", "expected solid fraction", expected_solid_fraction, "after the compression; sets how many grains",
           {.lowest = 0, .highest = 1, .lowest_included = false});
  file.add("Packing", "tightened solid fraction", tightened_solid_fraction,
           "of grains in a periodic cell, before it is compressed",
           {.lowest = 0, .highest = 0.7, .lowest_included = false});
  file.add("Packing", "friction", packing_friction, "between grains during the compression: less gives denser packings",
           Range::non_negative().usual(0, 2));
  declare_compression(file, compression);
  file.add("Packing", "time step", packing_time_step, "during the compression [s]", Range::positive());
  file.add("Packing", "overlap tolerance", packing_overlap_tolerance, "see Grains/overlap tolerance",
           Range::between(0, 0.1));
}

std::string TriaxialParameters::sample_text() const
{
  TriaxialParameters own = *this;
  ParameterFile file("A packing for a triaxial test in two scales");
  own.declare_sample(file);
  std::string text = file.resolved_text() + "edges =";
  for (const double length : edges())
    text += " " + exact_text(length);
  return text;
}

void TriaxialParameters::validate() const
{
  distribution.validate();
  simulation.validate();
  packing_simulation().validate();
  compression.validate();
  program.validate();
  loading_steps();
  if (is_periodic())
  {
    if (interface_shape != InterfaceShape::flat)
      reject(
          "Model/interface is not flat, but a periodic cell (Model/sides) has flat ones alone: choose flat, or walls");
    if (coupling.renewal > 0. && kind == ModelKind::two_scale)
      reject("Coupling/renewal is ", coupling.renewal,
             ", but the overlaps of a periodic cell (Model/sides) stay as they are made: choose 0, or walls");
  }
  else if (layers.high() != layers.per_edge)
    reject("Model/elements per height is ", layers.per_height, " beside ", layers.per_edge,
           " per edge: between walls the specimen is a cube; choose 0, or Model/sides = periodic");
  if (kind == ModelKind::two_scale)
  {
    if (is_periodic())
      require_interlayer(layers);
    else
      layers.validate(interface_shape);
    if (element_size() < 2. * distribution.mean_half_axes.mean())
      reject("the elements are smaller than a grain: edge over elements per edge is ", element_size(),
             " m; choose fewer Model/elements per edge or a larger Model/edge");
  }
  if (has_continuum())
  {
    if (bending_elements && large_strain)
      reject("Model/large strain has no bending elements; choose one of Model/bending elements and Model/large strain");
    continuum.validate();
    continuum.require_pressure(compression.pressure, "the cube has", "raise Packing/pressure");
  }
  if (!has_grains())
    return;
  const double least_edge = 2. * distribution.largest_half_axis * std::sqrt(3.);
  if (edge < least_edge)
    reject("Model/edge is ", edge, " m: the largest grains do not fit; it must exceed ", least_edge, " m");
  if (initial_solid_fraction > 0.3)
    reject("Packing/initial solid fraction is ", initial_solid_fraction,
           ": grains cannot be placed at random above about 0.3; 0.2 is safe");
  // At an overlap of 1e-5 radii: no packing under load is softer.
  const double limit = dem::stable_step_of_two_spheres(distribution.smallest_half_axis, simulation.grain(), 1e-5);
  for (const auto &[name, step] :
       {std::pair("Loading/time step", simulation.time_step), std::pair("Packing/time step", packing_time_step)})
    if (step > limit)
      reject(name, " is ", step, " s: it must stay below ", limit,
             " s, the stable step of two of the smallest grains in contact");
}

Layout TriaxialParameters::layout(const dem::Box &specimen) const
{
  if (is_periodic())
    return Interlayer(layers, specimen);
  return Interface(interface_shape, layers, specimen);
}

GradingParameters TriaxialParameters::grading() const
{
  GradingParameters sizes;
  sizes.kind = SizeKind::gaussian;
  sizes.gaussian = distribution;
  return sizes;
}

std::int64_t TriaxialParameters::loading_steps() const
{
  const std::int64_t steps = steps_over({"Loading/isotropic time + shear time", program.end_time()},
                                        {"Loading/time step", simulation.time_step});
  return (steps + cycle() - 1) / cycle() * cycle();
}

dem::SimulationParameters TriaxialParameters::loading_simulation() const
{
  dem::SimulationParameters loading = simulation;
  loading.with_walls().damping_ratio = loading.between_grains().damping_ratio;
  return loading;
}

dem::SimulationParameters TriaxialParameters::packing_simulation() const
{
  dem::SimulationParameters packing = loading_simulation();
  packing.between_grains().friction = packing_friction;
  packing.time_step = packing_time_step;
  packing.contact.overlap_tolerance = packing_overlap_tolerance;
  return packing;
}

} // namespace bergamo::driver
