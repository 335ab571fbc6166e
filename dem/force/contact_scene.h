#pragma once

#include "dem/force/contact_law.h"
#include "dem/force/contact_parameters.h"
#include "dem/state/particles.h"
#include "dem/state/surface.h"
#include "dem/state/wall.h"

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Bodies that contacts give loads to: particles first, then walls, and one for all surfaces, whose nodes take theirs
/// contact by contact.
struct BodyCount
{
  std::size_t particles, walls;

  std::size_t all() const { return particles + walls + 1; }
};

/// What the contacts of one pair of materials see of a step.
struct ContactScene
{
  const Particles &particles;
  const std::vector<PlaneWall> &walls;
  const ContactLaw &law;
  const ContactParameters &parameters;
  double time_step; ///< of the drift that led here [s]
  std::span<const Surface> surfaces = {};
  double surface_motion = 0.; ///< paths that the nodes of all surfaces have not exceeded since the start, added up [m]

  BodyCount bodies() const { return {particles.size(), walls.size()}; }
};

} // namespace bergamo::dem
