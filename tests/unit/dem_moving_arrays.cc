#include "dem/simulation/simulation.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// Spheres that cross one another's ways, so that they are sorted anew every now and then.
Simulation crossing()
{
  SimulationParameters parameters;
  parameters.time_step = 1e-5;
  parameters.sort_interval = 1;
  Particles grains;
  for (int i = 0; i < 20; ++i)
  {
    grains.add({Vec3::Constant(1e-3), 1., 1.}, 2650., Vec3(5e-3 * (i % 5), 5e-3 * (i / 5), 0.), Quaternion::Identity());
    grains.velocity.back() = Vec3((i % 3) - 1., (i % 7) - 3., i % 2);
  }
  return Simulation(parameters, grains, {});
}

} // namespace

TEST_CASE("who reads the arrays in place is told before grains move in them, each time and at no other")
{
  const Threads one_thread(1);
  Simulation simulation = crossing();
  std::int64_t n_told = 0, n_orders = simulation.n_orders();
  std::vector<std::int64_t> ids = simulation.particles.id;
  const Vec3 *place = simulation.particles.position.data();
  bool was_before = true;
  simulation.before_moving = [&]
  {
    ++n_told;
    was_before = was_before && simulation.particles.id == ids && simulation.particles.position.data() == place;
  };
  const auto look = [&]
  {
    CHECK(n_told == simulation.n_orders() - n_orders);
    n_told = 0;
    n_orders = simulation.n_orders();
    ids = simulation.particles.id;
    place = simulation.particles.position.data();
  };
  std::int64_t n_sorts = 0;
  for (int step = 0; step < 500; ++step)
  {
    simulation.step();
    n_sorts += n_told;
    look();
  }
  CHECK(n_sorts > 2);

  Particles added;
  added.add({Vec3::Constant(1e-3), 1., 1.}, 2650., Vec3(0., 0., 1.), Quaternion::Identity());
  simulation.add(added);
  CHECK(n_told == 1);
  look();
  simulation.add({});
  CHECK(n_told == 0);
  simulation.remove({3});
  CHECK(n_told >= 1);
  look();
  CHECK(was_before);
}
