#include "dem/motion/surface_path.h"

#include "dem/core/error.h"

#include <string>
#include <utility>

namespace bergamo::dem
{

SurfacePath::SurfacePath(Surface &surface, const Vec3 &pivot, std::function<SurfacePlacement(double)> placement)
    : pivot_(pivot), placement_(std::move(placement))
{
  for (const Vec3 &x : surface.node)
    arm_.push_back(x - pivot);
  surface.is_rigid = true;
  surface.velocity.assign(surface.node.size(), Vec3::Zero());
}

void SurfacePath::move(Surface &surface, const double time, const double time_step) const
{
  const SurfacePlacement placement = placement_(time);
  if (!placement.shift.allFinite() || !placement.turn.allFinite())
    throw RunError("a surface's placement is not finite at time " + std::to_string(time) +
                   " s; give a path that is defined until the end of the run");
  const double angle = placement.turn.norm();
  const Vec3 axis = angle > 0. ? Vec3(placement.turn / angle) : Vec3(Vec3::UnitX());
  const Mat3 rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  std::vector<Vec3> places;
  places.reserve(arm_.size());
  for (const Vec3 &arm : arm_)
    places.push_back(pivot_ + placement.shift + rotation * arm);
  surface.move_to(places, time_step);
}

} // namespace bergamo::dem
