#include "drivers/two_scale_triaxial/packing_stage.h"

#include "dem/measure/contact_list.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{

PackingStage begin_packing(const TriaxialParameters &parameters)
{
  std::mt19937_64 generator(parameters.seed);
  const double layer = parameters.element_size();
  const Vec3 edges(parameters.edge, parameters.edge, parameters.grain_layers() * layer);
  const std::vector<dem::Superquadric> shapes =
      dem::draw_grains(parameters.distribution, parameters.expected_solid_fraction * edges.prod(), generator);

  const double widening = std::cbrt(parameters.expected_solid_fraction / parameters.initial_solid_fraction);
  const dem::Box box{Vec3::Zero(), std::max(widening, 1.) * edges};
  dem::Particles particles = dem::add_at_random(shapes, box, parameters.simulation.grain().density, generator());
  return {std::make_unique<dem::Simulation>(parameters.packing_simulation(), std::move(particles), dem::box_walls(box)),
          dem::Compression(parameters.compression)};
}

PackingFigures packing_figures(const dem::Simulation &grains)
{
  PackingFigures figures;
  figures.box = dem::box_between(grains.walls);
  double solid = 0.;
  for (const double volume : grains.particles.volume)
    solid += volume;
  figures.solid_fraction = solid / figures.box.volume();
  figures.coordination_number = coordination_number(grains);
  return figures;
}

double coordination_number(const dem::Simulation &grains)
{
  return 2. * grains.contacts.n_touching() / grains.particles.size();
}

double max_overlap_over_radius(const dem::Simulation &grains)
{
  return std::max(dem::largest_relative_overlap(grains.contacts.touching(grains.particles), grains.particles),
                  dem::largest_relative_overlap(grains.contacts.touching_walls(grains.particles), grains.particles));
}

} // namespace bergamo::driver
