#include "drivers/common/step_advice.h"

#include "dem/motion/stable_step.h"
#include "drivers/common/number_text.h"

namespace bergamo::driver
{

std::vector<std::string> advice_on_step(const NamedTime &step, const double radius, const dem::Material &grain)
{
  constexpr double least_share = 0.01;
  const double limit = dem::stable_step_of_two_spheres(radius, grain, 1e-5); // no packing under load is softer
  if (step.seconds >= least_share * limit)
    return {};
  return {step.name + " is " + short_text(step.seconds) + " s, " + short_text(100 * step.seconds / limit, 2) +
          " % of the " + short_text(limit, 3) +
          " s that two of the smallest grains in contact bear; a tenth of that is usual, and takes " +
          short_text(0.1 * limit / step.seconds, 2) + " times fewer steps"};
}

std::vector<std::string> advice_on_penalty(const double penalty, const double diameter, const double young_modulus)
{
  constexpr double least = 0.01, most = 1e4;
  const double unit = young_modulus / (diameter * diameter), ratio = penalty / unit;
  if (ratio >= least && ratio <= most)
    return {};
  return {"Coupling/penalty is " + short_text(penalty) + " Pa/m2, " + short_text(ratio, 2) +
          " of the continuum's modulus over a grain's diameter squared; " +
          (ratio < least ? "both models may drift apart" : "it needs shorter steps than either model") + ": between " +
          short_text(least * unit, 2) + " and " + short_text(most * unit, 2) + " is usual"};
}

} // namespace bergamo::driver
