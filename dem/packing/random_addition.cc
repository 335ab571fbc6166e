#include "dem/packing/random_addition.h"

#include "dem/contact/common_normal.h"
#include "dem/core/error.h"
#include "dem/packing/distribution.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace bergamo::dem
{
namespace
{

/// Grains placed so far, by cells as wide as the largest grain.
class PlacedGrains
{
public:
  PlacedGrains(const Box &box, const double cell_size) : box(box)
  {
    for (int d = 0; d < 3; ++d)
      n[d] = std::max(1, static_cast<int>(box.edges()[d] / cell_size));
    cells.resize(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
  }

  void add(const std::int32_t i, const Vec3 &x) { cells[index(cell(x))].push_back(i); }

  template <class Predicate>
  bool any_near(const Vec3 &x, Predicate &&predicate) const
  {
    const Eigen::Vector3i centre = cell(x);
    for (int z = std::max(centre[2] - 1, 0); z <= std::min(centre[2] + 1, n[2] - 1); ++z)
      for (int y = std::max(centre[1] - 1, 0); y <= std::min(centre[1] + 1, n[1] - 1); ++y)
        for (int k = std::max(centre[0] - 1, 0); k <= std::min(centre[0] + 1, n[0] - 1); ++k)
          for (const std::int32_t i : cells[index({k, y, z})])
            if (predicate(i))
              return true;
    return false;
  }

private:
  Eigen::Vector3i cell(const Vec3 &x) const
  {
    Eigen::Vector3i c;
    for (int d = 0; d < 3; ++d)
      c[d] = std::clamp(static_cast<int>((x[d] - box.low[d]) / box.edges()[d] * n[d]), 0, n[d] - 1);
    return c;
  }

  std::size_t index(const Eigen::Vector3i &c) const
  {
    return (static_cast<std::size_t>(c[2]) * n[1] + c[1]) * n[0] + c[0];
  }

  Box box;
  int n[3];
  std::vector<std::vector<std::int32_t>> cells;
};

bool lies_inside(const BodyPose &pose, const Box &box)
{
  for (int d = 0; d < 3; ++d)
  {
    const Vec3 axis = Vec3::Unit(d);
    if (pose.position[d] + support(pose, axis).height > box.high[d] ||
        pose.position[d] - support(pose, -axis).height < box.low[d])
      return false;
  }
  return true;
}

} // namespace

Particles add_at_random(const std::span<const Superquadric> grains, const Box &box, const double density,
                        std::mt19937_64 &generator)
{
  constexpr int max_trials = 100000;
  double largest = 0., solid_volume = 0.;
  for (const Superquadric &grain : grains)
    largest = std::max(largest, bounding_radius(grain));

  Particles particles;
  PlacedGrains placed(box, 2. * largest);
  std::uniform_real_distribution<double> uniform(0., 1.);
  for (const Superquadric &grain : grains)
  {
    const double radius = bounding_radius(grain);
    bool is_placed = false;
    for (int trial = 0; trial < max_trials && !is_placed; ++trial)
    {
      const Vec3 share(uniform(generator), uniform(generator), uniform(generator));
      const Vec3 x = box.low + share.cwiseProduct(box.edges());
      const Quaternion orientation = draw_orientation(generator);
      const BodyPose pose = make_pose(grain, x, orientation);
      const auto overlaps = [&](const std::int32_t i)
      {
        const double range = radius + particles.bounding_radius[i];
        if ((particles.position[i] - x).squaredNorm() >= range * range)
          return false;
        const BodyPose other = make_pose(particles.shape[i], particles.position[i], particles.orientation[i]);
        return find_contact(pose, other).status != ContactStatus::separated;
      };
      if (!lies_inside(pose, box) || placed.any_near(x, overlaps))
        continue;
      placed.add(static_cast<std::int32_t>(particles.size()), x);
      particles.add(grain, density, x, orientation);
      is_placed = true;
    }
    if (!is_placed)
    {
      std::ostringstream message;
      message << "the packing does not fit: grain " << particles.size() + 1 << " of " << grains.size()
              << " found no place in the box of " << box.edges().transpose() << " m, the solid fraction reached is "
              << solid_volume / box.volume()
              << "; choose a larger box, smaller grains or a smaller initial solid fraction (0.22 works)";
      throw ConfigError(message.str());
    }
    solid_volume += volume(grain);
  }
  return particles;
}

} // namespace bergamo::dem
