#include "dem/flow/inlet_parameters.h"

#include "dem/core/error.h"
#include "dem/packing/largest_grain.h"

#include <cmath>
#include <string>

namespace bergamo::dem
{

void InletParameters::validate(const std::int32_t n_materials) const
{
  std::visit([](const auto &sand) { sand.validate(); }, grading);
  const double diameter = 2. * largest_bounding_radius(grading);
  require(box.low.allFinite() && box.high.allFinite(), "sum of the corners of an inlet's box",
          box.low.sum() + box.high.sum(), "finite [m]");
  for (int d = 0; d < 3; ++d)
    if (!(box.edges()[d] > diameter))
      reject("edge of an inlet's box along ", "xyz"[d], " is ", box.edges()[d],
             " m: it must be longer than the bounding sphere of its largest grains is wide, ", diameter,
             " m; choose a larger box or smaller grains");
  require(material >= 0 && material < n_materials, "material of an inlet's grains", material,
          "the number of one of the " + std::to_string(n_materials) + " materials of the table, counted from 0");
  require(mass_rate >= 0. && std::isfinite(mass_rate), "mass rate of an inlet", mass_rate, "at least 0 [kg/s]");
  require(number_rate >= 0. && std::isfinite(number_rate), "number rate of an inlet", number_rate, "at least 0 [1/s]");
  if ((mass_rate > 0.) == (number_rate > 0.))
    reject("mass rate and number rate of an inlet are ", mass_rate, " kg/s and ", number_rate,
           " 1/s: one of both must be positive and the other one 0");
  require(velocity.allFinite(), "sum of the velocity of an inlet's grains", velocity.sum(), "finite [m/s]");
  require((velocity_spread.array() >= 0.).all() && velocity_spread.allFinite(),
          "least spread of the velocity of an inlet's grains", velocity_spread.minCoeff(),
          "at least 0 and finite [m/s]");
  require(step_interval >= 1, "steps between two additions of an inlet", step_interval, "at least 1");
  require(n_trials >= 1, "trials of an inlet's grain", n_trials, "at least 1");
}

} // namespace bergamo::dem
