#pragma once

#include "dem/state/surface.h"

#include <functional>
#include <vector>

namespace bergamo::dem
{

/// Where a rigid surface is at a time.
struct SurfacePlacement
{
  Vec3 shift = Vec3::Zero(); ///< [m]
  Vec3 turn = Vec3::Zero();  ///< about the path's pivot, as a rotation vector: along the axis, of the angle [rad]
};

/// Motion of a surface as a function of time: a drum, a blade, a shaken box. Nodes are placed from where they were at
/// the start, so that no step's error stays. After each step of the simulation: path.move(surface, time, time step).
class SurfacePath
{
public:
  /// @param surface in its place of zero shift and turn, which becomes rigid and keeps the forces on its nodes
  /// @param pivot that turns leave in place [m]; @param placement by time [s]; zero at the present time, or the surface
  ///        jumps there in its first step
  SurfacePath(Surface &surface, const Vec3 &pivot, std::function<SurfacePlacement(double)> placement);

  /// Throws RunError for a placement that is not finite. @param time that the step has led to [s]
  void move(Surface &surface, double time, double time_step) const;

private:
  std::vector<Vec3> arm_; // from the pivot to the nodes
  Vec3 pivot_;
  std::function<SurfacePlacement(double)> placement_;
};

} // namespace bergamo::dem
