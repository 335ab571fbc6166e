#include "drivers/brachistochrone/path.h"
#include "drivers/brachistochrone/slide.h"
#include "drivers/common/forecast/forecast_parts.h"
#include "drivers/common/forecast/step_trial.h"

#include <cmath>
#include <numeric>

namespace bergamo::driver
{

Forecast SlideParameters::forecast() const
{
  Forecast f;
  f.n_grains = 1;
  f.files = {{"histories", static_cast<double>(slides().size()), output.n_samples * bytes_of_row(13)},
             grain_pictures(static_cast<double>(slides().size() * output.n_pictures), 1, 6)};
  constexpr double bytes_of_facet = 180;
  const double n_facets = std::accumulate(facets.begin(), facets.end(), 0.);
  f.files.push_back({"pictures of the tracks", 2. * output.n_pictures, n_facets * bytes_of_facet});
  double seconds = 0;
  for (const SlideSettings &settings : slides())
  {
    Slide slide(*this, settings);
    if (seconds == 0) // the number of facets does not count: the sphere touches one or two
      seconds = seconds_of([&] { slide.grains().step(); });
    f.stages.push_back({settings.name(), std::ceil(slide.exact_travel_time() / simulation.time_step), true,
                        simulation.time_step, 0, seconds});
  }
  f.unknown.emplace_back("by some steps when the sphere arrives, which is what is measured: the closed form is told");
  f.add_own_files(output.snapshot_interval, 1e5);
  return f;
}

} // namespace bergamo::driver
