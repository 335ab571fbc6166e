#pragma once

#include <span>
#include <vector>

namespace bergamo::dem
{

/// Bins of equal width over [0, highest].
struct Bins
{
  int n = 50;
  double highest = 5.;

  double width() const { return highest / n; }

  /// Throws ConfigError for no bins or an end that is not positive.
  void validate() const;
};

/// Distribution of values that are not negative. sum(density) width + share_above = 1.
struct Histogram
{
  double width = 0.;
  std::vector<double> density; ///< share of the values over the width, bin k from k width to (k + 1) width
  double share_above = 0.;     ///< of values above the last bin
};

/// A value between two bins belongs to the upper one, the end of the last to the last. Zeros without values.
Histogram histogram(std::span<const double> values, const Bins &bins);

} // namespace bergamo::dem
