#pragma once

#include "dem/geometry/contact_geometry.h"

namespace bergamo::dem
{

/// Contact search without a guess. Decides every pair: from the centre line first, then, where that stalls or may have
/// found another minimum than the least, by bounds over all directions; a pair that stays open is `undecided`.
/// Bodies must not share their centre.
ContactGeometry find_contact(const BodyPose &body1, const BodyPose &body2);

/// Contact search from the normal of an earlier, nearby configuration; falls back to find_contact where it fails.
/// @param guess unit vector from body 1 to body 2.
ContactGeometry update_contact(const BodyPose &body1, const BodyPose &body2, const Vec3 &guess);

} // namespace bergamo::dem
