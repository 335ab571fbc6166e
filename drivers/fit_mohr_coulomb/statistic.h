#pragma once

#include <cmath>
#include <limits>
#include <vector>

namespace bergamo::driver
{

/// Mean and sample standard deviation (n − 1 in the denominator); NaN where the values are too few for it.
struct Statistic
{
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();
};

inline Statistic statistic_of(const std::vector<double> &values)
{
  Statistic result;
  const double n = static_cast<double>(values.size());
  if (values.empty())
    return result;
  double sum = 0, squares = 0;
  for (const double value : values)
    sum += value;
  result.mean = sum / n;
  for (const double value : values)
    squares += (value - result.mean) * (value - result.mean);
  if (values.size() > 1)
    result.deviation = std::sqrt(squares / (n - 1));
  return result;
}

} // namespace bergamo::driver
