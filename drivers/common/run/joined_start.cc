#include "drivers/common/run/joined_start.h"

#include "drivers/common/number_text.h"
#include "fe_dealii/equilibrium/static_equilibrium.h"

namespace bergamo::driver
{

void start_at_rest(coupling::TwoScaleModel &model, Progress &progress)
{
  if (!model.overlap())
    return;
  model.compute_forces();
  // What is not borne is a small part of all forces, though it may be beyond the strength of a few elements.
  const fe::EquilibriumReport report =
      fe::find_equilibrium(*model.body(), {.least_increment = 1. / 16, .least_share = 0});
  if (report.borne < 1)
    progress.warn("the continuum bears " + short_text(100 * report.borne, 3) +
                  " % of what the grains of the overlap put on it from place to place, and yields under the rest, " +
                  short_text(report.left, 2) + " of all forces; strengthen the material or take larger elements");
  model.overlap()->begin();
}

} // namespace bergamo::driver
