#include "drivers/common/run/momentum_residual.h"

#include <algorithm>
#include <numeric>

namespace bergamo::driver
{
namespace
{

Vec3 momentum_of(const dem::Particles &grains)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < grains.size(); ++i)
    sum += grains.mass[i] * grains.velocity[i];
  return sum;
}

/// Of all walls and surfaces on the grains [N].
Vec3 support_of(const dem::Simulation &grains)
{
  Vec3 sum = Vec3::Zero();
  for (const dem::PlaneWall &wall : grains.walls)
    sum -= wall.force;
  for (const dem::Surface &surface : grains.surfaces)
    for (const Vec3 &force : surface.force)
      sum -= force;
  return sum;
}

} // namespace

void MomentumResidual::add_step(const dem::Simulation &grains)
{
  const std::vector<double> &mass = grains.particles.mass;
  const Vec3 weight = std::accumulate(mass.begin(), mass.end(), 0.) * grains.parameters().gravity;
  const double kick = grains.steps().next_kick;
  impulse_ += kick * (weight + support_of(grains));
  weight_impulse_ += kick * weight.norm();
}

const Vec3 &MomentumResidual::look(const dem::Simulation &grains)
{
  const Vec3 balance = momentum_of(grains.particles) - impulse_;
  if (n_looks_++ == 0)
    first_ = balance;
  present_ = balance - first_;
  largest_ = std::max(largest_, present_.norm());
  largest_impulse_ = std::max(largest_impulse_, weight_impulse_);
  return present_;
}

void MomentumResidual::visit(StateVisitor &visit)
{
  visit("momentum_residual/n_looks", n_looks_);
  visit("momentum_residual/first", first_);
  visit("momentum_residual/impulse", impulse_);
  visit("momentum_residual/weight_impulse", weight_impulse_);
  visit("momentum_residual/largest", largest_);
  visit("momentum_residual/largest_impulse", largest_impulse_);
}

} // namespace bergamo::driver
