#include "drivers/pile_installation/fit_in.h"

namespace bergamo::driver
{

dem::Particles fit_in(const dem::Particles &grains, const dem::Particles &fixed,
                      const std::vector<dem::PlaneWall> &walls, const dem::SimulationParameters &parameters)
{
  constexpr int n_rests = 100, steps_between = 20;
  if (grains.size() == 0)
    return grains;
  dem::Particles all;
  for (const auto *some : {&grains, &fixed})
    for (std::size_t i = 0; i < some->size(); ++i)
      all.append(*some, i, static_cast<std::int64_t>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all.weight[i] = 1.;
    if (i >= grains.size())
      all.fix(i);
  }
  for (std::vector<Vec3> *forces :
       {&all.external_force, &all.external_torque, &all.transfer_force, &all.transfer_torque})
    forces->clear();
  dem::Simulation simulation(parameters, std::move(all), walls);
  for (int rest = 0; rest < n_rests; ++rest)
  {
    for (int step = 0; step < steps_between; ++step)
      simulation.step();
    simulation.rest();
  }
  dem::Particles fitted;
  for (std::size_t i = 0; i < grains.size(); ++i)
    fitted.append(simulation.particles, simulation.index_of(static_cast<std::int64_t>(i)), grains.id[i]);
  return fitted;
}

} // namespace bergamo::driver
