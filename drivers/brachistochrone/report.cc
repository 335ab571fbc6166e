#include "drivers/brachistochrone/report.h"

#include <cmath>
#include <string>

namespace bergamo::driver
{
namespace
{

std::vector<double> orders(const std::vector<double> &facets, const std::vector<double> &deviation)
{
  std::vector<double> orders;
  for (std::size_t k = 0; k + 1 < facets.size(); ++k)
    orders.push_back(std::log(deviation[k] / deviation[k + 1]) / std::log(facets[k + 1] / facets[k]));
  return orders;
}

} // namespace

void add_slides(Summary &summary, const std::vector<SlideSettings> &slides, const std::vector<SlideFigures> &figures)
{
  for (const auto &[curve, name] : {std::pair(Curve::plane, std::string("plane")), {Curve::cycloid, "cycloid"}})
  {
    std::vector<double> facets, times, misses, distances, x, z;
    double exact = 0;
    for (std::size_t k = 0; k < slides.size(); ++k)
      if (slides[k].curve == curve)
      {
        const SlideFigures &f = figures[k];
        exact = f.exact_travel_time;
        facets.push_back(slides[k].n_facets);
        times.push_back(f.travel_time);
        misses.push_back(std::abs(f.travel_time - exact));
        distances.push_back(f.distance());
        x.push_back(f.x);
        z.push_back(f.z);
      }
    if (curve == Curve::plane)
      summary.set("facets", facets);
    summary.set(name + "_exact_travel_time_s", exact, "s");
    summary.set(name + "_travel_times_s", times, "s");
    summary.set(name + "_distances_from_path_m", distances, "m");
    summary.set(name + "_x_differences_m", x, "m");
    summary.set(name + "_z_differences_m", z, "m");
    if (curve == Curve::plane) // what is left there does not come from the facets
      continue;
    summary.set(name + "_distance_orders", orders(facets, distances));
    summary.set(name + "_z_difference_orders", orders(facets, z));
    summary.set(name + "_travel_time_orders", orders(facets, misses));
  }
}

} // namespace bergamo::driver
