#include "drivers/common/run/joined_start.h"

#include "dem/core/error.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"

namespace bergamo::driver
{

void start_at_rest(coupling::TwoScaleModel &model, Progress &progress)
{
  if (!model.overlap())
    return;
  model.compute_forces();
  try
  {
    fe::find_equilibrium(*model.body());
  }
  catch (const RunError &)
  {
    progress.warn(
        "the continuum does not bear what the grains of the overlap put on it from place to place: it starts "
        "with the mean stresses that it was given, and yields; strengthen the material or take larger elements");
  }
  model.overlap()->begin();
}

} // namespace bergamo::driver
