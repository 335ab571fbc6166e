#include "drivers/common/sand_file.h"

#include "dem/core/error.h"
#include "dem/geometry/contact_geometry.h"

namespace bergamo::driver
{
namespace
{

constexpr double largest_overlap = 0.1; // with a wall, of the smallest half-axis: soft grains have some percent
constexpr double rounding = 1e-6;       // of half-axes that a picture has in single precision

void require_inside(const dem::Particles &grains, const std::size_t part, const dem::Box &box, const std::string &file)
{
  const dem::Superquadric &shape = grains.parts.shape[part];
  const dem::BodyPose pose = dem::make_pose(shape, grains.part_position(part), grains.part_orientation(part));
  const double allowed = largest_overlap * shape.half_axes.minCoeff();
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1., 1.})
    {
      const double reach = side * pose.position[axis] + dem::support(pose, side * Vec3::Unit(axis)).height;
      const double wall = side > 0. ? box.high[axis] : -box.low[axis];
      if (!(reach <= wall + allowed))
        reject("Sand/grains file, ", file, ": the grain ", grains.parts.particle[part], ", counted from 0, reaches to ",
               "xyz"[axis], " = ", side * reach, " m, out of Sand/box, whose wall is at ", side * wall,
               " m; move the grain, or give the box a larger edge");
    }
}

} // namespace

dem::GrainsOfFile read_sand(const SandParameters &sand, const dem::Box &box, const dem::Material &grain)
{
  const dem::GrainDistribution &limits = sand.distribution;
  dem::GrainsOfFile file = dem::read_grains(sand.grains_file, dem::MaterialTable({grain}));
  const dem::Particles &grains = file.particles;
  for (std::size_t k = 0; k < grains.parts.size(); ++k)
  {
    const Vec3 &half_axes = grains.parts.shape[k].half_axes;
    if (half_axes.minCoeff() < (1. - rounding) * limits.smallest_half_axis ||
        half_axes.maxCoeff() > (1. + rounding) * limits.largest_half_axis)
      reject("Sand/grains file, ", sand.grains_file, ": the grain ", grains.parts.particle[k], ", counted from 0, has ",
             "half-axes of ", half_axes.minCoeff(), " to ", half_axes.maxCoeff(), " m; set Sand/smallest half-axis (",
             limits.smallest_half_axis, " m) and Sand/largest half-axis (", limits.largest_half_axis,
             " m) so that they hold all grains");
    require_inside(grains, k, box, sand.grains_file);
  }
  return file;
}

} // namespace bergamo::driver
