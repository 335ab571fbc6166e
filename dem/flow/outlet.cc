#include "dem/flow/outlet.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"

#include <cmath>

namespace bergamo::dem
{
namespace
{

void check_region(const Box &box)
{
  for (int d = 0; d < 3; ++d)
    require(box.edges()[d] > 0., "edge of an outlet's box", box.edges()[d], "positive [m]");
}

void check_region(const HalfSpace &half)
{
  constexpr double tolerance = 1e-9;
  require(std::abs(half.normal.norm() - 1.) < tolerance, "length of the normal of an outlet's plane",
          half.normal.norm(), "1: normalise it, and let it point to the grains that stay");
  require(std::isfinite(half.offset), "offset of an outlet's plane", half.offset, "finite [m]");
}

/// Whether all points nearer to x than a radius are inside.
bool holds(const Box &box, const Vec3 &x, const double radius)
{
  return ((x - box.low).array() >= radius).all() && ((box.high - x).array() >= radius).all();
}

bool holds(const HalfSpace &half, const Vec3 &x, const double radius)
{
  return half.normal.dot(x) + radius <= half.offset;
}

} // namespace

void OutletParameters::validate() const
{
  std::visit([](const auto &some) { check_region(some); }, region);
  require(step_interval >= 1, "steps between two checks of an outlet", step_interval, "at least 1");
}

Outlet::Outlet(const OutletParameters &parameters) : p(parameters)
{
  p.validate();
}

Exchange Outlet::act(Simulation &simulation)
{
  if (simulation.particles.cell.is_periodic())
    throw ConfigError("a periodic cell has no outlet: grains that leave it come in on the other side");
  if (simulation.n_steps % p.step_interval != 0)
    return {};
  const std::vector<std::int32_t> leaving = grains_inside(simulation.particles);
  Throughput with_these = sum;
  for (const std::int32_t i : leaving)
    with_these.count(simulation.particles, i);
  const Exchange gone = simulation.remove(leaving);
  sum = with_these;
  last_ids = gone.ids;
  return gone;
}

std::vector<std::int32_t> Outlet::grains_inside(const Particles &grains) const
{
  Collected<std::int32_t> inside;
  const auto look = [&](const auto &some)
  {
    parallel_ranges(grains.size(), 512,
                    [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                    {
                      for (std::size_t i = begin; i < end; ++i)
                      {
                        const double reach = p.rule == OutletRule::centre ? 0. : grains.bounding_radius[i];
                        if (holds(some, grains.position[i], reach) && !grains.is_fixed(i))
                          inside.of(part).push_back(static_cast<std::int32_t>(i));
                      }
                    });
  };
  std::visit(look, p.region);
  return inside.all();
}

} // namespace bergamo::dem
