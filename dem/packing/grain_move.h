#pragma once

#include "dem/geometry/contact_geometry.h"
#include "dem/packing/random_stream.h"

#include <span>

namespace bergamo::dem
{

/// A plane that a grain must stay below.
struct TangentPlane
{
  Vec3 normal;   ///< unit, away from the grain
  double room;   ///< between the grain and the plane [m]
  double height; ///< of the grain above its centre, along the normal [m]
};

/// What a grain may do at once.
struct MoveLimits
{
  double translation = 0.; ///< [m]
  double angle = 0.;       ///< [rad]
  double growth = 0.;      ///< of its size, over the size
  double translation_probability = 0.5;
};

struct GrainMove
{
  Vec3 translation = Vec3::Zero(); ///< [m]
  Quaternion rotation = Quaternion::Identity();
  double growth = 0.; ///< of the size, over the size
};

/// Moves a grain between planes and lets it grow as far as they leave room (Wellmann 3.4.4, algorithm 2): it goes away
/// from the nearest plane, or turns the point nearest to it away, by a random share of what is possible, then grows.
GrainMove choose_move(const BodyPose &grain, std::span<TangentPlane> planes, const MoveLimits &limits,
                      RandomStream &random);

} // namespace bergamo::dem
