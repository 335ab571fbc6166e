#include "dem/flow/occupied_box.h"

#include "dem/core/parallel.h"
#include "dem/geometry/contact_geometry.h"

#include <algorithm>
#include <cstddef>

namespace bergamo::dem
{
namespace
{

bool meets(const Box &box, const Vec3 &centre, const double radius)
{
  const Vec3 nearest = centre.cwiseMax(box.low).cwiseMin(box.high);
  return (centre - nearest).squaredNorm() < radius * radius;
}

/// Parts whose bounding spheres meet a box, in their order.
std::vector<std::int32_t> parts_in(const Box &box, const Particles &grains)
{
  Collected<std::int32_t> found;
  parallel_ranges(grains.parts.size(), 1024,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t k = begin; k < end; ++k)
                      if (meets(box, grains.part_position(k), grains.parts.bounding_radius[k]))
                        found.of(part).push_back(static_cast<std::int32_t>(k));
                  });
  return found.all();
}

GrainGrid grid_of_parts(const PackingSpace &box, const Particles &grains, const double largest)
{
  const std::vector<std::int32_t> inside = parts_in(box.bounds(), grains);
  double largest_inside = 0.;
  for (const std::int32_t k : inside)
    largest_inside = std::max(largest_inside, grains.parts.bounding_radius[k]);
  GrainGrid grid(box, largest + largest_inside);
  for (const std::int32_t k : inside)
    grid.add(k, grains.part_position(k), grains.parts.bounding_radius[k]);
  return grid;
}

} // namespace

OccupiedBox::OccupiedBox(const PackingSpace &box, const Particles &grains, const std::vector<PlaneWall> &walls,
                         const Particles &placed, const double largest)
    : grains(grains), walls(walls), placed(placed), grid_of_grains(grid_of_parts(box, grains, largest)),
      grid_of_placed(box, 2. * largest)
{
}

bool OccupiedBox::has_room_for(const PlacedGrain &grain) const
{
  return is_apart_from_walls(grain) && is_apart_from(grains, grid_of_grains, grain) &&
         is_apart_from(placed, grid_of_placed, grain);
}

void OccupiedBox::take_last()
{
  const std::size_t k = placed.parts.size() - 1;
  grid_of_placed.add(static_cast<std::int32_t>(k), placed.part_position(k), placed.parts.bounding_radius[k]);
}

bool OccupiedBox::is_apart_from_walls(const PlacedGrain &grain) const
{
  return std::all_of(walls.begin(), walls.end(),
                     [&](const PlaneWall &wall)
                     {
                       const double height = wall.normal.dot(grain.pose.position - wall.point);
                       return height > grain.bounding_radius || height > support(grain.pose, Vec3(-wall.normal)).height;
                     });
}

bool OccupiedBox::is_apart_from(const Particles &bodies, const GrainGrid &by_part, const PlacedGrain &grain)
{
  const auto overlaps = [&](const std::int32_t k, const Vec3 &centre_line)
  {
    const Superquadric &shape = bodies.parts.shape[k];
    const PlacedGrain other{shape, make_pose(shape, bodies.part_position(k), bodies.part_orientation(k)),
                            bodies.parts.bounding_radius[k], inscribed_radius(shape)};
    return !are_apart(grain, other, centre_line);
  };
  return !by_part.any_near(grain.pose.position, grain.bounding_radius, overlaps);
}

} // namespace bergamo::dem
