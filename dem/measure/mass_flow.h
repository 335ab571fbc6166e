#pragma once

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Flow of a discharge between two masses that have passed.
struct MassFlow
{
  double begin = 0., end = 0.; ///< times at which they had passed [s]
  double mean = 0.;            ///< [kg/s]; 0 where nothing has passed between
  double deviation = 0.;       ///< standard deviation of the windows' flows from their mean [kg/s]
  std::vector<double> windows; ///< flow in each of them [kg/s]
};

/// Two masses that pass one after the other [kg].
struct MassSpan
{
  double first, last;
};

/// The mean flow from the time at which the first mass had passed to that of the last one, and that of windows of equal
/// length between. Samples are joined by straight lines; where the last mass has not passed, the last sample counts.
/// Throws ConfigError for arrays of different lengths, times that do not ascend, masses that fall, or no window.
/// @param times of the samples [s]; @param masses that had passed by then [kg]
MassFlow mass_flow(std::span<const double> times, std::span<const double> masses, const MassSpan &span, int n_windows);

} // namespace bergamo::dem
