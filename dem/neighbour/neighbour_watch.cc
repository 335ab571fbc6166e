#include "dem/neighbour/neighbour_watch.h"

#include "dem/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{

void NeighbourWatch::take_all(const Particles &particles, const std::vector<PlaneWall> &walls,
                              std::span<const Surface> surfaces)
{
  position_when_built = particles.position;
  orientation_when_built = particles.has_clumps() ? particles.orientation : std::vector<Quaternion>();
  period_when_built = particles.cell.period;
  look_at_motion = particles.largest_motion + 0.5 * verlet_distance;
  wall_motion_when_built.clear();
  for (const PlaneWall &wall : walls)
    wall_motion_when_built.push_back(wall.motion);
  surface_motion_when_built.clear();
  for (const Surface &surface : surfaces)
    surface_motion_when_built.push_back(surface.motion);
}

std::vector<std::uint8_t> NeighbourWatch::take_strayed(const Particles &p)
{
  const double limit = 0.5 * verlet_distance;
  std::vector<std::uint8_t> has_strayed(p.parts.size());
  parallel_for(p.size(),
               [&](const std::size_t i)
               {
                 const bool strays = displacement(p, i) > 0.5 * limit;
                 for (auto k = p.first_part[i]; k < p.first_part[i + 1]; ++k)
                   has_strayed[k] = strays;
                 if (!strays)
                   return;
                 position_when_built[i] = p.position[i];
                 if (!orientation_when_built.empty())
                   orientation_when_built[i] = p.orientation[i];
               });
  look_at_motion = p.largest_motion + (limit - largest_displacement(p));
  return has_strayed;
}

std::vector<Vec3> NeighbourWatch::part_places(const Particles &p) const
{
  if (!p.has_clumps())
    return position_when_built;
  std::vector<Vec3> places(p.parts.size());
  parallel_for(places.size(),
               [&](const std::size_t k)
               {
                 const std::int32_t i = p.parts.particle[k];
                 places[k] = position_when_built[i] + orientation_when_built[i] * p.parts.place[k];
               });
  return places;
}

/// Largest displacement of any part's centre since the lists were built for it [m].
double NeighbourWatch::displacement(const Particles &p, const std::size_t i) const
{
  const double of_centre = (p.position[i] - position_when_built[i]).norm();
  if (orientation_when_built.empty())
    return of_centre;
  double arm = 0.;
  for (auto k = p.first_part[i]; k < p.first_part[i + 1]; ++k)
    arm = std::max(arm, p.parts.place[k].norm());
  // A turn by theta moves a point at distance r by at most 2 r sin(theta / 2), the length of the quaternion's vector.
  const Vec3 axis = (orientation_when_built[i].conjugate() * p.orientation[i]).vec();
  return of_centre + 2. * arm * axis.norm();
}

double NeighbourWatch::largest_displacement(const Particles &particles) const
{
  const bool is_plain = orientation_when_built.empty(); // then one square root does for all
  Collected<double> found;
  parallel_ranges(particles.size(), 1024,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    double most = 0.;
                    for (std::size_t i = begin; i < end; ++i)
                      most = std::max(most, is_plain ? (particles.position[i] - position_when_built[i]).squaredNorm()
                                                     : displacement(particles, i));
                    found.of(part).push_back(most);
                  });
  double largest = 0.;
  found.for_each([&](const double most) { largest = std::max(largest, most); });
  return is_plain ? std::sqrt(largest) : largest;
}

bool NeighbourWatch::boundaries_have_moved(const std::vector<PlaneWall> &walls,
                                           const std::span<const Surface> surfaces) const
{
  for (std::size_t w = 0; w < walls.size(); ++w)
    if (walls[w].motion - wall_motion_when_built[w] > 0.5 * verlet_distance)
      return true;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    if (surfaces[s].motion - surface_motion_when_built[s] > 0.5 * verlet_distance)
      return true;
  return false;
}

bool NeighbourWatch::must_renew_all(const Particles &particles, const std::vector<PlaneWall> &walls,
                                    std::span<const Surface> surfaces) const
{
  return particles.cell.is_periodic() || boundaries_have_moved(walls, surfaces);
}

bool NeighbourWatch::must_renew(const Particles &particles, const std::vector<PlaneWall> &walls,
                                std::span<const Surface> surfaces)
{
  if (boundaries_have_moved(walls, surfaces))
    return true;
  double limit = 0.5 * verlet_distance;
  if (particles.cell.is_periodic())
    limit -= 0.5 * (particles.cell.period - period_when_built).norm();
  if (particles.largest_motion < look_at_motion)
    return false;
  const double largest = largest_displacement(particles);
  look_at_motion = particles.largest_motion + (limit - largest);
  return largest > limit;
}

double least_cell_edge(const Particles &p, const double verlet_distance)
{
  double range = verlet_distance, arm = 0.;
  for (const double radius : p.parts.bounding_radius)
    range = std::max(range, 2. * radius + verlet_distance);
  for (const Vec3 &place : p.parts.place)
    arm = std::max(arm, place.norm());
  return 2. * (range + arm);
}

} // namespace bergamo::dem
