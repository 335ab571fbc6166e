#include "fe_dealii/stable_step.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "fe_dealii/element/largest_eigenvalue.h"
#include "fe_dealii/moving_body.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace bergamo::fe
{

StableStep stable_step(const MovingBody &body)
{
  std::vector<double> eigenvalue(body.n_elements());
  parallel_for(
      eigenvalue.size(), [&](const std::size_t e)
      { eigenvalue[e] = largest_eigenvalue(body.elements(), e, body.displacement().data()) / body.mass_factor(e); });
  for (std::size_t e = 0; e < eigenvalue.size(); ++e)
    if (!std::isfinite(eigenvalue[e]))
      throw RunError(body.describe(e) + " a stiffness that is no finite number; look for what is none in the motion of "
                                        "its nodes");
  const auto largest = std::max_element(eigenvalue.begin(), eigenvalue.end());
  return {2 / std::sqrt(*largest), *largest, std::size_t(largest - eigenvalue.begin())};
}

void require_stable(const MovingBody &body, const double time_step)
{
  const StableStep stable = stable_step(body);
  if (time_step <= stable.time_step)
    return;
  const std::array<double, 3> place = body.present_centre(stable.element);
  std::ostringstream message;
  message << "continuum: the time step of " << time_step << " s is above the stable one of " << stable.time_step
          << " s that element " << stable.element << " at (" << place[0] << ", " << place[1] << ", " << place[2]
          << ") m sets; choose a smaller step, larger elements there, or mass scaling";
  throw RunError(message.str());
}

} // namespace bergamo::fe
