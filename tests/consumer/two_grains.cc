#include "dem/simulation/simulation.h"

#include <cmath>
#include <iostream>

using namespace bergamo;

/// Two equal ellipsoids, pole against pole without friction and damping: they exchange their velocities.
int main()
{
  dem::SimulationParameters parameters;
  parameters.grain().young_modulus = 1e7;
  parameters.set_damping(0.);
  parameters.time_step = 1e-6;
  dem::Particles grains;
  const dem::Superquadric shape{Vec3(1e-3, 1e-3, 2e-3), 1., 1.};
  for (const double z : {-2.05e-3, 2.05e-3})
    grains.add(shape, 2650., Vec3(0., 0., z), Quaternion::Identity());
  grains.velocity = {Vec3(0., 0., 0.5), Vec3(0., 0., -0.25)};
  dem::Simulation simulation(parameters, std::move(grains), {});

  bool have_touched = false;
  for (int step = 0; step < 2000; ++step)
  {
    simulation.step();
    have_touched = have_touched || simulation.particles.force[0].norm() > 0.;
  }
  const double lower = simulation.particles.velocity[simulation.index_of(0)][2];
  const double upper = simulation.particles.velocity[simulation.index_of(1)][2];
  std::cout << "velocities " << lower << " and " << upper << " m/s\n";
  const bool is_right = have_touched && std::abs(lower + 0.25) < 1e-3 && std::abs(upper - 0.5) < 1e-3;
  return is_right ? 0 : 1;
}
