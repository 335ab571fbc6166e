#include "dem/simulation/divergence.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"

#include <sstream>

namespace bergamo::dem
{
namespace
{

constexpr const char *remedy =
    "; choose a smaller time step (stable estimate in summary.json) or start from the last snapshot";

std::string when(const Instant &instant)
{
  std::ostringstream text;
  text << ", at time " << instant.time << " s, step " << instant.n_steps;
  return text.str();
}

[[noreturn]] void throw_diverged(const Particles &p, const NeighbourWatch &watch, const Instant &instant,
                                 const std::size_t i, const char *trouble)
{
  std::ostringstream message;
  message << "the run diverged: grain " << p.id[i];
  if (p.position[i].allFinite())
    message << " at (" << p.position[i].transpose() << ") m";
  else if (const Vec3 *last = watch.place_when_built(i))
    message << ", last seen at (" << last->transpose() << ") m,";
  message << ' ' << trouble << when(instant) << remedy;
  throw RunError(message.str());
}

} // namespace

void check_finite(const Particles &p, const NeighbourWatch &watch, const Instant &instant)
{
  Collected<std::size_t> diverged;
  parallel_ranges(p.size(), 256,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t i = begin; i < end; ++i)
                      if (!p.position[i].allFinite() || !p.velocity[i].allFinite() ||
                          !p.angular_momentum[i].allFinite() || !p.angular_velocity[i].allFinite() ||
                          !p.orientation[i].coeffs().allFinite())
                        diverged.of(part).push_back(i);
                  });
  diverged.for_each([&](const std::size_t i) { throw_diverged(p, watch, instant, i, "whose state is not finite"); });
}

void check_finite(const std::vector<PlaneWall> &walls, const Instant &instant)
{
  for (std::size_t w = 0; w < walls.size(); ++w)
    if (!walls[w].point.allFinite() || !walls[w].velocity.allFinite() || !walls[w].normal.allFinite())
    {
      std::ostringstream message;
      message << "the run diverged: wall " << w << " (counted from 0) has the velocity ("
              << walls[w].velocity.transpose() << ") m/s and the place (" << walls[w].point.transpose() << ") m"
              << when(instant) << ": set finite velocities";
      throw RunError(message.str());
    }
}

void report_divergence(const Particles &p, const NeighbourWatch &watch, const Instant &instant)
{
  check_finite(p, watch, instant);
  // All states were finite: forces are not.
  std::size_t worst = 0;
  double largest = -1.;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    Vec3 force = p.force[i];
    if (!p.external_force.empty())
      force += p.external_force[i];
    if (!force.allFinite() || !p.torque[i].allFinite())
      throw_diverged(p, watch, instant, i, "on which the force is not finite");
    const double acceleration = force.stableNorm() / p.mass[i];
    if (acceleration > largest)
    {
      largest = acceleration;
      worst = i;
    }
  }
  throw_diverged(p, watch, instant, worst, "on which the force is too large");
}

} // namespace bergamo::dem
