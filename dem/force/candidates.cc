#include "dem/force/candidates.h"

#include "dem/core/parallel.h"

namespace bergamo::dem
{

VerletList near_parts(const Particles &p, const double range)
{
  const Parts &parts = p.parts;
  if (!p.has_clumps())
    return build_verlet_list({p.position, parts.bounding_radius, p.mass}, range, p.cell);
  std::vector<Vec3> position(parts.size());
  std::vector<double> mass(parts.size());
  parallel_for(parts.size(),
               [&](const std::size_t k)
               {
                 position[k] = p.part_position(k);
                 mass[k] = p.mass[parts.particle[k]];
               });
  return build_verlet_list({position, parts.bounding_radius, mass, parts.particle}, range, p.cell);
}

VerletList parts_near_walls(const Particles &p, const std::vector<PlaneWall> &walls, const double range)
{
  VerletList list;
  const std::size_t n = p.parts.size();
  list.row.assign(n + 1, 0);
  if (walls.empty())
    return list;
  const auto for_each_near = [&](const std::size_t k, const auto &found)
  {
    if (p.is_fixed(p.parts.particle[k]))
      return;
    const Vec3 centre = p.part_position(k);
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (walls[w].normal.dot(centre - walls[w].point) < p.parts.bounding_radius[k] + range)
        found(static_cast<std::int32_t>(w));
  };
  parallel_for(n, [&](const std::size_t k) { for_each_near(k, [&](auto) { ++list.row[k + 1]; }); });
  for (std::size_t k = 0; k < n; ++k)
    list.row[k + 1] += list.row[k];
  list.first.resize(list.row[n]);
  list.second.resize(list.row[n]);
  list.image.assign(list.row[n], own_image);
  parallel_for(n,
               [&](const std::size_t k)
               {
                 std::int32_t next = list.row[k];
                 for_each_near(k,
                               [&](const std::int32_t wall)
                               {
                                 list.first[next] = static_cast<std::int32_t>(k);
                                 list.second[next++] = wall;
                               });
               });
  return list;
}

} // namespace bergamo::dem
