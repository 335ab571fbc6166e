#include "benchmarks/peers/settled_beads.h"

#include "dem/core/error.h"
#include "dem/law/restitution.h"
#include "dem/packing/random_addition.h"
#include "dem/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bergamo::benchmark
{
namespace
{

constexpr double fall_modulus = 2e6;  // of the softest beads while they fall [Pa]
constexpr double fall_step = 2e-5;    // stable for them [s]
constexpr double fall_time = 0.3;     // at most [s]
constexpr double relaxed_time = 0.02; // as what they are [s]
constexpr double drag_rate = 1000.;   // then: on the velocities [1/s]
constexpr int steps_between_looks = 200;

dem::Superquadric sphere(const double radius)
{
  dem::Superquadric shape;
  shape.half_axes.setConstant(radius);
  return shape;
}

double mean_square_speed(const dem::Particles &beads)
{
  double sum = 0.;
  for (const Vec3 &v : beads.velocity)
    sum += v.squaredNorm();
  return sum / static_cast<double>(beads.size());
}

dem::SimulationParameters softened(dem::SimulationParameters p)
{
  const double softest = std::min(p.materials[material_1].young_modulus, p.materials[material_2].young_modulus);
  for (const std::int32_t m : {material_1, material_2})
    p.materials[m].young_modulus *= std::min(1., fall_modulus / softest);
  p.set_damping(0.7); // comes to rest soonest
  p.time_step = std::max(p.time_step, fall_step);
  return p;
}

/// The same beads at rest where they are, of the materials that belong there.
dem::Particles at_rest(const dem::Particles &beads, const BeadFilling &filling, const dem::MaterialTable &materials)
{
  dem::Particles resting;
  std::vector<Vec3> place(beads.size());
  for (std::size_t i = 0; i < beads.size(); ++i)
    place[beads.id[i]] = beads.position[i];
  for (const Vec3 &x : place)
  {
    const std::int32_t material = filling.material_at(x);
    resting.add(sphere(filling.radius), materials[material].density, x, Quaternion::Identity(), material);
  }
  return resting;
}

/// Steps until the beads are slow beside what a fall of a tenth of their radius gives them, or a time is over.
void come_to_rest(dem::Simulation &simulation, const double radius, const double longest_time, const double drag)
{
  const double slow = 2. * 9.81 * 0.1 * 0.01 * radius; // a tenth of that speed, its square
  const auto n_steps = static_cast<std::int64_t>(longest_time / simulation.parameters().time_step);
  dem::Particles &beads = simulation.particles;
  for (std::int64_t n = 0; n < n_steps; ++n)
  {
    if (drag > 0.)
    {
      beads.external_force.resize(beads.size());
      for (std::size_t i = 0; i < beads.size(); ++i)
        beads.external_force[i] = -drag * beads.mass[i] * beads.velocity[i];
    }
    simulation.step();
    if (n % steps_between_looks == steps_between_looks - 1 && simulation.time > 0.5 * longest_time &&
        mean_square_speed(beads) < slow)
      break;
  }
  beads.external_force.clear();
  if (mean_square_speed(beads) > 10. * slow)
    throw RunError("the beads do not come to rest: " + std::to_string(std::sqrt(mean_square_speed(beads))) +
                   " m/s after " + std::to_string(longest_time) + " s; choose fewer of them or another seed");
}

dem::Simulation in_vessel(const BulkCase &bulk, const dem::SimulationParameters &p, dem::Particles beads,
                          const BeadFilling &filling)
{
  dem::Simulation simulation(p, std::move(beads), filling.stoppers);
  simulation.add_surface(bulk.vessel);
  return simulation;
}

} // namespace

void fill(BulkCase &bulk, const BeadFilling &filling)
{
  const std::vector<dem::Superquadric> shapes(filling.n_beads, sphere(filling.radius));
  dem::Simulation falling = in_vessel(
      bulk, softened(bulk.parameters),
      dem::add_at_random(shapes, filling.space, bulk.parameters.materials[material_1].density, filling.seed), filling);
  come_to_rest(falling, filling.radius, fall_time, 0.);

  dem::Simulation relaxing =
      in_vessel(bulk, bulk.parameters, at_rest(falling.particles, filling, bulk.parameters.materials), filling);
  come_to_rest(relaxing, filling.radius, relaxed_time, drag_rate);
  bulk.beads = at_rest(relaxing.particles, filling, bulk.parameters.materials);
}

} // namespace bergamo::benchmark
