#include "drivers/brachistochrone/parameters.h"

#include "dem/core/error.h"

#include <cmath>

namespace bergamo::driver
{

namespace
{

constexpr double most_facets = 100000;
constexpr double rigid = 1e9; // Young's modulus of the track over the sphere's

} // namespace

SlideParameters::SlideParameters()
{
  simulation.grain() = {.young_modulus = 0.1e9, .poisson_ratio = 0.3, .density = 1000.};
  simulation.with_walls() = {.friction = 0., .damping_ratio = 0., .relaxation_time = 1e-5};
  simulation.time_step = 1e-6;
  output.n_pictures = 2;
}

void SlideParameters::declare(ParameterFile &file)
{
  file.add("Track", "horizontal distance", run, "of the centre's path from its start to its end [m]",
           Range::positive().usual(1e-3, 100));
  file.add("Track", "drop", drop, "of the end below the start [m]", Range::positive().usual(1e-3, 100));
  file.add("Track", "facets", facets,
           "numbers of flat pieces, each passed in the same time; every one is run on both curves, the plane and the "
           "cycloid",
           Range::between(1, most_facets));
  file.add("Track", "friction", friction,
           "0: the sphere slides; else it has to be large enough for it to roll down the plane", Range::non_negative());
  file.add("Track", "gravity", gravity, "downwards [m/s2]", Range::positive().usual(0.1, 1e4));

  file.add("Sphere", "radius", radius, "[m]", Range::positive().usual(1e-5, 1));
  file.add("Sphere", "Young's modulus", simulation.grain().young_modulus, "the track is rigid [Pa]",
           Range::positive().usual(1e6, 1e12));
  file.add("Sphere", "Poisson's ratio", simulation.grain().poisson_ratio, "",
           {.lowest = 0, .highest = 0.5, .highest_included = false});
  file.add("Sphere", "density", simulation.grain().density, "[kg/m3]", Range::positive().usual(500, 2e4));
  file.add("Sphere", "relaxation time", simulation.with_walls().relaxation_time,
           "A of the viscoelastic damping between sphere and track [s]", Range::non_negative());
  file.add("Sphere", "damping ratio", simulation.with_walls().damping_ratio,
           "dashpot beside it, share of critical damping", Range::between(0, 10).usual(0, 1));

  file.add("Output", "time step", simulation.time_step, "[s]", Range::positive());
  output.declare(file, "the sphere is");
}

void SlideParameters::validate() const
{
  simulation_parameters().validate();
  if (facets.empty())
    reject("Track/facets has no number; give one at least");
  for (std::size_t k = 0; k < facets.size(); ++k)
  {
    if (facets[k] != std::floor(facets[k]))
      reject("Track/facets: ", facets[k], " is no whole number");
    if (k > 0 && !(facets[k] > facets[k - 1]))
      reject("Track/facets: ", facets[k], " follows ", facets[k - 1], "; give them from the least to the most");
  }
  if (const double least = 2. / 7. * drop / run; friction > 0. && friction < least)
    reject("Track/friction is ", friction,
           ", with which the sphere slips down the plane; choose 0 (it slides), or at least ", least, " (it rolls)");
}

std::vector<SlideSettings> SlideParameters::slides() const
{
  std::vector<SlideSettings> slides;
  for (const Curve curve : {Curve::plane, Curve::cycloid})
    for (const double n : facets)
      slides.push_back({curve, static_cast<int>(n)});
  return slides;
}

dem::SimulationParameters SlideParameters::simulation_parameters() const
{
  dem::SimulationParameters p = simulation;
  p.wall() = p.grain();
  p.wall().young_modulus *= rigid;
  p.with_walls().friction = friction;
  p.gravity = {0., 0., -gravity};
  return p;
}

} // namespace bergamo::driver
