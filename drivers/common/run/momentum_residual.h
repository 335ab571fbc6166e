#pragma once

#include "dem/simulation/simulation.h"
#include "drivers/common/run/state_visitor.h"

#include <cstdint>

namespace bergamo::driver
{

/// What the momentum of grains misses of the impulses of their weight, of walls and of moving surfaces: zero to
/// rounding. It sums forces that the bodies around the grains got, not those of the grains.
class MomentumResidual
{
public:
  /// Once a step, between kick and drift: takes in what acts over the kick.
  void add_step(const dem::Simulation &grains);

  /// Of the momentum at the half step before, before add_step() of the present step. @return present()
  const Vec3 &look(const dem::Simulation &grains);

  const Vec3 &present() const { return present_; } ///< of the last look since the first one [N s]

  /// The largest of all looks over the impulse of the weight; 0 without weight.
  double relative() const { return largest_impulse_ > 0. ? largest_ / largest_impulse_ : 0.; }

  void visit(StateVisitor &visit);

private:
  std::int64_t n_looks_ = 0;
  Vec3 first_ = Vec3::Zero(), impulse_ = Vec3::Zero(), present_ = Vec3::Zero(); // [N s]
  double weight_impulse_ = 0., largest_ = 0., largest_impulse_ = 0.;            // [N s]
};

} // namespace bergamo::driver
