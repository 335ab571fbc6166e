#include "dem/flow/inlet.h"

#include "dem/core/error.h"
#include "dem/flow/occupied_box.h"
#include "dem/packing/largest_grain.h"
#include "dem/packing/random_stream.h"

#include <random>

namespace bergamo::dem
{
namespace
{

/// Where a grain comes in.
struct Entrance
{
  Vec3 position;
  Quaternion orientation;
  Vec3 velocity;
};

Entrance draw_entrance(const InletParameters &p, const double radius, RandomStream random)
{
  Entrance e;
  for (int d = 0; d < 3; ++d)
    e.position[d] = random.uniform(p.box.low[d] + radius, p.box.high[d] - radius);
  const double u = random.uniform(), v = random.uniform(), w = random.uniform();
  e.orientation = uniform_rotation(u, v, w);
  for (int d = 0; d < 3; ++d)
    e.velocity[d] = p.velocity[d] + random.uniform(-p.velocity_spread[d], p.velocity_spread[d]);
  return e;
}

/// The corner of a box that is furthest along a direction.
Vec3 corner(const Box &box, const Vec3 &direction)
{
  return (direction.array() > 0.).select(box.high, box.low);
}

} // namespace

Inlet::Inlet(const InletParameters &parameters, const Simulation &simulation)
    : p(parameters), start_time(simulation.time)
{
  const MaterialTable &materials = simulation.parameters().materials;
  p.validate(materials.size());
  if (simulation.particles.cell.is_periodic())
    throw ConfigError("a periodic cell has no inlet: it keeps its grains");
  for (const PlaneWall &wall : simulation.walls)
  {
    const double height = wall.normal.dot(corner(p.box, wall.normal) - wall.point);
    require(height > 0., "height of an inlet's box above a wall", height,
            "positive [m]: move the box to the side of the wall where the grains are");
  }
  density = materials[p.material].density;
  largest = largest_bounding_radius(p.grading);
  next = grain(0);
}

Exchange Inlet::act(Simulation &simulation)
{
  if (simulation.n_steps % p.step_interval != 0)
    return {};
  simulation.add({}); // in the middle of a step it refuses, before anything is drawn
  Particles come;
  Throughput with_these = sum;
  const auto is_due = [&] { return debt_after(with_these, simulation.time) >= share_of(next); };
  if (is_due())
  {
    const PackingSpace space(p.box);
    OccupiedBox occupied(space, simulation.particles, simulation.walls, come, largest);
    while (is_due() && place_next(occupied, come))
    {
      with_these.count(come, come.size() - 1);
      next = grain(with_these.n_grains);
    }
  }
  const Exchange exchange = simulation.add(come);
  sum = with_these;
  return exchange;
}

/// @return whether the grain found a place
bool Inlet::place_next(OccupiedBox &occupied, Particles &come)
{
  const double radius = bounding_radius(next), inscribed = inscribed_radius(next);
  for (int trial = 0; trial < p.n_trials; ++trial)
  {
    const Entrance e = draw_entrance(p, radius, RandomStream(p.seed, 0, n_tried++));
    if (!occupied.has_room_for({next, make_pose(next, e.position, e.orientation), radius, inscribed}))
      continue;
    come.add(next, density, e.position, e.orientation, p.material);
    come.velocity.back() = come.drift_velocity.back() = e.velocity;
    occupied.take_last();
    return true;
  }
  return false;
}

std::int64_t Inlet::n_waiting(const Simulation &simulation) const
{
  double left = debt(simulation);
  std::int64_t n = 0;
  for (double share = next_share(); left >= share; share = share_of(grain(sum.n_grains + n)))
  {
    left -= share;
    ++n;
  }
  return n;
}

/// Each from its own stream, so that none depends on how those before it were placed.
Superquadric Inlet::grain(const std::int64_t number) const
{
  const auto half = [](const std::uint64_t bits, const int k) { return static_cast<std::uint32_t>(bits >> 32 * k); };
  const auto n = static_cast<std::uint64_t>(number);
  std::seed_seq seeds{half(p.seed, 0), half(p.seed, 1), half(n, 0), half(n, 1)};
  std::mt19937_64 generator(seeds);
  return std::visit([&](const auto &sand) { return draw_grain(sand, generator); }, p.grading);
}

double Inlet::share_of(const Superquadric &grain) const
{
  return p.mass_rate > 0. ? density * volume(grain) : 1.;
}

double Inlet::debt_after(const Throughput &some, const double time) const
{
  const double elapsed = time - start_time;
  return p.mass_rate > 0. ? p.mass_rate * elapsed - some.mass
                          : p.number_rate * elapsed - static_cast<double>(some.n_grains);
}

} // namespace bergamo::dem
