#include "dem/measure/mass_flow.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bergamo::dem
{
namespace
{

/// The straight line between samples at a place of the first array, that of the last one beyond. @param x ascending
double between(const std::span<const double> x, const std::span<const double> y, const double at)
{
  const auto next = std::lower_bound(x.begin(), x.end(), at);
  if (next == x.end())
    return y.back();
  const auto k = static_cast<std::size_t>(next - x.begin());
  return k == 0 ? y.front() : y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}

void check(const std::span<const double> times, const std::span<const double> masses)
{
  require(masses.size() == times.size(), "number of masses of a flow", masses.size(),
          "that of the times, " + std::to_string(times.size()));
  for (std::size_t k = 1; k < times.size(); ++k)
  {
    require(times[k] > times[k - 1], "time of a flow's sample", times[k],
            "later than the one before, " + std::to_string(times[k - 1]) + " s");
    require(masses[k] >= masses[k - 1], "mass of a flow's sample", masses[k],
            "no less than the one before, " + std::to_string(masses[k - 1]) + " kg");
  }
}

} // namespace

MassFlow mass_flow(const std::span<const double> times, const std::span<const double> masses, const MassSpan &span,
                   const int n_windows)
{
  check(times, masses);
  require(n_windows >= 1, "number of windows of a flow", n_windows, "at least 1");
  MassFlow flow;
  if (times.empty())
    return flow;
  flow.begin = between(masses, times, span.first);
  flow.end = between(masses, times, span.last);
  if (!(flow.end > flow.begin))
    return flow;
  const auto passed_at = [&](const int window)
  { return between(times, masses, flow.begin + (flow.end - flow.begin) * window / n_windows); };
  flow.mean = (passed_at(n_windows) - passed_at(0)) / (flow.end - flow.begin);
  double squares = 0.;
  for (int window = 0; window < n_windows; ++window)
  {
    flow.windows.push_back((passed_at(window + 1) - passed_at(window)) / (flow.end - flow.begin) * n_windows);
    squares += (flow.windows.back() - flow.mean) * (flow.windows.back() - flow.mean);
  }
  flow.deviation = n_windows > 1 ? std::sqrt(squares / (n_windows - 1)) : 0.;
  return flow;
}

} // namespace bergamo::dem
