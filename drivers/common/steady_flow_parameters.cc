#include "drivers/common/steady_flow_parameters.h"

#include "dem/core/error.h"

namespace bergamo::driver
{

void SteadyFlowParameters::declare(ParameterFile &file)
{
  file.add("Steady flow", "first share", first_share, "of the mass that is discharged when the steady flow begins",
           Range::between(0, 1));
  file.add("Steady flow", "last share", last_share, "when it ends", Range::between(0, 1));
  file.add("Steady flow", "windows", n_windows, "of equal time, whose flows have a standard deviation",
           Range::between(2, 10000));
}

void SteadyFlowParameters::validate(const double end) const
{
  if (!(last_share > first_share))
    reject("Steady flow/last share is ", last_share, "; choose more than its first share, ", first_share);
  if (last_share > end)
    reject("Steady flow/last share is ", last_share, ", but the discharge ends at Discharge/last share, ", end,
           "; choose no more than that");
}

} // namespace bergamo::driver
