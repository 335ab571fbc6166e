#include "dem/measure/beverloo.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace bergamo::dem
{
namespace
{

double exponent(const BeverlooScale &scale)
{
  return scale.slot_length > 0. ? 1.5 : 2.5;
}

/// Flow over C and the power of the effective width.
double unit_flow(const BeverlooScale &scale)
{
  return scale.bulk_density * std::sqrt(scale.gravity) * (scale.slot_length > 0. ? scale.slot_length : 1.);
}

} // namespace

double BeverlooLaw::flow(const double width, const BeverlooScale &scale) const
{
  return c * unit_flow(scale) * std::pow(std::max(0., width - k * scale.diameter), exponent(scale));
}

BeverlooLaw fit_beverloo(const std::span<const double> widths, const std::span<const double> flows,
                         const BeverlooScale &scale)
{
  require(flows.size() == widths.size(), "number of flows for Beverloo's law", flows.size(),
          "that of the widths, " + std::to_string(widths.size()));
  for (const double flow : flows)
    require(flow > 0. && std::isfinite(flow), "flow for Beverloo's law", flow, "positive [kg/s]");
  const double n = static_cast<double>(widths.size());
  double x = 0., y = 0., xx = 0., xy = 0.;
  for (std::size_t k = 0; k < widths.size(); ++k)
  {
    x += widths[k] / n;
    y += std::pow(flows[k], 1. / exponent(scale)) / n;
  }
  for (std::size_t k = 0; k < widths.size(); ++k)
  {
    xx += (widths[k] - x) * (widths[k] - x);
    xy += (widths[k] - x) * (std::pow(flows[k], 1. / exponent(scale)) - y);
  }
  require(xx > 0., "spread of the widths for Beverloo's law", xx, "positive: give two widths at least");
  require(xy > 0., "growth of the flow with the width for Beverloo's law", xy / xx, "positive");
  const double slope = xy / xx;
  return {std::pow(slope, exponent(scale)) / unit_flow(scale), (x - y / slope) / scale.diameter};
}

} // namespace bergamo::dem
