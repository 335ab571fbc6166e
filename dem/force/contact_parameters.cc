#include "dem/force/contact_parameters.h"

#include "dem/core/error.h"

namespace bergamo::dem
{

void ContactParameters::validate() const
{
  require(overlap_tolerance >= 0. && overlap_tolerance <= 0.1, "overlap tolerance", overlap_tolerance, "in [0, 0.1]");
  require(curvature_bound > 0. && curvature_bound <= 1., "contact curvature bound", curvature_bound, "in (0, 1]");
}

} // namespace bergamo::dem
