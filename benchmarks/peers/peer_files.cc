#include "benchmarks/peers/peer_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace bergamo::benchmark
{

std::string stl_text(const dem::Surface &vessel)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  const auto write = [&](const Vec3 &x) { text << x.x() << ' ' << x.y() << ' ' << x.z() << '\n'; };
  text << "solid vessel\n";
  for (const dem::Triangle &t : vessel.topology.triangle)
  {
    const Vec3 &a = vessel.node[t[0]], &b = vessel.node[t[1]], &c = vessel.node[t[2]];
    text << "  facet normal ";
    write((b - a).cross(c - a).normalized());
    text << "    outer loop\n";
    for (const Vec3 *const corner : {&a, &b, &c})
    {
      text << "      vertex ";
      write(*corner);
    }
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid vessel\n";
  return text.str();
}

std::array<Vec3, 2> reach_of(const BulkCase &bulk)
{
  Vec3 low = bulk.vessel.node.front(), high = low;
  double widest = 0.;
  for (const Vec3 &x : bulk.vessel.node)
  {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
    widest = std::max(widest, std::hypot(x.x(), x.z()));
  }
  if (bulk.vessel_spin != 0.)
    for (const int d : {0, 2})
    {
      low[d] = -widest;
      high[d] = widest;
    }
  double largest = 0.;
  for (std::size_t i = 0; i < bulk.beads.size(); ++i)
  {
    largest = std::max(largest, bulk.beads.bounding_radius[i]);
    low = low.cwiseMin(bulk.beads.position[i]);
    high = high.cwiseMax(bulk.beads.position[i]);
  }
  low -= Vec3::Constant(largest);
  high += Vec3::Constant(largest);
  if (std::isfinite(bulk.outlet))
    low.z() = bulk.outlet;
  return {low, high};
}

double unbounded_restitution(const double damping_ratio)
{
  const double share = damping_ratio / std::sqrt(5. / 6.); // |ln e| / sqrt(pi^2 + ln^2 e)
  return std::exp(-std::numbers::pi * share / std::sqrt(1. - share * share));
}

} // namespace bergamo::benchmark
