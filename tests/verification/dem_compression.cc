#include "dem/loading/compression.h"
#include "dem/motion/stable_step.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/simulation/simulation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <omp.h>
#include <random>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

constexpr double pressure = 1e3; // [Pa]

struct Sand
{
  double young_modulus, diameter, density; // [Pa], [m], [kg/m3]
  double damping_ratio;
  double step_share; // of the stable step of two grains in a strong chain
};

/// The time in which the pressure moves a free grain by about its size: the unit of any compression [s].
double time_of_pressure(const Sand &sand)
{
  return sand.diameter * std::sqrt(sand.density / pressure);
}

/// Overlap over radius where a chain bears ten times the mean force p d^2 (Hertz, equal spheres: f = 4/3 E/(1 - nu^2)/2
/// sqrt(r/2) overlap^1.5).
double strong_overlap(const Sand &sand)
{
  const double plane_modulus = sand.young_modulus / (1. - 0.2 * 0.2);
  return std::pow(10. * 4. * pressure / (4. / 3. * 0.5 * plane_modulus * std::sqrt(0.5)), 2. / 3.);
}

Simulation loose_packing(const Sand &sand)
{
  SimulationParameters parameters;
  parameters.grain() = {sand.young_modulus, 0.2, sand.density};
  parameters.wall() = parameters.grain();
  parameters.between_grains().friction = 0.15;
  parameters.set_damping(sand.damping_ratio);
  parameters.time_step =
      sand.step_share * stable_step_of_two_spheres(0.4 * sand.diameter, parameters.grain(), strong_overlap(sand));
  std::mt19937_64 generator(7);
  const Box box{Vec3::Zero(), Vec3::Constant(6. * sand.diameter)};
  const UniformSizes sizes{0.8 * sand.diameter, 1.2 * sand.diameter, {1.3, 0.2}};
  const auto grains = draw_grains(sizes, 0.2 * box.volume(), generator);
  return Simulation(parameters, add_at_random(grains, box, sand.density, generator()), box_walls(box));
}

} // namespace

TEST_CASE("walls bring a packing to rest whatever the modulus, size, density and damping of its grains and the step")
{
  omp_set_num_threads(1); // a team costs more than it gains on 80 grains
  const Sand sand =
      GENERATE(Sand{1e7, 1e-3, 2650., 0.9, 0.2}, Sand{1e7, 1e-3, 2650., 0.9, 0.02}, Sand{5e9, 1e-3, 2650., 0.9, 0.04},
               Sand{1e11, 1e-3, 2650., 0.9, 0.15}, Sand{1e7, 1e-1, 2650., 0.9, 0.1}, Sand{1e11, 1e-1, 2650., 0.3, 0.4},
               Sand{1e7, 1e-5, 2650., 0.9, 0.1}, Sand{1e11, 1e-5, 2650., 0.9, 0.15}, Sand{1e9, 1e-3, 10., 0.9, 0.1},
               Sand{1e9, 1e-3, 10000., 0.05, 0.3});
  Simulation simulation = loose_packing(sand);
  REQUIRE(simulation.particles.size() > 70);
  // The walls need the time of a volume ratio of 3, a third at each axis, at their largest speed, and all comes to rest
  // in some bounces of the packing, of 6 diameters over the speed of a wave, which is above that of the pressure.
  CompressionParameters aim;
  aim.pressure = pressure;
  aim.largest_rate = std::min(1000., 0.05 / time_of_pressure(sand));
  aim.longest_time = 0.4 / aim.largest_rate + 60. * time_of_pressure(sand);
  Compression compression(aim);
  CAPTURE(sand.young_modulus, sand.diameter, sand.density, sand.damping_ratio, sand.step_share);
  const auto compress = [&]
  {
    while (!compression.is_finished())
      compression.step(simulation);
  };
  CHECK_NOTHROW(compress());
  CHECK(compression.is_finished());
  CHECK(compression.unbalance < aim.force_tolerance);
}

TEST_CASE("a wall is never faster than its largest rate and than the pressure can push the grains")
{
  omp_set_num_threads(1);
  const double largest_rate = GENERATE(1000., 0.3);
  const Sand sand{1e9, 1e-1, 2650., 0.9, 0.1}; // 600 mm: half a rate of 1 1/s is the speed of the pressure
  Simulation simulation = loose_packing(sand);
  CompressionParameters aim;
  aim.pressure = pressure;
  aim.largest_rate = largest_rate;
  aim.longest_time = 100.;
  Compression compression(aim);
  double fastest = 0.;
  for (int n = 0; n < 2000; ++n)
  {
    const Vec3 limit =
        (0.5 * largest_rate * box_between(simulation.walls).edges()).cwiseMin(0.5 * std::sqrt(pressure / sand.density));
    compression.step(simulation);
    for (int d = 0; d < 3; ++d)
    {
      const double speed = std::abs(simulation.walls[2 * d].velocity[d]);
      CHECK(simulation.walls[2 * d + 1].velocity[d] == -simulation.walls[2 * d].velocity[d]);
      CHECK(speed <= limit[d] * (1. + 1e-12)); // rounding
      fastest = std::max(fastest, speed / limit[d]);
    }
  }
  CHECK(fastest > 0.999); // they do move
}
