#include "dem/force/candidates.h"

#include "dem/core/parallel_sum.h"

namespace bergamo::dem
{

VerletList near_parts(const Particles &p, const CandidateSearch &search)
{
  const Parts &parts = p.parts;
  BoundingSpheres spheres{search.places, parts.bounding_radius, p.mass};
  spheres.sought = search.sought;
  std::vector<double> mass;
  if (p.has_clumps())
  {
    mass.resize(parts.size());
    parallel_for(parts.size(), [&](const std::size_t k) { mass[k] = p.mass[parts.particle[k]]; });
    spheres.masses = mass;
    spheres.body = parts.particle;
  }
  return build_verlet_list(spheres, search.range, p.cell);
}

VerletList parts_near_walls(const Particles &p, const std::vector<PlaneWall> &walls, const CandidateSearch &search)
{
  VerletList list;
  const std::size_t n = p.parts.size();
  list.row.assign(n + 1, 0);
  if (walls.empty())
    return list;
  const auto for_each_near = [&](const std::size_t k, const auto &found)
  {
    if (p.is_fixed(p.parts.particle[k]) || !search.seeks(k))
      return;
    const Vec3 &centre = search.places[k];
    for (std::size_t w = 0; w < walls.size(); ++w)
      if (walls[w].normal.dot(centre - walls[w].point) < p.parts.bounding_radius[k] + search.range)
        found(static_cast<std::int32_t>(w));
  };
  parallel_for(n, [&](const std::size_t k) { for_each_near(k, [&](auto) { ++list.row[k]; }); });
  exclusive_sum(list.row);
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
