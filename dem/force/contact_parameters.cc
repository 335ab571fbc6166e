#include "dem/force/contact_parameters.h"

#include "dem/core/error.h"

namespace bergamo::dem
{

void ContactParameters::validate() const
{
  require(motion_budget >= 0. && motion_budget <= 0.01, "contact motion budget", motion_budget, "in [0, 0.01]");
  require(curvature_bound > 0. && curvature_bound <= 1., "contact curvature bound", curvature_bound, "in (0, 1]");
}

} // namespace bergamo::dem
