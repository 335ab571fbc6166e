#include "drivers/rve_triaxial/distributions.h"

#include "dem/measure/force_statistics.h"
#include "dem/measure/histogram.h"

#include <cstdio>

namespace bergamo::driver
{
namespace
{

constexpr dem::Bins force_bins{24, 6.}, friction_bins{10, 1.};
constexpr int direction_bins = 9;

std::string name_of_bin(const char *what, const double low, const double high, const char *unit)
{
  char text[96];
  std::snprintf(text, sizeof text, "%s_%g_to_%g%s", what, low, high, unit);
  return text;
}

} // namespace

std::vector<std::string> distribution_columns()
{
  std::vector<std::string> names{"time_s", "stage"};
  const auto add = [&](const char *what, const int n, const double width, const char *unit)
  {
    for (int k = 0; k < n; ++k)
      names.push_back(name_of_bin(what, k * width, (k + 1) * width, unit));
  };
  add("normal_force_over_mean", force_bins.n, force_bins.width(), "");
  add("mobilised_friction", friction_bins.n, friction_bins.width(), "");
  add("contact_density", direction_bins, 90. / direction_bins, "_deg");
  add("normal_force", direction_bins, 90. / direction_bins, "_deg");
  return names;
}

std::vector<double> distribution_row(const double time, const std::int64_t stage,
                                     const std::span<const dem::TouchingContact> contacts, const double friction)
{
  std::vector<double> row{time, static_cast<double>(stage)};
  const auto add = [&](const std::vector<double> &values) { row.insert(row.end(), values.begin(), values.end()); };
  add(dem::histogram(dem::relative_normal_forces(contacts), force_bins).density);
  add(dem::histogram(dem::mobilised_friction(contacts, friction), friction_bins).density);
  const dem::DirectionDistribution directions = dem::direction_distribution(contacts, Vec3::UnitZ(), direction_bins);
  add(directions.density);
  add(directions.normal_force);
  return row;
}

} // namespace bergamo::driver
