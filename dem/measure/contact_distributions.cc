#include "dem/measure/contact_distributions.h"

#include "dem/measure/force_statistics.h"
#include "dem/measure/histogram.h"

#include <cstdio>

namespace bergamo::dem
{
namespace
{

constexpr Bins force_bins{24, 6.}, friction_bins{10, 1.};
constexpr int direction_bins = 9;
constexpr double direction_width = 90. / direction_bins;

std::string name_of_bin(const char *what, const double low, const double high, const char *unit)
{
  char text[96];
  std::snprintf(text, sizeof text, "%s_%g_to_%g%s", what, low, high, unit);
  return text;
}

} // namespace

std::vector<std::pair<std::string, double>> contact_distributions(const std::span<const TouchingContact> contacts,
                                                                  const double friction)
{
  std::vector<std::pair<std::string, double>> bins;
  const auto add = [&](const char *what, const std::vector<double> &values, const double width, const char *unit)
  {
    for (std::size_t k = 0; k < values.size(); ++k)
      bins.emplace_back(name_of_bin(what, k * width, (k + 1) * width, unit), values[k]);
  };
  const DirectionDistribution directions = direction_distribution(contacts, Vec3::UnitZ(), direction_bins);
  add("normal_force_over_mean", histogram(relative_normal_forces(contacts), force_bins).density, force_bins.width(),
      "");
  add("mobilised_friction", histogram(mobilised_friction(contacts, friction), friction_bins).density,
      friction_bins.width(), "");
  add("contact_density", directions.density, direction_width, "_deg");
  add("normal_force", directions.normal_force, direction_width, "_deg");
  return bins;
}

} // namespace bergamo::dem
