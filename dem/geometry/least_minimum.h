#pragma once

#include "dem/geometry/contact_geometry.h"

namespace bergamo::dem
{

/// The least minimum of phi over all directions, with proof: wherever phi is not shown to be larger, it is evaluated.
/// What is found is at most 3e-10 of the smallest half-axis above the least value there is. Costs about 120
/// evaluations; where 3000 bring no proof, the best direction known is taken.
/// @param first the result of a search that may have missed it: a converged one is returned unchanged if nothing lower
///        exists; an open one is returned as touching or separated once it is proven, otherwise as undecided
ContactGeometry find_least_minimum(const BodyPose &body1, const BodyPose &body2, const ContactGeometry &first);

} // namespace bergamo::dem
