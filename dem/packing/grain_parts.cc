#include "dem/packing/grain_parts.h"

#include "dem/core/parallel.h"

#include <algorithm>
#include <numeric>

namespace bergamo::dem
{

GrainParts::GrainParts(const std::span<const Superquadric> grains) : shape(grains.begin(), grains.end())
{
  for (const Superquadric &grain : grains)
    grain.validate();
  place.assign(grains.size(), Vec3::Zero());
  turn.assign(grains.size(), Quaternion::Identity());
  first_part.resize(grains.size() + 1);
  std::iota(first_part.begin(), first_part.end(), 0);
  grain_volume.resize(grains.size());
  parallel_for(grains.size(), [&](const std::size_t i) { grain_volume[i] = dem::volume(grains[i]); });
  measure();
}

GrainParts::GrainParts(const std::span<const Clump> grains)
{
  for (const Clump &grain : grains)
  {
    for (const ClumpPart &part : grain.parts())
    {
      shape.push_back(part.shape);
      place.push_back(part.position);
      turn.push_back(part.orientation);
    }
    first_part.push_back(static_cast<std::int32_t>(shape.size()));
    grain_volume.push_back(grain.volume());
  }
  measure();
}

void GrainParts::measure()
{
  part_radius.resize(shape.size());
  inscribed.resize(shape.size());
  radius.assign(size(), 0.);
  core.assign(size(), 0.);
  parallel_for(size(),
               [&](const std::size_t i)
               {
                 for (auto k = first_part[i]; k < first_part[i + 1]; ++k)
                 {
                   const double arm = place[k].norm();
                   part_radius[k] = dem::bounding_radius(shape[k]);
                   inscribed[k] = inscribed_radius(shape[k]);
                   radius[i] = std::max(radius[i], arm + part_radius[k]);
                   core[i] = std::max(core[i], inscribed[k] - arm);
                 }
               });
}

double GrainParts::largest_inscribed_radius() const
{
  return inscribed.empty() ? 0. : *std::max_element(inscribed.begin(), inscribed.end());
}

double GrainParts::largest_bounding_radius() const
{
  return radius.empty() ? 0. : *std::max_element(radius.begin(), radius.end());
}

/// @param arm of the part's centre from the grain's, global frame [m]
PlacedGrain GrainParts::part(const std::size_t k, const Vec3 &arm, const GrainPlace &grain) const
{
  return {shape[k], make_pose(shape[k], grain.position + arm, grain.orientation * turn[k]), part_radius[k],
          inscribed[k]};
}

bool GrainParts::is_inside(const PackingSpace &space, const std::size_t i, const GrainPlace &grain) const
{
  for (auto k = first_part[i]; k < first_part[i + 1]; ++k)
    if (!space.contains(part(k, grain.orientation * place[k], grain).pose, part_radius[k]))
      return false;
  return true;
}

bool GrainParts::are_apart(const std::size_t i, const GrainPlace &place_i, const std::size_t j,
                           const GrainPlace &place_j, const Vec3 &centre_line) const
{
  for (auto k = first_part[i]; k < first_part[i + 1]; ++k)
    for (auto l = first_part[j]; l < first_part[j + 1]; ++l)
    {
      const Vec3 arm_k = place_i.orientation * place[k], arm_l = place_j.orientation * place[l],
                 line = centre_line + arm_l - arm_k;
      const double reach = part_radius[k] + part_radius[l];
      if (line.squaredNorm() <= reach * reach &&
          !dem::are_apart(part(k, arm_k, place_i), part(l, arm_l, place_j), line))
        return false;
    }
  return true;
}

} // namespace bergamo::dem
