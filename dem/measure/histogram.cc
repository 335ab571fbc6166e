#include "dem/measure/histogram.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bergamo::dem
{

void Bins::validate() const
{
  require(n >= 1, "number of bins", n, "1 or more");
  require(highest > 0. && std::isfinite(highest), "end of the last bin", highest, "positive and finite");
}

Histogram histogram(const std::span<const double> values, const Bins &bins)
{
  bins.validate();
  std::vector<std::int64_t> count(bins.n, 0);
  std::int64_t n_above = 0;
  for (const double x : values)
    if (x <= bins.highest)
      ++count[std::min(static_cast<int>(x / bins.width()), bins.n - 1)];
    else
      ++n_above;
  Histogram result{bins.width(), std::vector<double>(bins.n, 0.)};
  if (values.empty())
    return result;
  const double n = static_cast<double>(values.size());
  for (int k = 0; k < bins.n; ++k)
    result.density[k] = static_cast<double>(count[k]) / (n * bins.width());
  result.share_above = static_cast<double>(n_above) / n;
  return result;
}

} // namespace bergamo::dem
