#pragma once

#include "dem/force/contact_law.h"
#include "dem/force/contact_parameters.h"
#include "dem/state/particles.h"
#include "dem/state/wall.h"

#include <vector>

namespace bergamo::dem
{

/// What the contacts of one pair of materials see of a step.
struct ContactScene
{
  const Particles &particles;
  const std::vector<PlaneWall> &walls;
  const ContactLaw &law;
  const ContactParameters &parameters;
  double time_step; ///< of the drift that led here [s]
};

} // namespace bergamo::dem
