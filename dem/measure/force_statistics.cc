#include "dem/measure/force_statistics.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace bergamo::dem
{
namespace
{

/// A sliding contact's tangential force is scaled to the limit, so only rounding keeps it from being exactly there.
constexpr double sliding = 1. - 1e-9;

} // namespace

double mean_normal_force(const std::span<const TouchingContact> contacts)
{
  double sum = 0.;
  for (const TouchingContact &contact : contacts)
    sum += contact.state.forces.normal;
  return contacts.empty() ? 0. : sum / static_cast<double>(contacts.size());
}

std::vector<double> relative_normal_forces(const std::span<const TouchingContact> contacts)
{
  const double mean = mean_normal_force(contacts);
  std::vector<double> forces;
  forces.reserve(contacts.size());
  for (const TouchingContact &contact : contacts)
    forces.push_back(mean > 0. ? contact.state.forces.normal / mean : 0.);
  return forces;
}

std::vector<double> mobilised_friction(const std::span<const TouchingContact> contacts, const double friction)
{
  std::vector<double> shares;
  shares.reserve(contacts.size());
  for (const TouchingContact &contact : contacts)
  {
    const double limit = friction * contact.state.forces.normal;
    shares.push_back(limit > 0. ? std::min(contact.state.forces.tangential.norm() / limit, 1.) : 0.);
  }
  return shares;
}

double sliding_fraction(const std::span<const TouchingContact> contacts, const double friction)
{
  if (contacts.empty())
    return 0.;
  const std::vector<double> shares = mobilised_friction(contacts, friction);
  const auto n_sliding = std::count_if(shares.begin(), shares.end(), [](const double x) { return x >= sliding; });
  return static_cast<double>(n_sliding) / static_cast<double>(contacts.size());
}

DirectionDistribution direction_distribution(const std::span<const TouchingContact> contacts, const Vec3 &axis,
                                             const int n_bins)
{
  require(n_bins >= 1, "number of bins", n_bins, "1 or more");
  require(axis.norm() > 0. && axis.allFinite(), "length of the axis", axis.norm(), "positive and finite");
  const double bin_angle = 0.5 * std::numbers::pi / n_bins, mean_force = mean_normal_force(contacts);
  std::vector<std::int64_t> count(n_bins, 0);
  std::vector<double> force(n_bins, 0.);
  for (const TouchingContact &contact : contacts)
  {
    const Vec3 &n = contact.state.normal;
    const double angle = std::atan2(n.cross(axis).norm(), std::abs(n.dot(axis)));
    const int k = std::min(static_cast<int>(angle / bin_angle), n_bins - 1);
    ++count[k];
    force[k] += contact.state.forces.normal;
  }
  DirectionDistribution result{std::vector<double>(n_bins, 0.), std::vector<double>(n_bins, 0.)};
  for (int k = 0; k < n_bins; ++k)
  {
    if (count[k] == 0)
      continue;
    const double n = static_cast<double>(count[k]);
    const double share_of_sphere = std::cos(k * bin_angle) - std::cos((k + 1) * bin_angle);
    result.density[k] = n / (static_cast<double>(contacts.size()) * share_of_sphere);
    result.normal_force[k] = mean_force > 0. ? force[k] / (n * mean_force) : 0.;
  }
  return result;
}

} // namespace bergamo::dem
