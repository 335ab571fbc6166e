#include "drivers/two_scale_triaxial/parameters.h"

#include "dem/core/error.h"
#include "drivers/common/continuum_parameters.h"
#include "drivers/common/grain_parameters.h"

#include <cmath>
#include <numbers>
#include <sstream>

namespace bergamo::driver
{

TriaxialParameters::TriaxialParameters()
{
  simulation.time_step = 1.2e-7;
  continuum.density = 1780.;
}

void TriaxialParameters::declare(ParameterFile &file)
{
  file.add("Model", "kind", kind, "which models share the cube",
           {{"two-scale", ModelKind::two_scale}, {"grains", ModelKind::grains}, {"continuum", ModelKind::continuum}});
  file.add("Model", "edge", edge, "edge of the cube [m]", Range::positive());
  file.add("Model", "elements per edge", elements_per_edge, "hexahedra along an edge of the cube",
           Range::between(2, 200));
  file.add("Model", "continuum layers", continuum_layers, "layers of elements, from the bottom",
           Range::between(1, 200));
  file.add("Model", "overlap layers", overlap_layers, "of these, the layers shared with the grains",
           Range::between(1, 200));

  declare_distribution(file, "Grains", distribution);
  declare_grains(file, simulation);
  file.add("Grains", "friction", simulation.between_grains().friction,
           "Coulomb's coefficient between grains during the loading", Range::non_negative());
  declare_overlap_tolerance(file, "Grains", simulation.contact.overlap_tolerance);

  file.add("Packing", "seed", seed, "of all random numbers");
  file.add("Packing", "initial solid fraction", initial_solid_fraction, "of the grains placed at random",
           {.lowest = 0, .highest = 1, .lowest_included = false});
  file.add("Packing", "expected solid fraction", expected_solid_fraction, "after the compression; sets how many grains",
           {.lowest = 0, .highest = 1, .lowest_included = false});
  file.add("Packing", "friction", packing_friction, "between grains during the compression: less gives denser packings",
           Range::non_negative());
  file.add("Packing", "pressure", compression.pressure, "isotropic pressure of the packing [Pa]", Range::positive());
  file.add("Packing", "largest strain rate", compression.largest_rate, "of the walls [1/s]",
           {.lowest = 0, .highest = 1000, .lowest_included = false});
  file.add("Packing", "pressure tolerance", compression.pressure_tolerance, "relative", Range::strictly_between(0, 1));
  file.add("Packing", "force tolerance", compression.force_tolerance, "mean unbalanced over mean contact force",
           Range::strictly_between(0, 1));
  file.add("Packing", "longest time", compression.longest_time, "simulated, then the compression has failed [s]",
           Range::positive());
  file.add("Packing", "time step", packing_time_step, "during the compression [s]", Range::positive());
  file.add("Packing", "overlap tolerance", packing_overlap_tolerance, "see Grains/overlap tolerance",
           Range::between(0, 0.1));

  declare_continuum(file, continuum);
  file.add("Continuum", "damping", continuum_damping, "mass-proportional [1/s]", Range::non_negative());

  file.add("Coupling", "penalty", coupling.penalty, "epsilon [Pa/m2]", Range::positive());
  file.add("Coupling", "projection", coupling.projection, "of the grains' displacements",
           {{"lumped", coupling::Projection::lumped}, {"consistent", coupling::Projection::consistent}});
  file.add("Coupling", "least weight", coupling.least_weight, "lower bound of the grains' weights in the overlap",
           {.lowest = 0, .highest = 1, .lowest_included = false});

  file.add("Loading", "isotropic volumetric strain", program.isotropic_volumetric_strain, "compression is negative");
  file.add("Loading", "isotropic time", program.isotropic_time, "[s]", Range::positive());
  file.add("Loading", "path", program.path, "of the shear phase",
           {{"unloading", dem::StrainPath::unloading},
            {"constant volume", dem::StrainPath::constant_volume},
            {"compression", dem::StrainPath::compression}});
  file.add("Loading", "axial strain", program.axial_strain, "along z in the shear phase");
  file.add("Loading", "volumetric strain change", program.volumetric_strain_change,
           "size of the change in the shear phase; without meaning at constant volume", Range::non_negative());
  file.add("Loading", "shear time", program.shear_time, "[s]", Range::positive());
  file.add("Loading", "ramp", program.ramp, "share of a phase in which it speeds up, and again slows down",
           {.lowest = 0, .highest = 0.5, .lowest_included = false});
  file.add("Loading", "time step", simulation.time_step, "[s]", Range::positive());

  file.add("Output", "samples", n_samples, "rows of history.csv", Range::between(1, 1000000));
  file.add("Output", "pictures", n_pictures, "times at which grains and mesh are written for ParaView",
           Range::between(1, 10000));
  file.add("Output", "snapshot interval", snapshot_interval, "wall clock time between snapshots [s]",
           Range::positive());
}

void TriaxialParameters::validate() const
{
  distribution.validate();
  simulation.validate();
  packing_simulation().validate();
  compression.validate();
  program.validate();
  const auto fail = [](const std::string &text) { throw ConfigError(text); };

  if (kind == ModelKind::two_scale)
  {
    if (continuum_layers >= elements_per_edge)
      fail("Model/continuum layers is " + std::to_string(continuum_layers) + " of " +
           std::to_string(elements_per_edge) +
           " layers (Model/elements per edge): at least one layer must be left to the grains alone");
    if (overlap_layers >= continuum_layers)
      fail("Model/overlap layers is " + std::to_string(overlap_layers) + ", as thick as the continuum of " +
           std::to_string(continuum_layers) +
           " layers or thicker: at least one layer must be left to the continuum alone");
    if (element_size() < 2. * distribution.mean_half_axes.mean())
      fail("the elements are smaller than a grain: edge over elements per edge is " + std::to_string(element_size()) +
           " m; choose fewer Model/elements per edge or a larger Model/edge");
  }
  if (has_continuum())
    continuum.validate();
  if (has_grains())
  {
    if (2. * distribution.largest_half_axis * std::sqrt(3.) > edge)
      fail("Model/edge is " + std::to_string(edge) + " m: the largest grains do not fit; it must exceed " +
           std::to_string(2. * distribution.largest_half_axis * std::sqrt(3.)) + " m");
    if (initial_solid_fraction > 0.3)
      fail("Packing/initial solid fraction is " + std::to_string(initial_solid_fraction) +
           ": grains cannot be placed at random above about 0.3; 0.2 is safe");
    // Two of the smallest grains as spheres at an overlap of 1e-5 radii: no packing under load is softer.
    dem::Superquadric smallest{Vec3::Constant(distribution.smallest_half_axis), 1., 1.};
    const double mass = simulation.grain().density * dem::volume(smallest);
    const double radius = distribution.smallest_half_axis;
    const double modulus =
        0.5 * simulation.grain().young_modulus / (1. - std::pow(simulation.grain().poisson_ratio, 2));
    const double stiffness = 2. * modulus * std::sqrt(0.5 * radius * 1e-5 * radius);
    const double limit = 2. * std::sqrt(0.5 * mass / stiffness);
    for (const auto &[name, step] :
         {std::pair("Loading/time step", simulation.time_step), std::pair("Packing/time step", packing_time_step)})
      if (step > limit)
      {
        std::ostringstream message;
        message << name << " is " << step << " s: it must stay below " << limit
                << " s, the stable step of two of the smallest grains in contact";
        fail(message.str());
      }
  }
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
