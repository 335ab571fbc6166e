#include "tests/verification/pressed_model.h"

#include "dem/loading/compression.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/state/positions_by_id.h"
#include "fe_dealii/mesh/box_mesh.h"

#include <deal.II/grid/tria.h>

#include <algorithm>

namespace bergamo::test
{

using coupling::TwoScaleModel;

namespace
{

/// Of the grains in the upper third of a box, mass over volume [kg/m3].
double bulk_density(const dem::Simulation &grains, const dem::Box &box)
{
  double mass = 0.;
  for (std::size_t i = 0; i < grains.particles.size(); ++i)
    if (grains.particles.position[i][2] > box.high[2] - box.edges()[2] / 3.)
      mass += grains.particles.mass[i];
  return 3. * mass / box.volume();
}

} // namespace

std::unique_ptr<dem::Simulation> make_pressed_packing()
{
  std::mt19937_64 generator(11);
  constexpr double edge = 0.006; // [m]
  const dem::Box loose{Vec3::Zero(), Vec3::Constant(1.5 * edge)};
  const auto grains = dem::draw_grains(dem::GrainDistribution(), 0.6 * edge * edge * edge, generator);
  dem::SimulationParameters parameters;
  parameters.time_step = 1.5e-7;
  parameters.between_grains().friction = 0.15;
  parameters.contact.overlap_tolerance = 1e-3;
  auto packing = std::make_unique<dem::Simulation>(
      parameters, dem::add_at_random(grains, loose, parameters.grain().density, generator()), dem::box_walls(loose));
  dem::CompressionParameters pressing;
  pressing.pressure = confining_pressure;
  pressing.pressure_tolerance = pressing.force_tolerance = 0.03;
  dem::Compression compression(pressing);
  while (!compression.is_finished())
  {
    compression.step(*packing);
    packing->integrate();
  }
  for (dem::PlaneWall &wall : packing->walls)
    wall.velocity.setZero();
  packing->rest();
  parameters.between_grains().friction = 0.5; // rougher than they were packed: no contact is about to slide
  packing->change(parameters);
  return packing;
}

dem::Particles cut_below(dem::Simulation &grains, const dem::Box &box)
{
  dem::Particles gone;
  std::vector<std::int32_t> below;
  for (std::size_t i = 0; i < grains.particles.size(); ++i)
    if (grains.particles.position[i][2] < box.low[2] + box.edges()[2] / 3.)
    {
      below.push_back(static_cast<std::int32_t>(i));
      gone.append(grains.particles, i, grains.particles.id[i]);
    }
  grains.remove_wall(4);
  grains.remove(below);
  grains.integrate();
  return gone;
}

TwoScaleModel make_pressed_model(const coupling::CouplingParameters &join, const double gravity)
{
  auto grains = make_pressed_packing();
  const dem::Box box = dem::box_between(grains->walls);
  const std::vector<Vec3> reference = dem::positions_by_id(grains->particles);
  dem::SimulationParameters parameters = grains->parameters();
  parameters.gravity = {0., 0., -gravity};
  grains->change(parameters);
  cut_below(*grains, box);
  return join_below(std::move(grains), box, join, reference);
}

TwoScaleModel join_below(std::unique_ptr<dem::Simulation> grains, const dem::Box &box,
                         const coupling::CouplingParameters &join, const std::vector<Vec3> &reference_by_id)
{
  const double third = box.edges()[2] / 3.;
  dealii::Triangulation<3> mesh;
  fe::make_box({{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.low[2] + 2. * third}, {3, 3, 2}},
               mesh);
  fe::ExplicitBodyParameters body;
  body.initial_stress = fe::uniform_pressure(confining_pressure);
  const Vec3 &gravity = grains->parameters().gravity;
  body.gravity = {gravity[0], gravity[1], gravity[2]};
  body.material = fe::MohrCoulomb(
      {.young_modulus = 4e8, .poisson_ratio = 0.1, .cohesion = 1e9, .density = bulk_density(*grains, box)});
  body.damping = 200.;
  const double step = grains->parameters().time_step;
  TwoScaleModel model(std::move(grains), std::make_unique<fe::ExplicitBody>(mesh, body), step);
  for (unsigned int face = 0; face < 5; ++face)
    model.body()->prescribe_velocity(face, face / 2);
  std::vector<double> weight;
  for (const auto &x : model.body()->node_position())
    weight.push_back(std::clamp((x[2] - box.low[2] - third) / third, 0., 1.));
  model.join(join, weight, reference_by_id);
  return model;
}

void run(TwoScaleModel &model, const int n_steps)
{
  for (int step = 0; step < n_steps; ++step)
  {
    model.compute_forces();
    model.kick();
    model.drift();
  }
}

} // namespace bergamo::test
