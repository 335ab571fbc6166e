#include "drivers/beam_impact/parameters.h"

#include "dem/core/error.h"

#include <cmath>
#include <numbers>

namespace bergamo::driver
{

ImpactParameters::ImpactParameters()
{
  output.n_samples = 500;
}

void ImpactParameters::declare(ParameterFile &file)
{
  file.add("Beam", "length", length, "between its supports [m]", Range::positive().usual(1e-3, 100));
  file.add("Beam", "edge", edge, "of its square section [m]", Range::positive().usual(1e-4, 10));
  file.add("Beam", "elements along", n_along, "an even number: there are nodes in the middle", Range::between(2, 1000));
  file.add("Beam", "elements across", n_across, "over width and over height", Range::between(1, 50));
  file.add("Beam", "element", element, "quadratic: 27 nodes; bending: 8 nodes that bend; plain: 8 nodes",
           {{"quadratic", BeamElement::quadratic}, {"bending", BeamElement::bending}, {"plain", BeamElement::plain}});

  file.add("Sphere", "radius", radius, "[m]", Range::positive().usual(1e-5, 1));
  file.add("Sphere", "velocity", velocity, "with which it hits the beam in the middle [m/s]",
           Range::positive().usual(1e-4, 1e3));

  file.add("Material", "Young's modulus", material.young_modulus, "of beam and sphere [Pa]",
           Range::positive().usual(1e6, 1e12));
  file.add("Material", "Poisson's ratio", material.poisson_ratio, "",
           {.lowest = 0, .highest = 0.5, .highest_included = false});
  file.add("Material", "density", material.density, "[kg/m3]", Range::positive().usual(500, 2e4));

  file.add("Closed form", "modes", n_modes, "of the beam, symmetric ones", Range::between(1, 100));

  file.add("Output", "duration", duration, "from the first touch on [s]", Range::positive());
  file.add("Output", "step share", step_share, "of the beam's stable time step",
           Range::strictly_between(0, 1).usual(0.05, 1));
  output.declare(file, "the beam is");
}

void ImpactParameters::validate() const
{
  material.validate("Material");
  if (n_along % 2 != 0)
    reject("Beam/elements along is ", n_along, ": the sphere hits nodes in the middle; give an even number");
}

double ImpactParameters::sphere_mass() const
{
  return 4. / 3. * std::numbers::pi * radius * radius * radius * material.density;
}

double ImpactParameters::hertz_stiffness() const
{
  const double nu = material.poisson_ratio, of_both = material.young_modulus / (2. * (1. - nu * nu));
  return 4. / 3. * of_both * std::sqrt(radius);
}

} // namespace bergamo::driver
